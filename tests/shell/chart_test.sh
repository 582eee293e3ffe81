#!/usr/bin/env bash
# Charts of methods and their limits: rows, front, recommendation, going on in a folder, wrong command lines.
source "$(dirname "$0")/common.sh"

# A ring with sources here and there. The derivative of its rates has the spectral radius 4 D + 1, here 9: euler's largest step
# is 2 / 9, rk4's 2.785 / 9.
cat >ring.lua <<'LUA'
local tunica = require "tunica"
local P = tunica.params { D = 2, untraced = false, differ = false, method = "euler" }
local tissue = tunica.ring { 20 }
tissue:cell { x = function(c) return c:uniform(0, 2) end, s = function(c) return 2 + math.sin(0.6 * math.pi * c.id) + c:uniform(0, 0.1, "s") end }
local model = tunica.model { tissue = tissue, params = P, dt = 0.1, stop = 4, method = P.method, signed = { "x" } }
model:rate(function(c, d)
  local flow = c:sum(function(n) return n.x - c.x end)
  if P.untraced and c.x > 1e9 then flow = 0 end
  d.x = P.D * flow + c.s - c.x
end)
if P.differ then
  model:at(1, function()
    for _ = 1, math.floor(1000 * (tissue:max "x" - 1)) do tissue:add_cell() end
  end)
end
model:report { most = function() return tissue:max "x" end, word = function() return "none" end }
return model
LUA
# column FILE NUMBER METHOD: a column of the rows of a method.
column() { awk -F, -v n="$2" -v m="$3" '$1 == m { print $n }' "$1"; }

# Rows, front, recommendation, pictures.
code 0 "$tunica" chart ring.lua --methods euler,heun,rkc2,bdf --out one --seconds 0.3 --repeats 2
says out.txt "For an error of 0.001:"; says err.txt "reference: dp54"
says one/chart.csv "method,setting of,setting,error"
for method in euler heun rkc2 bdf; do [ "$(column one/chart.csv 1 $method | wc -l)" -ge 3 ] || wrong "few rows of $method"; done
grep -q '^rkc2,dt,' one/chart.csv && grep -q '^rkc2,tolerance,' one/chart.csv || wrong "rkc2 has two series"
grep -q ',1$' one/chart.csv || wrong "no row is on the front"
# The steps are halved, and so are euler's errors, where it is stable: dt 0.2 is, 0.4 is not.
column one/chart.csv 3 euler | grep -qx 0.2 || wrong "euler at 0.2"
awk -F, '$1 == "euler" && $16 == "" && $3 < 0.15 { if (last && (last / $4 < 1.6 || last / $4 > 2.6)) bad = 1; last = $4 } END { exit bad }' one/chart.csv ||
  wrong "euler is not of order 1"
# The front: no row with an error has both less time and less error than one on it.
awk -F, 'NR > 1 && $4 != "" { n++; e[n] = $4; s[n] = $6; f[n] = $19 }
  END { for (i in e) if (f[i]) for (j in e) if (s[j] < s[i] && e[j] < e[i]) exit 1 }' one/chart.csv || wrong "the front is beaten"
[ "$(field one/chart.json complete)" = true ] || wrong "chart.json is not complete"
[ "$(field one/chart.json recommended.wanted)" = 0.001 ] || wrong "no recommendation in chart.json"
if command -v gnuplot >/dev/null; then
  [ "$(head -c 4 one/chart.png | tail -c 3)" = PNG ] || wrong "chart.png"
  says one/chart.svg "<svg"
fi

# Going on: rows that are there are not run again; a row that is missing is.
cp one/chart.csv before.csv
code 0 "$tunica" chart ring.lua --methods euler,heun,rkc2,bdf --out one --seconds 0.3
says err.txt "rows were there already, 0 are new"; same one/chart.csv before.csv
grep -v '^heun,dt,0.1,' before.csv >one/chart.csv
code 0 "$tunica" chart ring.lua --methods heun --out one --seconds 0.3; says err.txt ", 1 are new"

# Another model, time, seed or quantity in the same folder is an error that says what differs.
code 2 "$tunica" chart ring.lua D=1 --out one; says err.txt "parameter D is 1 now, and was 2 there"
code 2 "$tunica" chart ring.lua --until 3 --out one; says err.txt "--until is 3 now"
code 2 "$tunica" chart ring.lua --seed 4 --out one; says err.txt "--seed is 4 now"
code 2 "$tunica" chart ring.lua --quantity most --out one; says err.txt "--quantity is most now"
sed 's/c\.s - c\.x/c.s - 2 * c.x/' ring.lua >other.lua
code 2 "$tunica" chart other.lua --out one; says err.txt "the script has changed"
code 2 "$tunica" stability ring.lua --out one; says err.txt "not empty"

