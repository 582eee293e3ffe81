#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Auxin transport on the cellular apex: the spiral over many meshes, whorls, mutants and experiments of chapter 5.
source "$(dirname "$0")/common.sh"

value() { awk -v name="$1" '$1 == name { print $2 }' out.txt; }
between() { awk -v x="$(value "$1")" -v low="$2" -v high="$3" 'BEGIN { exit !(x != "" && x >= low && x <= high) }' || wrong "$last: $1 is $(value "$1"), expected $2 to $3"; }
run() { # model arguments: without pictures
  local model=phyllotaxis/$1
  shift
  last="$model $*"
  code 0 "$tunica" "$model" "$@" -q --no-frames --out run
  rm -rf run
}

# pin1 makes no primordia; auxin on its flank makes one there, on its tip a ring of them.
run pin1_mutant --until 30
between primordia 0 0
between highest 5 7.4
says out.txt "outside primordia is 6"
run pin1_mutant variant=npa --until 20
between last 4 9
for seed in 1 2 3; do
  run auxin_application --until 20 --seed $seed
  between primordia 1 1
  between farthest 0 0.8
  run auxin_application variant=tip --until 20 --seed $seed
  between primordia 8 40
  between widest_gap 0 65
done

# Ablation displaces and delays what is about to start; on a single mesh by chance not always.
: >ablated.txt
for seed in 1 2 3 4 5 6; do
  run ablation --until 10 count=0 --seed $seed
  control="$(value delay) $(value displaced)"
  run ablation --until 10 --seed $seed
  echo "$control $(value delay) $(value displaced)" >>ablated.txt
done
awk '{ d += $3 - $1; a += $2; b += $4 } END { exit !(d / NR > 0.1 && b > a + 6 * NR) }' ablated.txt ||
  wrong "ablation changes nothing: $(cat ablated.txt)"

# What is wrong is said, and where a step is too long too.
code 1 "$tunica" phyllotaxis/ablation count=1000 --until 8 --no-frames -q --out bad
says err.txt "would kill all of the"
code 1 "$tunica" phyllotaxis/auxin_application reach=0.01 --until 8 --no-frames -q --out bad2
says err.txt "the place is off the tissue"
code 1 "$tunica" phyllotaxis/auxin_application a=50 --until 8 --no-frames -q --out bad3
says err.txt "off the tissue"
code 1 "$tunica" phyllotaxis/transport_apex Th=1 --until 3 --no-frames -q --out bad4
says err.txt "primordia start at once"
code 1 "$tunica" phyllotaxis/transport_apex r_birth=3 --until 3 --no-frames -q --out bad5
says err.txt "greater than r_most"
for bad in initial=2.5 jugacy=1.5 most=800 max_area=1000 max_area=0.0001; do
  code 1 "$tunica" phyllotaxis/transport_apex $bad --until 1 --no-frames -q --out bad6
  says err.txt "${bad%=*}"
  rm -rf bad6
done
code 3 "$tunica" phyllotaxis/transport_apex method=euler dt=0.02 --until 10 --no-frames -q --out long
says err.txt "try a smaller dt"
rm -rf long
code 3 "$tunica" phyllotaxis/transport_apex dt=0.1 --until 10 --no-frames -q --out long
says err.txt "method's limit of about"
# A mesh on which twice the step of this variant ends below zero.
code 0 "$tunica" phyllotaxis/sensitivity variant=allocation_base --seed 19 --until 25 --no-frames -q --out sharper
code 2 "$tunica" phyllotaxis/transport_apex variant=decusate --no-frames -q
says err.txt "did you mean 'decussate'"

# The spiral lasts on a fine mesh; without discs there is none. (How well: share/doc/transport.md. By chance .15 of the angles count.)
code 0 "$tunica" sweep phyllotaxis/transport_apex variant=fine --seeds 1..6 --until 24 --score spiral --winners 0 -q --out fine.db
code 0 "$tunica" sweep show fine.db --csv
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "spiral") at = i } NR > 1 { sum += $at; ++n } END { exit !(n == 6 && sum / n >= 0.8) }' out.txt ||
  wrong "the spiral of variant=fine does not last"

# On an apex that grows up, from no primordia: the first ones come late and few, not all around at once; and it goes on.
run transport_apex variant=seedling --until 16 --seed 1
between primordia 2 5
between plastochron 0.01 8
run transport_apex variant=fine initial=0 --until 2 --seed 1
between primordia 5 12

# A run that was stopped goes on with the same bits, primordia included.
code 0 "$tunica" phyllotaxis/transport_apex --until 6 --no-frames -q --out whole
cp out.txt whole.txt
code 0 "$tunica" phyllotaxis/transport_apex --until 3 --no-frames -q --out half
code 0 "$tunica" resume half --until 6 -q
[ "$(awk '$1 == "hash"' whole.txt)" == "$(awk '$1 == "hash"' out.txt)" ] || wrong "resumed: another hash"

finish
