-- SPDX-License-Identifier: MIT
--- What could stand at the cursor: names, fields, methods, options, columns, parameters, models, files, each with one line of
-- help. Nothing of the user's is called to find out.

local core = require "tunica.core"
local session = require "tunica.prompt.session"
local values = require "tunica.prompt.values"
local debug = select(2, ...).debug

local most = 400

local keywords = { "and", "break", "do", "else", "elseif", "end", "false", "for", "function", "if", "in", "local", "nil", "not",
  "or", "repeat", "return", "then", "true", "until", "while" }

-- Help of one line ----------------------------------------------------------------------------------------------------------

local function first_sentence(doc) return (doc:match "^(.-)%.%s" or doc:gsub("%.$", "")) end

--- "(above, area [unit])" of an operation.
local function about_entry(entry)
  local names = {}
  for _, spec in ipairs(entry.args) do names[#names + 1] = spec.required and spec.name or "[" .. spec.name .. "]" end
  local call = ""
  if entry.kind == "named" then call = "{ } "
  elseif entry.kind ~= "property" then call = "(" .. table.concat(names, ", ") .. ") " end
  return call .. first_sentence(entry.doc)
end

local entries_by_call

local function registry()
  require "tunica"
  return require "tunica.registry"
end

local function entry_of(fn)
  if not entries_by_call then
    entries_by_call = {}
    for _, entry in ipairs(registry().all()) do
      if entry.call then entries_by_call[entry.call] = entry end
    end
  end
  return entries_by_call[fn]
end

local function about_value(value)
  if type(value) == "function" then
    local entry = entry_of(value)
    return entry and about_entry(entry) or ""
  end
  local ok, text = pcall(values.brief, value)
  return ok and text or ""
end

-- What a chain of names is --------------------------------------------------------------------------------------------------

local library_kinds = { model = true, phyllotaxis = true, parameters = true }

--- A field without running the user's code; nil if that cannot be told.
local function field_of(value, name)
  if type(value) == "userdata" or library_kinds[values.kind(value)] or value == package.loaded.tunica then
    local ok, member = pcall(function() return value[name] end)
    return ok and member or nil
  end
  if type(value) == "string" then return string[name] end
  if type(value) ~= "table" then return nil end
  for _ = 1, 8 do
    local member = rawget(value, name)
    if member ~= nil then return member end
    local meta = debug.getmetatable(value)
    value = type(meta) == "table" and rawget(meta, "__index")
    if type(value) ~= "table" then return nil end
  end
end

--- The value of "a.b:c", or nil.
local function resolve(chain)
  local value, first = nil, true
  for name in chain:gmatch "[%a_][%w_]*" do
    if first then value = session.lookup(name) else value = field_of(value, name) end
    if value == nil then return nil end
    first = false
  end
  return value
end

-- Members -------------------------------------------------------------------------------------------------------------------

local function add(list, prefix, name, about)
  if name:sub(1, #prefix) == prefix and #list < most then list[#list + 1] = { name = name, about = about } end
end

--- Operations of an owner; `mark` is "." or ":".
local function add_operations(list, prefix, owner, mark)
  for _, entry in ipairs(registry().all()) do
    local is_method = entry.name:find(":", 1, true) ~= nil
    if entry.owner == owner and (mark == "." or is_method) then add(list, prefix, entry.member, about_entry(entry)) end
  end
end

local plain_fields = {
  model = { time = "the time now", steps = "steps so far", cost = "what it has cost", about = "how it is solved",
    tissue = "its tissue",
    params = "its parameters", name = "its name", views = "its views", stop = "when a run ends" },
  phyllotaxis = { time = "the time now", steps = "steps so far", cost = "what it has cost", about = "how it is solved",
    count = "primordia so far", angles = "their angles", params = "its parameters", name = "its name", views = "its views",
    apex = "its apex", finished = "whether it has reached its end" },
}

local function add_object(list, prefix, value, kind, mark)
  add_operations(list, prefix, kind, mark)
  if mark == ":" then return end
  for name, about in pairs(plain_fields[kind] or {}) do add(list, prefix, name, about) end
  if kind == "cell" or kind == "side" or kind == "wall" or kind == "junction" then
    local ok, names = pcall(function() return core.columns(value.tissue, kind) end)
    for _, name in ipairs(ok and names or {}) do add(list, prefix, name, values.short(value[name])) end
  end
end

local function add_parameters(list, prefix, P)
  local declared = require("tunica.params").declared(P)
  for name, value in pairs(P) do
    local spec = declared[name]
    local about = values.brief(value) .. (spec.unit and " " .. spec.unit or "")
    add(list, prefix, name, spec.doc and about .. "  " .. spec.doc or about)
  end
end

--- Names of a table that begin so, sorted. Of very many only some, but always the first and the last: what all have in
-- common at their beginning is what these two have.
local function names_in(value, prefix, mark, seen)
  local names, after, first, last = {}, prefix .. "\255", nil, nil
  for name, item in next, value do
    if type(name) == "string" and name >= prefix and name < after and (mark == "." or type(item) == "function")
      and not seen[name] and name:find "^[%a_][%w_]*$" then
      if not first or name < first then first = name end
      if not last or name > last then last = name end
      if #names < most - 2 then names[#names + 1], seen[name] = name, true end
    end
  end
  for _, name in ipairs { first, last } do
    if not seen[name] then names[#names + 1], seen[name] = name, true end
  end
  table.sort(names)
  return names
end

local function add_table(list, prefix, value, mark)
  local seen = {}
  for _ = 1, 8 do
    local names = names_in(value, prefix, mark, seen)
    for _, name in ipairs(names) do add(list, prefix, name, about_value(value[name])) end
    local meta = debug.getmetatable(value)
    value = type(meta) == "table" and rawget(meta, "__index")
    if type(value) ~= "table" then return end
  end
end

local function members(object, mark, prefix)
  local value, list = resolve(object), {}
  if value == nil then return list end
  local kind = values.kind(value)
  if kind == "string" then add_table(list, prefix, string, mark)
  elseif kind == "parameters" then add_parameters(list, prefix, value)
  elseif value == package.loaded.tunica then add_operations(list, prefix, "tunica", mark)
  elseif type(value) == "userdata" or library_kinds[kind] then add_object(list, prefix, value, kind, mark)
  elseif kind == "table" then add_table(list, prefix, value, mark) end
  table.sort(list, function(a, b) return a.name < b.name end)
  return list
end

-- Globals -------------------------------------------------------------------------------------------------------------------

local function globals(prefix)
  local list = {}
  for _, name in ipairs(session.names()) do
    if name:sub(1, #prefix) == prefix then
      local about = ""
      if name == "tunica" then about = "the library"
      else about = about_value((session.lookup(name))) end
      add(list, prefix, name, about)
    end
  end
  if prefix ~= "" then
    for _, name in ipairs(keywords) do add(list, prefix, name, "") end
  end
  return list
end

-- Where the cursor is -------------------------------------------------------------------------------------------------------

--- Reads the text up to the cursor. Returns the start of an open string, or nil; and the open brackets, innermost last, as
-- { mark, position }.
local function scan(text)
  local open, at = {}, 1
  while at <= #text do
    local c = text:sub(at, at)
    if c == '"' or c == "'" then
      local i = at + 1
      while i <= #text and text:sub(i, i) ~= c do i = i + (text:sub(i, i) == "\\" and 2 or 1) end
      if i > #text then return at + 1, open end
      at = i
    elseif text:sub(at, at + 1) == "--" then
      at = text:find("\n", at, true) or #text
    elseif c:match "[%(%[{]" then open[#open + 1] = { c, at }
    elseif c:match "[%)%]}]" then open[#open] = nil end
    at = at + 1
  end
  return nil, open
end

local chain_at_end = "([%a_][%w_.:]*)%s*$"

--- The operation in whose arguments the cursor is: its entry, the value before the colon, and the text of the arguments so far.
local function call_around(text, open)
  local last = open[#open]
  local start = last and last[2] or #text + 1
  if last and last[1] == "{" and open[#open - 1] and open[#open - 1][1] == "(" and
    text:sub(open[#open - 1][2] + 1, start - 1):match "^%s*$" then
    start = open[#open - 1][2]
  end
  local chain = text:sub(1, start - 1):match(chain_at_end)
  if not chain then return nil end
  local entry = entry_of(resolve(chain))
  return entry, resolve(chain:match "^(.*)[.:]" or ""), last and text:sub(last[2] + 1) or "", chain
end

--- Options of an operation whose table is open.
local function options(entry, prefix)
  local list = {}
  for _, spec in ipairs(entry.kind == "named" and entry.args or entry.options) do
    local default = spec.default ~= nil and type(spec.default) ~= "table" and " (" .. values.brief(spec.default) .. ")" or ""
    add(list, prefix, spec.name, (spec.unit and spec.unit .. "  " or "") .. (spec.doc or "") .. default)
  end
  table.sort(list, function(a, b) return a.name < b.name end)
  return list
end

-- Strings -------------------------------------------------------------------------------------------------------------------

local function tissue_of(value)
  local kind = values.kind(value)
  if kind == "tissue" then return value end
  if kind == "model" then return value.tissue end
  if type(value) == "userdata" then
    local ok, tissue = pcall(core.tissue_of, value)
    return ok and tissue or nil
  end
  local model = session.lookup "model"
  if values.kind(model) == "model" then return model.tissue end
  local tissue = session.lookup "tissue"
  return values.kind(tissue) == "tissue" and tissue or nil
end

local function columns(tissue, prefix, kinds)
  local list = {}
  for _, kind in ipairs(kinds) do
    local ok, names = pcall(core.columns, tissue, kind)
    for _, name in ipairs(ok and names or {}) do add(list, prefix, name, "column of the " .. kind .. "s") end
  end
  return list
end

--- Files below the folder that the word names; folders end in /.
local function files(prefix)
  local folder, start = prefix:match "^(.*/)([^/]*)$"
  folder, start = folder or "", start or prefix
  local home = os.getenv "HOME"
  local real = folder:gsub("^~/", (home or "~"):gsub("%%", "%%%%") .. "/")
  local ok, names = pcall(core.list, real == "" and "." or real)
  local list = {}
  table.sort(ok and names or {})
  for _, name in ipairs(ok and names or {}) do
    if name:sub(1, #start) == start and (start ~= "" or name:sub(1, 1) ~= ".") then
      local is_folder = core.kind_of(real .. name) == "folder"
      add(list, prefix, folder .. name .. (is_folder and "/" or ""), "")
    end
  end
  return list
end

local function shipped(prefix)
  local list = {}
  for _, model in ipairs(require("tunica.prompt.script").shipped()) do add(list, prefix, model.name, model.about) end
  return list
end

local with_models = { load = true, help = true, dofile = true }
local with_columns = { plot = true, show = true, column = true }

--- The option that a string is the value of ("name = " before the quote), or the argument at that place.
local function spec_of(entry, before)
  local name = before:match "([%a_][%w_]*)%s*=%s*{?%s*$"
  if name and entry.by_key[name] then return entry.by_key[name] end
  if not name then return entry.args[select(2, before:gsub(",", "")) + 1] end
end

local function in_string(text, start, open)
  local prefix, before = text:sub(start), text:sub(1, start - 2)
  local entry, owner, inside, chain = call_around(before, open)
  if #open == 0 then chain = before:match(chain_at_end) end
  if chain and with_models[chain] then
    local list = shipped(prefix)
    for _, each in ipairs(files(prefix)) do list[#list + 1] = each end
    return list
  end
  if chain == "edit_curve" then
    local list = {}
    for name, text in pairs(require("tunica.prompt.edit_curve").parameters()) do
      add(list, prefix, name, text:sub(1, 60))
    end
    table.sort(list, function(a, b) return a.name < b.name end)
    for _, each in ipairs(files(prefix)) do list[#list + 1] = each end
    return list
  end
  if chain and with_columns[chain] and tissue_of(nil) then
    return columns(tissue_of(nil), prefix, { "cell", "side", "wall", "junction" })
  end
  local spec = entry and spec_of(entry, inside)
  if spec then
    local list, tissue = {}, tissue_of(owner)
    for _, choice in ipairs(spec.choices or {}) do add(list, prefix, choice, "") end
    local of_column = spec.type:find("column", 1, true) or spec.doc and spec.doc:find("column", 1, true)
    if of_column and tissue then
      local kind = spec.of or spec.name == "sides" and "side" or "cell"
      for _, each in ipairs(columns(tissue, prefix, { kind })) do list[#list + 1] = each end
    end
    if #list > 0 then return list end
  end
  return files(prefix)
end

-- Everything ------------------------------------------------------------------------------------------------------------------

--- Candidates as the program takes them: whole words, and how they are shown.
local function whole(list, before)
  local out = {}
  for i, each in ipairs(list) do out[i] = { text = before .. each.name, label = each.name, about = each.about or "" } end
  return out
end

--- complete(line, cursor): where the word begins (bytes before it), and a list of { text, label, about }.
return function(line, cursor)
  local text = line:sub(1, cursor)
  local start, open = scan(text)
  if start then return start - 1, whole(in_string(text, start, open), "") end
  local marks = text:match "^%s*%?+%s*" or ""
  local word = text:sub(#marks + 1):match "[%a_][%w_.:]*$" or ""
  local object, mark, prefix = word:match "^(.*)([.:])([%w_]*)$"
  if object then return cursor - #word, whole(members(object, mark, prefix), object .. mark) end
  local list = {}
  local last = open[#open]
  if last and last[1] == "{" then
    local entry = call_around(text:sub(1, last[2]), open)
    if entry and (entry.kind == "named" or entry.options) then list = options(entry, word) end
  end
  if #list == 0 or word ~= "" then
    for _, each in ipairs(globals(word)) do list[#list + 1] = each end
  end
  return cursor - #word, whole(list, "")
end
