# Shared by the tests of the whole program: $1 is the program, $2 a scratch folder, made anew.
set -u
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tunica=$(realpath "$1")
fake=$here/fake_model.lua
rm -rf "$2"
mkdir -p "$2"
cd "$2" || exit 1
failures=0

wrong() {
  echo "WRONG: $*"
  failures=$((failures + 1))
}

# code N command...: the command must return N. Its output is in out.txt and err.txt.
code() {
  local expected=$1 got
  shift
  "$@" >out.txt 2>err.txt </dev/null
  got=$?
  [ "$got" -eq "$expected" ] || { wrong "$* returned $got, expected $expected"; cat out.txt err.txt; }
}

# says FILE TEXT: the file must hold the text.
says() { grep -qF -- "$2" "$1" || { wrong "$1 does not say '$2' but:"; cat "$1"; }; }
silent() { [ ! -s "$1" ] || { wrong "$1 should be empty but says:"; cat "$1"; }; }
same() { cmp -s "$1" "$2" || wrong "$1 and $2 differ"; }

# field FILE NAME: a value of a JSON file by its dotted name.
field() {
  "$tunica" - "$1" "$2" <<'LUA'
local core = require "tunica.core"
local value = core.decode(core.read_file(arg[1]))
for name in arg[2]:gmatch "[^.]+" do value = value[tonumber(name) or name] end
print(value)
LUA
}

finish() {
  [ "$failures" -eq 0 ] && exit 0
  echo "$failures wrong"
  exit 1
}
