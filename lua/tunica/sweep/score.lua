-- SPDX-License-Identifier: MIT
--- The score of a run: a Lua expression over the values of its report, statistics of its series, and its parameters.

local core = require "tunica.core"

local score = {}

local mathematics = { "abs", "acos", "asin", "atan", "atan2", "ceil", "cos", "exp", "floor", "fmod", "huge", "log", "log10", "max",
  "min", "pi", "pow", "sin", "sqrt", "tan", "tonumber", "tostring" }
local keywords = {}
for word in ("and break do else elseif end false for function if in local nil not or repeat return then true until while"):gmatch "%a+" do
  keywords[word] = true
end

local function refuse(format, ...)
  core.blame_command_line()
  error("--score: " .. string.format(format, ...), 0)
end

--- The names that an expression uses by themselves, not as fields of something.
local function names_in(expression)
  local text = expression:gsub('"[^"]*"', '""'):gsub("'[^']*'", "''"):gsub("%.%.", " ")
  local list = {}
  for before, name in (" " .. text):gmatch "(.)%f[%a_]([%a_][%w_]*)" do
    if not before:match "[%.:%w]" and not keywords[name] then list[#list + 1] = name end
  end
  return list
end

--- Compiles an expression. `known`: names of reports, `parameters`: name -> value of the model's own. Errors: of the
-- command line (syntax, unknown names).
function score.compile(expression, reports, parameters)
  local chunk, why = loadstring("return " .. expression, "=--score")
  if not chunk then refuse("%s", (why:gsub("^%-%-score:1: ", ""))) end
  local names, known = {}, {}
  local function add(name)
    names[#names + 1], known[name] = name, true
  end
  for _, name in ipairs(reports) do add(name) end
  for name in pairs(parameters) do add(name) end
  for _, name in ipairs { "time", "steps", "cells", "primordia", "series", "report", "parameter" } do add(name) end
  local own = table.concat(names, ", ")
  for _, name in ipairs(mathematics) do add(name) end
  for _, name in ipairs(names_in(expression)) do
    if not known[name] then refuse("there is no '%s'%s; there are: %s", name, core.did_you_mean(name, names), own) end
  end
  return { chunk = chunk, parameters = parameters, expression = expression }
end

local special = { NaN = 0 / 0, Infinity = math.huge, ["-Infinity"] = -math.huge }

--- Numbers that JSON cannot hold come as text.
local function revive(value)
  if type(value) == "table" then
    for key, item in pairs(value) do value[key] = revive(item) end
    return value
  end
  return special[value] or value
end

local function typed(text, like)
  if type(like) == "number" then return tonumber(text) end
  if type(like) == "boolean" then return text == "true" end
  return text
end

--- The score of a run: result as JSON, the sample's parameters as name -> text (for files whose runs do not tell theirs).
-- Returns the number, or nil and why there is none.
function score.of(self, json, changed)
  local result = revive(core.decode(json))
  local parameters = {}
  for name, value in pairs(self.parameters) do parameters[name] = value end
  for name, text in pairs(changed) do parameters[name] = typed(text, self.parameters[name]) end
  for name, value in pairs(result.parameters or {}) do parameters[name] = value end
  local env = { report = result.report, series = result.series or {}, parameter = parameters, tonumber = tonumber, tostring = tostring,
    time = result.time, steps = result.steps, cells = result.cells, primordia = result.primordia }
  for name, value in pairs(parameters) do env[name] = value end
  for name, value in pairs(result.report) do env[name] = value end
  for _, name in ipairs(mathematics) do
    if env[name] == nil then env[name] = math[name] end
  end
  setfenv(self.chunk, env)
  local ok, value = pcall(self.chunk)
  if not ok then return nil, (tostring(value):gsub("^%-%-score:1: ", "")) end
  if type(value) == "boolean" then value = value and 1 or 0 end
  if type(value) ~= "number" then return nil, string.format("the score is no number but %s", core.describe(value)) end
  if value ~= value or value == math.huge or value == -math.huge then return nil, "the score is " .. tostring(value) end
  return value
end

return score
