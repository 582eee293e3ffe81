#!/usr/bin/env bash
# Lua as models see it: what is refused, where errors point, what is the same in every process.
source "$(dirname "$0")/common.sh"

# fails NAME TEXT <<< script: the script fails with exit code 1, its file and a text.
fails() {
  cat >"$1.lua"
  code 1 "$tunica" "$1.lua"
  says err.txt "$2"
}
fails syntax "syntax.lua:2:" <<<$'local x = 1\nlocal = 3'
fails undefined "undefined.lua:2: variable 'prnt' is not defined; did you mean 'print'?" <<<$'-- one\nprnt(1)'
fails nested "at nested.lua:2 in 'outer'" <<<$'local function inner() error "deep" end\nlocal function outer() inner() end\nouter()'
fails object "a table" <<<'error {}'
fails nothing "not text" <<<'error(nil)'
fails tostring "from tostring" <<<'error(setmetatable({}, { __tostring = function() return "from tostring" end }))'
fails recursion "stack overflow" <<<$'local function f() return 1 + f() end\nf()'
fails missing "no file 'lost.lua'" <<<'require "lost"'
fails library "no part 'tunica.lost'" <<<'require "tunica.lost"'
fails foreign "variable 'ffi' is not defined" <<<'ffi.cast()'
fails literal "attempt to index" <<<'local x = loadstring "return 3LL" return package.loaded.ffi.cast'
fails loader "'loadlib'" <<<'package.loadlib("libm.so", "sin")'
fails dump "'dump'" <<<'string.dump(print)'
fails registry "'getregistry'" <<<'debug.getregistry()'
fails seed "finite" <<<'math.randomseed(0/0)'
fails interval "no whole number" <<<'math.random(3, 2)'
fails random "number expected" <<<'math.random({})'
fails pairs "table expected" <<<'for k in pairs(nil) do end'
fails compiler "not found" <<<'require "jit"'
# A sanitized program needs more address space than any limit that would end this soon.
if ! ldd "$tunica" | grep -q libasan && ulimit -S -v 1000000 2>/dev/null; then
  fails memory "memory" <<<'local t = ("x"):rep(2 ^ 20) local s = {} for i = 1, 1e7 do s[i] = t .. i end'
  ulimit -S -v unlimited
fi

# Compiled Lua is never loaded, by any door.
printf '\033LJ\002\000' >code.bin
code 1 "$tunica" code.bin; says err.txt bytecode
cat >doors.lua <<'LUA'
local text = "\27LJ\2\0"
for _, result in ipairs { { load(text) }, { loadstring(text) }, { load(function() local t = text text = nil return t end) },
    { loadfile "code.bin" }, { load("\27LJ", "x", "b") } } do
  assert(result[1] == nil and result[2]:find "bytecode", result[2])
end
assert(not pcall(dofile, "code.bin"))
assert(load("return 1", "x", "b")() == 1)
assert(load("return x", "x", "t", { x = 5 })() == 5)
LUA
code 0 "$tunica" doors.lua

# The same in every process and for every order of making: pairs, math.random, x^2.
cat >canary.lua <<'LUA'
local t, names = {}, {}
for i = 1, 40 do names[i] = "name" .. (i * 7919) % 41 end
for _, name in ipairs(names) do t[name] = math.random() end
t[3], t[1], t[2.5], t[true], t[false] = 1, 2, 3, 4, 5
local sum, order = 0, {}
for k, v in pairs(t) do sum = (sum * 1.1 + v) ^ 2 % 7 order[#order + 1] = tostring(k) end
print(string.format("%.17g", sum), table.concat(order, " "))
print(math.random(10), math.random(-5, 5), math.random())
math.randomseed(4)
print(math.random())
LUA
"$tunica" canary.lua >first.txt
for _ in 1 2 3 4 5 6 7 8 9 10; do "$tunica" canary.lua >again.txt; same first.txt again.txt; done
says first.txt "1 2.5 3 name1 name10 name11"; says first.txt "name9 false true"
"$tunica" --seed 2 canary.lua >again.txt; ! cmp -s first.txt again.txt || wrong "the seed changes nothing"
cat >removing.lua <<'LUA'
local t = { a = 1, b = 2, c = 3 }
for k in pairs(t) do t.b = nil assert(k ~= "b") end
for k, v in pairs(setmetatable({}, { __pairs = function() return function(_, k) if not k then return 1, 2 end end end })) do
  assert(k == 1 and v == 2)
end
for i = 1, 1000 do
  local r, s = math.random(), math.random(7)
  assert(r >= 0 and r < 1 and s >= 1 and s <= 7 and s == math.floor(s))
end
LUA
code 0 "$tunica" removing.lua
finish
