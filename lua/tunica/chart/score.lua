-- SPDX-License-Identifier: MIT
--- `tunica chart --score`: which step or tolerance a pattern needs. Each setting is run on the same seeds, by the program's pool
-- (src/shell/score_chart.cpp), and its mean score held against that of the finest setting. The program asks `next` what is to be
-- run, and tells what came of it.

local core = require "tunica.core"
local study = require "tunica.chart.study"
local directory = require "tunica.run.directory"
local sample = require "tunica.chart.sample"
local report = require "tunica.chart.score_report"
require "tunica.chart.look"  -- once, and not in every run

local score = {}

local first_look = 2           -- seeds: whether they matter is seen before all are run
local finer, coarser = 4, 4    -- the finest and the coarsest step of simple methods, relative to what own_step() says
local coarsest = 64            -- of methods that take long steps in their stride
local fewest_steps = 8         -- in a run
local enough = 2               -- settings one after the other that keep the score: finer ones are not tried
local tolerances = { 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6 }
local patience = 3600          -- s for a run, as in a sweep
local times_the_finest = 50    -- that a run may take afterwards, and at least
local at_least = 10            -- s

-- Settings ---------------------------------------------------------------------------------------------------------

local function is_simple(way) return not way.implicit and not way.adaptive end

--- A step with two digits: 0.0057 says as much as 0.00565685, and can be remembered.
local function round(dt) return tonumber(string.format("%.2g", dt)) end

--- What a method makes of the model's own step: one that is stable farther takes longer ones, one that is as stable the same.
local function own_step(self, way)
  if not self.own.dt then return 10 ^ math.floor(math.log10(self.goal / 1000)) end
  local stability = {}
  for _, each in ipairs(core.methods_of_solution()) do stability[each.name] = each.stability end
  local own = stability[self.own.method] or 0
  if own == 0 or way.stability == 0 or way.stability == own then return self.own.dt end
  return round(self.own.dt * (way.stability / own))
end

