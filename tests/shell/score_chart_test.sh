#!/usr/bin/env bash
# tunica chart --score: the mean of a report over seeds for every method and step, held against the finest; runs that blow up or
# silently stop making what they count; going on in a folder; wrong command lines.
source "$(dirname "$0")/common.sh"

# Cells of a ring grow to 1 and are thrown back at random every quarter; a beat is counted where they have come back. A step of more
# than 3 / k throws them below zero, where they stay: no more beats. Without `signed` the kernel stops such a run.
cat >beats.lua <<'LUA'
local tunica = require "tunica"
local P = tunica.params { k = 12, chance = 0.2, signed = true, every = 0.25, wait = 0, untraced = false, dt = 0.05, method = "euler" }
local tissue = tunica.ring { 20 }
tissue:cell { x = 0.5 }
local model = tunica.model { tissue = tissue, params = P, dt = P.dt, stop = 10, method = P.method, signed = P.signed and { "x" } or nil }
model:rate(function(c, d)
  local made = P.k * c.x * (1 - c.x)
  if P.untraced and c.x > 1e9 then made = 0 end
  d.x = tunica.where(tunica.below(c.x, 0), 0, made)
end)
local beats = 0
model:every(P.every, function()
  if tissue:mean "x" > 0.5 then beats = beats + 1 end
  for c in tissue:cells() do c.x = c.x * (1 - P.chance * math.random()) end
  local begun = os.clock()
  while os.clock() - begun < P.wait / 40 do end
end)
model:report { beats = function() return beats end, level = function() return tissue:mean "x" end, word = function() return "x" end }
return model
LUA
chart() { "$tunica" chart beats.lua "$@"; }
# cell FILE METHOD BY SETTING NUMBER: a field of a row of chart.csv.
cell() { awk -F, -v m="$2" -v b="$3" -v s="$4" -v n="$5" '$1 == m && $2 == b && $3 == s { print $n }' "$1"; }
runs() { "$tunica" sweep show "$1/runs.db" --csv | tail -n +2 | wc -l; }
near() { awk -v a="$1" -v b="$2" -v e="${3:-1e-9}" 'BEGIN { exit !(a != "" && a - b <= e && b - a <= e) }' || wrong "$1 is not $2"; }

# --- Rows and the recommendation. The finest step of the model's own method is what others are held against.
code 0 chart --score level --seeds 1..6 --methods euler,rkc2 --error 0.01 --out one
says err.txt "the finest: euler dt 0.0125"; says out.txt "Cheapest that keeps level:"; says out.txt "evaluations"
head -1 one/chart.csv | grep -q "^method,setting of,setting,parameters,seeds,score" || wrong "the head of chart.csv"
near "$(cell one/chart.csv euler dt 0.0125 8)" 0
[ "$(cell one/chart.csv rkc2 tolerance 0.1 5)" = 6 ] || wrong "rkc2 by tolerance"
[ -n "$(cell one/chart.csv rkc2 dt 0.05 6)" ] || wrong "rkc2 by dt"
[ "$(field one/chart.json complete)" = true ] || wrong "chart.json is not complete"
[ "$(field one/chart.json recommended.method)" != nil ] || wrong "no recommendation in chart.json"
# Mean, paired difference and its standard error, from the rows of the runs.
"$tunica" sweep show one/runs.db --csv >runs.csv
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
  $at["solution.method"] == "euler" { x[$at["solution.dt"], $at["seed"]] = $at["level"] }
  END { for (s = 1; s <= 6; s++) { d = x["0.05", s] - x["0.0125", s]; sum += d; two += d * d; all += x["0.05", s] }
    printf "%.12g %.12g %.12g\n", all / 6, sum / 6, sqrt((two - sum * sum / 6) / 5 / 6) }' runs.csv >expected.txt
read -r mean difference deviation <expected.txt
near "$(cell one/chart.csv euler dt 0.05 6)" "$mean"; near "$(cell one/chart.csv euler dt 0.05 8)" "$difference"
near "$(cell one/chart.csv euler dt 0.05 9)" "$deviation" 1e-8
if command -v gnuplot >/dev/null; then
  [ "$(head -c 4 one/chart.png | tail -c 3)" = PNG ] || wrong "chart.png"
  says one/chart.svg "<svg"
fi
# The steps tried are the model's own times powers of two; where a method is stable farther (sts by 21.89 / 2), longer in proportion.
code 0 chart dt=0.0123 --score level --seeds 1..2 --methods euler,heun,sts --out farther
[ -n "$(cell farther/chart.csv heun dt 0.0492 6)" ] || wrong "heun does not take euler's steps"
[ -n "$(cell farther/chart.csv sts dt 0.26 6)" ] || wrong "sts takes no longer steps than euler"
# A step whose score differs for certain by what matters is not recommended, and is marked.
code 0 chart --score level --seeds 1..6 --methods euler --dt 0.2,0.0125 --error 1e-4 --out marked
says out.txt "!  euler"; says out.txt "That is the finest setting itself"; [ "$(cell marked/chart.csv euler dt 0.2 10)" = 1 ] || wrong "0.2 does not differ"

