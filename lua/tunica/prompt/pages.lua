-- SPDX-License-Identifier: MIT
--- What is known of operations, models and parameters, as text for a terminal.

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local desk = require "tunica.prompt.desk"
local script = require "tunica.prompt.script"

local pages = {}

-- Text ------------------------------------------------------------------------------------------------------------------

--- Columns of the terminal; the prompt may set it.
pages.width = function()
  local screen = package.loaded["tunica.prompt.screen"]
  return screen and screen.width and screen.width() or tonumber(os.getenv "COLUMNS" or "") or 80
end

local function length(text) return select(2, text:gsub("[^\128-\191]", "")) end

--- Breaks text into lines that are no longer than the terminal is wide; `indent` before each but the first.
function pages.wrap(text, indent, first)
  local width, out, line = math.max(30, math.min(pages.width(), 100)), {}, first or indent
  local empty = true
  for word in text:gmatch "%S+" do
    if not empty and length(line) + 1 + length(word) > width then
      out[#out + 1], line, empty = line, indent, true
    end
    line = empty and line .. word or line .. " " .. word
    empty = false
  end
  out[#out + 1] = line
  return table.concat(out, "\n")
end

--- Two columns: names, and what is to be said of them.
function pages.rows(rows, indent)
  local widest, out = 0, {}
  for _, row in ipairs(rows) do widest = math.max(widest, length(row[1])) end
  widest = math.min(widest, math.floor(pages.width() / 2.5))
  for _, row in ipairs(rows) do
    local first = indent .. row[1] .. (" "):rep(math.max(0, widest - length(row[1]))) .. "  "
    if length(row[1]) > widest then
      out[#out + 1] = indent .. row[1]
      first = indent .. (" "):rep(widest) .. "  "
    end
    out[#out + 1] = pages.wrap(row[2], indent .. (" "):rep(widest) .. "  ", first)
  end
  return table.concat(out, "\n")
end

function pages.first_sentence(text) return text:match "^(.-[%.%?])%s" or text end

-- Operations ------------------------------------------------------------------------------------------------------------

local function plain_value(value)
  if type(value) == "string" then return '"' .. value .. '"' end
  return type(value) == "table" and (next(value) and "{ ... }" or "{}") or tostring(value)
end

--- How an operation is written: tissue:find(id [, kind]), tunica.sheet { cells =, seed = }, cell.id
function pages.signature(entry)
  if entry.kind == "property" then return entry.title end
  if entry.signature then return entry.signature end
  local needed, optional = {}, {}
  for _, spec in ipairs(entry.args) do
    local list = spec.required and #optional == 0 and needed or optional
    list[#list + 1] = entry.kind == "named" and not spec.position and spec.name .. " =" or spec.name
  end
  if entry.kind == "named" then
    for _, name in ipairs(optional) do needed[#needed + 1] = name end
    if #needed > 6 then needed = { needed[1], needed[2], needed[3], needed[4], "..." } end
    if entry.rest then needed[#needed + 1] = "name = value" end
    return entry.title .. " { " .. table.concat(needed, ", ") .. " }"
  end
  local text = table.concat(needed, ", ")
  for i, name in ipairs(optional) do text = text .. (i == 1 and #needed == 0 and "[" or " [, ") .. name end
  return entry.title .. "(" .. text .. ("]"):rep(#optional) .. ")"
end

--- What an argument may be: type and limits, unit, default.
function pages.expected(spec)
  local words = { (registry.expected(spec):gsub("^an? ", ""):gsub(", or an? ", " or ")) }
  if spec.type == "any" then words = {} end
  if spec.unit then words[#words + 1] = spec.unit end
  if spec.required then words[#words + 1] = "needed" end
  if spec.default ~= nil then words[#words + 1] = plain_value(spec.default) .. " if not given" end
  return table.concat(words, "; ")
end

function pages.operation(entry)
  local out = { pages.signature(entry) .. (entry.returns and "   gives " .. entry.returns or ""), "" }
  out[1] = pages.wrap(out[1], "    ", "")
  out[#out + 1] = pages.wrap(entry.doc, "", "")
  local rows = {}
  for _, spec in ipairs(entry.args) do
    local expected = pages.expected(spec)
    rows[#rows + 1] = { spec.name, spec.doc .. (expected ~= "" and " (" .. expected .. ")" or "") }
  end
  for _, spec in ipairs(entry.options or {}) do
    local expected = pages.expected(spec)
    rows[#rows + 1] = { spec.name .. " =", spec.doc .. (expected ~= "" and " (" .. expected .. ")" or "") }
  end
  if entry.rest then rows[#rows + 1] = { "name = value", (entry.rest.doc or "any other names") .. " (" ..
    pages.expected(entry.rest) .. ")" } end
  if #rows > 0 then out[#out + 1] = "\n" .. pages.rows(rows, "  ") end
  if entry.source then out[#out + 1] = "\nsource: " .. entry.source end
  if entry.example then out[#out + 1] = "\nexample:\n    " .. entry.example:gsub("%s+$", ""):gsub("\n", "\n    ") end
  return table.concat(out, "\n")
end

-- Models ----------------------------------------------------------------------------------------------------------------

function pages.parameter(p, now)
  local words = { p.doc or "", "(" .. plain_value(p.default) }
  if p.unit then words[2] = words[2] .. " " .. p.unit end
  if p.min and p.max then words[2] = string.format("%s; from %.14g to %.14g", words[2], p.min, p.max)
  elseif p.min then words[2] = string.format("%s; %.14g or more", words[2], p.min)
  elseif p.max then words[2] = string.format("%s; %.14g or less", words[2], p.max) end
  words[2] = words[2] .. ")"
  if now ~= nil and now ~= p.default then words[3] = "now " .. plain_value(now) end
  return (table.concat(words, " "):gsub("^ ", ""))
end

function pages.parameters(list, values)
  local rows = {}
  for _, p in ipairs(list) do rows[#rows + 1] = { p.name, pages.parameter(p, values and values[p.name]) } end
  return pages.rows(rows, "  ")
end

--- The declarations behind P as a list by name.
function pages.declared(P)
  local list = {}
  for name, spec in pairs(params.declared(P)) do
    list[#list + 1] = setmetatable({ name = name }, { __index = spec })
  end
  return list
end

function pages.model(name, path, P)
  local head = script.header(core.read_file(path))
  local out, rows = { pages.wrap(name .. ": " .. head.about, "", ""), "" }, {}
  for _, section in ipairs(head.sections) do rows[#rows + 1] = { section.title:lower(), section.text } end
  if #rows > 0 then out[#out + 1] = pages.rows(rows, "  ") end
  local list = P and pages.declared(P) or script.parameters(path)
  if #list > 0 then out[#out + 1] = "\nparameters:\n" .. pages.parameters(list, P and params.values(P)) end
  out[#out + 1] = "\n" .. path
  return table.concat(out, "\n")
end

function pages.models()
  local rows = {}
  for _, model in ipairs(script.shipped()) do rows[#rows + 1] = { model.name, model.about } end
  return pages.wrap("shipped models, for load \"name\" (help \"name\" says more):", "", "") .. "\n" .. pages.rows(rows, "  ")
end

-- Overviews -------------------------------------------------------------------------------------------------------------

--- Owners of operations in the order in which they are shown, with what they are.
pages.owners = {
  { "prompt", "names that only the prompt has" },
  { "tunica", "functions of the module (local tunica = require \"tunica\")" },
  { "tissue", "a tissue" },
  { "cell", "a cell" },
  { "wall", "a wall between two cells, or at the border" },
  { "side", "a wall as one of its cells sees it" },
  { "junction", "a point where walls meet" },
  { "model", "a model of a tissue" },
  { "phyllotaxis", "a model of phyllotaxis by inhibition" },
  { "contour", "a curve in the plane" },
  { "curve", "a function drawn as a curve" },
  { "apex", "a surface of revolution that grows" },
  { "surface", "a surface given by functions" },
  { "bulges", "a surface with primordia" },
}

function pages.of_owner(owner)
  local list = {}
  for _, entry in ipairs(registry.all()) do
    if entry.owner == owner then list[#list + 1] = entry end
  end
  if owner == "tunica" or owner == "prompt" then table.sort(list, function(a, b) return a.name < b.name end) end
  return list
end

function pages.overview(owner, title)
  local rows = {}
  for _, entry in ipairs(pages.of_owner(owner)) do rows[#rows + 1] = { entry.title, pages.first_sentence(entry.doc) } end
  return pages.wrap(title .. ":", "", "") .. "\n" .. pages.rows(rows, "  ")
end

function pages.tour()
  local model = desk.model()
  local rows = {
    { 'load "ring"', "takes a shipped model; it is then model, tissue and P (help \"models\" lists all)" },
    { "run(50)", "runs it for some time; Ctrl-C stops it, run() goes on" },
    { "show()", "draws it" },
    { "P.D = 2", "changes a parameter from the next step on; help \"D\" says what it is" },
    { "undo()", "goes back to before the last run or change; redo() forward" },
    { "edit()", "opens its script in your editor; reload() takes what you changed, the tissue stays" },
    { "who()", "lists what there is" },
    { 'save "file"', "keeps the session; restore \"file\" goes on with it" },
    { 'help "tissue:divide"', "or ?tissue:divide: an operation, with its arguments, limits and an example" },
    { 'help "tissue"', "what can be done with a tissue; likewise " .. '"cell", "model", "apex" ...' },
    { 'search "word"', "or ??word: everything in which the word occurs" },
  }
  return "Some things to type:\n" .. pages.rows(rows, "  ") .. (model and "\n\nThe model at hand: " .. tostring(model) or "") ..
    "\n\n" .. pages.wrap("More: help \"prompt\" (names that only the prompt has), help \"operations\" (all others), help " ..
      "\"methods\" (of integration).", "", "")
end

function pages.methods()
  local rows = {}
  for _, way in ipairs(core.methods_of_solution()) do
    rows[#rows + 1] = { way.name, string.format("%s; order %d%s", way.title, way.order, way.adaptive and ", adaptive" or "") }
  end
  return "methods of integration, for tunica.model { method = } and model:solve_with { method = }:\n" .. pages.rows(rows, "  ")
end

return pages