--- The steps or tolerances of a method, coarse to fine.
local function ladder(self, way, by)
  local own = by == "dt" and self.options.steps or self.options.tolerances
  if #own > 0 then
    local list = { unpack(own) }
    table.sort(list, function(a, b) return a > b end)
    return list
  end
  if by == "tolerance" then return tolerances end
  local list, base = {}, own_step(self, way)
  local from = is_simple(way) and self.own.dt and coarser or coarsest
  local to = is_simple(way) and 1 / finer or 1
  local times = from
  while times >= to do
    if base * times <= self.goal / fewest_steps then list[#list + 1] = tonumber(core.shortest(base * times)) end
    times = times / 2
  end
  return list
end

--- The ways to solve that are to be tried, as { way =, by = }; implicit methods only if they are named.
local function series_of(self)
  local list = {}
  local named = #self.options.methods > 0
  for _, way in ipairs(self.methods) do
    if named or not way.implicit then
      local fixed, adaptive = not way.adaptive or way.either, way.adaptive
      -- Steps that are asked for, and no tolerances, are not asked of methods that choose their own; and the other way round.
      local only_steps = #self.options.steps > 0 and #self.options.tolerances == 0
      local only_tolerances = #self.options.tolerances > 0 and #self.options.steps == 0
      if fixed and not only_tolerances then list[#list + 1] = { way = way, by = "dt" } end
      if adaptive and not only_steps then list[#list + 1] = { way = way, by = "tolerance" } end
    end
  end
  if #list == 0 then study.refuse("none of these methods has what is asked for: steps (--dt) or tolerances (--tolerance)") end
  return list
end

--- The series whose finest setting all are held against: of the method named first, else of the model's own, else the first.
local function finest_series(self, list)
  local wanted = self.options.methods[1] or self.own.method
  local by = #self.options.methods == 0 and self.own.tolerance and "tolerance" or nil
  for _, s in ipairs(list) do
    if s.way.name == wanted and (not by or s.by == by) then return s end
  end
  for _, s in ipairs(list) do
    if s.way.name == wanted then return s end
  end
  return list[1]
end

--- Number of the combination in which every listed parameter is least.
local function finest_combination(self)
  local best, least = 1, nil
  for k, values in ipairs(self.options.combinations) do
    local better = least ~= nil
    local numbers = {}
    for i, p in ipairs(self.options.parameters) do
      numbers[i] = p.varies and tonumber(values[i]) or 0
      better = better and numbers[i] <= least[i]
    end
    if not least or better then best, least = k, numbers end
  end
  return best
end

--- What is listed: { { name =, text = }, ... } of a combination.
local function listed(self, combination)
  local list = {}
  for i, p in ipairs(self.options.parameters) do
    if p.varies then list[#list + 1] = { name = p.name, text = self.options.combinations[combination][i] } end
  end
  return list
end

-- Running ----------------------------------------------------------------------------------------------------------

local function limit(self)
  if self.options.seconds > 0 then return self.options.seconds end
  return self.reference and math.max(at_least, times_the_finest * self.reference.wall) or patience
end

--- Has a setting run on the first `seeds` seeds (all, unless given); its row. The program goes to work in between.
local function measure(self, combination, method, by, setting, seeds)
  local key = string.format("%d %s %s %s", combination, method, by, core.shortest(setting))
  local row = self.by_key[key]
  if row and not seeds then return row end
  row = { combination = combination, listed = listed(self, combination), method = method, by = by, setting = setting }
  local ask = { combination = tostring(combination), method = method, [by] = core.shortest(setting) }
  row.runs, self.asked = {}, row
  if not seeds then
    self.rows[#self.rows + 1], self.by_key[key] = row, row
  end
  coroutine.yield { ask, label = report.label(row), seeds = tostring(seeds or #self.options.seeds),
    seconds = tostring(limit(self)) }
  return row
end

--- Runs the finest setting; false if it cannot serve, which is then said.
local function make_reference(self, s, combination)
  local steps = ladder(self, s.way, s.by)
  local finest = steps[#steps]
  if not finest then study.refuse("no step of %s fits the time of %g; name some: --dt", s.way.name, self.goal) end
  local first = measure(self, combination, s.way.name, s.by, finest, first_look)
  if sample.alike(first.runs) then
    study.refuse("seeds change nothing in this model: two of them end in the same state. Without --score, " ..
      "`tunica chart` measures its error")
  end
  local row = measure(self, combination, s.way.name, s.by, finest)
  self.finest = row
  sample.judge(self, row, nil)
  if #row.failures > 0 or row.n < 2 then
    local f = row.failures[1] or { seed = self.options.seeds[1], why = "not run" }
    if f.how == sample.no_score then study.refuse("--score: %s (seed %d)", f.why, f.seed) end
    self.trouble = string.format("the finest setting, %s, fails itself on %d of %d seeds (seed %d: %s); name finer ones: --%s",
      report.label(row), #row.failures, #row.runs, f.seed, report.brief(f.why), s.by)
    self.code = study.exit.numerical
    return false
  end
  self.reference = sample.reference(self, row)
  study.note(self, "the finest: %s, %s %s +- %s over %d seeds", report.label(row), self.options.score, study.short(row.mean),
    study.short(row.error), row.n)
  return true
end

--- One method from coarse to fine, until `enough` settings have kept the score; then one step between the last that fails and
-- the first that does not.
local function run_series(self, s, combination)
  local good, before, between = 0, nil, nil
  local own = #self.options.steps + #self.options.tolerances > 0
  for _, setting in ipairs(ladder(self, s.way, s.by)) do
    local row = measure(self, combination, s.way.name, s.by, setting)
    good = row.keeps and good + 1 or 0
    if good == 1 and before and not before.keeps then between = round(math.sqrt(setting * before.setting)) end
    before = row
    if good >= enough and not own then break end
  end
  if between and s.by == "dt" and not own then measure(self, combination, s.way.name, s.by, between) end
end

local function all(self)
  local list = series_of(self)
  if not make_reference(self, finest_series(self, list), finest_combination(self)) then return end
  for combination in ipairs(self.options.combinations) do
    for _, s in ipairs(list) do run_series(self, s, combination) end
  end
  self.complete = true
end

-- What the program calls -------------------------------------------------------------------------------------------

--- Makes the folder, or goes on in one of an earlier chart of a score; the program looks whether its runs are of the same.
local function open_folder(self)
  local out = self.options.out
  if out and core.kind_of(out .. "/runs.db") then
    self.folder = out
    local free, why = directory.lock(out)
    if not free then study.refuse("%s", why) end
    return
  end
  local refusal = out and directory.refusal(out)
  if refusal then study.refuse("%s", refusal) end
  self.folder = directory.make(out, self.options.name .. "-chart", function(folder) directory.lock(folder) end)
end

--- begin(options) -> the chart. Errors: of the command line.
function score.begin(options)
  local self = { options = options, kind = "chart", code = study.exit.ok, rows = {}, by_key = {} }
  local about = core.decode(options.about)
  self.own = about.solution
  if not self.own then study.refuse("the model has no rates that a method integrates; there is nothing to chart") end
  self.goal = options.until_time or about.stop
  if not (self.goal > 0) then study.refuse("--until %g leaves no time to run", self.goal) end
  for _, p in ipairs(options.parameters) do
    if p.varies and (p.name == "dt" or p.name == "tolerance" or p.name == "method") then
      study.refuse("%s=...: the methods' own settings are options here: --methods a,b --dt .01,.02 --tolerance 1e-2,1e-3", p.name)
    end
  end
  study.choose_methods(self)
  series_of(self)
  open_folder(self)
  self.record = { identity = { kind = "chart --score" }, name = options.name, score = options.score,
    seeds = core.as_list(options.seeds), ["until"] = self.goal, versions = core.decode(options.versions),
    arguments = core.as_list(options.arguments) }
  self.course = coroutine.create(function() all(self) end)
  return self
end

--- next(chart) -> { { combination =, method =, dt = or tolerance = }, label =, seeds =, seconds = }, all as text; nil when all is
-- done.
function score.next(self)
  local ok, batch = coroutine.resume(self.course)
  if not ok then error(batch, 0) end
  return batch
end

--- tell(chart, { runs of the setting asked for }): see src/shell/score_chart.cpp for a run's fields.
function score.tell(self, told)
  local row = self.asked
  row.runs = sample.read(told[1], self.options.seeds)
  sample.judge(self, row, self.reference)
end

--- close(chart, stopped) -> exit code. Whatever happened, the runs that are there are kept and shown.
function score.close(self, stopped)
  if #self.rows > 0 then
    local ok, why = pcall(report.conclude, self)
    if not ok then
      study.complain(self, "%s", tostring(why))
      self.code = math.max(self.code, study.exit.files)
    end
  end
  if self.trouble then study.complain(self, "%s", self.trouble) end
  if stopped then study.note(self, "interrupted; to continue: the same command with --out %s", self.folder) end
  return self.code
end

return score
