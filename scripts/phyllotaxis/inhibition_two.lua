-- SPDX-License-Identifier: MIT
-- Two inhibitors (thesis 4.4, 4.5) on a cylinder: a long-range one, which primordia begin to send out only as they grow older, chooses
-- the place; a short-range one of the youngest permits it. With these values, from one primordium on: decussate.
local tunica = require "tunica"

local P = tunica.params {
  long = { 1.1418, "threshold of the long-range inhibitor", unit = "1/length", min = 0 },
  b_long = { 0.398, "its decay with age", unit = "1/time", min = 0 },
  onset = { 0.632, "rate at which primordia begin to send it out", unit = "1/time", min = 0 },
  short = { 0.797, "threshold of the short-range inhibitor", unit = "1/length", min = 0 },
  b_short = { 5.635, "its decay with age", unit = "1/time", min = 0 },
  ramp = { 3.98, "time in which the long-range threshold rises from 0", unit = "time", min = 0 },
  samples = { 360, "places on the ring", min = 3 },
  tie = { 1e-5, "fields nearer than this are equal", min = 0 },
}

local model = tunica.phyllotaxis {
  path = function(age) return 1, -age end,
  samples = P.samples, tie = P.tie, params = P, stop = { primordia = 60 },
}
model:inhibition {
  field = function(d, age) return (1 - math.exp(-P.onset * age)) * math.exp(-P.b_long * age) / d end,
  below = function(t) return P.long * math.min(1, t / P.ramp) end,
}
model:inhibition { field = function(d, age) return math.exp(-P.b_short * age) / d end, below = P.short }

model:report { primordia = function() return model.count end, angles = function() return model.angles end }

return model
