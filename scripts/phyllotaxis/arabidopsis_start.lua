--- The first leaves of Arabidopsis: from the cotyledons to the spiral.
-- WHAT    with 38 places on the ring, as many as there are cells around the apex, the divergence angles are 180, 114, 161,
--         133, 142, 142 ... degrees: within the standard error of those measured in the plant.
-- HOW     one inhibitor (4.3) whose threshold rises quickly at the start, as in inhibition_single. The first primordium is at
--         angle 0; which of two equal minima the third takes is drawn, and decides the hand of the spiral.
-- TRY     --seed 2 (the other hand)   shape=disk   shape=cylinder   samples=360 (as if space were continuous)   to=0.8
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.3.1, figs 4.4 and 4.5
local tunica = require "tunica"

local P = tunica.params {
  shape = { "dome", "of the apex: dome, disk, arabidopsis, or cylinder" },
  b = { 4.8, "decay of the inhibition with age", unit = "1/time", min = 0 },
  from = { 0.165, "threshold at the start", unit = "1/length", min = 0 },
  to = { 0.5, "threshold in the end", unit = "1/length", min = 0 },
  ramp = { 2.78, "time in which it rises", unit = "time", min = 1e-9 },
  samples = { 38, "places on the ring", min = 3 },
}

local options = { samples = P.samples, params = P, stop = { primordia = 20 } }
if P.shape == "cylinder" then
  options.path = function(age) return 1, -age end
else
  options.apex, options.radius = tunica.apex { profile = P.shape, growth = 1 }, 1
end
local model = tunica.phyllotaxis(options)

model:inhibition {
  field = function(d, age) return math.exp(-P.b * age) / d end,
  below = function(t) return P.from + (P.to - P.from) * math.min(1, t / P.ramp) end,
}
model:primordium { angle = 0 }

--- Divergence angles so far, 0 to 360, in the sense of the spiral.
local function divergences()
  local list, angles = model:primordia(), {}
  local hand = list[3] and list[3].divergence < 0 and -1 or 1
  for i = 2, #list do angles[#angles + 1] = string.format("%.1f", (hand * list[i].divergence) % 360) end
  return table.concat(angles, " ")
end

model:view { name = "field", colour = "field", arrows = true, labels = true, every = 0.25 }
model:view { name = "top", from = "top", labels = true }
model:report { primordia = function() return model.count end, angles = divergences }

return model