# --- Going on: nothing is run again; more seeds, another score, more steps cost what is missing; another model is refused.
before=$(runs one)
code 0 chart --score level --seeds 1..6 --methods euler,rkc2 --error 0.01 --out one
[ "$(runs one)" = "$before" ] || wrong "runs were made again"
code 0 chart --score beats --seeds 1..6 --methods euler --dt 0.05,0.0125 --out one
[ "$(runs one)" = "$before" ] || wrong "another score made runs"
code 0 chart --score level --seeds 1..7 --methods euler --dt 0.05,0.0125 --out one
[ "$(runs one)" = $((before + 2)) ] || wrong "a seventh seed for two steps made $(runs one) runs of $before"
code 2 chart k=11 --score level --seeds 1..6 --methods euler --out one; says err.txt "k=11"
code 2 chart --score level --seeds 1..6 --until 3 --out one; says err.txt "until is 3"
code 2 chart --out one; says err.txt "it is of tunica chart --score"
mkdir -p full && touch full/file
code 2 chart --score level --out full; says err.txt "not empty"
# Ctrl-C keeps the runs that are done.
"$tunica" chart beats.lua wait=0.2 --score level --seeds 1..400 --methods euler --out stopped -j 2 >out.txt 2>err.txt </dev/null &
process=$!
for _ in $(seq 200); do
  [ "$(runs stopped 2>/dev/null)" -gt 2 ] 2>/dev/null && break
  sleep 0.1
done
kill -INT $process
wait $process
[ $? -eq 130 ] || wrong "SIGINT: not 130"
says err.txt "to continue: the same command with --out stopped"
[ "$(runs stopped)" -gt 2 ] || wrong "no runs after Ctrl-C"; [ -s stopped/chart.csv ] || wrong "no rows after Ctrl-C"

# --- What passes for a pattern, and is none. Runs that go on below zero, where nothing beats any more:
code 0 chart --score level --seeds 1..5 --methods euler --dt 0.0125,0.25 --out silent k=16
says out.txt "5 of 5 run on, no more beats"; says out.txt "no more beats after t = "; says out.txt "in the finest runs 40"
says out.txt "euler dt 0.0125"; [ "$(cell silent/chart.csv euler dt 0.25 11)" = 5 ] || wrong "silent failures are not counted"
[ "$(field silent/chart.json recommended.dt)" = 0.0125 ] || wrong "a run without beats is recommended"
# Runs that the kernel stops, with cell and time.
code 0 chart --score level --seeds 1..5 --methods euler --dt 0.0125,0.25 --out loud k=16 signed=false
says out.txt "5 of 5 blow up, t = "; says out.txt "x became -"; says out.txt "in cell "; says out.txt "How runs failed"
# Runs that take too long are rows too, and made again when asked for.
code 3 chart wait=1 --score level --seeds 1..2 --methods euler --dt 0.01,0.02 --out slowly --seconds 0.3
says err.txt "fails itself on 2 of 2 seeds"; says out.txt "2 of 2 are out of time"
code 0 chart wait=1 --score level --seeds 1..2 --methods euler --dt 0.01,0.02 --out slowly --retry; says out.txt "Cheapest"
# A finest setting that fails itself; a method that cannot do the model.
code 3 chart --score level --seeds 1..5 --methods euler --dt 0.25 --out broken k=16 signed=false
says err.txt "the finest setting, euler dt 0.25, fails itself on 5 of 5 seeds"; says err.txt "name finer ones: --dt"
code 0 chart untraced=true --score level --seeds 1..2 --methods euler,backward_euler --dt 0.02,0.01 --out slow
says out.txt "cannot be traced"

# --- Seeds that are too few for the difference that matters; how many it takes.
# Two courses that have nothing in common but their mean: throwing back half as often costs half.
code 0 chart every=0.25,0.5 wait=0.2 --score level --seeds 1..3 --methods euler --dt 0.01 --error 0.01 --out few
says out.txt "with these 3 seeds; that is too few to tell one of 0.01: some 15 are needed"; says out.txt "every 0.5"
code 0 chart --score level --seeds 1..3 --methods euler --dt 0.01,0.0001 --out same
says out.txt "would have shown with these 3 seeds"

# --- Steps that are parameters.
code 0 chart --score level --seeds 1..3 --out listed --methods euler --dt 0.02,0.01 every=0.25,0.5
says out.txt "every"; says err.txt "the finest: euler dt 0.01, every 0.25"; [ "$(grep -c "every=0.5" listed/chart.csv)" = 2 ] || wrong "every=0.5"

# --- Wrong command lines.
code 2 chart --score levels; says err.txt "did you mean 'level'?"
code 2 chart --score ""; says err.txt "expected an expression"
code 2 chart --score "level +"; says err.txt "--score"
code 2 chart --score level --seeds 5..1; says err.txt "reversed"
code 2 chart --score level --seeds 3; says err.txt "at least 2 seeds"
code 2 chart --score level --seed 3; says err.txt "--seeds 1..12"
code 2 chart --seeds 1..4; says err.txt "--score"
code 2 chart --dt 0.1; says err.txt "--score"
code 2 chart --score level --dt -1; says err.txt "--dt: expected steps above 0"
code 2 chart --score level --tolerance 2; says err.txt "--tolerance"
code 2 chart --score level --error 0; says err.txt "--error"
code 2 chart --score level --quantity x; says err.txt "--quantity"
code 2 chart --score level --methods eular; says err.txt "did you mean 'euler'?"
code 2 chart --score level --methods euler --tolerance 1e-3; says err.txt "none of these methods"
code 2 chart dt=0.1,0.2 --score level; says err.txt "dt"
code 2 chart method=euler,heun --score level; says err.txt "--methods a,b"
code 2 chart --score level --until 0; says err.txt "--until"
code 2 chart chance=0 --score level --seeds 1..4 --methods euler --out deaf; says err.txt "seeds change nothing"
code 2 chart --score word --seeds 1..2 --methods euler --dt 0.02,0.01 --out word; says err.txt "no number"
[ ! -e runs ] || wrong "a wrong command line left a folder"
code 0 "$tunica" chart --help; says out.txt "--score"; says out.txt "Chart of a pattern"
finish
