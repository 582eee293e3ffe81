-- SPDX-License-Identifier: MIT
--- `tunica chart`: what every method's error costs, and which method to take. share/doc/methods.md says how to read it.

local core = require "tunica.core"
local study = require "tunica.chart.study"
local reference = require "tunica.chart.reference"
local quantity = require "tunica.chart.quantity"
local rows = require "tunica.chart.rows"
local picture = require "tunica.chart.picture"

local chart = {}

local short_run = 0.2          -- s; shorter ones are repeated
local patience = 60            -- s for one run, before any has come to the error asked for
local times_the_cheapest = 50  -- that a run may cost afterwards, and at least
local at_least = 2             -- s
local first_doubling, last_halving = 7, 40

--- begin(model, options) -> the chart. Errors: of the command line.
function chart.begin(model, options)
  local self = study.begin(model, options, "chart", "state")
  self.path = self.folder .. "/chart.csv"
  self.rows, self.by_key = rows.read(self.path), {}
  for _, row in ipairs(self.rows) do self.by_key[rows.key(row.method, row.by, row.setting)] = row end
  self.left_out = {}
  return self, study.exit.ok
end

-- Runs -------------------------------------------------------------------------------------------------------------

--- Most seconds that one run may take now.
local function limit(self)
  if self.options.seconds then return self.options.seconds end
  local best = rows.cheapest(self.rows, self.options.error)
  return best and math.max(at_least, times_the_cheapest * best.seconds) or patience
end

--- Runs a setting, again if it is short; its row, or nil after an interruption. The least time counts: others were disturbed.
local function measure(self, method, by, setting)
  local row, longest, spent
  local solution = { method = method, [by] = setting }
  local seconds = limit(self)
  for n = 1, self.options.repeats do
    local run = study.try(self, solution, seconds)
    if not run then return nil end
    local cost = run.cost
    if n == 1 then
      row = { method = method, by = by, setting = setting, seconds = cost.seconds, failure = run.failure, detail = run.detail }
      for _, name in ipairs { "evaluations", "steps", "rejected", "jacobians", "factorizations", "newton_iterations", "linear_iterations" } do
        row[name] = cost[name]
      end
      if run.status == "done" then row.error, row.means = quantity.compare(self.quantity.take(self.model), self.reference.values) end
      if (row.error or 0) >= 1 then
        row.failure, row.detail = "no digit right", string.format("error %s", study.short(row.error))
      end
      if self.reference.by_means then row.error = row.error or row.means end
      longest, spent, row.wall = cost.seconds, 0, run.wall
    end
    row.seconds, longest = math.min(row.seconds, cost.seconds), math.max(longest, cost.seconds)
    row.repeats, row.spread, spent = n, longest - row.seconds, spent + run.wall
    if row.failure or row.seconds >= short_run or spent > 1 then break end
  end
  return row
end