# Wrong command lines.
code 2 "$tunica" chart ring.lua --methods euler,hein; says err.txt "did you mean 'heun'?"
code 2 "$tunica" chart ring.lua --quantity mostt; says err.txt "did you mean 'most'?"
code 2 "$tunica" chart ring.lua --quantity word; says err.txt "no number"
code 2 "$tunica" chart ring.lua --error 0; says err.txt "--error"
code 2 "$tunica" chart ring.lua --eror 0.1; says err.txt "did you mean '--error'?"
code 2 "$tunica" chart; says err.txt "required"
sed 's/ stop = 4,//' ring.lua >endless.lua
code 2 "$tunica" chart endless.lua; says err.txt "--until"
echo 'return 3' >none.lua; code 2 "$tunica" chart none.lua; says err.txt "returned no model"
code 0 "$tunica" chart --help; says out.txt "--quantity"; code 0 "$tunica" stability --help; says out.txt "maxima"
[ ! -e runs ] || wrong "a wrong command line left a folder"

# A number that the model reports; no folder named; no gnuplot.
mkdir -p bare && PATH=$PWD/bare code 0 "$tunica" chart ring.lua --methods heun --quantity most --seconds 0.1 --error 1e-2
says err.txt "gnuplot is not installed"; [ -s runs/ring-chart-1/chart.csv ] || wrong "no default folder"

# Rules that cannot be traced: implicit methods are left out, with the reason.
code 0 "$tunica" chart ring.lua untraced=true --methods heun,backward_euler --seconds 1 --out slow --until 0.2
says err.txt "backward_euler is left out"; says err.txt "cannot be traced"; says err.txt "rk4"
# Other cells than the reference has.
code 0 "$tunica" chart ring.lua differ=true --methods euler,heun --seconds 0.1 --out differ
says differ/chart.csv "cells differ"; says out.txt "cells differ (means: "

# A reference that does not converge: two events a rounding error apart.
cat >chaos.lua <<'LUA'
local tunica = require "tunica"
local tissue = tunica.ring { 4 }
tissue:cell { x = 1, y = 1, z = 20 }
local model = tunica.model { tissue = tissue, dt = 0.01, stop = 60, signed = { "x", "y", "z" } }
model:rate(function(c, d)
  d.x = 10 * (c.y - c.x)
  d.y = c.x * (28 - c.z) - c.y
  d.z = c.x * c.y - 8 / 3 * c.z
end)
return model
LUA
code 3 "$tunica" chart chaos.lua --out chaos --methods heun --seconds 1
says err.txt "the reference does not converge"; [ -s chaos/chart.json ] || wrong "chart.json is not kept"

# Ctrl-C keeps the rows; the same command goes on.
timeout --foreground -s INT 1 "$tunica" chart ring.lua --methods euler --error 1e-8 --seconds 5 --out stopped >out.txt 2>err.txt </dev/null
[ -s stopped/chart.csv ] || wrong "no rows after Ctrl-C"
says err.txt "to continue: the same command with --out stopped"

# Limits: euler 2 / rho, and the same for heun; rk4 2.785 / rho.
code 0 "$tunica" stability ring.lua --methods euler,heun,rk4,crank_nicolson,bs32 --out limits --seconds 1 --until 60
awk -F, 'function near(a, b) { return a > 0.97 * b && a < 1.03 * b }
  $1 == "euler" || $1 == "heun" { n += near($9, 2 / 9) && near($3, 2 / 9) } $1 == "rk4" { n += near($9, 2.785 / 9) && near($3, 2.785 / 9) } END { exit n != 3 }' limits/stability.csv ||
  { wrong "the theory"; cat limits/stability.csv; }
says out.txt "Largest dt"; says out.txt "Loosest tolerance"
cp limits/stability.csv before.csv
code 0 "$tunica" stability ring.lua --methods euler,heun,rk4,crank_nicolson,bs32 --out limits --seconds 1 --until 60
same limits/stability.csv before.csv
code 2 "$tunica" stability ring.lua --quantity xx; says err.txt "did you mean 'x'?"
finish
