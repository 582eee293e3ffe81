-- SPDX-License-Identifier: MIT
--- The rows of a chart: one for each method and setting; their file, which of them no other beats, what they say.

local core = require "tunica.core"
local study = require "tunica.chart.study"

local rows = {}

-- A row is a table by these names; `by` is "dt" or "tolerance". Numbers, but for method, by, failure, detail.
local fields = { "method", "by", "setting", "error", "means", "seconds", "spread", "repeats", "evaluations", "steps", "rejected",
  "jacobians", "factorizations", "newton_iterations", "linear_iterations", "failure", "detail", "wall", "front" }
local texts = { method = true, by = true, failure = true, detail = true }
local header = "method,setting of,setting,error,error of means,CPU seconds,spread of seconds,repeats,evaluations,steps,rejected,jacobians," ..
  "factorizations,newton iterations,linear iterations,failure,detail,seconds of the clock,front"
local cells_differ = "cells differ"

function rows.key(method, by, setting) return string.format("%s %s %s", method, by, core.shortest(setting)) end

--- What runs in the same series have in common: rkc2 can take fixed steps or choose them.
function rows.label(method, by) return method .. (method == "rkc2" and by == "dt" and " fixed" or "") end

local function text_of(row, name)
  local value = row[name]
  if name == "error" and not value and row.means then return cells_differ end
  if value == nil or value == false then return "" end
  if value == true then return "1" end
  if type(value) == "number" then return core.shortest(value) end
  return (value:gsub('[,"%c]', ";"))
end

