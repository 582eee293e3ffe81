-- SPDX-License-Identifier: MIT
-- Work on a model at the prompt: load, reload with the state kept, undo, sessions, transcripts.
local core = require "tunica.core"
local desk = require "tunica.prompt.desk"
local history = require "tunica.prompt.history"
local work = require "tunica.prompt.work"
local check = require "check"

local folder = os.tmpname()
os.remove(folder)
core.mkdir(folder)
local said
local write = io.write
io.write = function(...) said = said .. table.concat({ ... }) end -- luacheck: ignore

-- The prompt: lines are evaluated in a table of their own.
local g = setmetatable({}, { __index = _G })
for name, fn in pairs(work) do rawset(g, name, fn) end
desk.globals = g

--- One line typed; what it says. Errors go on.
local function line(text)
  said = ""
  desk.begin_line(text)
  local chunk = assert(loadstring(text, "=(prompt)"))
  setfenv(chunk, g)
  local ok, message = pcall(chunk)
  desk.end_line(ok)
  desk.look()
  if not ok then error(message, 0) end
  return said
end

local function says(text, ...)
  for _, expected in ipairs { ... } do
    if not said:find(expected, 1, true) then error(string.format("'%s' should say '%s', said: %s", text, expected, said), 2) end
  end
end

local function tell(text, ...)
  line(text)
  says(text, ...)
end

local function refused(text, ...)
  local ok, message = pcall(line, text)
  assert(not ok, text .. " should fail")
  for _, expected in ipairs { ... } do
    assert(message:find(expected, 1, true), string.format("'%s' should say '%s', said: %s", text, expected, message))
  end
end

-- Nothing loaded yet.
refused("reload()", "there is no model")
refused("set { D = 1 }", "there is no model")
refused('save "x"', "there is no model")
tell("undo()", "nothing to undo")
tell("who()", "nothing yet")

