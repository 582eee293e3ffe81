-- SPDX-License-Identifier: MIT
--- Parameters of a model: declared with their defaults, changed by key=value on the command line, read as P.name.

local core = require "tunica.core"
local registry = require "tunica.registry"
local fail = registry.fail

local params = {}

--- Set while a rule is traced: function(P, name, value) returns the symbol to stand for a number. Else nil.
params.trace_hook = nil

--- Set while only the declarations of a script are wanted: function(declared), which may raise an error.
params.declared_hook = nil

-- What belongs to each table of parameters: { values =, declared =, names =, overridden = }. Weak, so that P itself
-- holds nothing that a script could reach or confuse.
local inside = setmetatable({}, { __mode = "k" })

local current  -- the parameters of this script

local function is_finite(x) return x == x and x ~= math.huge and x ~= -math.huge end

local function words(value)
  return type(value) == "string" and "'" .. value .. "'" or tostring(value)
end

--- Checks a value against a parameter's type and limits; returns nil or what is wrong.
local function complaint(spec, value)
  if type(value) ~= spec.type then return string.format("expected a %s, got %s", spec.type, words(value)) end
  if spec.type ~= "number" then return nil end
  if not is_finite(value) then return "expected a finite number, got " .. tostring(value) end
  if spec.min and value < spec.min then return string.format("expected at least %.14g, got %.14g", spec.min, value) end
  if spec.max and value > spec.max then return string.format("expected at most %.14g, got %.14g", spec.max, value) end
end

local known = { "unit", "min", "max" }

--- { 1.0, "what it means", unit = "...", min =, max = }, or the plain value.
local function read_declaration(name, given)
  local spec = type(given) == "table" and given or { given }
  for key in pairs(spec) do
    if type(key) == "string" and key ~= "unit" and key ~= "min" and key ~= "max" then
      fail("parameter '%s' has no option '%s'%s; write { value, \"meaning\", unit =, min =, max = }", name, key,
        core.did_you_mean(key, known))
    end
  end
  local kind = type(spec[1])
  if kind ~= "number" and kind ~= "boolean" and kind ~= "string" then
    fail("parameter '%s': expected a number, true or false, or text as default, got %s", name, kind)
  end
  local declared = { type = kind, default = spec[1], doc = spec[2], unit = spec.unit, min = spec.min, max = spec.max }
  local wrong = complaint(declared, spec[1])
  if wrong then fail("parameter '%s': %s", name, wrong) end
  return declared
end

--- The text of a key=value argument as a value of the parameter's type.
local function read_override(name, spec, text)
  local value = text
  if spec.type == "number" then
    value = tonumber(text)
  elseif spec.type == "boolean" then
    value = ({ ["true"] = true, ["false"] = false })[text]
  end
  local wrong
  if value == nil then
    wrong = string.format("expected %s, got '%s'", spec.type == "number" and "a number" or "true or false", text)
  else
    wrong = complaint(spec, value)
  end
  if wrong then
    core.blame_command_line()
    error(string.format("parameter '%s': %s (on the command line: %s=%s)", name, wrong, name, text), 0)
  end
  return value
end

local function unknown(P, name)
  local names = inside[P].names
  if type(name) ~= "string" then fail("parameters have names, got a %s", type(name)) end
  fail("there is no parameter '%s'%s", name, core.did_you_mean(name, names))
end

local meta = { __metatable = "parameters" }

function meta.__index(P, name)
  local value = inside[P].values[name]
  if value == nil then unknown(P, name) end
  if params.trace_hook and type(value) == "number" then return params.trace_hook(P, name, value) end
  return value
end

--- Variants stand for values that were the defaults when the script was read: the name alone would change nothing.
local function check_variant(my, value)
  local spec = my.declared.variant
  if not spec.choices or value == my.values.variant or type(value) ~= "string" then return end
  for _, name in ipairs(spec.choices) do
    if name == value then
      fail("variants are chosen on loading: %s", my.loaded_as and string.format("load { %q, variant = %q }", my.loaded_as, value)
        or "on the command line, variant=" .. value)
    end
  end
  fail("there is no variant '%s'%s; there are: %s", value, core.did_you_mean(value, spec.choices), table.concat(spec.choices, ", "))
end

local function assign(P, name, value)
  local my = inside[P]
  if my.values[name] == nil then unknown(P, name) end
  if core.in_rule() then fail("parameter '%s' cannot be set in a rule; rules only compute", name) end
  local wrong = complaint(my.declared[name], value)
  if wrong then fail("parameter '%s': %s", name, wrong) end
  my.values[name] = value
end

function meta.__newindex(P, name, value)
  if name == "variant" and inside[P].declared.variant then check_variant(inside[P], value) end
  assign(P, name, value)
end

function meta.__pairs(P) return pairs(inside[P].values) end

