#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The shipped models: their numbers, where they must fail, and the same bits in every process and after a resume.
source "$(dirname "$0")/common.sh"

# value NAME: from the report in out.txt.
value() { awk -v name="$1" '$1 == name { print $2 }' out.txt; }
between() { awk -v x="$(value "$1")" -v low="$2" -v high="$3" 'BEGIN { exit !(x != "" && x >= low && x <= high) }' || wrong "$1 is $(value "$1"), expected $2 to $3"; }

# Ring: the step limit of forward Euler is .02445.
code 0 "$tunica" patterning/ring dt=0.024 -q --no-frames --out ring_024
between peaks 3 4
code 3 "$tunica" patterning/ring dt=0.025 -q --no-frames --out ring_025
says err.txt "auxin became"
says err.txt "try a smaller dt"

# Grid: nine peaks, from the outside in, as symmetric as the square.
code 0 "$tunica" patterning/grid -q --no-frames --out grid
between peaks 9 9
between asymmetry 0 1e-9
between onset_border 0 0.2
between onset_centre 2 60

# Sheet at rest: set S of the reference, and no pattern at lower production.
for seed in 1 2 3; do
  code 0 "$tunica" patterning/sheet growth=0 --seed $seed -q --no-frames --out sheet_$seed
  between peaks 7 10
  between spacing 4.1 5.3
  between pin_between_peaks 0.93 0.97
done
code 0 "$tunica" patterning/sheet growth=0 rho=4 -q --no-frames --out sheet_rho
between peaks 0 0

# Division: Errera's rule leaves fewer sharp corners than the nearest wall.
code 0 "$tunica" growth/dividing_sheet -q --no-frames --out errera
between model.sides_5 0.204 0.304
between model.sides_6 0.341 0.441
between model.sides_7 0.208 0.308
between model.area_cv 0.19 0.36
sharp=$(value model.below_60_degrees)
code 0 "$tunica" growth/dividing_sheet rule=closest_wall -q --no-frames --out closest
awk -v a="$sharp" -v b="$(value model.below_60_degrees)" 'BEGIN { exit !(a < b) }' || wrong "sharp cells: errera $sharp, closest wall $(value model.below_60_degrees)"

# Apex: cells divide on the surface as in the plane, and near those of a real apex.
code 0 "$tunica" growth/apex max_area=0.02 to=1.6 --until 6 -q --no-frames --out apex
between model.mean_sides 5.9 6.1
between model.four_way 0 0
between model.area_cv 0.19 0.36
sharp=$(value model.below_60_degrees)
code 0 "$tunica" growth/apex max_area=0.02 to=1.6 rule=closest_wall --until 6 -q --no-frames --out apex_closest
awk -v a="$sharp" -v b="$(value model.below_60_degrees)" 'BEGIN { exit !(a < b) }' || wrong "sharp cells on the apex: errera $sharp, closest wall $(value model.below_60_degrees)"
code 0 "$tunica" growth/apex max_area=0.02 to=1.6 rule=along --until 3 -q --no-frames --out apex_along
between model.four_way 0 0

# The same bits in five processes and after stops. Each model for a short while.
short() { # model end arguments
  local model=$1 end=$2 name expected
  shift 2
  name=${model//\//_}
  code 0 "$tunica" "$model" "$@" --until "$end" -q --no-frames --out "bits_${name}_1"
  expected=$(value hash)
  [ -n "$expected" ] || wrong "$model reports no hash"
  for n in 2 3 4 5; do
    code 0 "$tunica" "$model" "$@" --until "$end" -q --no-frames --out "bits_${name}_$n"
    [ "$(value hash)" = "$expected" ] || wrong "$model: process $n gives $(value hash), not $expected"
  done
  for part in 0.1 0.5 0.9; do
    local stop
    stop=$(awk -v e="$end" -v p=$part 'BEGIN { print e * p }')
    code 0 "$tunica" "$model" "$@" --until "$stop" -q --no-frames --out "stop_${name}_$part"
    code 0 "$tunica" resume "stop_${name}_$part" --until "$end" -q
    [ "$(value hash)" = "$expected" ] || wrong "$model resumed at $stop gives $(value hash), not $expected"
  done
}
short patterning/ring 10
short patterning/grid 5
short patterning/sheet 5 cells=150
short patterning/activator_inhibitor 10
short patterning/real_apex 2
short growth/dividing_sheet 2
short growth/cylinder 6
short growth/apex 1 max_area=0.03 to=1.2
short numerics/gradient_line 20
short numerics/activator_inhibitor 2
short numerics/brusselator 1
short numerics/gray_scott 10
short phyllotaxis/inhibition_single 3
short phyllotaxis/inhibition_two 6 pattern=bijugate
short phyllotaxis/transitions 30
short phyllotaxis/noise 10
short phyllotaxis/threshold_ramp 20
short phyllotaxis/low_resolution 5
short phyllotaxis/arabidopsis_start 2

finish
