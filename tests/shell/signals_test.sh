#!/usr/bin/env bash
# A signal stops whatever Lua is doing; a run writes a checkpoint and says where; resuming gives the same result.
source "$(dirname "$0")/common.sh"

# stopped SIGNAL CODE command...: started, left to run a moment, stopped.
stopped() {
  local signal=$1 expected=$2 process
  shift 2
  "$@" >out.txt 2>err.txt </dev/null &
  process=$!
  sleep 0.3
  kill "-$signal" "$process"
  # A program that does not stop would hang the tests.
  (sleep 10; kill -9 "$process") 2>/dev/null &
  local watchdog=$!
  wait "$process" 2>/dev/null
  local got=$?
  kill "$watchdog" 2>/dev/null
  [ "$got" -eq "$expected" ] || { wrong "$signal: $* returned $got, expected $expected"; cat err.txt; }
}

# Shells start background jobs with SIGINT ignored; the program takes it all the same.
stopped INT 130 "$tunica" -e 'while true do end'
stopped TERM 143 "$tunica" -e 'while true do end'
stopped HUP 129 "$tunica" -e 'local t = {} while true do t[#t % 100 + 1] = {} end'
stopped INT 130 "$tunica" -e 'while true do pcall(function() while true do end end) end'
stopped INT 130 "$tunica" -e 'while true do xpcall(error, function() while true do end end) end'
stopped INT 130 "$tunica" -e 'coroutine.wrap(function() while true do end end)()'
stopped TERM 143 "$tunica" -e 'while true do table.sort({ 3, 2, 1 }, function(a, b) return a < b end) end'

"$tunica" "$fake" stop=3 -q --out whole >whole.txt
hash=$(field whole/run.json result.hash)
# In the middle of its own loop, and inside an event that never ends and swallows errors.
i=0
for signal in INT:130 TERM:143 HUP:129 USR1:75; do
  i=$((i + 1))
  stopped "${signal%:*}" "${signal#*:}" "$tunica" "$fake" stop=3 pause=0.003 --out "run$i"
  says err.txt "checkpoint: run$i/checkpoint.bin"; says err.txt "tunica resume run$i"
  [ "$(field "run$i/run.json" status)" = interrupted ] || wrong "status of run$i"
  code 0 "$tunica" resume "run$i"
  [ "$(field "run$i/run.json" result.hash)" = "$hash" ] || wrong "run$i resumed to another result"
  cmp -s <(tail -n +2 "run$i/series.csv") <(tail -n +2 whole/series.csv) || wrong "run$i: another series"
done
stopped INT 130 "$tunica" "$fake" loop_at=0.02 --out stuck
says err.txt "interrupted at t = 0; checkpoint"

# A function of Lua's own that does not return: the copy in memory is written, and the program ends by itself.
cat >stuck.lua <<'MODEL'
local tunica = require "tunica"
local tissue = tunica.ring { 20 }
tissue:cell { x = 1 }
local model = tunica.model { tissue = tissue, dt = 0.001, stop = 3 }
model:rate(function(c, d) d.x = -c.x end)
model:every(0.001, function() tissue:mean "x" end)
model:at(2, function() if arg[1] == "stuck=1" then string.rep("a", 30000):find(("a*"):rep(30) .. "b") end end)
tunica.params { stuck = { 0, "whether it hangs" } }
return model
MODEL
"$tunica" stuck.lua stuck=1 --out hung -q >out.txt 2>err.txt </dev/null &
process=$!
sleep 1.5; kill -TERM $process; wait $process
[ $? -eq 143 ] || wrong "a run that cannot be stopped returned $?"
says err.txt "cannot be broken off"; says err.txt "tunica resume hung"
[ -s hung/checkpoint.bin ] || wrong "no checkpoint of a run that cannot be stopped"
sed -i 's/== "stuck=1"/== "never"/' hung/script/stuck.lua
code 0 "$tunica" resume hung
"$tunica" stuck.lua --out free -q >out.txt
[ "$(field hung/run.json result.hash)" = "$(field free/run.json result.hash)" ] || wrong "resumed to another result"

# A second signal ends it at once, even where the first is not heeded.
"$tunica" -e 'string.rep("a", 30000):find(("a*"):rep(30) .. "b")' 2>err.txt &
process=$!
sleep 0.3; kill -INT $process; sleep 0.2; kill -INT $process; wait $process 2>/dev/null
[ $? -eq 130 ] || wrong "second signal"
finish
