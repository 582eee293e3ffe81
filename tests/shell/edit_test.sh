#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# edit() at the prompt: an editor that changes the file, one that does not, one that fails, and none.
source "$(dirname "$0")/common.sh"

cat >edit.lua <<'LUA'
local g = require "tunica.prompt.names"()
g.load(arg[1])
g.model:advance(1)
g.edit()
print("k " .. tostring(g.P[arg[2]]), "t " .. g.model.time)
LUA
cat >mine.lua <<'LUA'
--- A ring.
local tunica = require "tunica"
local P = tunica.params { k = 1 }
local tissue = tunica.ring { 5 }
tissue:cell { s = 1 }
local model = tunica.model { tissue = tissue, params = P, dt = 0.1, stop = 5 }
model:rate(function(c, d) d.s = P.k end)
return model
LUA
unset VISUAL
EDITOR="sed -i s/k.=.1/k=2/" code 0 "$tunica" edit.lua mine.lua k
says out.txt "mine.lua read again"
says out.txt "k 2	t 1"
EDITOR=true code 0 "$tunica" edit.lua mine.lua k
says out.txt "nothing was changed"
EDITOR=false code 1 "$tunica" edit.lua mine.lua k
says err.txt "is \$EDITOR right?"
VISUAL="sed -i s/k=2/k=3/" EDITOR=false code 0 "$tunica" edit.lua mine.lua k
says out.txt "k 3"
EDITOR="sed -i s/return.model/return/" code 1 "$tunica" edit.lua mine.lua k
says err.txt "returned no model"

# A shipped model is copied, once; names of files may hold anything.
EDITOR="sed -i s/70,/71,/" code 0 "$tunica" edit.lua patterning/ring T
says out.txt "this is your copy of it: ring.lua"
says out.txt "k 71"
grep -q "71," ring.lua || wrong "the copy was not edited"
EDITOR=true code 1 "$tunica" edit.lua patterning/ring T
says err.txt "is there already"
sed s/k=3/k=4/ mine.lua | sed 's/^return$/return model/' >"it's; touch oops.lua"
EDITOR="sed -i s/k=4/k=5/" code 0 "$tunica" edit.lua "it's; touch oops.lua" k
says out.txt "k 5"
[ ! -e oops.lua ] || wrong "the name of a file was taken for a command"
finish
