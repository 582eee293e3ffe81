-- SPDX-License-Identifier: MIT
--- Sessions kept in files, and what was typed as a script.

local core = require "tunica.core"
local registry = require "tunica.registry"
local plain = require "tunica.plain"
local desk = require "tunica.prompt.desk"
local history = require "tunica.prompt.history"
local screen = require "tunica.prompt.screen"
local script = require "tunica.prompt.script"
local op, fail = registry.op, registry.fail
local function say(...) desk.say(...) end

local mark = "tunica session 1"
local file = { name = "file", type = "string", required = true, doc = "its path" }

-- Sessions --------------------------------------------------------------------------------------------------------------

--- Whether a value holds no more than so many entries.
local function is_small(value, most)
  if type(value) == "string" then return #value < most end
  if type(value) ~= "table" then return true end
  local left = most
  local function count(t, depth)
    for _, item in next, t do
      left = left - 1
      if left < 0 or depth > 20 then return false end
      if type(item) == "table" and not count(item, depth + 1) then return false end
    end
    return true
  end
  return count(value, 1)
end

--- Plain variables of the prompt, `most`: those that are not larger; names that stand for the model are made anew.
local function variables(most)
  local found = {}
  for name, value in next, desk.globals do
    if type(name) == "string" and not desk.is_given(name, value) and name ~= "model" and name ~= "tissue" and name ~= "P"
        and plain.is_plain(value) and (not most or is_small(value, most)) then
      found[name] = value
    end
  end
  return plain.encode(found)
end

--- What a session file holds: of the model at hand, in this state, and the plain variables.
local function sections_of(model, source, snapshot, most)
  local about = { path = core.absolute_path(source.path), name = source.name, shipped = source.shipped,
    overrides = source.overrides, seed = core.seed(),
    solution = desk.has_tissue(model) and model:solution() or nil, files = script.files(source), time = model.time }
  return { mark = mark, about = core.encode(about), model = snapshot, variables = variables(most) }
end

op { name = "prompt.save", args = { file },
  doc = "Keeps the session in a file: the model with its script, parameters and state, and the plain variables (numbers, text, " ..
    "cells, tables of them). Rules and events must be those of the script.",
  example = 'load "patterning/ring" local name = os.tmpname() save(name) os.remove(name)',
  fn = function(path)
    local model, source = desk.need_model "save", desk.source
    if not source then fail "save: this model was typed here; transcript \"file\" keeps what was typed, as a script" end
    local added = desk.added(model)
    if added then
      fail("save: the script of %s does not make these, which were added later: %s. A session is read by running the " ..
        "script again: put them into the script first, and load that", source.name, added)
    end
    core.write_atomic(path, core.pack(sections_of(model, source, model:snapshot())))
    say("%s at t = %.6g is kept in %s", source.name, model.time, path)
  end }

local function read_session(path)
  local bytes = core.read_file(path)
  local ok, parts = pcall(core.unpack, bytes)
  if not ok or parts.mark ~= mark then
    local damaged = ok and "" or "; " .. tostring(parts):gsub("^.-: ", "")
    fail("restore: '%s' is no session that save wrote%s", path, damaged)
  end
  return parts, core.decode(parts.about)
end

--- math.random goes on as it would have, whatever the seed of this program is.
local function with_seed(snapshot, seed)
  if seed == core.seed() then return snapshot end
  local parts, bytes = core.unpack(snapshot), {}
  if parts.random:byte(17) ~= 0 then return snapshot end  -- seeded by the script
  for i = 1, 8 do
    bytes[i] = string.char(seed % 256)
    seed = math.floor(seed / 256)
  end
  parts.random = table.concat(bytes) .. parts.random:sub(9, 16) .. "\1"
  return core.pack(parts)
end

op { name = "prompt.restore", args = { file },
  doc = "Goes on with a session that save wrote, with the script as it was then, also if the file has changed or gone since.",
  example = 'load "patterning/ring" local name = os.tmpname() save(name) restore(name) os.remove(name)',
  fn = function(path)
    local parts, about = read_session(path)
    history.keep("restore", true)
    local text = about.files[1].text
    local there = pcall(core.read_file, about.path)
    local model, source = desk.run { path = about.path, name = about.name, shipped = about.shipped,
      overrides = about.overrides, text = text }
    if about.solution and core.encode(model:solution()) ~= core.encode(about.solution) then model:solve_with(about.solution) end
    model:restore(with_seed(parts.model, about.seed))
    desk.take(model, source)
    for name, value in pairs(plain.decode(parts.variables, desk.inside(model).tissue)) do desk.globals[name] = value end
    say("%s at t = %.6g", about.name, model.time)
    local other = script.changed(source)
    if not there then say("  its script %s is gone; the copy in the session is used", about.path)
    elseif other then say("  %s has changed since; reload() takes it as it is now", other) end
    for i = 2, #about.files do  -- modules, and what was read by dofile since
      local read, now = pcall(core.read_file, about.files[i].path)
      if not read or now ~= about.files[i].text then say("  %s is not as it was", about.files[i].path) end
    end
  end }

