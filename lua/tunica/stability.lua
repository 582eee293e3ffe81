-- SPDX-License-Identifier: MIT
--- `tunica stability`: the largest step of every method that stays bounded, and that keeps the pattern.

local core = require "tunica.core"
local study = require "tunica.chart.study"
local reference = require "tunica.chart.reference"
local quantity = require "tunica.chart.quantity"
local pattern = require "tunica.chart.pattern"
local trials = require "tunica.chart.trials"

local stability = {}

local precision = { dt = 1.01, tolerance = 2 }  -- ratio of the last two tried
local stride = { dt = 2, tolerance = 10 }       -- of the search before
local needed = 0.01                             -- how near two references must be; the pattern is coarser
local most_strides = 20
local fewest_steps = 10                         -- a longer step is not tried: instability could not show
local too_large = 100                           -- times the greatest value at the start and the end: no longer bounded

--- begin(model, options) -> the study. Errors: of the command line.
function stability.begin(model, options)
  local self = study.begin(model, options, "stability", "first")
  if self.quantity.kind ~= "cell" then study.refuse("--quantity: '%s' is no column of cells; the pattern is one of cells", self.quantity.name) end
  local take = self.quantity.take
  self.quantity.take = function(m)
    local values = take(m)
    values.maxima = pattern.maxima(m.tissue, self.quantity.name)
    return values
  end
  self.trials = trials.read(self.folder .. "/trials.csv")
  self.results = {}
  return self, study.exit.ok
end

-- Trials -----------------------------------------------------------------------------------------------------------

--- One run: { bounded =, pattern =, why = }, from the file if it is there; nil after an interruption.
local function try(self, method, by, setting)
  local known = trials.find(self.trials, method, by, setting)
  if known then return known end
  study.progress(self, "%s, %s %s", method, by, study.short(setting))
  local run = study.try(self, { method = method, [by] = setting }, self.options.seconds or 120)
  if not run then return nil end
  local trial = { method = method, by = by, setting = setting, bounded = run.status == "done", pattern = false, why = run.failure }
  if run.failure and run.time then trial.why = string.format("%s at t = %s", run.failure, study.short(run.time)) end
  local size = trial.bounded and quantity.size(self.quantity.take(self.model)) or 0
  if size > too_large * self.size then
    trial.bounded, trial.why = false, string.format("%s is %s times what it should be", self.quantity.name, study.short(size / self.size))
  end
  local index, alternates = self.model.tissue:checkerboard(self.quantity.name)  -- after a failure, of the last good state
  if alternates then
    trial.why = (trial.why and trial.why .. "; " or "") .. string.format("checkerboard (index %.2f)", index)
  elseif trial.bounded then
    trial.why = pattern.difference(self.model.tissue, pattern.maxima(self.model.tissue, self.quantity.name), self.reference.values.maxima)
    trial.pattern = trial.why == nil
  end
  trials.add(self.trials, trial)
  return trial
end

--- The largest setting that has `what` ("bounded" or "pattern"), by strides from `first` and then bisection of the logarithm.
-- Returns true and { value =, why = what is wrong just above, open = nothing was wrong up to the most tried }; false after an
-- interruption.
local function largest(self, method, by, what, first, most)
  local low, high, why
  local setting = math.min(first, most)
  for _ = 1, most_strides do
    local trial = try(self, method, by, setting)
    if not trial then return false end
    if trial[what] then low = setting else high, why = setting, trial.why end
    if low and (high or setting >= most) then break end
    setting = low and math.min(setting * stride[by], most) or setting / stride[by]
  end
  if not low then return true, { why = why } end
  if not high then return true, { value = low, open = true } end
  while high / low > precision[by] do
    local middle = math.sqrt(low * high)
    local trial = try(self, method, by, middle)
    if not trial then return false end
    if trial[what] then low = middle else high, why = middle, trial.why end
  end
  return true, { value = low, why = why }
end

--- The larger of the spectral radii at the start and at the end of the reference, where the model now is.
local function radius(self)
  if self.old and self.old.spectral_radius then return self.old.spectral_radius end
  local ok, at_end = pcall(self.model.spectral_radius, self.model)
  self.model:restore(self.start)
  local ok_too, at_start = pcall(self.model.spectral_radius, self.model)
  local largest_one = math.max(ok and at_end or 0, ok_too and at_start or 0)
  return largest_one > 0 and largest_one < math.huge and largest_one or nil
end

--- The limits of one method as a result. Returns false after an interruption.
local function judge(self, way, by)
  local label = way.name .. (way.either and by == "dt" and " fixed" or "")
  local result = { label = label, method = way.name, by = by }
  local first = by == "dt" and study.base_step(self) or 1e-3
  local most = by == "dt" and self.goal / fewest_steps or 1
  local went
  if by == "dt" then
    went, result.bounded = largest(self, way.name, by, "bounded", first, most)
    if not went then return false end
    first = result.bounded.value or first
    local trial = try(self, way.name, by, first)
    if not trial then return false end
    if trial.pattern then result.pattern = result.bounded end
  end
  if not result.pattern then
    went, result.pattern = largest(self, way.name, by, "pattern", first, most)
    if not went then return false end
  end
  result.theory = by == "dt" and self.radius and way.stability > 0 and way.stability / self.radius or nil
  self.results[#self.results + 1] = result
  trials.write_results(self)
  return true
end

--- Makes the reference and finds every limit. Returns when all is done or after an interruption.
function stability.loop(self)
  if not reference.make(self, needed) then return end
  self.radius = radius(self)
  self.model:restore(self.start)
  self.size = math.max(quantity.size(self.quantity.take(self.model)), quantity.size(self.reference.values))
  self.record.spectral_radius = self.radius
  local count = #self.reference.values.maxima
  study.note(self, "reference: %s; %d maxima of %s", self.reference.about, count, self.quantity.name)
  study.write_record(self)
  for _, by in ipairs { "dt", "tolerance" } do
    for _, way in ipairs(self.methods) do
      local why = study.obstacle(self, way)
      if why and by == "dt" then study.note(self, "%s is left out: %s", way.name, why) end
      local takes = by == "dt" and (not way.adaptive or way.either) or by == "tolerance" and way.adaptive
      if takes and not why and not judge(self, way, by) then return end
    end
  end
  self.complete = true
end

-- The end ----------------------------------------------------------------------------------------------------------

local function conclude(self)
  local picture = require "tunica.chart.bars"
  study.print(self, trials.table(self))
  local drawn, why = picture.draw(self)
  if drawn and self.complete then
    local text = core.terminal_picture(core.read_file(self.folder .. "/stability.png"))
    if text then study.print(self, text) end
  end
  if not drawn then study.note(self, "no pictures: %s", why) end
  self.record.complete = self.complete or false
  study.write_record(self)
  study.print(self, "directory  " .. self.folder .. "\n")
end

--- close(study, message, code) -> exit code. Whatever happened, the trials that were made are kept.
function stability.close(self, message, code)
  return study.close(self, message, code, #self.results > 0 and conclude)
end

return stability
