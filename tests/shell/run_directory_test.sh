#!/usr/bin/env bash
# The run directory: what is in it, what is refused, what damage and a full disk do.
source "$(dirname "$0")/common.sh"

code 0 "$tunica" "$fake" n=20 label='a,"b"' --out first
says out.txt "status     done"; says out.txt "steps      1000"; silent err.txt
for check in status=done seed=1 parameters.values.n=20 parameters.overridden.1=label parameters.overridden.2=n \
  result.time=10 result.steps=1000 result.cells=20 arguments.1=n=20 method.method=euler; do
  [ "$(field first/run.json "${check%%=*}")" = "${check#*=}" ] || wrong "run.json: $check"
done
same "$fake" first/script/fake_model.lua
[ "$(grep -c '' first/series.csv)" -eq 23 ] || wrong "series.csv has not 21 rows and 2 lines above"
says first/series.csv '"a,""b"""'
[ -z "$(find first -name '*.part*' -o -name '*.new')" ] || wrong "temporary files are left"

# Names, nothing overwritten.
code 0 "$tunica" "$fake" -q; code 0 "$tunica" "$fake" -q
[ -e runs/fake_model-1/run.json ] && [ -e runs/fake_model-2/run.json ] || wrong "numbered directories"
cp -r first before
code 2 "$tunica" "$fake" --out first; says err.txt "exists and is not empty"; says err.txt "tunica resume first"
diff -r first before || wrong "a refused run changed the directory"
mkdir empty; code 0 "$tunica" "$fake" -q --out empty
echo text >file; code 2 "$tunica" "$fake" --out file; says err.txt file; [ "$(cat file)" = text ] || wrong "file was overwritten"
code 0 "$tunica" "$fake" -q --out deep/er/run
code 4 "$tunica" "$fake" --out file/run; says err.txt "file"
code 2 "$tunica" -e 'return { advance = function() end }' --out endless; says err.txt "--until"
code 0 "$tunica" "$fake" --until 2 -q --out short; [ "$(field short/run.json result.time)" = 2 ] || wrong "--until"

# An end that lies past the last step by a rounding error is reached.
cat >rounded.lua <<'END'
local tunica = require "tunica"
local tissue = tunica.ring { 3 }
tissue:cell { a = 1 }
local model = tunica.model { tissue = tissue, dt = 1, stop = 1000.0000000000002 }
model:rate(function(c, d) d.a = -0.001 * c.a end)
return model
END
code 0 timeout 60 "$tunica" rounded.lua -q --out rounded; [ "$(field rounded/run.json result.steps)" = 1000 ] || wrong "rounded end"

# JSON on standard output; a failure too.
code 0 "$tunica" "$fake" --json -q; [ "$(field out.txt status)" = done ] || wrong "--json"
[ "$(field out.txt report.mean 2>/dev/null || field out.txt result.report.mean)" != nil ] || wrong "--json report"
code 1 "$tunica" "$fake" --json -q error_at=1; [ "$(field out.txt status)" = failed ] || wrong "--json of a failure"
code 1 "$tunica" --json -e 'error "early"'; [ "$(field out.txt message)" != nil ] || wrong "--json of an early failure"

# Failures name what and where, and keep the last good state.
code 3 "$tunica" "$fake" nan_at=3 --out nan; says err.txt "auxin of cell 3 is nan"; says err.txt "nan/checkpoint.bin"
[ "$(field nan/run.json failures.1.column)" = auxin ] || wrong "run.json of a failure"
cat >ratio.lua <<'LUA'
local tunica = require "tunica"
local tissue = tunica.ring { 20 }
tissue:cell { auxin = 1, ratio = 0 }
local model = tunica.model { tissue = tissue, dt = 0.1, stop = 10 }
model:rate(function(c, d) d.auxin = 1 end)
model:derive(function(c, t) c.ratio = math.sqrt(5.5 - t) end)
model:report { every = 1, ratio = function() return tissue:max "ratio" end }
return model
LUA
code 3 "$tunica" ratio.lua --out ratio; says err.txt "ratio became"; says err.txt "in cell 1 at time 6"
[ "$(field ratio/run.json failures.1.column)" = ratio ] || wrong "run.json of a failure in a derived column"
code 1 "$tunica" "$fake" error_at=3 --out mistake; says err.txt "fake_model.lua:25"
[ "$(field mistake/run.json status)" = failed ] || wrong "status of a failure"

# Repeating, continuing beyond the end, from the script's copy.
cp "$fake" model.lua
code 0 "$tunica" model.lua n=20 --out original
echo 'error "changed"' >model.lua
code 0 "$tunica" rerun original --out repeated; says out.txt "same hash as before  yes"
[ "$(field repeated/run.json result.hash)" = "$(field original/run.json result.hash)" ] || wrong "rerun"
sed 's/"hash": "\(.\)[^"]*",\?$/"hash": "0000000000000000",/' original/run.json >changed.json && cp changed.json original/run.json
code 1 "$tunica" rerun original --out differs; says err.txt "differs"
code 0 "$tunica" "$fake" stop=20 -q --out long
code 0 "$tunica" resume short --until 20 -q
[ "$(field short/run.json result.hash)" = "$(field long/run.json result.hash)" ] || wrong "continued beyond its end"