function meta.__tostring(P)
  local lines = {}
  for name, value in pairs(inside[P].values) do lines[#lines + 1] = name .. " = " .. words(value) end
  return "parameters { " .. table.concat(lines, ", ") .. " }"
end

local function apply_command_line(my)
  for name, text in pairs(core.overrides()) do
    local spec = my.declared[name]
    if not spec then
      core.blame_command_line()
      error(string.format("the model has no parameter '%s'%s; it has: %s", name, core.did_you_mean(name, my.names),
        table.concat(my.names, ", ")), 0)
    end
    my.values[name] = read_override(name, spec, text)
    my.overridden[#my.overridden + 1] = name
  end
end

--- Takes the table of variants out of what is declared, if there is one: name -> { parameter = value, ... }.
local function read_variants(my, given)
  local variants = given.variants
  if type(variants) ~= "table" or variants[1] ~= nil then return nil end
  local spec = my.declared.variant
  if not spec or spec.type ~= "string" then
    fail("variants of a model are chosen by a parameter: variant = { \"name of the default\", \"what they are\" } is missing")
  end
  local names = {}
  for name, values in pairs(variants) do
    if type(name) ~= "string" or type(values) ~= "table" then
      fail("variants: expected name = { parameter = value, ... }, came %s", core.describe(type(name) == "string" and values or name))
    end
    names[#names + 1] = name
    for key, value in pairs(values) do
      local declared = my.declared[key]
      if not declared or key == "variant" then
        fail("variant '%s': there is no parameter '%s'%s", name, tostring(key),
          type(key) == "string" and core.did_you_mean(key, my.names) or "")
      end
      local wrong = complaint(declared, value)
      if wrong then fail("variant '%s', parameter '%s': %s", name, key, wrong) end
    end
  end
  table.sort(names)
  if not variants[spec.default] then
    fail("variant: there is no variant '%s'%s", spec.default, core.did_you_mean(spec.default, names))
  end
  spec.choices = names
  return variants
end

--- The values of the chosen variant become the defaults; what the command line says comes after.
local function choose_variant(my, variants)
  local chosen = core.overrides().variant or my.declared.variant.default
  if not variants[chosen] then
    core.blame_command_line()
    error(string.format("there is no variant '%s'%s; there are: %s", chosen, core.did_you_mean(chosen, my.declared.variant.choices),
      table.concat(my.declared.variant.choices, ", ")), 0)
  end
  for name, value in pairs(variants[chosen]) do
    my.declared[name].default = value
    my.values[name] = value
  end
end

function params.declare(given)
  if current then fail("tunica.params was called before in this script; a model has one table of parameters") end
  local my = { values = {}, declared = {}, names = {}, overridden = {} }
  local has_variants = type(given.variants) == "table" and given.variants[1] == nil
  for name, default in pairs(given) do
    if name == "variants" and has_variants then goto next end
    if not name:match "^[%a_][%w_]*$" then fail("'%s' cannot name a parameter; expected letters, digits, _", name) end
    my.declared[name] = read_declaration(name, default)
    my.values[name] = my.declared[name].default
    my.names[#my.names + 1] = name
    ::next::
  end
  local variants = read_variants(my, given)
  if variants then choose_variant(my, variants) end
  if params.declared_hook then params.declared_hook(my.declared) end
  apply_command_line(my)
  local P = setmetatable({}, meta)
  inside[P] = my
  current = P
  return P
end

registry.op {
  name = "tunica.params", kind = "named", rest = { type = "any" },
  doc = "The parameters of the model with their defaults. On the command line, name=value changes one. A parameter is " ..
    "given by its default, or with its meaning and limits: D = { 1.0, \"diffusion\", unit = \"um2/s\", min = 0 }. With " ..
    "variants = { name = { parameter = value, ... }, ... } the parameter `variant` chooses one, whose values become the defaults.",
  returns = "the parameters; P.name reads one",
  example = [[
local tunica = require "tunica"
local P = tunica.params { D = { 1.0, "diffusion", min = 0 }, rule = "errera", noisy = false }
print(P.D)]],
  fn = params.declare,
}

--- For the rest of the library -------------------------------------------------------------------------------------

--- The parameters of the script that runs, or nil.
function params.current() return current end

--- Another script begins (or goes on with its parameters `P`).
function params.forget(P) current = P end

--- True if the value is a table of parameters.
function params.is(value) return inside[value] ~= nil end

--- Goes back to values that P had, name -> value.
function params.go_back(P, values)
  for name, value in pairs(values) do assign(P, name, value) end
end

--- Tells by which name the prompt has loaded the script of P.
function params.loaded_as(P, name) inside[P].loaded_as = name end

--- The table of values behind P: name -> number, boolean or string.
function params.values(P) return inside[P].values end

--- The declarations behind P: name -> { type, default, doc, unit, min, max }.
function params.declared(P) return inside[P].declared end

--- Names, sorted, that the command line changed.
function params.overridden(P) return inside[P].overridden end

return params
