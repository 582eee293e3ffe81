-- SPDX-License-Identifier: MIT
-- One inhibitor (thesis 4.3): primordia on a ring of a flat apex that grows exponentially. Each adds exp(-b age) / distance to
-- the field; one is born where the field is below the threshold. From a lattice at the Fibonacci angle to contact pair (5, 8).
local tunica = require "tunica"

local P = tunica.params {
  b = { 1, "decay of the inhibition with age", unit = "1/time", min = 0 },
  threshold = { 10, "below it a primordium is born", unit = "1/length", min = 0 },
  angle = { 137.51, "divergence angle at the start", unit = "degrees" },
  initial = { 30, "primordia at the start", min = 1 },
  samples = { 720, "places on the ring", min = 3 },
  growth = { 1, "relative rate of growth", unit = "1/time", min = 0 },
}

local model = tunica.phyllotaxis {
  path = function(age) return math.exp(P.growth * age), 0 end,
  samples = P.samples, params = P, stop = { primordia = 150 },
}
model:inhibition { field = function(d, age) return math.exp(-P.b * age) / d end, below = P.threshold }
model:initial { count = P.initial, angle = P.angle }

--- Mean divergence, folded to 0..180, and plastochron of the last 60.
local function last()
  local list, c, s = model:primordia(), 0, 0
  local n = math.min(60, #list - 1)
  for i = #list - n + 1, #list do
    c, s = c + math.cos(math.rad(list[i].divergence)), s + math.sin(math.rad(list[i].divergence))
  end
  return math.abs(math.deg(math.atan2(s, c))), (list[#list].time - list[#list - n].time) / n
end

model:report {
  primordia = function() return model.count end,
  angle = function() return (last()) end,
  plastochron = function() return select(2, last()) end,
}

return model