# Damage.
damage() { printf '%s' "$2" | dd of="$1" bs=1 seek=200 conv=notrunc 2>/dev/null; }
code 0 "$tunica" "$fake" n=20 pause=0.001 -q --checkpoint 0.1 --out torn
damage torn/checkpoint.bin XX
code 0 "$tunica" resume torn; says err.txt "damaged checkpoint passed over"; says err.txt "checkpoint.previous.bin"
[ "$(field torn/run.json result.hash)" = "$("$tunica" "$fake" n=20 --json -q | { cat >j; field j result.hash; })" ] ||
  wrong "resumed from the previous checkpoint to another result"
damage torn/checkpoint.bin XX; damage torn/checkpoint.previous.bin XX
code 4 "$tunica" resume torn; says err.txt "tunica rerun torn"
: >torn/checkpoint.bin; head -c 100 first/checkpoint.bin >torn/checkpoint.previous.bin
code 4 "$tunica" resume torn
echo '{' >torn/run.json; code 2 "$tunica" resume torn; says err.txt damaged
echo '{}' >torn/run.json; code 2 "$tunica" resume torn; says err.txt damaged

# A script on standard input, code on the command line and modules are kept as well.
mkdir -p kit && cp "$fake" kit/part.lua && echo 'return require "part"' >kit/main.lua
code 0 "$tunica" kit/main.lua -q --out modular; rm -r kit
code 0 "$tunica" rerun modular --out modular2; says out.txt "yes"
"$tunica" - -q --out piped <"$fake" >/dev/null || wrong "a model on standard input"
code 0 "$tunica" rerun piped --out piped2; says out.txt "yes"
code 0 "$tunica" -e "return dofile '$fake'" -q --out coded
code 0 "$tunica" rerun coded --out coded2; says out.txt "yes"

# The commit that is checked out where the script lies, as git keeps it: loose, packed, detached, in a linked work tree.
hash_of() { printf "$1%.0s" $(seq 40); }
git_is() { code 0 "$tunica" "$1" -q --out "git$2"; [ "$(field "git$2/run.json" git)" = "$3" ] || wrong "git $2 is not $3"; }
mkdir -p tree/deep tree/.git/refs/heads && cp "$fake" tree/deep/model.lua
git_is tree/deep/model.lua 1 nil
echo 'ref: refs/heads/main' >tree/.git/HEAD
git_is tree/deep/model.lua 2 nil
printf '# pack-refs with: peeled\n%s refs/heads/other\n%s refs/heads/main\n^%s\n' "$(hash_of a)" "$(hash_of b)" "$(hash_of c)" >tree/.git/packed-refs
git_is tree/deep/model.lua 3 "$(hash_of b)"
hash_of d >tree/.git/refs/heads/main
git_is tree/deep/model.lua 4 "$(hash_of d)"
(cd tree/deep && "$tunica" model.lua -q --out here >/dev/null) || wrong "run in its own folder"
[ "$(field tree/deep/here/run.json git)" = "$(hash_of d)" ] || wrong "git of a script named without a folder"
mkdir -p linked tree/.git/worktrees/linked && cp "$fake" linked/model.lua
echo 'gitdir: ../tree/.git/worktrees/linked' >linked/.git; echo ../.. >tree/.git/worktrees/linked/commondir
echo 'ref: refs/heads/other' >tree/.git/worktrees/linked/HEAD
git_is linked/model.lua 5 "$(hash_of a)"
hash_of e >tree/.git/HEAD
git_is tree/deep/model.lua 6 "$(hash_of e)"
rm -r tree/.git
code 0 "$tunica" rerun git6 --out git7; [ "$(field git7/run.json git)" = "$(hash_of e)" ] || wrong "git after rerun"
code 0 "$tunica" -e "return dofile '$fake'" -q --out git8; [ "$(field git8/run.json git)" = nil ] || wrong "git of no file"

# Where nothing can be written. Root writes anywhere, so that a folder of /proc stands for a forbidden place.
code 4 "$tunica" "$fake" --out /proc/forbidden; says err.txt "/proc"
if [ "$(id -u)" -eq 0 ] && mkdir -p disk && mount -t tmpfs -o size=2m tmpfs disk 2>/dev/null; then
  "$tunica" "$fake" bytes=400000 pause=0.002 --checkpoint 0.2 -q --out disk/run >out.txt 2>err.txt &
  process=$!
  sleep 0.7
  head -c 4m /dev/zero >disk/filler 2>/dev/null
  wait $process; got=$?
  [ $got -eq 4 ] || { wrong "full disk returned $got"; cat err.txt; }
  says err.txt "No space left"
  rm disk/filler
  code 0 "$tunica" resume disk/run -q
  "$tunica" "$fake" bytes=400000 -q --out roomy >/dev/null
  [ "$(field disk/run/run.json result.hash)" = "$(field roomy/run.json result.hash)" ] || wrong "after a full disk"
  umount disk
fi
finish
