--- Phyllotaxis by one inhibition field, from the first primordium on.
-- WHAT    primordia arise on a ring around the tip, where the inhibition by the older ones is lowest, when it falls below a
--         threshold. The threshold rises at first: the second primordium comes opposite the first, then a spiral sets in.
-- HOW     inhibition (4.3): each primordium adds exp(-b age) / distance. All move away from the tip with the growing apex.
--         The time of each insertion is found, not stepped to.
-- TRY     samples=38 (the sequence of fig. 4.4)   shape=disk   shape=cylinder   to=2 (higher order)
--         shape=disk b=0.5 to=0.35 (distichous)
--         jugacy=2 shape=disk b=1 to=2 (spiro-decussate; to=0.9 decussate, to=3 bijugate)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.3, figs 4.1-4.4
local tunica = require "tunica"

local P = tunica.params {
  shape = { "dome", "of the apex: dome, disk, hemisphere_cylinder, paraboloid, cone, or cylinder" },
  b = { 4.8, "decay of the inhibition with age", unit = "1/time", min = 0 },
  from = { 0.165, "threshold at the start", unit = "1/length", min = 0 },
  to = { 0.5, "threshold in the end", unit = "1/length", min = 0 },
  ramp = { 2.78, "time in which it rises", unit = "time", min = 1e-9 },
  jugacy = { 1, "primordia at once, evenly spaced: imposed", min = 1 },
  samples = { 360, "places on the ring", min = 3 },
  primordia = { 60, "at the end", min = 2 },
}

local options = { samples = P.samples, jugacy = P.jugacy, params = P, stop = { primordia = P.primordia } }
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
if P.jugacy > 1 then
  model:initial { count = P.jugacy, angle = 180 / P.jugacy }
else
  model:primordium { angle = 0 }
end

--- What the last 40 are.
local function recent() return model:pattern { first = math.max(1, model.count - 39) } end

model:view { name = "top", from = "top", labels = true }
model:view { name = "side", from = "side" }
model:view { name = "field", colour = "field", arrows = true, every = 0.25 }
model:view { name = "lattice", lattice = true, parastichies = true, labels = true }
model:report {
  primordia = function() return model.count end,
  angle = function() return recent().mean end,
  pattern = function() return tostring(recent()) end,
}

return model
