#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What only looks (views, reports) changes nothing, in batch and in a sweep alike; what is wrong in it is the script's error, with its
# line. A script that eats memory while a sweep learns its parameters ends within the limit.
source "$(dirname "$0")/common.sh"

# --- Random numbers in events, reports and views: the same bits, however often one looks. Three steps of .7 end before 2.1.
cat >random.lua <<'LUA'
local tunica = require "tunica"
local P = tunica.params { D = 1, every = 0, shown = 0 }
local tissue = tunica.ring { 20 }
tissue:cell { auxin = 1 }
local model = tunica.model { tissue = tissue, dt = .7, stop = 2.1 }
model:rate(function(c, d) d.auxin = -P.D * c.auxin end)
model:every(.7, function()
  for c in tissue:cells() do c.auxin = c.auxin + math.random() end
end)
local calls = 0
model:report { every = P.every > 0 and P.every or nil, luck = function() return math.random() end,
  calls = function() calls = calls + 1 return calls end }
if P.shown > 0 then model:view { every = P.shown, size = 60, colour = function(c) return c.auxin + math.random() end } end
return model
LUA
value() { awk -v name="$1" '$1 == name { print $2 }' out.txt; }
for every in 0 0.7 1.4; do
  code 0 "$tunica" random.lua every=$every -q --out run
  rm -rf run
  hash=$(value hash) luck=$(value luck)
  code 0 timeout 30 "$tunica" sweep random.lua every=$every --seeds 1,2 -q --out random.db
  "$tunica" sweep show random.db --sample 1 >sample.txt
  says sample.txt "$hash"
  says sample.txt "$luck"
  rm -f random.db*
done
code 0 "$tunica" random.lua -q --out plain
luck=$(value luck)
code 0 "$tunica" random.lua every=0.7 -q --out often
[ "$luck" == "$(value luck)" ] || wrong "a report changes what comes after it"
state=$(value hash)
code 0 "$tunica" random.lua every=0.7 -q --no-frames --out unseen
[ "$state" == "$(value hash)" ] || wrong "no frames: another hash"
for frames in "" --no-frames; do
  code 0 "$tunica" random.lua shown=0.7 -q --out "shown$frames" $frames
  value hash >"hash$frames"
done
same hash hash--no-frames

# --- An error in a view: exit code 1, the script's line, and a run that can be resumed once the script is mended.
cat >view.lua <<'LUA'
local tunica = require "tunica"
local P = tunica.params { what = "good" }
local tissue = tunica.ring { 20 }
tissue:cell { auxin = 1 }
local model = tunica.model { tissue = tissue, dt = .1, stop = 1 }
model:rate(function(c, d) d.auxin = -c.auxin end)
local looks = {
  raises = { plot = function() error "torn" end },
  bare = { plot = function() error("torn", 0) end },
  table = { plot = function() error {} end },
  option = { plot = function() return { y = { 1 }, xlable = "n" } end },
  number = { plot = function() return 3 end },
  colour = { colour = function() return {} end },
  field = { every = .5, colour = function(c) return c.nothing end },
  camera = { camera = function() return 3 end },
  title = { title = function() return {} end },
  good = {},
}
model:view(looks[P.what])
return model
LUA
wrong_view() { # what line words
  code 1 "$tunica" view.lua "what=$1" -q --out "view-$1"
  says err.txt "view.lua:$2: "
  says err.txt "$3"
  [ "$(field "view-$1/run.json" failures.1.kind)" == script ] || wrong "view-$1: not the script's fault"
}
wrong_view raises 8 torn
wrong_view bare 19 torn
wrong_view table 19 "not text but a table"
wrong_view option 19 "did you mean 'xlabel'"
wrong_view number 19 "must return the options"
wrong_view colour 19 "must return a number or nil"
wrong_view field 14 "no field 'nothing'"
wrong_view camera 19 "must return a table"
wrong_view title 19 "must return text"
code 0 "$tunica" view.lua -q --out view-good
code 1 "$tunica" view.lua what=raises -q --out again
sed -i 's/error "torn"/return { y = { 1, 2 } }/' again/script/view.lua
code 0 "$tunica" resume again -q
[ -s again/picture.png ] || wrong "resumed after mending: no picture"

# --- Memory and time while the script is loaded.
cat >eats.lua <<'LUA'
local list = {}
for i = 1, 1e9 do list[i] = ("x"):rep(1e5) .. i end
LUA
code 2 timeout 60 "$tunica" sweep eats.lua a=1..2 --random 3 --memory 150 --out eats.db
says err.txt "more than the limit of 150 MB, while the script was loaded"
[ ! -e eats.db ] || wrong "a file was made for nothing"
echo 'while true do pcall(function() while true do end end) end' >hangs.lua
code 2 timeout 60 "$tunica" sweep hangs.lua a=1..2 --random 3 --time-limit 1 --out hangs.db
says err.txt "not done after 1 s, while the script was loaded"

finish
