#!/usr/bin/env bash
# What a run directory says of what a script read, and of what is legal but may not be meant.
source "$(dirname "$0")/common.sh"

# Curves that a script reads are copied with it: beside it, named by a whole path, elsewhere.
mkdir -p with/curves apart
cat >write.lua <<'LUA'
local tunica = require "tunica"
for i, path in ipairs { "with/curves/a.func", "apart/b.func", "c.func" } do tunica.curve { { 0, i }, { 1, 2 * i } }:save(path) end
tunica.contour({ { 0, 0 }, { 1, 0 }, { 1, -1 } }):save "apart/d.con"
LUA
code 0 "$tunica" write.lua
cat >with/curved.lua <<'LUA'
local tunica = require "tunica"
local whole = tunica.params { whole = "" }.whole
local sum = tunica.curve "curves/a.func"(0.3) + tunica.curve "../apart/b.func"(0.3) + tunica.curve "c.func"(0.3)
  + tunica.contour(whole):length() + tunica.curve "raised"(0)
local tissue = tunica.ring { 3 }
tissue:cell { auxin = 1 }
local model = tunica.model { tissue = tissue, dt = 0.1, stop = 1 }
model:rate(function(c, d) d.auxin = sum end)
return model
LUA
code 0 "$tunica" with/curved.lua whole="$PWD/apart/d.con" --out curved
same with/curves/a.func curved/script/curves/a.func
[ "$(ls curved/script/files | wc -l)" -eq 3 ] || wrong "copies of curves that lie elsewhere"
[ "$(field curved/run.json script.files.2.asked)" = ../apart/b.func ] || wrong "run.json does not name the curves"
echo rubbish >with/curves/a.func; echo rubbish >apart/b.func; rm c.func apart/d.con
code 0 "$tunica" rerun curved --out curved_again; says out.txt "same hash as before  yes"
code 0 "$tunica" rerun curved_again --out curved_thrice; says out.txt "same hash as before  yes"
code 0 "$tunica" resume curved --until 2 -q

# What is legal but may not be meant is said once, and stands in run.json.
cat >shrinks.lua <<'LUA'
local tunica = require "tunica"
for i = 1, 3 do tunica.apex { profile = { { 0.1, 0 }, { 1, 0 }, { 1, -3 } }, growth = { { 0, 1 }, { 1, -i }, { 2, 1 } } } end
local tissue = tunica.ring { 3 }
tissue:cell { auxin = 1 }
local model = tunica.model { tissue = tissue, dt = 0.1, stop = 1 }
model:rate(function(c, d) d.auxin = 1 end)
return model
LUA
code 0 "$tunica" shrinks.lua --out shrinks
[ "$(grep -c 'the rate of growth is negative' err.txt)" -eq 1 ] || wrong "negative growth is not said once"
says err.txt "shrinks.lua:2: tunica.apex: the rate of growth is negative, -0."; says err.txt "a hole at the tip"
for text in "the rate of growth is negative" "a hole at the tip"; do
  [ "$(grep -c "tunica.apex: .*$text" shrinks/run.json)" -eq 1 ] || wrong "run.json does not say once: $text"
done
finish
