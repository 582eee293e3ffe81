-- SPDX-License-Identifier: MIT
--- help and search at the prompt: all of it from the registry, and from the headers and parameters of models.

require "tunica"  -- every operation is declared

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local desk = require "tunica.prompt.desk"
local pages = require "tunica.prompt.pages"
local script = require "tunica.prompt.script"
require "tunica.prompt.work"
local op, fail = registry.op, registry.fail

-- Topics that have a page of their own.
local topics = { models = pages.models, methods = pages.methods }
for _, owner in ipairs(pages.owners) do
  topics[owner[1]] = function() return pages.overview(owner[1], owner[2]) end
end
function topics.operations()
  local out = {}
  for _, owner in ipairs(pages.owners) do
    if owner[1] ~= "prompt" then out[#out + 1] = pages.overview(owner[1], owner[2]) end
  end
  return table.concat(out, "\n\n")
end

local function list_of(title, entries)
  local rows = {}
  for _, entry in ipairs(entries) do rows[#rows + 1] = { entry.title, pages.first_sentence(entry.doc) } end
  return pages.wrap(title, "", "") .. "\n" .. pages.rows(rows, "  ")
end

--- A parameter of the model at hand.
local function parameter(name)
  local model = desk.model()
  local P = model and model.params
  local spec = P and params.declared(P)[name:gsub("^P%.", "")]
  if not spec then return nil end
  local bare = name:gsub("^P%.", "")
  local p = setmetatable({ name = bare }, { __index = spec })
  return string.format("P.%s, a parameter of %s\n%s", bare, desk.source and desk.source.name or "the model at hand",
    pages.rows({ { bare, pages.parameter(p, params.values(P)[bare]) } }, "  "))
end

--- An option of some operations.
local function option(name)
  local rows = {}
  for _, entry in ipairs(registry.all()) do
    local spec = entry.by_key[name]
    for _, each in ipairs(entry.options or {}) do spec = spec or each.name == name and each end
    if spec then
      local expected = pages.expected(spec)
      rows[#rows + 1] = { entry.title, spec.doc .. (expected ~= "" and " (" .. expected .. ")" or "") }
    end
  end
  if #rows > 0 then return string.format("'%s' is an argument of\n", name) .. pages.rows(rows, "  ") end
end

local function method_of_solution(name)
  for _, way in ipairs(core.methods_of_solution()) do
    if way.name == name then
      return string.format("%s, a method of integration: %s; order %d%s. model:solve_with { method = \"%s\" } takes it.",
        name, way.title,
        way.order, way.adaptive and ", adaptive" or ", fixed steps (dt)", name)
    end
  end
end

--- Shipped models of this name or last part of a name.
local function models_called(name)
  local found = {}
  for _, model in ipairs(script.shipped()) do
    if model.name == name or model.name:match "[^/]+$" == name then found[#found + 1] = pages.model(model.name, model.path) end
  end
  return found
end

--- Everything that is called so: a list of pages.
local function called(name)
  local bare = name:gsub("%s*%(%s*%)$", "")
  local entry = registry.find(bare) or registry.find("prompt." .. bare)
  if entry then return { pages.operation(entry) } end
  local found, same_member = {}, {}
  found[1] = parameter(bare)
  if topics[bare] then found[#found + 1] = topics[bare]() end
  for _, e in ipairs(registry.all()) do
    if e.member == bare then same_member[#same_member + 1] = e end
  end
  if #same_member == 1 then
    found[#found + 1] = pages.operation(same_member[1])
  elseif #same_member > 1 then
    found[#found + 1] = list_of(string.format("'%s' is an operation of several things; help \"owner:%s\" says more:", bare,
      bare), same_member)
  end
  for _, text in ipairs { option(bare) or false, method_of_solution(bare) or false } do
    if text then found[#found + 1] = text end
  end
  for _, text in ipairs(models_called(bare)) do found[#found + 1] = text end
  return found
end

--- Every word that help knows, for completion and for hints.
local function known_names()
  local seen, names = {}, {}
  local function add(name)
    if not seen[name] then names[#names + 1], seen[name] = name, true end
  end
  for _, entry in ipairs(registry.all()) do
    add(entry.title)
    add(entry.member)
    for _, spec in ipairs(entry.args) do add(spec.name) end
    for _, spec in ipairs(entry.options or {}) do add(spec.name) end
  end
  for name in pairs(topics) do add(name) end
  for _, model in ipairs(script.shipped()) do
    add(model.name)
    add(model.name:match "[^/]+$")
  end
  for _, way in ipairs(core.methods_of_solution()) do add(way.name) end
  local model = desk.model()
  for name in pairs(model and model.params and params.values(model.params) or {}) do add(name) end
  return names
end

--- The page of a file that is no shipped model.
local function own_file(name)
  local ok, path = pcall(script.find, name)
  return ok and pages.model(name, path) or nil
end

local function about_text(name)
  local found = called(name)
  if #found == 0 then found[1] = own_file(name) end
  if #found == 0 then
    local short = name:sub(1, 100):gsub("%c", " ")
    if not desk.model() and short:match "^P%.%a" then fail("help: parameters are those of a model; load one first") end
    fail("help: nothing is called '%s'%s; search \"%s\" looks into all texts", short, core.did_you_mean(short, known_names()),
      short)
  end
  return table.concat(found, "\n\n")
end

local function about_model(model)
  local source = desk.source
  if model == desk.model() and source then return pages.model(source.name, source.path, model.params) end
  return tostring(model) .. (model.params and "\n\nparameters:\n" .. pages.parameters(pages.declared(model.params),
    params.values(model.params)) or "")
end

local function about_value(value)
  if desk.inside(value) then return about_model(value) end
  if params.is(value) then return "parameters:\n" .. pages.parameters(pages.declared(value), params.values(value)) end
  if type(value) == "function" then
    for _, entry in ipairs(registry.all()) do
      if entry.call == value then return pages.operation(entry) end
    end
    return "a function that is no operation of tunica"
  end
  if value == require "tunica" then return topics.tunica() end
  local kind = core.kind(value) or core.shape_kind(value)
  if topics[kind] then return tostring(value) .. "\n\n" .. topics[kind]() end
  return core.describe(value)
end

op { name = "prompt.help", args = { { name = "topic", type = "any", doc = "a name in quotes (an operation, an option, a model, " ..
  "a parameter), or a thing itself; ?name is the same" } },
  doc = "Says what something is: its arguments with units, limits and defaults, where it comes from, and an example that runs. " ..
    "Without a topic: where to begin.",
  example = 'help "tissue:divide"',
  fn = function(topic)
    local text = topic == nil and pages.tour() or type(topic) == "string" and about_text(topic) or about_value(topic)
    desk.say("%s", text)
  end }

-- Search ----------------------------------------------------------------------------------------------------------------

--- Whether every word occurs in the text (in small letters).
local function holds(text, words)
  for _, word in ipairs(words) do
    if not text:find(word, 1, true) then return false end
  end
  return true
end

local function text_of(entry)
  local out = { entry.name, entry.doc, entry.returns or "", entry.source or "" }
  for _, spec in ipairs(entry.args) do
    out[#out + 1] = spec.name .. " " .. spec.doc .. " " .. (spec.choices and table.concat(spec.choices, " ") or "")
  end
  return table.concat(out, " "):lower()
end

local function text_of_model(model)
  local out = { model.name, (core.read_file(model.path):match "^(.-)\n[^%-\n]") or "" }
  for _, p in ipairs(script.parameters(model.path)) do out[#out + 1] = p.name .. " " .. (p.doc or "") end
  return table.concat(out, " "):lower()
end

op { name = "prompt.search", args = { { name = "words", type = "string", required = true,
  doc = "one or several; ??word is the same" } },
  doc = "Lists all operations and models in whose texts every one of the words occurs.",
  example = 'search "primordia"',
  fn = function(given)
    local words, rows = {}, {}
    for word in given:lower():gmatch "%S+" do words[#words + 1] = word end
    if #words == 0 then fail "search: which word? search \"primordia\"" end
    for _, entry in ipairs(registry.all()) do
      if holds(text_of(entry), words) then rows[#rows + 1] = { entry.title, pages.first_sentence(entry.doc) } end
    end
    for _, model in ipairs(script.shipped()) do
      if holds(text_of_model(model), words) then rows[#rows + 1] = { model.name, model.about } end
    end
    desk.say("%s", #rows > 0 and pages.rows(rows, "") or "no text holds " .. given:sub(1, 200))
  end }

return { help = registry.prompt.help, search = registry.prompt.search }
