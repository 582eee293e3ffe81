#!/usr/bin/env bash
# What the command line takes, prints and returns.
source "$(dirname "$0")/common.sh"

# Code, scripts, standard input.
code 0 "$tunica" -e ''; silent out.txt; silent err.txt
code 0 "$tunica" -e 'print(1 + 1)' -e 'print "two"'; says out.txt 2; says out.txt two
code 1 "$tunica" -e 'error "no"'; says err.txt "(command line):1: no"; silent out.txt
code 1 "$tunica" -e 'local x ='; says err.txt "(command line):1:"
echo 'print(arg[0], arg[1], arg[2])' >script.lua
code 0 "$tunica" script.lua one k=2; says out.txt "script.lua	one	k=2"
echo 'print("read", ...)' | "$tunica" - >out.txt; says out.txt read
echo 'print "piped"' | "$tunica" >out.txt; says out.txt piped
printf '#!/usr/bin/env tunica\nprint "shebang"\n' >bang.lua
code 0 "$tunica" bang.lua; says out.txt shebang
code 7 "$tunica" -e 'os.exit(7)'
code 0 "$tunica" -e 'os.exit(true)'
code 1 "$tunica" -e 'os.exit(false)'
mkdir -p parts && echo 'return { value = 42 }' >parts/helper.lua && echo 'print(require("helper").value)' >parts/main.lua
code 0 "$tunica" parts/main.lua; says out.txt 42

# Versions, help, models.
code 0 "$tunica" --version; says out.txt "tunica 0."; says out.txt LuaJIT
code 0 "$tunica" --version --json; [ "$(field out.txt tunica)" != nil ] || wrong "--version --json"
code 0 "$tunica" --help; says out.txt "Exit codes"
code 0 "$tunica" resume --help; says out.txt "--until"
code 0 "$tunica" models
code 0 "$tunica" models --json; field out.txt 1 >/dev/null || wrong "models --json"

# Wrong command lines are told apart from wrong scripts.
code 2 "$tunica" nothing.lua; says err.txt "called 'nothing.lua'"
code 2 "$tunica" .; says err.txt "folder"
code 2 "$tunica" --untill 3 script.lua; says err.txt "did you mean '--until'?"
code 2 "$tunica" --until soon script.lua; says err.txt "--until"
code 2 "$tunica" --until nan "$fake"; says err.txt "--until"
code 2 "$tunica" --until -1 "$fake"; says err.txt "--until"
code 2 "$tunica" --seed -1 script.lua; says err.txt "--seed"
code 2 "$tunica" --checkpoint 0 "$fake"; says err.txt "--checkpoint"
code 2 "$tunica" --movie --no-frames "$fake"; says err.txt "--movie"
code 2 "$tunica" "$fake" Stop=1; says err.txt "did you mean 'stop'?"
code 2 "$tunica" "$fake" stop=soon; says err.txt "expected a number, got 'soon'"
code 2 "$tunica" "$fake" stop=nan; says err.txt "finite"
code 2 "$tunica" "$fake" flag=yes; says err.txt "true or false"
code 2 "$tunica" "$fake" stop; says err.txt "name=value"
code 2 "$tunica" resume nowhere; says err.txt "not a folder"
code 2 "$tunica" resume .; says err.txt "no run.json"
code 2 "$tunica" resume; says err.txt "directory"
code 2 "$tunica" rerun . extra; says err.txt "extra"
[ ! -e runs ] || wrong "a wrong command line left a run directory"

# Standard output that cannot be written is an error; a reader that goes away is none.
"$tunica" -e 'print "x"' >/dev/full 2>err.txt; [ $? -eq 4 ] || wrong "/dev/full"
says err.txt "standard output"
"$tunica" -e 'for i = 1, 1e6 do print(i) end' 2>err.txt | head -n 1 >out.txt; silent err.txt
TERM=xterm NO_COLOR=1 "$tunica" -e 'error "no"' 2>err.txt; ! grep -q $'\033' err.txt || wrong "colour without a terminal"

# Nothing heavy is loaded before it is needed: start-up depends on it.
! ldd "$tunica" | grep -Ei 'osmesa|llvm|libGL\.so|avcodec' || wrong "linked to what should be loaded at run time"

# The plain prompt.
printf '1 + 1\nx = 3\nfor i = 1, 2 do\n  print("i", i)\nend\nx\nerror "oops"\nx * 2\n' | "$tunica" -i -e '' >out.txt 2>err.txt
printf '2\ni\t1\ni\t2\n3\n6\n' >expected.txt; same out.txt expected.txt; says err.txt oops
printf 'model.name\n' | "$tunica" -i "$fake" >out.txt 2>err.txt; says out.txt fake
finish
