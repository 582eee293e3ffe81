-- SPDX-License-Identifier: MIT
--- Declarations of the library for editors (LuaCATS: lua-language-server and others), from the registry.

local pages = require "tunica.prompt.pages"
local registry = require "tunica.registry"
require "tunica"

local stubs = {}

-- What models have besides operations.
local fields = {
  model = { { "time", "number" }, { "steps", "integer" }, { "tissue", "tunica.tissue" }, { "params", "tunica.parameters" },
    { "name", "string" },
    { "about", "table" }, { "cost", "table" }, { "stop", "number" } },
  phyllotaxis = { { "time", "number" }, { "steps", "integer" }, { "count", "integer" }, { "angles", "number[]" },
    { "finished", "boolean" },
    { "params", "tunica.parameters" }, { "name", "string" }, { "apex", "tunica.apex" }, { "about", "table" }, { "cost",
      "table" } },
  cell = { { "[string]", "number" } }, wall = { { "[string]", "number" } }, side = { { "[string]", "number" } },
    junction = { { "[string]", "number" } },
}

local plain = { any = "any", boolean = "boolean", ["function"] = "function", table = "table", number = "number",
  integer = "integer",
  string = "string", vector = "number[]", column = "string" }

local objects = {}
for _, owner in ipairs(pages.owners) do
  if owner[1] ~= "prompt" and owner[1] ~= "tunica" then objects[owner[1]] = "tunica." .. owner[1] end
end