-- Load: by name, by the last part of it, with parameters; nothing changes when it fails.
tell('load "patterning/ring"', "patterning/ring: Auxin peaks", "50 cells")
refused('load "rng"', "did you mean 'ring'")
refused("load(5)", "'name' must be text")
refused('load { "ring", Q = 1 }', "no parameter 'Q'")
assert(g.model.time == 0 and #g.tissue == 50)
tell('load { "ring", cells = 30 }', "30 cells")
assert(g.P.cells == 30 and #g.tissue == 30)
tell("undo()", "back to before: load")
assert(#g.tissue == 50)

-- Loading gives what the program itself gives.
line "model:advance(5)"
local through = g.model:hash()
line 'load "ring"'
line "model:advance(2)"
line "reload()"
says("reload", "has not changed", "t = 2 is kept")
assert(not said:find "not declared", said)
line "model:advance(5)"
check.equal(g.model:hash(), through, "a run over a reload")

-- So do other methods, division, and phyllotaxis.
for _, case in ipairs { { "brusselator", 0.5, 1 }, { "dividing_sheet", 2, 3 }, { "noise", 3, 8 }, { "gray_scott", 10, 20 } } do
  line('load "' .. case[1] .. '"')
  g.model:advance(case[2])
  g.model:advance(case[3])
  local expected = g.model:hash()
  line('load "' .. case[1] .. '"')
  g.model:advance(case[2])
  line "reload()"
  g.model:advance(case[3])
  check.equal(g.model:hash(), expected, case[1])
  line 'load "ring"'
end

-- Parameters: all or none; undo and redo.
tell("set { D = 2, T = 50 }", "D 1 -> 2, T 70 -> 50")
refused("set { D = 3, T = -50 }", "parameter 'T': expected at least 0")
assert(g.P.D == 2 and g.P.T == 50)
refused("set { d = 3 }", "did you mean 'D'")
refused("set {}", "which parameter")
line "P.D = 4"
tell("who()", "changed: D = 4, T = 50")
tell("undo()", "P.D = 4")
assert(g.P.D == 2)
tell("undo()", "set")
assert(g.P.D == 1)
tell("redo()", "again: set")
assert(g.P.D == 2)
tell("redo()", "again: P.D = 4")
assert(g.P.D == 4)
tell("redo()", "nothing to redo")
line "undo()"
line "P.T = 60"
tell("redo()", "nothing to redo")

-- Undo of runs, operations and values set by hand; state and time.
line 'load "growth/dividing_sheet"'
local before, cells = g.model:hash(), #g.tissue
line "model:advance(0.5)"
line "c = tissue:find(3)"
line "for cell in tissue:cells() do cell:remove() break end"
assert(#g.tissue < cells + 100)
tell("undo()", "back to before: for cell in")
tell("undo()", "back to before: model:advance(0.5)", "t = 0")
check.equal(g.model:hash(), before, "after undo")
line 'load "ring"'
line "c = tissue:find(7)"
line "c.auxin = 5"
tell("undo()", "c.auxin = 5")
assert(g.c.auxin < 2)

-- The memory bound: the oldest go first, the last stays.
local most = history.bytes
history.bytes = 3 * #g.model:snapshot()
for i = 1, 10 do line("model:advance(" .. i * 0.1 .. ")") end
local count, bytes = history.size()
assert(count >= 1 and count <= 3 and bytes <= history.bytes, count)
history.bytes = 1
line "model:advance(2)"
check.equal((history.size()), 1)
history.bytes = most

-- Reload of an own script: what is kept, and what is said.
local path = folder .. "/own.lua"
local last
local function script(text)
  last = text
  core.write_atomic(path, text)
end
local head = [[
-- A row of cells.
local tunica = require "tunica"
local P = tunica.params { D = { 1, "diffusion", min = 0 }, k = 2, old = 1 }
local tissue = tunica.hexagons { 4, 4 }
tissue:cell { auxin = 1, gone = 2 }
local model = tunica.model { tissue = tissue, params = P, dt = 0.1, stop = 5 }
local seen, factor = 0, 10
]]
local tail = [[
model:rate(function(c, d) d.auxin = P.k - P.D * c.auxin end)
model:every(1, function() seen = seen + factor end)
model:report { seen = function() return seen end }
return model
]]
local function seen() return g.model.reports[1].fn() end
script(head .. tail)
line('load "' .. path .. '"')
line "model:advance(2)"
line "c = tissue:find(3)"
line "c:divide()"
line "c = tissue:find(5)"
line "P.D = 3"
line "P.old = 7"
check.equal(seen(), 20)
local auxin, size = g.c.auxin, #g.tissue
script((head .. tail):gsub("gone = 2", "fresh = 8"):gsub("factor = 0, 10", "factor = 0, 100"):gsub("k = 2, old = 1", "k = 5"))
tell("reload()", "read again", "t = 2 is kept", "new: cell.fresh", "cell.gone is not declared any more", "P.D stays 3",
  "not kept: P.old = 7")
check.equal(#g.tissue, size)
check.equal(g.c.auxin, auxin)
check.equal(g.c.fresh, 8)
check.equal(g.P.k, 5)
check.equal(g.model.time, 2)
check.equal(seen(), 20)
line "model:advance(3)"
check.equal(seen(), 120)  -- the constant is the file's, the counter its own

-- What was carried over once is carried over again.
line "model:solve_with { method = 'heun' }"
line "reload()"
tell("reload()", "P.D stays 3", "the method stays heun")
check.equal(seen(), 120)
line "model:solve_with { method = 'euler' }"

-- A file with an error changes nothing; nor one that returns no model, or another tissue.
local was, hash = g.model, g.model:hash()
script(head .. "model:rate(function(c, d) d.auxin = \n")
refused("reload()", "own.lua:")
script(head .. "error 'on purpose'")
refused("reload()", "own.lua:8: on purpose")
script(head)
refused("reload()", "returned no model")
script((head .. tail):gsub("hexagons { 4, 4 }", "ring { 16 }"))
refused("reload()", "geometry")
script((head .. tail):gsub("P.k %- P.D", "P.nothing - P.D"))
refused("reload()", "no parameter 'nothing'")
assert(g.model == was)
check.equal(g.model:hash(), hash)

-- Watch: read again at the next prompt after it has been saved.
script(head .. tail)
tell("watch()", "watching", "read again")  -- it has been saved since
script((head .. tail):gsub("k = 2", "k = 9"))
tell("local x = 1", "read again")
check.equal(g.P.k, 9)
tell("watch(false)", "no longer")

-- Modules of the script are read again, too.
core.write_atomic(folder .. "/part.lua", "return { k = 1 }")
script((head .. tail):gsub("local seen", "model:report { k = function() return require('part').k end }\nlocal seen"))
line "reload()"
check.equal(g.model.reports[1].fn(), 1)
core.write_atomic(folder .. "/part.lua", "return { k = 2 }")
tell("reload()", "read again")
check.equal(g.model.reports[1].fn(), 2)

-- Sessions: with the script as it was, also when it is gone.
line "number = 12.5"
line "c = tissue:find(5)"
hash = g.model:hash()
local file = folder .. "/session"
tell('save "' .. file .. '"', "is kept in")
line 'load "ring"'
line "number = nil"
os.remove(path)
tell('restore "' .. file .. '"', "is gone")
check.equal(g.model:hash(), hash)
check.equal(g.number, 12.5)
check.equal(g.c.id, 5)
script(last)
line "reload()"
check.equal(g.P.D, 3)
check.equal(g.model:hash(), hash)
refused('restore "' .. folder .. '/part.lua"', "no session")
refused('restore "' .. folder .. '/none"', "none")
local whole = core.read_file(file)
for _, cut in ipairs { 0, 1, 20, #whole - 1 } do
  core.write_atomic(file, whole:sub(1, cut))
  refused('restore "' .. file .. '"', "no session")
end
check.equal(g.model:hash(), hash)

-- Models of phyllotaxis.
line 'load "noise"'
line "model:advance(6)"
local count_before = g.model.count
tell("reload()", "t = 6 is kept")
check.equal(g.model.count, count_before)
hash = g.model:hash()
line "model:advance(8)"
tell("undo()", "t = 6")
check.equal(g.model:hash(), hash)
tell('save "' .. file .. '"', "kept")
tell('restore "' .. file .. '"', "t = 6")
check.equal(g.model:hash(), hash)

-- Rules and events added at the prompt: undo and redo take them along; a session cannot hold them.
line 'load "ring"'
line "model:advance(1)"
local plain_hash, rule_count = g.model:hash(), tonumber(tostring(g.model):match "(%d+) rules")
line 'model:supply { "auxin", rate = 5, cells = { tissue:find(3) }, to = 1.5 }'
line "model:advance(2)"
local supplied = g.model:hash()
refused('save "' .. file .. '.none"', "put them into the script first", "1 rule (rate, ", "1 event (at 1.5)")
assert(not core.kind_of(file .. ".none"))
tell("undo()", "model:advance(2)", "t = 1")
tell("undo()", "model:supply", "t = 1")
check.equal(g.model:hash(), plain_hash)
tell('save "' .. file .. '"', "kept")
tell("redo()", "again: model:supply")
tell("redo()", "again: model:advance(2)", "t = 2")
check.equal(g.model:hash(), supplied, "after redo")
line "undo()"
line "model:advance(2)"
check.equal(g.model:hash(), supplied, "run after undo")
line "undo()"
line "undo()"
line "model:every(0.5, function() end)"
line "model:when(function(t) return t > 1.2 end, function() end)"
line "model:rate(function(c, d) d.auxin = 0.001 end)"
line "model:report { most = function() return 1 end }"
line "model:advance(1.5)"
refused('save "' .. file .. '"', "1 event (every 0.5)", "1 condition (when)", "1 rule (rate, ", "1 report (most)")
local more = g.model:snapshot()
tell("undo(5)", "t = 1")
check.equal(g.model:hash(), plain_hash, "rules, events, conditions and reports have gone")
check.equal(tonumber(tostring(g.model):match "(%d+) rules"), rule_count)
g.more = more
refused("model:restore(more)", "the snapshot has " .. rule_count + 1 .. " rules, the model " .. rule_count)
g.more = nil
check.equal(g.model:hash(), plain_hash)
line "redo()"
line "redo()"
line "model:advance(3)"  -- with what has come again
line "undo()"
-- a rule with a mistake can be taken back, too
line "model:rate(function(c, d) d.auxin = c.auxn end)"
refused("model:advance(2)", "auxn")
tell("undo()", "model:rate(function(c, d) d.auxin = c.auxn end)")
line "model:advance(2)"
tell("reload()", "not kept, for the script does not make them: ", "1 event (every 0.5)", "1 condition (when)")
tell('save "' .. file .. '"', "kept")

-- A snapshot goes back also by itself; one that a fresh model cannot have made is refused.
line 'load "ring"'
line "model:advance(1)"
line "mark = model:snapshot()"
line "model:every(1, function() end)"
line "model:advance(2)"
line "model:restore(mark)"
assert(g.model.time == 1)
line 'load "ring"'
line "model:restore(mark)"
line 'load "ring"'
line "model:every(1, function() end)"
line "mark = nil"

-- Inhibitions stay: that is told, and the rest can be gone back to.
line 'load "noise"'
line "model:advance(3)"
line "model:every(1, function() end)"
line "model:advance(4)"
line "undo(2)"
tell('save "' .. file .. '"', "kept")
line "model:inhibition { field = function(d) return math.exp(-d) end, below = 100 }"
line "model:advance(4)"
line "undo()"
hash = g.model:hash()
refused("undo()", "undo: the state before 'model:inhibition", "cannot lose them")
check.equal(g.model:hash(), hash)
for _ = 1, 20 do
  if not pcall(line, "undo()") then goto continue end
  if rawget(g, "model") and g.model.time < 3 or said:find "load" then break end
  ::continue::
end
says("undo()", "load phyllotaxis/noise")

-- Variants stand for values that are chosen on loading.
line 'load "transport_apex"'
local chosen = 'variants are chosen on loading: load { "phyllotaxis/transport_apex", variant = "decussate" }'
refused('set { D = 2, variant = "decussate" }', chosen)
refused('P.variant = "decussate"', chosen)
refused('P.variant = "decusate"', "no variant 'decusate'", "did you mean 'decussate'")
refused("P.variant = 3", "expected a string")
assert(g.P.variant == "fibonacci" and g.P.D ~= 2)
line "P.variant = P.variant"
line 'load { "phyllotaxis/transport_apex", variant = "decussate" }'
assert(g.P.variant == "decussate" and g.P.jugacy == 2)
tell("undo()", "load")
assert(g.P.variant == "fibonacci")
line 'load "ring"'

-- Edit: of a shipped model a copy is made, and taken.
local editor = os.getenv "EDITOR"
if not os.getenv "VISUAL" and editor == "true" then tell("edit()", "nothing was changed") end

-- What was typed, as a script.
desk.lines = {}
line 'load "ring"'
line "model:advance(1)"
pcall(line, "model:advnce(2)")
line "tissue:sum 'auxin'"
line "x = 1"
line "undo()"
local copy = folder .. "/typed.lua"
line('transcript "' .. copy .. '"')
refused('transcript "' .. copy .. '"', "exists already")
local typed = core.read_file(copy)
for _, text in ipairs { 'ans = show(load "ring")', "-- not run: model:advnce(2)", "x = 1\n" } do
  assert(typed:find(text, 1, true), typed)
end
hash = g.model:hash()
said = ""
local chunk = assert(loadstring(typed, "@typed.lua"))
local print_before = print
print = function() end -- luacheck: ignore
chunk()
print = print_before -- luacheck: ignore
check.equal(desk.globals.model:hash(), hash)
desk.globals = g

core.remove_all(folder)
io.write = write -- luacheck: ignore
