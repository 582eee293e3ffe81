#!/usr/bin/env bash
# kill -9 at twenty moments: resume works each time and comes to the same end.
source "$(dirname "$0")/common.sh"

"$tunica" "$fake" stop=3 bytes=50000 -q --out whole >whole.txt
hash=$(field whole/run.json result.hash)
for i in $(seq 1 20); do
  "$tunica" "$fake" stop=3 bytes=50000 pause=0.001 --checkpoint 0.01 -q --out "run$i" >/dev/null 2>&1 &
  process=$!
  sleep "0.$(printf '%03d' $((i * 20 + RANDOM % 20)))"
  kill -9 $process 2>/dev/null
  wait $process 2>/dev/null
  # Before the directory has its name there is nothing to lose.
  [ -e "run$i" ] || { "$tunica" "$fake" stop=3 bytes=50000 -q --out "run$i" >/dev/null; continue; }
  [ -e "run$i/run.json" ] || wrong "run$i: a directory without its record"
  code 0 "$tunica" resume "run$i" -q
  [ "$(field "run$i/run.json" result.hash)" = "$hash" ] || wrong "run$i resumed to another result"
  cmp -s <(tail -n +2 "run$i/series.csv") <(tail -n +2 whole/series.csv) || wrong "run$i: another series"
  rm -rf "run$i"
done
finish
