-- SPDX-License-Identifier: MIT
--- Values as the prompt shows them: usefully and briefly, whatever their size.

local core = require "tunica.core"
local screen = require "tunica.prompt.screen"
local debug = select(2, ...).debug

local values = {}

local most_lines, most_text = 24, 2000

-- Short forms -----------------------------------------------------------------------------------------------------------

function values.number(x)
  if x == math.floor(x) and math.abs(x) < 1e15 then return string.format("%.0f", x) end
  return core.shortest(x)
end

--- A time, without the digits that adding steps has left.
function values.time(x) return (string.format("%.10g", x)) end

local function short(x) return (string.format("%.4g", x):gsub("e%+?(-?)0*(%d)", "e%1%2")) end
values.short = short

local function loaded(name) return package.loaded["tunica." .. name] end

--- The registry's entry of a function, or nil.
local function entry_of(fn)
  local registry = loaded "registry"
  for _, entry in ipairs(registry and registry.all() or {}) do
    if entry.call == fn then return entry end
  end
end

local function first_sentence(doc) return doc:match "^(.-%.)%s" or doc end

local function of_function(fn)
  local entry = entry_of(fn)
  if entry then return "function " .. entry.name:gsub("^prompt%.", "") .. ": " .. first_sentence(entry.doc) end
  local about = debug.getinfo(fn, "S")
  if about.what == "C" or about.source:sub(1, 8) == "=tunica/" then return "function of the library" end
  return string.format("function at %s:%d", about.short_src, about.linedefined)
end

--- What a value is: "model", "phyllotaxis", "parameters", "tissue", "cell" ..., or Lua's type.
function values.kind(value)
  local kind = type(value)
  if kind == "userdata" then return core.kind(value) or kind end
  if kind ~= "table" then return kind end
  local model, phyllotaxis, params = loaded "model", loaded "phyllotaxis", loaded "params"
  if model and model.is_model(value) then return "model" end
  if phyllotaxis and phyllotaxis.is_phyllotaxis(value) then return "phyllotaxis" end
  if params and params.is(value) then return "parameters" end
  return kind
end

local is_name = "^[%a_][%w_]*$"

local function key_text(key)
  if type(key) == "string" then return key:match(is_name) and key or string.format("[%s]", values.brief(key)) end
  return "[" .. values.brief(key) .. "]"
end

local function safely(f, ...)
  local ok, text = pcall(f, ...)
  return ok and type(text) == "string" and text or nil
end

local function has_text(value)
  local meta = debug.getmetatable(value)
  return type(meta) == "table" and rawget(meta, "__tostring") ~= nil
end

local brief_items = 8

--- Whether a table has more entries beyond its list than are worth sorting for one line.
local function is_huge(value)
  local left = 1000 + #value
  for _ in next, value do
    left = left - 1
    if left < 0 then return true end
  end
  return false
end

