#!/usr/bin/env bash
# tunica sweep: the same table however often it was killed and whatever the number of processes; runs that crash, hang or
# eat memory are rows; what is wrong on the command line is said; a full disk loses nothing.
source "$(dirname "$0")/common.sh"

cat >model.lua <<'LUA'
local tunica = require "tunica"
local P = tunica.params { a = { 1, "makes", min = 0, max = 10 }, b = { 2, "decay" }, wait = 0, way = "good", n = 3 }
local core = require "tunica.core"
local begun = core.now()
while core.now() - begun < P.wait do end
if P.way == "error" then error "a mistake" end
if P.way == "crash" then os.execute "kill -SEGV $PPID" end
if P.way == "hang" then while true do pcall(function() while true do end end) end end
if P.way == "memory" then
  local list = {}
  for i = 1, 1e9 do list[i] = ("x"):rep(1e6) .. i end
end
local tissue = tunica.hexagons { 4, 4 }
tissue:cell { auxin = function(c) return 1 + c:uniform(-0.1, 0.1) end }
local model = tunica.model { tissue = tissue, params = P, dt = 0.05, stop = 1 }
model:rate(function(c, d) d.auxin = P.a - P.b * c.auxin end)
model:at(0.5, function() P.b = P.b * (1 + 0.1 * math.random()) end)
model:report { every = 0.2, mean = function() return tissue:mean "auxin" end, word = function() return P.way end,
  inner = function() return { twice = 2 * P.a } end }
return model
LUA

sweep() { "$tunica" sweep model.lua "$@" 2>err.txt; }
table() { "$tunica" sweep show "$1" --csv; }

# --- The same table.
code 0 "$tunica" sweep model.lua a=0..5 b=.5..3 wait=0.002 --random 50 --seeds 1..4 --score "mean - 0.1 * a" --out one.db --jobs 1
says out.txt "score on fresh seeds"
code 0 "$tunica" sweep model.lua a=0..5 b=.5..3 wait=0.002 --random 50 --seeds 1..4 --score "mean - 0.1 * a" --out two.db --jobs 3 -q
silent out.txt
table one.db >one.csv
table two.db >two.csv
same one.csv two.csv
[ "$(wc -l <one.csv)" -eq 221 ] || wrong "200 runs, 20 of winners and a head make $(wc -l <one.csv) lines"
killed=0
for i in $(seq 1 40); do
  "$tunica" sweep model.lua a=0..5 b=.5..3 wait=0.002 --random 50 --seeds 1..4 --score "mean - 0.1 * a" --out killed.db --jobs 2 -q &
  process=$!
  sleep "0.$((2 + RANDOM % 5))"
  kill -9 $process 2>/dev/null && killed=$((killed + 1))
  wait $process 2>/dev/null && break
done
[ "$killed" -ge 1 ] || wrong "no sweep was killed"
code 0 sweep a=0..5 b=.5..3 wait=0.002 --random 50 --seeds 1..4 --score "mean - 0.1 * a" --out killed.db -q
table killed.db >killed.csv
same one.csv killed.csv
# Ctrl-C keeps what is done.
"$tunica" sweep model.lua a=0..5 wait=0.05 --random 100 --out stopped.db --jobs 2 -q 2>err.txt &
process=$!
sleep 1
kill -INT $process
wait $process
[ $? -eq 130 ] || wrong "SIGINT: not 130"
says err.txt "the same command goes on"
[ "$(table stopped.db | wc -l)" -gt 3 ] || wrong "Ctrl-C lost the runs"

# --- A search: the same steps, whatever the number of processes and however often it is killed.
search=("$tunica" sweep model.lua a=0..5 b=.5..3 --refine 40 --seeds 1..2 --score "-(mean - 1)^2 - (a - 2)^2" -q)
code 0 "${search[@]}" --random 6 --out search1.db --jobs 1
for i in 1 2 3 4 5 6 7 8; do
  "${search[@]}" --random 6 --out search2.db --jobs 3 &
  process=$!
  sleep "0.$((2 + RANDOM % 3))"
  kill -9 $process 2>/dev/null
  wait $process 2>/dev/null && break