--- Writes all rows; each time, so that none is lost and the front is always that of the rows there.
function rows.write(list, path)
  local lines = { header }
  for _, row in ipairs(list) do
    local line = {}
    for i, name in ipairs(fields) do line[i] = text_of(row, name) end
    lines[#lines + 1] = table.concat(line, ",")
  end
  core.write_atomic(path, table.concat(lines, "\n") .. "\n")
end

--- The rows of a file, in order and by key; none if there is no file. Lines that are damaged are left out.
function rows.read(path)
  local list = {}
  if not core.kind_of(path) then return list end
  local first = true
  for line in core.read_file(path):gmatch "([^\n]+)" do
    local row, i = {}, 0
    for text in (line .. ","):gmatch "(.-)," do
      i = i + 1
      local name = fields[i]
      if name and text ~= "" then row[name] = texts[name] and text or tonumber(text) end
    end
    row.front = nil
    if not first and row.method and row.setting and row.seconds then list[#list + 1] = row end
    first = false
  end
  return list
end

--- The error that counts; nil if there is none.
function rows.error_of(row) return not row.failure and row.error or nil end

--- Marks the rows that no other beats: less error than every cheaper one. Below the floor errors say nothing.
function rows.mark_front(list, floor)
  local sorted = {}
  for _, row in ipairs(list) do
    row.front = nil
    if rows.error_of(row) then sorted[#sorted + 1] = row end
  end
  table.sort(sorted, function(a, b)
    if a.seconds ~= b.seconds then return a.seconds < b.seconds end
    return rows.key(a.method, a.by, a.setting) < rows.key(b.method, b.by, b.setting)
  end)
  local least = math.huge
  for _, row in ipairs(sorted) do
    local error = math.max(row.error, floor)
    if error < least then row.front, least = true, error end
  end
end

--- The rows in the order of the kernel's methods, coarse settings first.
function rows.sorted(list)
  local rank, sorted = {}, {}
  for i, way in ipairs(core.methods_of_solution()) do rank[way.name] = i end
  for i, row in ipairs(list) do sorted[i] = row end
  table.sort(sorted, function(a, b)
    if a.method ~= b.method then return (rank[a.method] or 0) < (rank[b.method] or 0) end
    if a.by ~= b.by then return a.by < b.by end
    return a.setting > b.setting
  end)
  return sorted
end

-- Saying it --------------------------------------------------------------------------------------------------------

local function setting_text(row) return string.format("%s %s", row.by == "dt" and "dt" or "tol", study.short(row.setting)) end

--- Rows for a table, sorted; of those that failed only the finest above the ones that worked.
local function to_print(list)
  local series, order = {}, {}
  for _, row in ipairs(rows.sorted(list)) do
    local label = rows.label(row.method, row.by)
    if not series[label] then
      series[label] = {}
      order[#order + 1] = label
    end
    table.insert(series[label], row)
  end
  local shown = {}
  for _, label in ipairs(order) do
    local worked = false
    for i, row in ipairs(series[label]) do
      local next_row = series[label][i + 1]
      worked = worked or not row.failure
      if worked or not next_row or not next_row.failure then shown[#shown + 1] = row end
    end
  end
  return shown
end

--- The table on standard output.
function rows.table(list, floor)
  local lines = { { "", "method", "setting", "error", "seconds", "+", "evaluations", "steps", "rejected", "jacobians", "factors", "linear" } }
  for _, row in ipairs(to_print(list)) do
    local error = row.failure or row.error and (row.error <= floor and "<= " .. study.short(floor) or study.short(row.error))
      or string.format("%s (means: %s)", cells_differ, study.short(row.means))
    lines[#lines + 1] = { row.front and "*" or "", rows.label(row.method, row.by), setting_text(row), error, study.short(row.seconds),
      row.repeats > 1 and study.short(row.spread) or "", string.format("%.0f", row.evaluations), string.format("%.0f", row.steps),
      string.format("%.0f", row.rejected), string.format("%.0f", row.jacobians), string.format("%.0f", row.factorizations),
      string.format("%.0f", row.linear_iterations) }
  end
  return study.columns(lines, { false, false, false, false, true, true, true, true, true, true, true, true })
end

--- The cheapest row with an error at or below `wanted`, or nil.
function rows.cheapest(list, wanted)
  local best
  for _, row in ipairs(list) do
    local error = rows.error_of(row)
    if error and error <= wanted and (not best or row.seconds < best.seconds) then best = row end
  end
  return best
end

--- What euler costs at an error: between two of its rows; at its largest step that works, if that has less error already; or,
-- beyond its rows, by order 1. Returns seconds and how they were found; nil if euler has no row.
local function euler_at(list, wanted)
  local above, below, finest
  for _, row in ipairs(list) do
    local error = row.method == "euler" and rows.error_of(row)
    if error and error <= wanted and (not below or row.setting > below.setting) then below = row end
    if error and error > wanted and (not above or row.setting < above.setting) then above = row end
    if error and (not finest or row.setting < finest.setting) then finest = row end
  end
  if not finest then return nil end
  if below and above and below.setting < above.setting then
    local share = math.log(wanted / above.error) / math.log(below.error / above.error)
    return above.seconds * (below.seconds / above.seconds) ^ share, "interpolated between its rows"
  end
  if below then return below.seconds, "its largest step that works" end
  return finest.seconds * finest.error / wanted, string.format("extrapolated at order 1 from dt %s", study.short(finest.setting))
end

--- Which row to take for an error, in words and as a table for the record; nil if none comes so far.
function rows.recommend(list, wanted)
  local best = rows.cheapest(list, wanted)
  if not best then return string.format("No run came to an error of %s.\n", study.short(wanted)) end
  local label = rows.label(best.method, best.by)
  local text = string.format("For an error of %s: %s, %s %s: error %s in %s s.", study.short(wanted), label, best.by,
    study.short(best.setting), study.short(best.error), study.short(best.seconds))
  local found = { method = best.method, [best.by] = best.setting, error = best.error, seconds = best.seconds, wanted = wanted }
  local seconds, how = euler_at(list, wanted)
  if best.method == "euler" then
    text = text .. " No other method is cheaper."
    found.euler_seconds, found.times_faster = best.seconds, 1
  elseif seconds then
    text = text .. string.format(" euler: %s s (%s), %s times as long.", study.short(seconds), how, study.short(seconds / best.seconds))
    found.euler_seconds, found.euler_found, found.times_faster = seconds, how, seconds / best.seconds
  else
    text = text .. " euler has no row to compare with."
  end
  return text .. "\n", found
end

return rows