local function type_of(spec)
  local out = {}
  for name in spec.type:gmatch "[^|]+" do
    if name == "string" and spec.choices then
      for _, choice in ipairs(spec.choices) do out[#out + 1] = string.format("%q", choice) end
    elseif name == "list" then
      out[#out + 1] = (spec.of and (plain[spec.of] or objects[spec.of]) or "any") .. "[]"
    else
      out[#out + 1] = plain[name] or objects[name] or "any"
    end
  end
  return table.concat(out, "|")
end

local results = { ["a number"] = "number", ["a whole number"] = "integer", text = "string", ["true or false"] = "boolean",
  ["a table"] = "table",
  ["a surface"] = "tunica.surface", ["the tissue"] = "tunica.tissue", ["a model of phyllotaxis"] = "tunica.phyllotaxis",
    ["x, y, z"] = "number x, number y, number z",
  ["the parameters; P.name reads one"] = "tunica.parameters", ["the new cell"] = "tunica.cell",
    ["the wall between them"] = "tunica.wall",
  ["the element, or nil if it is gone or never was"] = "tunica.cell|tunica.wall|tunica.side|tunica.junction|nil",
    ["the path"] = "string",
  ["the two daughters"] = "tunica.cell, tunica.cell", ["an iterator: neighbour, wall"] = "fun(): tunica.cell, tunica.wall",
  cell = "tunica.cell", side = "tunica.side", wall = "tunica.wall", junction = "tunica.junction",
  ["cell or nil at the border"] = "tunica.cell?", ["side or nil at the border"] = "tunica.side?",
  ["cell, cell or nil at the border"] = "tunica.cell, tunica.cell?",
  ["side, side or nil at the border"] = "tunica.side, tunica.side?", ["junction, junction"] = "tunica.junction, tunica.junction",
  ["x, y"] = "number x, number y", ["its arc length, x, y"] = "number arc, number x, number y",
  ["a text"] = "string",
  ["what tunica.pattern gives"] = "table",
  ["the angle (degrees), the field there, and whether it is below every threshold"] =
    "number angle, number field, boolean below",
  ["the path, or paths"] = "string|string[]", ["x, y, and the unit tangent's x, y"] =
    "number x, number y, number tangent_x, number tangent_y",
  ["x, y, z, of length 1"] = "number x, number y, number z",
  ["the least and the greatest angle; nil if the pair is not visible and opposed at `angle`"] = "number? least, number? greatest",
  ["a table that prints as its description"] = "table",
  ["two cells, the one with more first; or nothing"] = "tunica.cell? first, tunica.cell? second",
  ["three numbers"] = "number, number, number", ["theta, a"] = "number theta, number a" }

--- The type of what an operation gives, read from its words.
local function result_type(words)
  if results[words] then return results[words] end
  local kind = words:match "^an iterator: (%a+)$"
  if kind and objects[kind] then return "fun(): " .. objects[kind] end
  kind = words:match "^an? (%a+)"
  if objects[kind] then return objects[kind] end
  if words:match "^true" then return "boolean" end
  if words:match "^a table" then return "table" end
  if words:match "^a list" then return "table" end
  if words:match "^'" then return "string" end
  for _, start in ipairs { "a number", "a whole number", "the number", "text", "16 hexadecimal" } do
    if words:sub(1, #start) == start then return (start == "text" or start:match "^16") and "string" or "number" end
  end
  return "any"
end

local function line(text) return (text:gsub("%s+", " ")) end

local function described(spec)
  local expected = spec.type ~= "any" and pages.expected(spec) or ""
  return line(spec.doc .. (expected ~= "" and " (" .. expected .. ")" or ""))
end

local function options_class(entry, name, out)
  out[#out + 1] = "---@class " .. name
  for _, spec in ipairs(entry.args) do
    out[#out + 1] = string.format("---@field %s? %s %s", spec.name, type_of(spec), described(spec))
    if spec.position then out[#out + 1] = string.format("---@field [%d]? %s the same", spec.position, type_of(spec)) end
  end
  if entry.rest then out[#out + 1] = string.format("---@field [string] %s %s", type_of(entry.rest), line(entry.rest.doc or
    "")) end
  out[#out + 1] = ""
end

local function operation(entry, out)
  local class = "tunica." .. entry.name:gsub("^tunica%.", ""):gsub("[:.]", "_") .. "_options"
  if entry.kind == "named" then options_class(entry, class, out) end
  out[#out + 1] = "---" .. line(entry.doc)
  if entry.source then out[#out + 1] = "---\n---Source: " .. line(entry.source) end
  local names = {}
  if entry.kind == "named" then
    local first = entry.positions and entry.args[1] and "|" .. type_of(entry.args[1]) or ""
    out[#out + 1] = "---@param options? " .. class .. first
    names[1] = "options"
  else
    for i, spec in ipairs(entry.args) do
      local name = spec.name:match "^[%a_][%w_]*$" and not loadstring("local " .. spec.name) and spec.name .. "_" or spec.name
      out[#out + 1] = string.format("---@param %s%s %s %s", name, spec.required and "" or "?", type_of(spec), described(spec))
      names[i] = name
    end
  end
  if entry.returns then out[#out + 1] = "---@return " .. result_type(entry.returns) .. " # " .. line(entry.returns) end
  local mark = entry.owner == "tunica" and "." or ":"
  out[#out + 1] = string.format("function %s%s%s(%s) end\n", entry.owner, mark, entry.member, table.concat(names, ", "))
end

local function class(owner, about, out)
  out[#out + 1] = string.format("---%s\n---@class tunica.%s", about:sub(1, 1):upper() .. about:sub(2), owner)
  for _, field in ipairs(fields[owner] or {}) do out[#out + 1] = string.format("---@field %s %s", field[1], field[2]) end
  for _, entry in ipairs(pages.of_owner(owner)) do
    if entry.kind == "property" then
      out[#out + 1] = string.format("---@field %s %s %s", entry.member, result_type(entry.returns or ""), line(entry.doc))
    end
  end
  out[#out + 1] = "local " .. owner .. " = {}\n"
  for _, entry in ipairs(pages.of_owner(owner)) do
    if entry.kind ~= "property" then operation(entry, out) end
  end
end

--- The declarations as text.
function stubs.text()
  local out = { "---@meta tunica", "-- Written by scripts/reference from the registry of operations; for editors only, " ..
    "never run.\n",
    "---@class tunica.parameters\n---@field [string] number|string|boolean\n" }
  for _, owner in ipairs(pages.owners) do
    if objects[owner[1]] then class(owner[1], owner[2], out) end
  end
  out[#out + 1] = "---@class tunica\nlocal tunica = {}\n"
  for _, entry in ipairs(pages.of_owner "tunica") do operation(entry, out) end
  out[#out + 1] = "return tunica"
  return table.concat(out, "\n") .. "\n"
end

--- Operations whose owner has no class: there should be none.
function stubs.left_out()
  local list = {}
  for _, entry in ipairs(registry.all()) do
    if not objects[entry.owner] and entry.owner ~= "tunica" and entry.owner ~= "prompt" then list[#list + 1] = entry.name end
  end
  return list
end

return stubs