done
code 0 "${search[@]}" --random 6 --out search2.db --jobs 2
table search1.db >search1.csv
table search2.db >search2.csv
same search1.csv search2.csv
[ "$(wc -l <search1.csv)" -gt 100 ] || wrong "a search of 46 samples has too few rows"
code 2 "${search[@]}" --random 6 --out search2.db --step 0.1
says err.txt "step is 0.1 now, and was 0.2 there"
code 2 "${search[@]}" --out search2.db --random 7
says err.txt "refined from 6 samples"
# Better than the samples it began with.
code 0 "$tunica" sweep show search1.db --best 1
[ "$(grep -A1 '^sample' out.txt | tail -1 | awk '{ print $1 }')" -gt 6 ] || { wrong "the search found nothing better"; cat out.txt; }

# --- A run of a sweep is a run by itself.
line=$("$tunica" sweep show one.db --sample 7 | grep -m1 "tunica model.lua")
hash=$("$tunica" sweep show one.db --sample 7 | grep -m1 hash | sed 's/.*= //')
"$tunica" ${line#*tunica } -q --no-frames --out alone >alone.txt
grep -q "hash *$hash" alone.txt || wrong "a run by itself differs: $line"

# --- What goes wrong is a row.
code 0 sweep way=good,error,crash,hang,memory a=1,2 --grid --time-limit 3 --memory 100 --out bad.db -q
table bad.db | cut -d, -f 1,4 >status.txt
printf '%s\n' sample,status 1,done 2,done 3,failed 4,failed 5,crashed 6,crashed 7,time 8,time 9,memory 10,memory >expected.txt
same status.txt expected.txt
"$tunica" sweep show bad.db --failures >failures.txt
says failures.txt "a mistake"
says failures.txt "not done after 3 s"
says failures.txt "limit of 100 MB"
code 0 sweep way=good,error,crash,hang,memory a=1,2 --grid --time-limit 3 --memory 100 --out bad.db
[ ! -s err.txt ] || wrong "runs that failed are made again"

# --- The score and the table see the parameters that the run had: a variant changes others than the one that is swept.
cat >variant.lua <<'LUA'
local P = require("tunica").params { T = 2, variant = { "a", "v" }, variants = { a = {}, b = { T = 3 } } }
return { twice = 2 * P.T }
LUA
code 0 "$tunica" sweep variant.lua variant=a,b --grid --score T --out variant.db
table variant.db >variant.csv
printf '%s\n' variant,score,T,twice a,2,2,4 b,3,3,6 >expected.txt
cut -d, -f 5- variant.csv >columns.txt
[ "$(sort -u columns.txt)" = "$(sort -u expected.txt)" ] || { wrong "parameters of variants"; cat variant.csv; }

# --- What a run printed does not name its failure.
cat >said.lua <<'LUA'
local P = require("tunica").params { way = "a", D = 1 }
if P.way == "printed" then print "out of memory? no" error "plain failure" end
if P.way == "colon" then error("relative error: 5 percent", 0) end
if P.way == "killed" then os.execute "kill -KILL $PPID" end
if P.way == "left" then os.exit(0) end
return { status = P.D, D = 2 * P.D, x = 1 }
LUA
code 0 "$tunica" sweep said.lua way=printed,colon,killed,left,a --grid --out said.db -q
"$tunica" sweep show said.db --failures >failures.txt
says failures.txt "sample 1 seed 1: failed: said.lua:2: plain failure"
says failures.txt "sample 2 seed 1: failed: relative error: 5 percent"
says failures.txt "sample 3 seed 1: killed: ended from outside"
says failures.txt "sample 4 seed 1: failed: ended with exit code 0"
# Names that meet in the table are told apart.
table said.db | sed -n '1p;6p' >said.csv
printf '%s\n' sample,seed,fresh,status,way,parameter.D,report.D,report.status,x 5,1,0,done,a,1,2,1,1 >expected.txt
same said.csv expected.txt

# --- A score that runs for ever has none.
code 0 timeout 60 "$tunica" sweep said.lua D=1,2 --grid --score "(function() while true do end end)()" --out endless.db -q
says err.txt "does it end?"
code 0 timeout 60 "$tunica" sweep show endless.db
says out.txt "does it end?"

# --- The start of a search stays what it was.
cat >start.lua <<'LUA'
local P = require("tunica").params { a = 1 }
if P.a > 5 and not io.open "mended" then error "not yet" end
return { y = P.a }
LUA
code 0 "$tunica" sweep start.lua a=0..10 --random 8 --refine 6 --score y --out start.db -q
touch mended
code 0 "$tunica" sweep start.lua a=0..10 --random 8 --refine 6 --score y --out start.db -q --retry
"$tunica" sweep show start.db --failures >failures.txt
says failures.txt "no run failed"

# --- A file that only some samples read.
cat >some.lua <<'LUA'
local P = require("tunica").params { a = 1 }
return { y = P.a > 1 and require "part" or 0 }
LUA
echo "return 5" >part.lua
code 0 "$tunica" sweep some.lua a=1,2 --grid --out some.db -q
echo "return 6" >part.lua
code 2 "$tunica" sweep some.lua a=1,2 --grid --seeds 1..2 --out some.db -q
says err.txt "part.lua', which some of its runs read, has changed since"
echo "return 5" >part.lua
code 0 "$tunica" sweep some.lua a=1,2 --grid --seeds 1..2 --out some.db -q

# --- Fresh seeds are those that no search of the file has seen.
code 0 "$tunica" sweep said.lua D=1,2 --grid --seeds 1..4 --out seen.db -q
code 2 "$tunica" sweep said.lua D=1,2 --grid --seeds 1 --fresh-seeds 3..5 --score x --out seen.db -q
says err.txt "3 is a seed of a search in 'seen.db'"

# --- Looking at it.
code 0 env LC_ALL=C "$tunica" sweep show one.db --plot a mean
says out.txt "*"
code 0 "$tunica" sweep show one.db --plot a mean --png mean.png
[ -s mean.png ] || wrong "no plot"
code 2 "$tunica" sweep show one.db --plot a meen
says err.txt "did you mean 'mean'"
code 2 "$tunica" sweep show one.db --sample 99
says err.txt "there is no sample 99"
code 2 "$tunica" sweep show nothere.db
says err.txt "there is no file 'nothere.db'"
code 0 "$tunica" sweep --help
says out.txt "3..5:9"

# --- The command line.
refused() {
  local text=$1
  shift
  code 2 sweep "$@" --out refused.db
  says err.txt "$text"
  [ ! -e refused.db ] || wrong "refused, and yet there is a file: $*"
}
refused "the range 5..0 is reversed" a=5..0 --random 3
refused "did you mean 'way'" wy=1..2 --random 3
refused "expected at most 10, got 50" a=0..50 --random 3
refused "did you mean 'mean'" a=0..5 --random 3 --score "2 * meen"
refused "needs the number of steps" a=0..5 --grid
refused "no parameter varies" a=1 --random 3
refused "is among --seeds" a=0..5 --random 3 --score mean --seeds 1..4 --fresh-seeds 4..6
refused "--seeds: 4..1 is reversed" a=0..5 --random 3 --seeds 4..1
refused "--refine needs --score" a=0..5 --refine 10
refused "run the shards first" a=0..5 --refine 10 --score mean --shard 1/2
refused "moves within ranges" a=1,2 --refine 10 --score mean
refused "how are the ranges to be sampled" a=0..5
code 0 sweep a=0..5 --random 3 --score word --out word.db
says err.txt "the score is no number but the text 'good'"
echo 'local P = require("tunica").params { a = 1 }; return 3' >nothing.lua
code 2 "$tunica" sweep nothing.lua a=0..1 --random 3
says err.txt "no model"
cat >mute.lua <<'LUA'
local tunica = require "tunica"
tunica.params { a = 1 }
return tunica.model { tissue = tunica.hexagons { 3, 3 }, dt = 1, stop = 1 }
LUA
code 2 "$tunica" sweep mute.lua a=0..1 --random 3
says err.txt "no report"

# --- Files are not mixed.
code 2 sweep a=0..4 b=.5..3 wait=0.002 --random 50 --seeds 1..4 --out one.db
says err.txt "a=0..5 b=0.5..3"
code 2 sweep a=0..5 b=.5..3 wait=0.002 --sobol 50 --seeds 1..4 --out one.db
says err.txt "sampling is sobol now, and was random there"
cp model.lua keep.lua
echo "-- changed" >>model.lua
code 2 sweep a=0..5 b=.5..3 wait=0.002 --random 50 --seeds 1..4 --out one.db
says err.txt "the script (or a file that it reads) has changed"
cp keep.lua model.lua
echo "no database at all" >text.db
code 2 sweep a=0..5 --random 3 --out text.db
says err.txt "not the file of a sweep"
"$tunica" sweep model.lua a=0..5 wait=0.5 --random 12 --out busy.db -q &
process=$!
sleep 0.7
code 2 sweep a=0..5 wait=0.5 --random 12 --out busy.db
says err.txt "in use"
wait $process
# A model as it is, on many seeds.
code 0 sweep a=2 --seeds 1..5 --score mean --out seeds.db -q
[ "$(table seeds.db | wc -l)" -eq 11 ] || wrong "5 seeds and as many fresh ones make $(table seeds.db | wc -l) lines with the head"
code 2 sweep a=2 --out nothing.db
says err.txt "or several --seeds"
# More samples and seeds may be added: the first stay.
code 0 sweep a=0..5 --sobol 8 --out more.db -q
code 0 sweep a=0..5 --sobol 16 --seeds 1..2 --out more.db -q
code 0 sweep a=0..5 --sobol 16 --seeds 1..2 --out whole.db -q
table more.db >more.csv
table whole.db >whole.csv
same more.csv whole.csv

# --- Parts.
for k in 1 2 3; do
  code 0 sweep a=0..5 --sobol 16 --seeds 1..2 --shard $k/3 --out part$k.db -q
  code 0 "$tunica" sweep show part$k.db
  grep -q left out.txt && wrong "a part lacks what is not its own"
done
code 0 "$tunica" sweep merge merged.db part1.db part2.db part3.db
table merged.db >merged.csv
same merged.csv whole.csv
# A part that does not fit changes nothing, neither itself nor those before it.
cp part2.db other2.db
"$tunica" - other2.db <<'LUA' || wrong "cannot forge a part"
local name = arg[1]
local file = assert(io.open(name, "rb"))
local bytes, count = file:read("*a"):gsub('"steps":20', '"steps":21')
file:close()
assert(count > 0)
file = assert(io.open(name, "wb"))
file:write(bytes)
file:close()
LUA
cp part1.db kept.db
code 0 "$tunica" sweep merge kept.db part2.db
cp kept.db before.db
code 2 "$tunica" sweep merge kept.db part3.db other2.db
says err.txt "another result for sample"
same kept.db before.db
code 2 "$tunica" sweep merge fresh.db part2.db other2.db
[ ! -e fresh.db ] || wrong "a merge that was refused left a file"

# --- A full disk, as a limit of the file's size.
(
  ulimit -f 60
  "$tunica" sweep model.lua a=0..5 --random 200 --out full.db -q >out.txt 2>err.txt
  [ $? -eq 4 ] || echo "WRONG code" >>err.txt
)
says err.txt "are kept"
grep -q WRONG err.txt && wrong "a full disk: not 4"
code 0 "$tunica" sweep show full.db
code 0 sweep a=0..5 --random 200 --out full.db -q
code 0 sweep a=0..5 --random 200 --out roomy.db -q
table full.db >full.csv
table roomy.db >roomy.csv
same full.csv roomy.csv
finish
