-- SPDX-License-Identifier: MIT
--- A solution that others are measured against: of two methods that know nothing of each other, at tight tolerances.

local core = require "tunica.core"
local study = require "tunica.chart.study"
local quantity = require "tunica.chart.quantity"

local reference = {}

local tightest = 1e-11       -- of what steps are controlled by; rounding is felt soon below
local well_agreed = 1e-9     -- no third method is asked
local halvings = 4           -- of rk4's step, should the average step of dp54 be too long somewhere

--- Runs a method and adds it to the witnesses, if it comes to the end. Returns false after an interruption.
local function ask(self, witnesses, solution, seconds)
  local setting = solution.dt and "dt " .. study.short(solution.dt) or "tolerance " .. study.short(solution.tolerance)
  study.progress(self, "reference: %s, %s", solution.method, setting)
  local run = study.try(self, solution, seconds)
  if not run then return false end
  local name = string.format("%s (%s)", solution.method, setting)
  if run.status ~= "done" then
    witnesses.failed[#witnesses.failed + 1] = string.format("%s: %s", name, run.detail)
    return true
  end
  witnesses[#witnesses + 1] = { name = name, method = solution.method, values = self.quantity.take(self.model), cost = run.cost }
  return true
end

local function has(witnesses, method)
  for _, witness in ipairs(witnesses) do
    if witness.method == method then return witness end
  end
end

--- How far the first of the witnesses is from the one that agrees best with it; who that is; whether by means.
local function agreement(witnesses)
  local least, who, by_means
  for i = 2, #witnesses do
    local error, means = quantity.compare(witnesses[i].values, witnesses[1].values)
    witnesses[i].differs = error or means
    if not least or (error or means) < least then least, who, by_means = error or means, witnesses[i].name, error == nil end
  end
  return least, who, by_means
end

--- Asks one method after the other until two agree well. Returns false after an interruption.
local function gather(self, witnesses, needed)
  local limit = self.options.seconds and 10 * self.options.seconds or 300
  if not ask(self, witnesses, { method = "dp54", tolerance = tightest }, limit) then return false end
  local first = has(witnesses, "dp54")
  local slow = first and math.min(limit, math.max(10, 20 * first.cost.seconds)) or limit
  local way = { implicit = true }
  if not study.obstacle(self, way) and not ask(self, witnesses, { method = "bdf", tolerance = tightest }, slow) then return false end
  if #witnesses == 2 and agreement(witnesses) <= math.min(well_agreed, needed / 10) then return true end
  if first then
    local dt = self.goal / first.cost.steps
    for _ = 1, halvings do
      dt = dt / 2
      if not ask(self, witnesses, { method = "rk4", dt = dt }, limit) then return false end
      if has(witnesses, "rk4") then break end
    end
  end
  if #witnesses < 2 then return ask(self, witnesses, { method = "rkc2", tolerance = 100 * tightest }, limit) end
  return true
end

local function sentence(witnesses)
  local list = {}
  for i = 2, #witnesses do list[#list + 1] = string.format("%s differs by %s", witnesses[i].name, study.short(witnesses[i].differs)) end
  for _, text in ipairs(witnesses.failed) do list[#list + 1] = text end
  return table.concat(list, "; ")
end

local file = "/reference.json"

--- Whether an earlier study in the folder has left its reference.
local function read(self)
  if not core.kind_of(self.folder .. file) then return false end
  local ok, saved = pcall(function() return core.decode(core.read_file(self.folder .. file)) end)
  if not ok or type(saved) ~= "table" or not saved.values or not saved.floor then return false end
  self.reference = saved
  return true
end

--- Errors: the best two witnesses are not as near as needed.
local function check(self, floor, about, needed)
  if floor <= needed then return end
  self.code = study.exit.numerical
  error(string.format("the reference does not converge: %s; they must agree to %s. Is the model chaotic by then, or does an event " ..
    "depend on the last bits? Try a smaller --until, a --quantity that is a mean, a larger --error; or compare patterns over " ..
    "many seeds: --score", about, study.short(needed)), 0)
end

--- Makes self.reference = { values, floor, by_means, about }, or reads it. `needed`: how near two methods must be, relative.
-- Returns false after an interruption. Errors: they do not agree.
function reference.make(self, needed)
  if read(self) then
    check(self, self.reference.floor, self.reference.about, needed)
    return true
  end
  local witnesses = { failed = {} }
  if not gather(self, witnesses, needed) then return false end
  if #witnesses < 2 then
    self.code = study.exit.numerical
    error("the reference does not converge: two methods are needed, but " .. table.concat(witnesses.failed, "; "), 0)
  end
  local floor, who, by_means = agreement(witnesses)
  local about = string.format("%s; %s", witnesses[1].name, sentence(witnesses))
  self.record.reference = { about = about, floor = floor, agrees_with = who, by_means = by_means }
  study.write_record(self)
  check(self, floor, about, needed)
  self.reference = { values = witnesses[1].values, floor = math.max(floor, 1e-15), by_means = by_means, about = about }
  core.write_atomic(self.folder .. file, core.encode(self.reference))
  return true
end

return reference
