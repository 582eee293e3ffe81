-- SPDX-License-Identifier: MIT
--- Runs that come to their end, but not as the finest ones do: their state has gone where no fine run goes, or no longer
-- changes, or what they count has stopped.

local study = require "tunica.chart.study"

local faults = {}

local below_zero = 0.01   -- of the greatest value: more than that below zero is no rounding, nor within a tolerance
local beyond = 10         -- times the greatest value of the finest runs
local longer = 2          -- times the longest pause in any of the finest runs
local at_rest = 1e-3      -- what changes by less towards the end, of its sum between two looks, may as well stand still

--- What the finest runs do, all seeds together: columns -> least, greatest, how long before the end they still change; counts ->
-- longest pause. Counts that do not rise in every one of them are left out.
function faults.measure(courses, goal)
  local self = { columns = {}, counts = {}, goal = goal }
  for n, course in ipairs(courses) do
    for name, c in pairs(course.columns) do
      local all = self.columns[name] or { least = math.huge, greatest = -math.huge, still = 0, drift = math.huge }
      all.least, all.greatest = math.min(all.least, c.least), math.max(all.greatest, c.greatest)
      all.still, all.drift = math.max(all.still, goal - c.moved), math.min(all.drift, c.drift or 0)
      self.columns[name] = all
    end
    for name, c in pairs(course.counts) do
      local all = self.counts[name] or { pause = 0, runs = 0, value = 0 }
      if all.runs == n - 1 and c.rises > 1 then
        all.runs, all.pause, all.value = n, math.max(all.pause, c.pause), all.value + c.value
      end
      self.counts[name] = all
    end
  end
  for name, all in pairs(self.counts) do
    if all.runs < #courses then self.counts[name] = nil else all.value = all.value / all.runs end
  end
  return self
end

local function at(time) return "t = " .. study.short(time) end

--- Why a column is not what the finest runs have, and when; nil if it is.
local function of_column(self, name, c)
  local all = self.columns[name]
  if not all then return nil end
  local size = math.max(math.abs(all.least), math.abs(all.greatest))
  if all.least >= 0 and c.least < -below_zero * size then
    return string.format("%s falls to %s (%s)", name, study.short(c.least), at(c.least_at)), c.least_at
  end
  for _, extreme in ipairs { "greatest", "least" } do
    if math.abs(c[extreme]) > beyond * size then
      return string.format("%s comes to %s (%s; in the finest runs no further than %s)", name, study.short(c[extreme]),
        at(c[extreme .. "_at"]), study.short(size)), c[extreme .. "_at"]
    end
  end
  if all.drift > at_rest and self.goal - c.moved > math.max(longer * all.still, 0.1 * self.goal) then
    return string.format("%s does not change any more after %s", name, at(c.moved)), c.moved
  end
end

--- What is wrong with a run that came to its end, since when, and in few words; nil if nothing is. The pattern comes first.
function faults.of(self, course)
  local list, first, words = {}, math.huge, nil
  local function add(why, time, brief) list[#list + 1], first, words = why, math.min(first, time), words or brief end
  for name, all in pairs(self.counts) do
    local c = course.counts[name]
    if c and self.goal - c.rose > longer * all.pause then
      add(string.format("no more %s after %s: %s by the end, in the finest runs %s", name, at(c.rose), study.short(c.value),
        study.short(all.value)), c.rose, "no more " .. name)
    end
  end
  for name, c in pairs(course.columns) do
    local why, time = of_column(self, name, c)
    if why then add(why, time, name .. " gone wrong") end
  end
  if #list > 0 then return table.concat(list, "; "), first, words end
end

return faults
