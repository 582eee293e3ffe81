-- SPDX-License-Identifier: MIT
-- One inhibitor (thesis 4.3, fig. 4.6): primordia on a ring of a growing apex. Each adds exp(-b age) / distance to the field; one is born
-- where the field is below the threshold. From a lattice at a divergence angle: the Fibonacci angle here; 99.5 (Lucas), 151.14
-- (anomalous), 106.45, 77.96, and 68.75 with jugacy = 2 keep their own at this threshold. growth = 1 and profile = disk give an apex on which
-- everything is exact; profile = dome with growth = raised one like that of a plant.
local tunica = require "tunica"

local P = tunica.params {
  b = { 1, "decay of the inhibition with age", unit = "1/time", min = 0 },
  threshold = { 11.15, "below it a primordium is born", unit = "1/length", min = 0 },
  angle = { 137.51, "divergence angle at the start", unit = "degrees" },
  initial = { 20, "primordia at the start (a multiple of the jugacy)", min = 1 },
  jugacy = { 1, "of the start", min = 1 },
  samples = { 720, "places on the ring", min = 3 },
  profile = { "disk", "profile of the apex" },
  growth = { "constant", "its relative growth along the profile" },
  radius = { 1, "of the ring", unit = "length", min = 0 },
  count = { 140, "primordia in all", min = 2 },
}

local model = tunica.phyllotaxis {
  apex = tunica.apex { profile = P.profile, growth = P.growth }, radius = P.radius,
  samples = P.samples, params = P, stop = { primordia = P.count },
}
model:inhibition { field = function(d, age) return math.exp(-P.b * age) / d end, below = P.threshold }
model:initial { count = P.initial, angle = P.angle, jugacy = P.jugacy }

local function pattern() return model:pattern { jugacy = P.jugacy > 1 and P.jugacy or nil } end
model:report {
  pattern = function() return pattern().name end,
  angle = function() return pattern().mean end,
  pair = function() return pattern().pair end,
  plastochron = function() return pattern().plastochron.mean end,
}
model:view { from = "top", colour = "age" }

return model