--- Adds a row and writes all.
local function add(self, row)
  local key = rows.key(row.method, row.by, row.setting)
  if self.by_key[key] then
    for i, other in ipairs(self.rows) do
      if other == self.by_key[key] then self.rows[i] = row end
    end
  else
    self.rows[#self.rows + 1] = row
  end
  self.by_key[key] = row
  rows.mark_front(self.rows, self.reference.floor)
  rows.write(self.rows, self.path)
end

--- Whether a row says that a run was out of time when it had clearly less than it would get now.
local function had_less_time(self, row)
  local had = row.failure == "out of time" and tonumber((row.detail or ""):match "^%S+")
  return had and 1.4 * had < limit(self)
end

--- The row of a setting: read, or run.
local function row_of(self, method, by, setting)
  local old = self.by_key[rows.key(method, by, setting)]
  if old and not had_less_time(self, old) then
    self.skipped = (self.skipped or 0) + 1
    return old
  end
  study.progress(self, "%d rows; %s, %s %s", #self.rows, method, by, study.short(setting))
  local row = measure(self, method, by, setting)
  if row then
    add(self, row)
    self.fresh = (self.fresh or 0) + 1
  end
  return row
end

-- Series -----------------------------------------------------------------------------------------------------------

--- Settings from coarse to fine: steps halved, beginning so coarse that most methods fail; tolerances by decades.
local function settings(self, by)
  local list = {}
  if by == "tolerance" then
    for decade = 1, 10 do list[decade] = tonumber("1e-" .. decade) end
    return list
  end
  local base = study.base_step(self)
  for power = first_doubling, -last_halving, -1 do
    local dt = base * 2 ^ power
    if dt <= self.goal / 2 then list[#list + 1] = dt end
  end
  return list
end

--- Runs one method from coarse to fine until its error is at the floor, no longer falls, or the next run would cost too much.
-- Returns false after an interruption.
local function run_series(self, method, by)
  local before, stuck, failed
  for _, setting in ipairs(settings(self, by)) do
    local row = row_of(self, method, by, setting)
    if not row then return false end
    if row.failure == "out of time" then return true end
    if row.failure then
      failed = (failed or 0) + 1
      if before or failed > 20 then return true end  -- after some that worked, or far below any sensible step
    else
      local error = row.error or row.means
      stuck = before and error > 0.8 * before and (stuck or 0) + 1 or 0
      if error <= 2 * self.reference.floor or stuck >= 4 then return true end
      if by == "dt" and 2 * math.max(row.seconds, row.wall or 0) > limit(self) then return true end
      before = error
    end
  end
  return true
end

--- The series of all methods; those that choose their steps first, since they come to small errors soonest and so tell what
-- the others may cost.
local function all_series(self)
  local list = {}
  for pass = 1, 2 do
    for _, way in ipairs(self.methods) do
      if pass == 1 and way.adaptive and not way.implicit then list[#list + 1] = { way, "tolerance" } end
      if pass == 2 and way.adaptive and way.implicit then list[#list + 1] = { way, "tolerance" } end
      if pass == 2 and (not way.adaptive or way.either) then list[#list + 1] = { way, "dt" } end
    end
  end
  return list
end

--- Makes the reference and every row. Returns when all is there or after an interruption.
function chart.loop(self)
  if not reference.make(self, self.options.error / 10) then return end
  local floor = self.reference.floor
  study.note(self, "reference: %s; errors below %s say nothing", self.reference.about, study.short(floor))
  if self.reference.by_means then
    study.note(self, "the two references have different cells: errors are of the means per cell (%s)", self.quantity.name)
  end
  for _, series in ipairs(all_series(self)) do
    local way, by = series[1], series[2]
    local why = study.obstacle(self, way)
    if why then
      self.left_out[way.name] = why
      study.note(self, "%s is left out: %s", way.name, why)
    elseif not run_series(self, way.name, by) then
      return
    end
  end
  self.complete = true
end

-- The end ----------------------------------------------------------------------------------------------------------

local function show(self)
  local ok, png = pcall(core.read_file, self.folder .. "/chart.png")
  local text = ok and core.terminal_picture(png)
  if text then study.print(self, text) end
end

local function conclude(self)
  local floor = self.reference.floor
  rows.mark_front(self.rows, floor)
  rows.write(self.rows, self.path)
  local drawn, why = picture.chart(self)
  if drawn and self.complete then show(self) end
  study.print(self, rows.table(self.rows, floor))
  if self.skipped then study.note(self, "%d rows were there already, %d are new", self.skipped, self.fresh or 0) end
  local text, found = rows.recommend(self.rows, self.options.error)
  study.print(self, "* no other run is both cheaper and nearer\n" .. text)
  self.record.recommended, self.record.left_out, self.record.complete = found, self.left_out, self.complete or false
  study.write_record(self)
  if not drawn then study.note(self, "no pictures: %s", why) end
  study.print(self, "directory  " .. self.folder .. "\n")
end

--- close(chart, message, code) -> exit code. Whatever happened, the rows that are there are kept and shown.
function chart.close(self, message, code)
  return study.close(self, message, code, self.reference and #self.rows > 0 and conclude)
end

return chart
