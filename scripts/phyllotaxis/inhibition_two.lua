-- SPDX-License-Identifier: MIT
-- Two inhibitors (thesis 4.4, 4.5) on a cylinder: a long-range one, which primordia begin to send out only as they grow older, chooses
-- the place; a short-range one of the youngest permits it. With these values, from one primordium on: decussate.
-- change = 1.3 after 60 primordia leads to a spiral, change = 2 to bijugate (thesis fig. 4.10): the threshold then rises by this factor.
local tunica = require "tunica"

local P = tunica.params {
  long = { 1.1418, "threshold of the long-range inhibitor", unit = "1/length", min = 0 },
  b_long = { 0.398, "its decay with age", unit = "1/time", min = 0 },
  onset = { 0.632, "rate at which primordia begin to send it out", unit = "1/time", min = 0 },
  short = { 0.797, "threshold of the short-range inhibitor", unit = "1/length", min = 0 },
  b_short = { 5.635, "its decay with age", unit = "1/time", min = 0 },
  ramp = { 3.98, "time in which the long-range threshold rises from 0", unit = "time", min = 0 },
  samples = { 360, "places on the ring", min = 3 },
  change = { 1, "factor by which the long-range threshold changes after 60 primordia", min = 0 },
  count = { 200, "primordia in all", min = 2 },
  tie = { 1e-5, "fields nearer than this are equal", min = 0 },
}

local model = tunica.phyllotaxis {
  path = function(age) return 1, -age end,
  samples = P.samples, tie = P.tie, params = P, stop = { primordia = P.count },
}
local changed = math.huge  -- when the threshold begins to change
model:inhibition {
  field = function(d, age) return (1 - math.exp(-P.onset * age)) * math.exp(-P.b_long * age) / d end,
  below = function(t)
    local change = t < changed and 1 or 1 + (P.change - 1) * math.min(1, (t - changed) / 1.84)
    return P.long * math.min(1, t / P.ramp) * change
  end,
}
model:inhibition { field = function(d, age) return math.exp(-P.b_short * age) / d end, below = P.short }

model:after(60, function(t) changed = t end)

--- The pattern of numbers first to last.
local function pattern(first, last)
  if model.count < last then return nil end
  return model:pattern { first = first, last = last }
end
local function name(first, last)
  return function()
    local found = pattern(first, last)
    return found and string.format("%s, %.1f degrees", found.name, found.mean) or "not reached"
  end
end
model:report { start = name(21, 60), final = name(math.max(1, P.count - 79), P.count) }
model:view { from = "oblique", colour = "age" }

return model
