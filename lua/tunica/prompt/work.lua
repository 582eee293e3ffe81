-- SPDX-License-Identifier: MIT
--- Work on a model at the prompt: load and reload it, change parameters, go back, see what there is. What this module returns
-- are names that only the prompt has.

require "tunica"  -- every operation is declared

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local carry = require "tunica.prompt.carry"
local desk = require "tunica.prompt.desk"
local history = require "tunica.prompt.history"
local screen = require "tunica.prompt.screen"
local script = require "tunica.prompt.script"
local op, fail = registry.op, registry.fail
local function say(...) desk.say(...) end

require "tunica.prompt.keep"
require "tunica.prompt.edit_curve"

local loaded = 'load "patterning/ring"\n'

-- Load and reload -------------------------------------------------------------------------------------------------------

local function describe(model, source)
  local about = script.header(source.files[1].text).about
  say("%s%s%s", source.name, about ~= "" and ": " or "", about)
  local g = {}
  if desk.inside(model).tissue then g[#g + 1] = "tissue (" .. tostring(model.tissue) .. ")" end
  if model.params then g[#g + 1] = "P" end
  if #g == 0 then return say "model now stands for it; help(model) says more" end
  say("model, %s now stand for it; help(model) says more", table.concat(g, ", "))
end

op { name = "prompt.load", kind = "named", rest = { type = "number|string|boolean", doc = "a parameter = its value" },
  doc = "Loads a model into the variables model, tissue and P: a shipped one by its name (or the last part of it), or a script " ..
    "of your own by its path. Parameters may be changed at once, as on the command line.",
  args = { { name = "name", type = "string", required = true, position = 1, doc = "of a shipped model, or the path of a " ..
    "script" } },
  example = loaded .. 'load { "patterning/ring", cells = 30 }',
  fn = function(o)
    local path, name, shipped = script.find(o.name)
    local overrides = {}
    for key, value in pairs(o) do
      if key ~= "name" then overrides[key] = value end
    end
    history.keep("load " .. name, true)
    local model, source = desk.run { path = path, name = name, shipped = shipped, overrides = overrides }
    desk.take(model, source)
    describe(model, source)
  end }

--- Reads the script again. `changes`: parameters, name -> value, that it is to see from now on, as if they had been given on
-- loading; `what`: for undo. Returns what is worth saying.
function desk.reload(changes, what)
  local model, source = desk.need_model "reload", desk.source
  if not source then
    fail "reload: this model was typed here; load one from a file (transcript \"file\" writes what was typed)"
  end
  local changed, overrides = script.changed(source), {}
  for _, list in ipairs { source.overrides or {}, changes or {} } do
    for name, value in pairs(list) do overrides[name] = value end
  end
  history.keep(what or "reload", true)
  local fresh, now = desk.run { path = source.path, name = source.name, shipped = source.shipped,
    overrides = overrides, use = source.built }
  if changes and model.params then  -- so that a value set by hand gives way, too
    for name in pairs(changes) do model.params[name] = desk.begun(model).script.params[name] end
  end
  local notes = carry.over(model, fresh, changed ~= nil or changes ~= nil)
  local old_tissue, g = desk.inside(model).tissue, desk.globals
  local handles = {}
  for name, value in next, g do
    local kind = type(value) == "userdata" and core.kind(value)
    if old_tissue and kind and kind ~= "tissue" and rawequal(select(2, pcall(core.tissue_of, value)), old_tissue) then
      handles[#handles + 1] = { name, core.find(fresh.tissue, kind, core.id(value)) }
    end
  end
  desk.take(fresh, now)
  for _, handle in ipairs(handles) do g[handle[1]] = handle[2] end
  return notes, changed
end

local function say_reloaded()
  local notes, changed = desk.reload()
  say("%s %s; the state at t = %.6g is kept", desk.source.path, changed and "read again" or "has not changed", desk.model().time)
  for _, note in ipairs(notes) do say("  %s", note) end
end

op { name = "prompt.reload", fn = say_reloaded, example = loaded .. "reload()",
  doc = "Reads the script of the model again. Tissue, time and state stay as they are; rules, views and the parameters that " ..
    "you did not change become those of the file. Says what could not be kept. If the file has an error nothing changes." }

-- Watch -----------------------------------------------------------------------------------------------------------------

local watching, refused = false, nil

desk.on_look(function()
  local source = watching and desk.model() and desk.source
  if not source or not script.changed(source) then return end
  local text = select(2, pcall(core.read_file, source.path))
  if text == refused then return end  -- its error was told
  refused = text
  say_reloaded()
  refused = nil
end)

op { name = "prompt.watch", args = { { name = "on", type = "boolean", default = true, doc = "false: no longer" } },
  doc = "From now on the script of the model is read again as soon as it has been saved: it is looked at before each prompt.",
  example = loaded .. "watch() watch(false)",
  fn = function(on)
    if on and not desk.source then fail "watch: load a model from a file first" end
    watching, refused = on, nil
    say(on and "watching " .. desk.source.path .. " (watch(false) ends it)" or "no longer watching")
  end }

-- Edit ------------------------------------------------------------------------------------------------------------------

local function quoted(path) return "'" .. path:gsub("'", "'\\''") .. "'" end

--- A shipped model is not edited in its place: a copy in the folder at hand takes its place.
local function own_copy(source)
  if not source.shipped then return source.path end
  local copy = source.name:match "[^/]+$" .. ".lua"
  if core.kind_of(copy) then
    fail("edit: %s is a shipped model, and its copy '%s' is there already: load \"%s\" takes that", source.name, copy, copy)
  end
  core.write_atomic(copy, source.files[1].text)
  say("%s is a shipped model; this is your copy of it: %s", source.name, copy)
  source.path, source.name, source.shipped, source.files[1].path = copy, (copy:gsub("%.lua$", "")), false, copy
  return copy
end

op { name = "prompt.edit",
  doc = "Opens the script of the model in your editor ($VISUAL, else $EDITOR, else vi) and reads it again afterwards. Of a " ..
    "shipped model a copy is made in the current folder.",
  example = loaded .. "print(edit)",
  fn = function()
    desk.need_model "edit"
    if not desk.source then
      fail "edit: this model was typed here; transcript \"file\" writes what was typed, and load takes that"
    end
    local path = own_copy(desk.source)
    local editor = os.getenv "VISUAL" or os.getenv "EDITOR" or ""
    if editor == "" then editor = "vi" end
    io.flush()
    local status = os.execute(editor .. " " .. quoted(path))
    if status ~= 0 and status ~= true then
      fail("edit: '%s' did not end well (status %s); is $EDITOR right?", editor, tostring(status))
    end
    if script.changed(desk.source) then say_reloaded() else say("nothing was changed") end
  end }

-- Parameters ------------------------------------------------------------------------------------------------------------

op { name = "prompt.set", kind = "named", rest = { type = "number|string|boolean",
  doc = "a parameter = its new value" },
  doc = "Changes parameters of the model: all of them, or none if one is refused. They take effect at the next step; what a " ..
    "script did with them while it was loaded (the number of cells, say) stays. P.name = value does the same for one. " ..
    "A variant is chosen on loading: load { name, variant = ... }.",
  example = loaded .. "set { D = 0.5, T = 90 }",
  fn = function(o)
    local P = desk.need_model "set".params
    if not P then fail "set: the model has no parameters (tunica.params)" end
    if next(o) == nil then fail "set: which parameter, to what? set { D = 2 }" end
    local before, words = {}, {}
    for name, value in pairs(params.values(P)) do before[name] = value end
    history.keep("set", true)
    local ok, why = pcall(function()
      for name, value in pairs(o) do P[name] = value end
    end)
    if not ok then
      for name, value in pairs(before) do P[name] = value end
      fail("%s", (tostring(why):gsub("^%S-:%d+: ", "")))
    end
    for name, value in pairs(o) do
      words[#words + 1] = string.format("%s %s -> %s", name, tostring(before[name]), tostring(value))
    end
    say("%s", table.concat(words, ", "))
  end }

-- Back and forth --------------------------------------------------------------------------------------------------------

local function tell(what, point)
  local model = desk.model()
  say("%s: %s%s", what, point.what, model and string.format("   (t = %.6g)", model.time) or "")
end

op { name = "prompt.undo", args = { { name = "times", type = "integer", min = 1, max = 1000, default = 1,
  doc = "so many changes back" } },
  doc = string.format("Goes back to the state before the last run, step or change of the model: tissue, time, parameters, " ..
    "rules and events, and which model it was. Up to %d states are kept, in %d MB together; the oldest go first.",
    history.count, history.bytes / 2 ^ 20),
  example = loaded .. "set { D = 2 } undo()",
  fn = function(times)
    for i = 1, times do
      local point = history.undo()
      if not point then
        if i == 1 then say("nothing to undo") end
        return
      end
      tell("back to before", point)
    end
  end }

op { name = "prompt.redo", doc = "Takes back the last undo(), if nothing has been changed since.",
  example = loaded .. "set { D = 2 } undo() redo()",
  fn = function()
    local point = history.redo()
    if point then tell("again", point) else say("nothing to redo") end
  end }

-- Who -------------------------------------------------------------------------------------------------------------------

local function brief(value)
  local ok, values = pcall(require, "tunica.prompt.values")
  if ok and type(values) == "table" and values.brief then return values.brief(value) end
  local kind = type(value)
  if desk.inside(value) or core.kind(value) == "tissue" then return tostring(value) end
  if kind == "function" then return "function" end
  if kind == "table" and not getmetatable(value) then
    local count = 0
    for _ in next, value do count = count + 1 end
    return string.format("table, %d entr%s", count, count == 1 and "y" or "ies")
  end
  local text = kind == "string" and string.format("%q", value) or tostring(value)
  return #text > 60 and text:sub(1, 57) .. "..." or text
end

op { name = "prompt.who", doc = "Lists the variables that you, or a model, have made, and the parameters that are not as the " ..
  "file has them.",
  example = loaded .. "who()",
  fn = function()
    local names, width = {}, 1
    for name, value in next, desk.globals do
      if type(name) == "string" and not desk.is_given(name, value) and name:sub(1, 1) ~= "_" then
        names[#names + 1], width = name, math.max(width, #name)
      end
    end
    table.sort(names)
    for _, name in ipairs(names) do
      local value = desk.globals[name]
      local text = params.is(value) and "parameters" or brief(value)
      if params.is(value) then
        local all, changed = 0, {}
        for _ in pairs(params.values(value)) do all = all + 1 end
        for key, now in pairs(desk.model() and desk.changed_parameters(desk.model()) or {}) do
          changed[#changed + 1] = key .. " = " .. tostring(now)
        end
        text = string.format("%d parameters%s", all, #changed > 0 and "; changed: " .. table.concat(changed, ", ") or "")
      end
      io.write(screen.fold(string.format("%-" .. width .. "s  %s", name, text), width + 2), "\n")
    end
    if #names == 0 then say("nothing yet; load \"patterning/ring\" takes a shipped model") end
    if desk.source then say("the model is from %s", desk.source.path) end
    local count, bytes = history.size()
    if count > 0 then say("undo() can go back by up to %d states (%.1f MB)", count, bytes / 2 ^ 20) end
  end }

local names = {}
for _, name in ipairs { "load", "reload", "watch", "edit", "edit_curve", "set", "undo", "redo", "who", "save", "restore",
  "transcript" } do
  names[name] = registry.prompt[name]
end
return names
