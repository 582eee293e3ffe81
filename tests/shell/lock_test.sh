#!/usr/bin/env bash
# A run directory belongs to one process at a time, and to nobody once that has ended, however it ended.
source "$(dirname "$0")/common.sh"

await() {
  for _ in $(seq 200); do
    [ -e "$1" ] && return
    sleep 0.02
  done
  wrong "$1 does not appear"
}

"$tunica" "$fake" stop=3 -q --out whole >whole.txt
hash=$(field whole/run.json result.hash)
"$tunica" "$fake" stop=3 pause=0.01 --checkpoint 0.05 -q --out run >/dev/null 2>&1 &
process=$!
await run/checkpoint.bin
code 2 "$tunica" resume run
says err.txt "'run' is in use: process $process is running it"
kill -0 $process || wrong "the run was disturbed"
code 0 "$tunica" "$fake" stop=1 -q --out other # another directory is another matter
kill -9 $process
wait $process 2>/dev/null
"$tunica" resume run -q >/dev/null 2>&1 &
process=$!
sleep 0.5
code 2 "$tunica" resume run
says err.txt "in use"
wait $process || wrong "the first resume failed"
[ "$(field run/run.json result.hash)" = "$hash" ] || wrong "resumed to another result"
code 0 "$tunica" resume run -q
cp -r run copy
code 0 "$tunica" resume copy -q
finish
