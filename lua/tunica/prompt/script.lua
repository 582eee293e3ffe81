-- SPDX-License-Identifier: MIT
--- Scripts run from the prompt: found by name, run as if in a fresh program, their headers and parameters read.

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local fail = registry.fail
local whole_debug = (select(2, ...) or {}).debug or debug
local load_text = loadstring

local script = {}

-- Names -----------------------------------------------------------------------------------------------------------------

local function first_comment(text)
  for line in text:gmatch "[^\n]*" do
    if line:match "^%-%-" then
      local words = line:match "^%-+%s*(.*)$"
      if words ~= "" and not words:find "SPDX" then return words end
    elseif not line:match "^#" and line ~= "" then
      return ""
    end
  end
  return ""
end

local function collect(folder, prefix, list)
  for _, name in ipairs(core.list(folder)) do
    local path = folder .. "/" .. name
    if core.kind_of(path) == "folder" then
      if name ~= "parts" then collect(path, prefix .. name .. "/", list) end  -- parts of models are none
    elseif name:match "%.lua$" then
      list[#list + 1] = { name = prefix .. name:gsub("%.lua$", ""), path = path }
    end
  end
  return list
end

--- The shipped models: a list of { name =, path =, about = }, by name.
function script.shipped()
  local list = collect(core.shared_folder "scripts", "", {})
  table.sort(list, function(a, b) return a.name < b.name end)
  for _, model in ipairs(list) do model.about = first_comment(core.read_file(model.path)) end
  return list
end

--- The path of a script given by its path or the name (or last part of the name) of a shipped model, and its name.
function script.find(given)
  for _, path in ipairs { given, given .. ".lua" } do
    local kind = given ~= "" and not given:find "%z" and core.kind_of(path)
    if kind == "file" then return path, (path:gsub("%.lua$", "")) end
  end
  local names, found = {}, {}
  for _, model in ipairs(script.shipped()) do
    local last = model.name:match "[^/]+$"
    if model.name == given or model.name .. ".lua" == given then return model.path, model.name, true end
    if last == given then found[#found + 1] = model end
    names[#names + 1], names[#names + 2] = model.name, last
  end
  if #found == 1 then return found[1].path, found[1].name, true end
  if #found > 1 then fail("there are %d models called '%s': %s and %s", #found, given, found[1].name, found[2].name) end
  fail("no file and no shipped model is called '%s'%s; help \"models\" lists them", given:sub(1, 200),
    core.did_you_mean(given:sub(1, 200), names))
end

-- Running ---------------------------------------------------------------------------------------------------------------

--- The message with the lines of the user's own files that led there.
local function with_chain(message)
  local lines = { tostring(message) }
  for level = 2, 60 do
    local info = whole_debug.getinfo(level, "Sln")
    if not info or #lines > 10 then break end
    if info.source:sub(1, 1) == "@" and info.currentline > 0 then
      local in_function = info.name and " in '" .. info.name .. "'" or ""
      lines[#lines + 1] = string.format("  at %s:%d%s", info.short_src, info.currentline, in_function)
    end
  end
  if #lines == 2 and lines[1]:find(lines[2]:match "^  at (.-:%d+)" .. ":", 1, true) then lines[2] = nil end
  return table.concat(lines, "\n")
end

local standard = {}
for name in pairs(package.loaded) do standard[name] = true end

local latest  -- the source whose modules core.sources() gathers, also those required later

local function replace(list, by)
  for i = #list, 1, -1 do list[i] = nil end
  for i, item in ipairs(by) do list[i] = item end
  return list
end

-- What puts the state around a script in order again; by name. Ctrl-C breaks off the code that would have done it, so the next
-- line does.
local unsettled = {}

local function settle(name)
  local put_back = unsettled[name]
  unsettled[name] = nil
  if put_back then put_back() end
end

--- Puts in order what an interrupted script left.
function script.settle()
  for _, name in ipairs { "builders", "declarations", "state" } do settle(name) end
end

--- What running a script changes of the state around it: a function that puts it back.
local function kept_state()
  if latest then replace(latest.files, core.sources()) end
  local before, path, random, current, overrides = latest, package.path, core.random_state(), params.current(), {}
  local sources = replace({}, core.sources())
  for name, value in pairs(core.overrides()) do overrides[name] = value end
  return function()
    latest, package.path = before, path
    core.random_state(random)
    params.forget(current)
    replace(core.sources(), sources)
    local given = core.overrides()
    for name in pairs(given) do given[name] = nil end
    for name, value in pairs(overrides) do given[name] = value end
  end
end

--- As at the start of the program: the script's own modules are read again, random numbers begin anew.
local function begin_afresh(path, overrides)
  for name in pairs(package.loaded) do
    if not standard[name] and not name:match "^tunica" then package.loaded[name] = nil end
  end
  local given = core.overrides()
  for name in pairs(given) do given[name] = nil end
  for name, value in pairs(overrides) do given[name] = tostring(value) end
  replace(core.sources(), {})
  local folder = path:match "^(.*)/[^/]*$"
  local prefix = folder and folder .. "/" or ""
  package.path = prefix .. "?.lua;" .. prefix .. "?/init.lua"
  core.random_state(("\0"):rep(17))
  params.forget()
end

local slow = 0.02  -- seconds that a builder takes whose result is worth keeping

--- While `work` runs, builders of tissues keep what took them long: in `built`, by their number. With `use`, those of the
-- same name at the same place give what was kept.
local function with_builders(built, use, work)
  local functions, count = registry.module, 0
  local own = {}
  unsettled.builders = function()
    for name, fn in pairs(own) do functions[name] = fn end
  end
  for _, entry in ipairs(registry.all()) do
    if entry.owner == "tunica" and entry.returns == "a tissue" then
      local name = entry.member
      own[name] = functions[name]
      functions[name] = function(...)
        count = count + 1
        local number, kept = count, use and use[count]
        if kept and kept.name == name then
          local tissue = core.build_line(1, 1)
          core.tissue_load(tissue, kept.bytes)
          built[number] = kept
          return tissue
        end
        local began = core.now()
        local tissue = own[name](...)
        if core.now() - began > slow then built[number] = { name = name, bytes = core.tissue_save(tissue) } end
        return tissue
      end
    end
  end
  return xpcall(work, with_chain)
end

--- Runs a script: { path =, name =, overrides = name -> value, text = (else the file's), use = what `built` was before }.
-- Returns its result and the source: { path, name, overrides, files = { { path =, text = }, ... }, built = }.
function script.run(o)
  script.settle()
  local text = o.text or core.read_file(o.path)
  local overrides, built = o.overrides or {}, {}
  unsettled.state = kept_state()
  begin_afresh(o.path, overrides)
  local chunk, wrong = load_text(text, "@" .. o.path)
  core.sources()[1] = { path = o.path, text = text }
  local before = rawget(_G, "arg")
  rawset(_G, "arg", { [0] = o.path })
  local ok, result = false, wrong
  if chunk then ok, result = with_builders(built, o.use, chunk) end
  rawset(_G, "arg", before)
  settle "builders"
  if not ok then
    settle "state"
    error(result, 0)
  end
  unsettled.state = nil
  latest = { path = o.path, name = o.name or o.path, shipped = o.shipped, overrides = overrides,
    files = replace({}, core.sources()), built = built }
  return result, latest
end

--- The files of a source, as they were read: { path =, text = }, the script first.
function script.files(source)
  return source == latest and replace(source.files, core.sources()) or source.files
end

--- Whether a file of the source has changed on disk: its path, or nil. A file that is gone counts as unchanged.
function script.changed(source)
  for _, file in ipairs(script.files(source)) do
    local there, text = pcall(core.read_file, file.path)
    if there and text ~= file.text then return file.path end
  end
end

-- Headers ---------------------------------------------------------------------------------------------------------------

--- The comment at the head of a script: { about =, sections = { { title =, text = }, ... } } (WHAT, HOW, TRY, SOURCE).
function script.header(text)
  local head, current = { about = first_comment(text), sections = {} }, nil
  for line in text:gmatch "[^\n]*" do
    local words = line:match "^%-%-%s?(.*)$"
    if not words and line ~= "" and not line:match "^#" then break end
    local title, rest = (words or ""):match "^%s*(%u%u+)%s+(.*)$"
    if title and title ~= "SPDX" then
      current = { title = title, text = rest }
      head.sections[#head.sections + 1] = current
    elseif current and words and words ~= "" then
      current.text = current.text .. " " .. words:match "^%s*(.-)%s*$"
    end
  end
  return head
end

--- The parameters that a script declares, without building its model: a list of { name =, type =, default =, doc =, unit =,
-- min =, max = }, by name; empty if it declares none.
function script.parameters(path)
  script.settle()
  local text, found = core.read_file(path), nil
  unsettled.state = kept_state()
  unsettled.declarations = function() params.declared_hook = nil end
  begin_afresh(path, {})
  params.declared_hook = function(declared)
    found = declared
    error("declared", 0)
  end
  local chunk = load_text(text, "@" .. path)
  if chunk then pcall(chunk) end
  script.settle()
  local list = {}
  for name, spec in pairs(found or {}) do
    list[#list + 1] = { name = name, type = spec.type, default = spec.default, doc = spec.doc, unit = spec.unit,
      min = spec.min, max = spec.max }
  end
  return list
end

return script
