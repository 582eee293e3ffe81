-- SPDX-License-Identifier: MIT
--- What runs are compared by: every column of state, one column, or a number that the model reports.

local core = require "tunica.core"

local quantity = {}

local function has(list, name)
  for _, other in ipairs(list) do
    if other == name then return true end
  end
  return false
end

--- Takes the values of columns, by identity.
local function columns_of(tissue, columns)
  local list = {}
  for i, column in ipairs(columns) do
    local ids, values = core.column_values(tissue, column.kind, column.name)
    list[i] = { name = column.name, kind = column.kind, ids = core.as_list(ids), values = core.as_list(values) }
  end
  return { columns = list }
end

--- The names by which a quantity can be asked for.
local function known_names(model, reports)
  local names, state = {}, {}
  for _, column in ipairs(model:state_columns()) do
    names[#names + 1] = column.name
    state[column.name] = column.kind
  end
  for _, name in ipairs((core.columns(model.tissue, "cell"))) do
    if not state[name] then
      names[#names + 1] = name
      state[name] = "cell"
    end
  end
  for name in pairs(reports) do names[#names + 1] = name end
  return names, state
end

--- choose(model, name or nil, default, refuse) -> { name =, take = function(model) -> values }. `default`: "state", or "first" for
-- the first column of state.
function quantity.choose(model, name, default, refuse)
  local state = model:state_columns()
  if #state == 0 then refuse("the model has no state: no rate or flux changes a column") end
  if not name and default == "state" then
    return { name = "state", take = function(m) return columns_of(m.tissue, state) end }
  end
  name = name or state[1].name
  local reports = {}
  if default == "state" then
    for _, report in ipairs(model.reports) do reports[report.name] = report.fn end
  end
  local names, kinds = known_names(model, reports)
  if not has(names, name) then
    refuse("--quantity: neither a column nor a report is called '%s'%s; there are: %s", name, core.did_you_mean(name, names),
      table.concat(names, ", "))
  end
  if kinds[name] then
    local column = { name = name, kind = kinds[name] }
    return { name = name, kind = kinds[name], take = function(m) return columns_of(m.tissue, { column }) end }
  end
  local fn = reports[name]
  if type(fn()) ~= "number" then refuse("--quantity: the report '%s' gives %s, no number", name, core.describe(fn())) end
  return { name = name, take = function() return { number = fn() } end }
end

local function mean(values)
  local sum = 0
  for _, value in ipairs(values) do sum = sum + value end
  return #values > 0 and sum / #values or 0
end

--- |a - b| / |b|, and |a - b| where b is 0.
local function relative(difference, size) return size > 0 and difference / size or difference end

--- ||a - b||_2 / ||b||_2 over elements of the same identity; nil if the sets of identities differ.
local function distance(a, b)
  if #a.ids ~= #b.ids then return nil end
  local at, difference, size = {}, 0, 0
  for i, id in ipairs(b.ids) do at[id] = b.values[i] end
  for i, id in ipairs(a.ids) do
    local other = at[id]
    if not other then return nil end
    difference, size = difference + (a.values[i] - other) ^ 2, size + other ^ 2
  end
  return relative(math.sqrt(difference), math.sqrt(size))
end

--- compare(values, reference) -> relative difference, nil; or, if other cells are there, nil and that of the means per cell.
-- Of several columns the largest counts.
function quantity.compare(a, b)
  if a.number then return relative(math.abs(a.number - b.number), math.abs(b.number)) end
  local most, means, same = 0, 0, true
  for i, column in ipairs(a.columns) do
    local d = distance(column, b.columns[i])
    same = same and d ~= nil
    most = math.max(most, d or 0)
    local other = mean(b.columns[i].values)
    means = math.max(means, relative(math.abs(mean(column.values) - other), math.abs(other)))
  end
  if same then return most, nil end
  return nil, means
end

--- The greatest absolute value in what was taken.
function quantity.size(values)
  local most = math.abs(values.number or 0)
  for _, column in ipairs(values.columns or {}) do
    for _, value in ipairs(column.values) do most = math.max(most, math.abs(value)) end
  end
  return most
end

return quantity
