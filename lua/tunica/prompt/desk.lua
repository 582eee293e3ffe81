-- SPDX-License-Identifier: MIT
--- What lies before someone who works at the prompt: the model at hand with the script it came from, and the lines typed.
-- The prompt sets desk.globals to the table in which it evaluates, calls desk.begin_line and desk.end_line around each input,
-- and desk.look before each prompt.

require "tunica"  -- every operation is declared

local registry = require "tunica.registry"
local params = require "tunica.params"
local course = require "tunica.course"
local plain = require "tunica.plain"
local screen = require "tunica.prompt.screen"
local script = require "tunica.prompt.script"
local tissue_models, ring_models = require("tunica.model").inside, require("tunica.phyllotaxis").inside

local desk = {
  globals = _G,
  lines = {},     -- what was typed: { text =, ok = }
  source = nil,   -- of the model at hand: { name =, path =, files =, overrides =, built = }
}

-- Globals that are no work of the user's.
local given = {}
for name in pairs(_G) do given[name] = true end

function desk.is_given(name, value)
  return given[name] and rawequal(rawget(_G, name), value) or registry.prompt[name] == value or value == package.loaded.tunica
end

function desk.say(format, ...)
  io.write(screen.fold(select("#", ...) > 0 and string.format(format, ...) or format), "\n")
end

--- What belongs to a model of either kind, or nil.
function desk.inside(model)
  if type(model) ~= "table" then return nil end
  return tissue_models[model] or ring_models[model]
end

--- True of a model with tissue, false of one of phyllotaxis.
function desk.has_tissue(model) return tissue_models[model] ~= nil end

--- The model at hand: the variable `model`, or nil.
function desk.model()
  local model = rawget(desk.globals, "model")
  return desk.inside(model) and model or nil
end

--- The same, or an error that says how to come by one.
function desk.need_model(what)
  local model = desk.model()
  if not model then
    registry.fail("%s: there is no model; load \"patterning/ring\" takes a shipped one (help \"models\" lists them)", what)
  end
  return model
end

-- What a model's script held when it had just been run: what differs from it later is state.
local begun = setmetatable({}, { __mode = "k" })
function desk.begun(model) return begun[model] end

local function held_by(model)
  local my = desk.inside(model)
  return { script = plain.decode(course.save(my), my.tissue), solution = desk.has_tissue(model) and model:solution() or nil }
end

--- Runs a script (see script.run), which must return a model. Returns that and its source.
function desk.run(o)
  local model, source = script.run(o)
  if not desk.inside(model) then
    if o.shipped then registry.fail("'%s' has run to its end; it leaves no model to work on", o.name) end
    registry.fail("'%s' has run, and returned no model (its last line should be: return model)", o.path)
  end
  begun[model] = held_by(model)
  return model, source
end

--- Makes it the model at hand. `source`: what desk.run gave, or nil.
function desk.take(model, source)
  local g = desk.globals
  begun[model] = begun[model] or held_by(model)
  if not model.name then model.name = (source and source.name or "typed"):match "[^/]*$" end
  g.model, g.tissue, g.P = model, desk.inside(model).tissue, model.params
  desk.source = source
  if model.params and source then params.loaded_as(model.params, source.name) end
end

--- What the model has been given since its script was run, as text; nil if nothing.
function desk.added(model) return course.later(desk.inside(model), begun[model].script) end

--- Parameters of the model at hand that are not as the file has them: name -> value.
function desk.changed_parameters(model)
  local my, changed = desk.inside(model), {}
  if not my.params then return changed end
  local declared = params.declared(my.params)
  for name, value in pairs(params.values(my.params)) do
    if value ~= declared[name].default then changed[name] = value end
  end
  return changed
end

-- Lines ---------------------------------------------------------------------------------------------------------------------

local at_line, at_look = {}, {}

--- `fn(text)` is called before each line is run.
function desk.on_line(fn) at_line[#at_line + 1] = fn end

--- `fn()` is called before each prompt.
function desk.on_look(fn) at_look[#at_look + 1] = fn end

function desk.begin_line(text)
  script.settle()
  desk.lines[#desk.lines + 1] = { text = text, ok = true }
  for _, fn in ipairs(at_line) do fn(text) end
end

--- `ok`: whether the line ran without an error.
function desk.end_line(ok)
  local line = desk.lines[#desk.lines]
  if line then line.ok = ok end
end

function desk.look()
  for _, fn in ipairs(at_look) do
    local ok, message = pcall(fn)
    if not ok then io.stderr:write("tunica: ", tostring(message), "\n") end
  end
end

return desk