-- What was typed --------------------------------------------------------------------------------------------------------

local head = [[
-- What was typed at the prompt of tunica. Run it again: tunica %s
setfenv(1, require("tunica.prompt.names")())
local function show(...)
  if select("#", ...) > 0 and (...) ~= nil then print(...) end
  return ...
end
]]

--- Lines that only tell something, and are nothing for a script.
local function only_tells(text)
  local word = text:match "^%s*([%a_]+)%s*[%({\"'%[]"
  return text:match "^%s*%?" or text:match "^%s*$" or word == "help" or word == "search" or word == "transcript" or
    word == "who" or word == "edit"
    or word == "watch"
end

--- A line as a statement of a script; nil if it cannot be one.
local function as_statement(text)
  if not loadstring(text) then text = text:gsub("%f[%w_]until%s*=%f[^=]", '["until"] =') end  -- as the prompt reads it
  local bare = text:gsub("^%s*=", ""):gsub(";%s*$", "")
  if loadstring("return " .. bare) then
    return text:match ";%s*$" and "ans = " .. bare or "ans = show(" .. bare .. ")"
  end
  return loadstring(text) and text or nil
end

-- undo() goes back by lines, so a script in which it occurs tells where lines begin.
local telling_lines = [[
local typed = require("tunica.prompt.desk").begin_line
]]

local function goes_back(text) return text:match "^%s*undo%s*[%({]" or text:match "^%s*redo%s*[%({]" end

--- The lines that ran without an error, the first so many of them, as a script.
local function as_script(path, count)
  local out, left_out, with_undo = { (head:format(path:match "[^/]+$" or path)) }, 0, false
  for _, line in ipairs(desk.lines) do with_undo = with_undo or line.ok and goes_back(line.text) end
  if with_undo then out[2] = telling_lines end
  for i, line in ipairs(desk.lines) do
    if i > (count or i) then break end
    if not only_tells(line.text) then
      local statement = line.ok and as_statement(line.text)
      if statement then
        local told = with_undo and string.format("typed %q ", line.text:gsub("%s+", " "):sub(1, 60)) or ""
        out[#out + 1] = told .. statement .. "\n"
      else
        left_out = left_out + 1
        out[#out + 1] = "-- not run: " .. line.text:gsub("\n", "\n--          ") .. "\n"
      end
    end
  end
  return table.concat(out), left_out
end

op { name = "prompt.transcript", args = { file },
  doc = "Writes what was typed as a script that runs; lines that failed become comments. An existing file is not overwritten.",
  example = 'local name = os.tmpname() os.remove(name) transcript(name) os.remove(name)',
  fn = function(path)
    if core.kind_of(path) then fail("transcript: '%s' exists already; choose another name", path) end
    local text, left_out = as_script(path)
    core.write_atomic(path, text)
    say("%s written%s", path, left_out > 0 and string.format("; lines that failed, as comments: %d", left_out) or "")
  end }

-- What is left when the program must be ended --------------------------------------------------------------------------------

-- A function of Lua's own that does not return (a pattern that backtracks for ever) cannot be broken off: then the program
-- writes what it was handed here last.
local folder = os.getenv "XDG_STATE_HOME" or ""
if folder:sub(1, 1) ~= "/" then folder = os.getenv "HOME" and os.getenv "HOME" .. "/.local/state" or "." end
local rescued = string.format("%s/tunica/rescued-%d", folder, core.process_id())

local most_entries = 10000  -- of a variable that is rescued

local function rescue(begins)
  local model, source = desk.model(), desk.source
  local point = model and source and not desk.added(model) and history.present(begins)
  if not point then  -- the line that runs now is no part of what is worth keeping
    if #desk.lines < 2 or screen.private then return core.rescue() end
    return core.rescue { path = rescued .. ".lua", bytes = (as_script(rescued .. ".lua", #desk.lines - 1)),
      note = "What was typed before is kept in " .. rescued .. ".lua" }
  end
  core.rescue { path = rescued, sections = sections_of(model, source, point.snapshot, most_entries),
    note = string.format('The state at t = %.6g is kept: restore "%s"', model.time, rescued) }
end

local next_line, next_slice = 0, 0

--- Hands the state at hand to the program: before a line unless that takes long, in the middle of a run as often as a fiftieth
-- of the time allows.
local function hand_over(begins)
  local now = core.now()
  if now < (begins and next_line or next_slice) then return end
  pcall(rescue, begins)
  local took = core.now() - now
  next_line = took < 0.05 and 0 or now + 10 * took
  next_slice = now + math.max(0.2, 50 * took)
end
desk.on_line(function() hand_over(true) end)
desk.on_slice = hand_over