--- Items of a table within braces, no more than a few.
local function brief_table(value, depth)
  if depth > 2 then return "{ ... }" end
  local parts, listed = {}, 0
  for i = 1, math.min(#value, brief_items) do
    parts[i] = values.brief(rawget(value, i), depth + 1)
    listed = i
  end
  local more = #value > listed
  if not more and is_huge(value) then
    parts[#parts + 1] = "..."
  elseif not more then
    for key, item in pairs(value) do
      local in_list = type(key) == "number" and key >= 1 and key <= listed and key == math.floor(key)
      if not in_list then
        if #parts >= brief_items then more = true break end
        parts[#parts + 1] = key_text(key) .. " = " .. values.brief(item, depth + 1)
      end
    end
  end
  if more then parts[#parts + 1] = #value > listed and string.format("... %d items", #value) or "..." end
  return #parts == 0 and "{}" or "{ " .. table.concat(parts, ", ") .. " }"
end

--- One line for any value.
function values.brief(value, depth)
  local kind = type(value)
  if kind == "number" then return values.number(value) end
  if kind == "string" then return '"' .. screen.printable(screen.cut(value, 60)) .. '"' end
  if kind == "function" then return of_function(value) end
  if (kind == "table" or kind == "userdata") and has_text(value) then
    local text = safely(tostring, value) or "a " .. kind
    return screen.printable(screen.cut(text:match "^%s*([^\n]+)" or text, 200))
  end
  if kind == "table" then return safely(brief_table, value, depth or 0) or "a table" end
  return tostring(value)
end

-- Columns ---------------------------------------------------------------------------------------------------------------

local bars = { "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█" }
local plain_bars = { ".", ":", "-", "=", "+", "*", "#", "@" }

--- Counts of a list of numbers in `bins` equal intervals between the least and the greatest.
local function histogram(list, low, high, bins)
  local counts = {}
  for i = 1, bins do counts[i] = 0 end
  local scale = high > low and bins / (high - low) or 0
  for _, x in ipairs(list) do
    local i = math.min(bins, math.floor((x - low) * scale) + 1)
    counts[i] = counts[i] + 1
  end
  return counts
end

--- A row of little bars.
local function sparkline(counts)
  local most, out, set = math.max(1, unpack(counts)), {}, screen.unicode and bars or plain_bars
  for i, count in ipairs(counts) do out[i] = count == 0 and " " or set[math.max(1, math.ceil(count / most * #set))] end
  return table.concat(out)
end

local column_meta = { __metatable = "column" }

--- The column of a tissue as it is now: { name =, kind =, count =, min =, max =, mean =, values = list }.
function values.column(tissue, name, kind)
  kind = kind or "cell"
  local _, list = core.column_values(tissue, kind, name)
  return setmetatable({ name = name, kind = kind, count = #list, values = list,
    min = #list > 0 and core.min(tissue, kind, name) or nil, max = #list > 0 and core.max(tissue, kind, name) or nil,
    mean = #list > 0 and core.mean(tissue, kind, name) or nil }, column_meta)
end

function column_meta.__tostring(column)
  if column.count == 0 then return string.format("column %s: no %ss", column.name, column.kind) end
  local text = string.format("column %s: %d %ss, %s to %s, mean %s", column.name, column.count, column.kind, short(column.min),
    short(column.max), short(column.mean))
  if column.max == column.min then return text end
  local low, high = short(column.min), short(column.max)
  local bins = math.max(8, math.min(32, screen.width() - #low - #high - 5))
  return text .. "\n  " .. low .. " " .. sparkline(histogram(column.values, column.min, column.max, bins)) .. " " .. high
end

local function range_text(tissue, kind, name)
  local low, high = core.min(tissue, kind, name), core.max(tissue, kind, name)
  return low == high and short(low) or short(low) .. " to " .. short(high)
end

local function columns_line(tissue, kind)
  local parts, count = {}, tissue:count(kind)
  for _, name in ipairs((select(2, core.columns(tissue, kind)))) do
    parts[#parts + 1] = count > 0 and name .. " " .. range_text(tissue, kind, name) or name
  end
  return #parts > 0 and kind .. "s: " .. table.concat(parts, ", ") or nil
end

-- Whole objects ---------------------------------------------------------------------------------------------------------

--- The model that a tissue belongs to, or nil.
local function model_of(tissue)
  local module = loaded "model"
  for model, my in next, module and module.inside or {} do
    if my.tissue == tissue then return model end
  end
end

local function tissue_lines(tissue)
  local head, model = tostring(tissue), model_of(tissue)
  if tissue.has_geometry and #tissue > 0 then head = head .. ", area " .. short(core.sum(tissue, "cell", "area")) end
  if model then head = head .. ", time " .. values.time(model.time) end
  local lines = { head }
  for _, kind in ipairs { "cell", "wall", "side", "junction" } do
    local known, line = pcall(columns_line, tissue, kind)
    lines[#lines + 1] = known and line and "  " .. line or nil
  end
  return lines
end

local function solution_line(model)
  local known, solution = pcall(function() return model:solution() end)
  if not known then return nil end
  return "  method " .. solution.method .. (solution.dt and ", dt " .. values.number(solution.dt) or "") ..
    (solution.tolerance and ", tolerance " .. values.number(solution.tolerance) or "")
end

--- "derive sheet.lua:35, :36, rate :39"
local function rules_text(rules)
  local parts, before, what = {}, nil, nil
  for i, r in ipairs(rules) do
    local file, line = (r.where or ""):match "([^/]*):(%d+)$"
    local place = not file and r.where or file == before and ":" .. line or file .. ":" .. line
    parts[i] = (r.what ~= what and r.what .. " " or "") .. place .. (r.direct and " (interpreted)" or "")
    before, what = file, r.what
  end
  return table.concat(parts, ", ")
end

local function model_lines(model)
  local my = (loaded(values.kind(model)) or {}).inside[model]
  local ends = type(model.stop) == "number" and model.stop < 1e300
  local lines = { ends and tostring(model) .. " of " .. values.time(model.stop) or tostring(model) }
  lines[#lines + 1] = solution_line(model)
  if #my.rules > 0 then lines[#lines + 1] = "  rules: " .. rules_text(my.rules) end
  local reports = {}
  for _, r in ipairs(my.reports) do reports[#reports + 1] = r.name end
  if #reports > 0 then lines[#lines + 1] = "  reports: " .. table.concat(reports, ", ") end
  if my.params then
    local names = {}
    for name, value in pairs(my.params) do names[#names + 1] = name .. " = " .. values.brief(value) end
    lines[#lines + 1] = "  parameters: " .. table.concat(names, ", ")
  end
  return lines
end

--- name = value unit   meaning, in columns.
local function parameter_lines(P)
  local declared, lines, widest = loaded "params".declared(P), {}, 0
  local rows = {}
  for name, value in pairs(P) do
    local spec = declared[name]
    local text = name .. " = " .. values.brief(value) .. (spec.unit and " " .. spec.unit or "")
    rows[#rows + 1] = { text, spec.doc or "" }
    widest = math.max(widest, math.min(30, screen.length(text)))
  end
  for i, row in ipairs(rows) do
    local doc, room = row[2], screen.width() - widest - 2
    if room >= 16 then doc = screen.wrap(doc, room) or "" end
    for line in doc:gmatch "[^\n]+" do
      local left = lines[i] and "" or row[1]
      lines[i] = (lines[i] and lines[i] .. "\n" or "") .. left .. (" "):rep(widest - screen.length(left) + 2) ..
        screen.paint("dim", line)
    end
    lines[i] = lines[i] or row[1]
  end
  return lines
end

local function table_lines(value)
  local one = brief_table(value, 0)
  if screen.length(one) <= screen.width() and not one:find("...", 1, true) then return { one } end
  local lines, count, shown, most = {}, 0, 0, most_lines - 4
  for _ in next, value do count = count + 1 end
  local is_list = #value == count
  local function add(key, item)
    lines[#lines + 1] = "  " .. key_text(key) .. " = " .. values.brief(item, 1)
    shown = shown + 1
  end
  if is_list then
    for i = 1, math.min(count, most) do add(i, value[i]) end
  else
    for key, item in pairs(value) do
      if shown == most then break end
      add(key, item)
    end
  end
  table.insert(lines, 1, is_list and string.format("a list of %d items", count) or string.format("a table of %d entries", count))
  if shown < count then lines[#lines + 1] = string.format("  ... %d more", count - shown) end
  return lines
end

local function text_lines(text)
  if #text <= most_text and not text:find "\n" then return { '"' .. screen.printable(text) .. '"' } end
  local lines = {}
  for line in (text:sub(1, most_text) .. "\n"):gmatch "(.-)\n" do
    if #lines >= most_lines - 4 then break end
    lines[#lines + 1] = screen.printable(line)
  end
  lines[#lines + 1] = string.format("(text of %d bytes)", #text)
  return lines
end

local makers = { tissue = tissue_lines, model = model_lines, phyllotaxis = model_lines, parameters = parameter_lines }

--- Everything the prompt says of a value; lines are cut to the width of the screen, long lists of names are wrapped.
function values.show(value)
  local kind = values.kind(value)
  local lines, is_cut
  if makers[kind] then
    lines = makers[kind](value)
  elseif kind == "string" then lines = text_lines(value)
  elseif value == package.loaded.tunica then lines = { "the library: help \"tunica\" lists what it has" }
  elseif kind == "table" and not has_text(value) then lines, is_cut = table_lines(value), true
  elseif (kind == "table" or type(value) == "userdata") and has_text(value) then
    lines = {}
    for line in (tostring(value) .. "\n"):gmatch "(.-)\n" do lines[#lines + 1] = screen.printable(line) end
  else
    lines = { values.brief(value) }
    local command = kind == "function" and (lines[1]:match "^function ([%w_]+):")
    if command then lines[2] = string.format("%s() calls it; ?%s says what it can be given", command, command) end
  end
  local width = screen.width()
  for i, line in ipairs(lines) do
    if is_cut then
      lines[i] = screen.cut(line, width)
    elseif screen.length(line) > width and kind ~= "string" and kind ~= "parameters" then
      local indent = line:match "^%s*"
      lines[i] = indent .. screen.wrap(line, width - #indent, indent .. "  ")
    end
  end
  return table.concat(lines, "\n")
end

return values
