--- A threshold that rises: from two rows of leaves to ever finer spirals.
-- WHAT    at a low threshold primordia stand opposite each other (180 degrees). As it rises, this gives way, at once, to
--         about 150 degrees; then the angle falls towards 137.5 and swings about it, while the spirals become finer.
-- HOW     one inhibitor (4.3) on a flat apex; its threshold rises geometrically over `ramp` units of time. The picture
--         `divergence` shows each primordium's angle against the threshold when it arose.
-- TRY     b=2   to=20 (up to higher orders)   samples=5760
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.3.1, fig. 4.3
local tunica = require "tunica"

local P = tunica.params {
  b = { 0.5, "decay of the inhibition with age", unit = "1/time", min = 0 },
  from = { 0.15, "threshold at the start", unit = "1/length", min = 1e-9 },
  to = { 6, "threshold in the end", unit = "1/length", min = 1e-9 },
  ramp = { 150, "time in which it rises", unit = "time", min = 1e-9 },
  samples = { 720, "places on the ring", min = 3 },
}
local apex = tunica.apex { profile = "disk", growth = 1 }
local model = tunica.phyllotaxis { apex = apex, radius = 1, samples = P.samples, params = P, stop = P.ramp }

local function threshold(t) return P.from * (P.to / P.from) ^ math.min(1, t / P.ramp) end

model:inhibition { field = function(d, age) return math.exp(-P.b * age) / d end, below = threshold }
model:primordium { angle = 0 }

--- Mean of the last ten divergence angles, 0 to 180.
local function angle()
  local list, sum, n = model:primordia(), 0, 0
  for i = math.max(2, #list - 9), #list do sum, n = sum + math.abs(list[i].divergence), n + 1 end
  return n > 0 and sum / n or nil
end

model:view { name = "top", from = "top", every = 10 }
model:view { name = "divergence", plot = "threshold" }
model:report { every = 1, threshold = function() return threshold(model.time) end, angle = angle, primordia = function() return model.count end }

return model
