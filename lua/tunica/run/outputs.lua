-- SPDX-License-Identifier: MIT
--- What a run leaves behind on its way: frames of the views, rows of the time series. Both come at multiples of an
-- interval, counted and not added up, so that a resumed run meets the same times.

local core = require "tunica.core"

local outputs = {}

local function due_time(output)
  -- A step that ends a rounding error early still counts.
  return output.every * output.count - 1e-9 * output.every
end

--- The time of the next output, or nil.
function outputs.next_time(list)
  local first
  for _, output in ipairs(list) do
    if output.every then
      local time = output.every * output.count
      if not first or time < first then first = time end
    end
  end
  return first
end

--- Makes every output that is due at this time, and moves its count past it.
function outputs.emit(list, time)
  for _, output in ipairs(list) do
    if output.every and time >= due_time(output) then
      output.write(output.count)
      output.count = math.max(output.count + 1, math.floor(time / output.every + 1e-9) + 1)
    end
  end
end

--- Counts of all outputs, for a checkpoint; and back.
function outputs.counts(list)
  local counts = {}
  for i, output in ipairs(list) do counts[i] = { count = output.count, written = output.written } end
  return counts
end

function outputs.set_counts(list, counts)
  for i, output in ipairs(list) do
    if counts[i] then output.count, output.written = counts[i].count, counts[i].written end
  end
end

-- Reports ----------------------------------------------------------------------------------------------------------

--- A value as what JSON can hold; tables keep their named and numbered entries.
function outputs.plain(value, depth)
  local kind = type(value)
  if kind == "number" or kind == "boolean" or kind == "string" then return value end
  if kind ~= "table" or (depth or 0) > 8 then return tostring(value) end
  local copy, list = {}, #value > 0
  for key in pairs(value) do list = list and type(key) == "number" and key <= #value end
  for key, item in pairs(value) do copy[list and key or tostring(key)] = outputs.plain(item, (depth or 0) + 1) end
  return copy
end

local function reports_of(model)
  local list = {}
  for i, report in ipairs(model.reports or {}) do
    list[i] = { name = report.name, value = outputs.plain(report.fn()) }
  end
  return list
end

--- All reports of the model now: list of { name =, value = } in their order. Random numbers that they draw are those that come next
-- and come again afterwards: how often a run reports does not change it.
function outputs.reports(model)
  local random = core.random_state()
  local ok, list = pcall(reports_of, model)
  core.random_state(random)
  if not ok then error(list, 0) end
  return list
end

--- How large the model is, and what that counts: cells, or primordia.
function outputs.size(model)
  local ok, tissue = pcall(function() return model.tissue end)
  if ok and tissue then return tissue:count(), "cells" end
  return model.count, "primordia"
end

--- Whether one of the reports has this name.
function outputs.has(reports, name)
  for _, report in ipairs(reports) do
    if report.name == name then return true end
  end
  return false
end

--- Adds { name, scalar } for a value and, with dotted names, for what is inside it.
function outputs.flatten(name, value, out)
  if type(value) == "table" then
    for key, item in pairs(value) do outputs.flatten(name .. "." .. key, item, out) end
  else
    out[#out + 1] = { name, value }
  end
  return out
end

--- A scalar with every digit that matters.
function outputs.text(value)
  return type(value) == "number" and core.shortest(value) or tostring(value)
end

-- Series -----------------------------------------------------------------------------------------------------------

local function csv_field(value)
  if value == nil then return "" end
  local text = outputs.text(value)
  return text:find '[",\n\r]' and '"' .. text:gsub('"', '""') .. '"' or text
end

local Series = {}
Series.__index = Series

--- Rows of time, size and every report, in memory and, now and then, in <folder>/series.csv.
function outputs.series(folder, header) return setmetatable({ folder = folder, lines = { header } }, Series) end

--- Adds a row; the first one settles the columns.
function Series:add(time, size, unit, reports)
  local values, names = { [unit] = size }, outputs.has(reports, unit) and {} or { unit }
  for _, report in ipairs(reports) do
    for _, pair in ipairs(outputs.flatten(report.name, report.value, {})) do
      names[#names + 1], values[pair[1]] = pair[1], pair[2]
    end
  end
  if not self.columns then
    self.columns = names
    local fields = { "time" }
    for _, name in ipairs(names) do fields[#fields + 1] = csv_field(name) end
    self.lines[#self.lines + 1] = table.concat(fields, ",")
  end
  local fields = { outputs.text(time) }
  for _, name in ipairs(self.columns) do fields[#fields + 1] = csv_field(values[name]) end
  self.lines[#self.lines + 1] = table.concat(fields, ",")
  self.last, self.changed = time, true
end

--- Rewrites the file, at most so often that it costs a twentieth of the run; `force` writes in any case.
function Series:flush(force)
  local now = core.now()
  if not self.changed or not force and now < (self.next_flush or 0) then return end
  core.write_atomic(self.folder .. "/series.csv", table.concat(self.lines, "\n") .. "\n")
  self.changed = false
  self.next_flush = now + math.max(2, 20 * (core.now() - now))
end

--- What a checkpoint needs to continue it, cheap: lines are only ever added. And back from the text of so many lines.
function Series:mark() return { count = #self.lines, last = self.last, columns = self.columns } end

function Series:text(mark) return table.concat(self.lines, "\n", 1, mark.count) end

function Series:restore(mark, text)
  self.lines, self.last, self.columns = {}, mark.last, mark.columns
  for line in (text .. "\n"):gmatch "(.-)\n" do self.lines[#self.lines + 1] = line end
  self.changed = true
end

return outputs
