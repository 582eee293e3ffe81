-- SPDX-License-Identifier: MIT
--- What a run of a chart of scores notes on its way, besides its report: how far its state goes, and which numbers of the report
-- count something. By that a run is told that comes to its end, but not as the finest ones do (tunica.chart.faults).

local core = require "tunica.core"
local outputs = require "tunica.run.outputs"

local look = {}

local looks = 60  -- in a run
local last = 6    -- of them: how much a column still changes

--- Puts the solution in place. Errors: the method needs derivatives that the rules do not give.
local function solve(model, solution)
  local own = { method = solution.method, dt = tonumber(solution.dt), tolerance = tonumber(solution.tolerance) }
  for _, way in ipairs(core.methods_of_solution()) do
    for _, rule in ipairs(way.name == own.method and way.implicit and model.about.rules or {}) do
      if not rule.traced then
        error(string.format("%s needs derivatives of the rules, and the %s rule of %s cannot be traced", own.method, rule.rule,
          rule.where), 0)
      end
    end
  end
  model:solve_with(own)
  return own
end

--- begin(model, solution, end) -> looks, as an output of tunica.run.outputs. `solution`: { method =, dt = or tolerance = } as
-- texts.
function look.begin(model, solution, goal)
  local self = { model = model, every = goal / looks, count = 0, columns = {}, counts = {}, begun = os.clock(), spent = 0 }
  self.solution = solve(model, solution)
  for i, column in ipairs(model:state_columns()) do
    self.columns[i] = { name = column.name, kind = column.kind, least = math.huge, greatest = -math.huge, moved = model.time,
      changes = {} }
  end
  self.write = function() look.take(self) end
  return self
end

--- Extremes of a column, and when it last changed.
local function note_column(self, column, time)
  local _, values = core.column_values(self.model.tissue, column.kind, column.name)
  local sum, weighted = 0, 0
  for i, value in ipairs(values) do
    if value < column.least then column.least, column.least_at = value, time end
    if value > column.greatest then column.greatest, column.greatest_at = value, time end
    sum, weighted = sum + value, weighted + i * value
  end
  if sum ~= column.sum or weighted ~= column.weighted then column.moved = time end
  local size = math.max(math.abs(sum), math.abs(column.sum or sum))
  table.insert(column.changes, size > 0 and math.abs(sum - (column.sum or sum)) / size or 0)
  if #column.changes > last then table.remove(column.changes, 1) end
  column.sum, column.weighted = sum, weighted
end

--- Whole numbers that never fall: when they rose last, and their longest pause so far.
local function note_count(counts, name, value, time)
  local c = counts[name]
  if not c then
    counts[name] = { whole = value == math.floor(value), rose = time, pause = 0, value = value, rises = 0 }
    return
  end
  c.whole = c.whole and value == math.floor(value) and value >= c.value
  if value ~= c.value then
    c.pause, c.rose, c.value, c.rises = math.max(c.pause, time - c.rose), time, value, c.rises + 1
  end
end

function look.take(self)
  local begun, time = os.clock(), self.model.time
  for _, column in ipairs(self.columns) do note_column(self, column, time) end
  for _, report in ipairs(outputs.reports(self.model)) do
    for _, pair in ipairs(outputs.flatten(report.name, report.value, {})) do
      if type(pair[2]) == "number" then note_count(self.counts, pair[1], pair[2], time) end
    end
  end
  self.spent = self.spent + os.clock() - begun
end

--- At the end of the run: what its result holds besides the report. Seconds are of the processor, from the model's start to its
-- end, without loading, and without the looks themselves.
function look.finish(self)
  look.take(self)
  local model, columns, counts = self.model, {}, {}
  if model:solution().method ~= self.solution.method then
    error(string.format("the model changes its method itself (to %s): methods cannot be compared", model:solution().method), 0)
  end
  local sums = {}
  for _, c in ipairs(self.columns) do
    sums[#sums + 1] = core.shortest(c.sum) .. " " .. core.shortest(c.weighted)
    columns[c.name] = { least = c.least, least_at = c.least_at, greatest = c.greatest, greatest_at = c.greatest_at,
      moved = c.moved, drift = math.max(0, unpack(c.changes)) }
  end
  for name, c in pairs(self.counts) do
    local pause = math.max(c.pause, model.time - c.rose)
    if c.whole then counts[name] = { value = c.value, rises = c.rises, rose = c.rose, pause = pause } end
  end
  local cost = model.cost
  return { columns = columns, counts = counts, ["end"] = table.concat(sums, ", "), evaluations = cost.evaluations,
    solver_seconds = cost.seconds, seconds = os.clock() - self.begun - self.spent }
end

return look
