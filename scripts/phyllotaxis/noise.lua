--- Decussate leaves in spite of noise.
-- WHAT    pairs of primordia, each at right angles to the one before. The places on the ring are displaced at random, around
--         it and along the apex, anew after every insertion; the pattern, which would turn into a spiral with more noise,
--         stays.
-- HOW     two inhibitors (4.4, 4.5) on 72 places; displacements are normal, `around` degrees and `along` ring radii.
-- TRY     along=0.06 around=6 (too much: a spiral)   around=0 along=0   samples=360   --seed 2
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.5, fig. 4.11
local tunica = require "tunica"

local P = tunica.params {
  long = { 0.298, "threshold of the long-range inhibition", unit = "1/length", min = 0 },
  ramp = { 2.97, "time in which it rises from 0", unit = "time", min = 1e-9 },
  b_long = { 0.507, "its decay with age", unit = "1/time", min = 0 },
  onset = { 0.265, "rate at which primordia begin to send it out", unit = "1/time", min = 0 },
  short = { 2.27, "threshold of the short-range inhibition", unit = "1/length", min = 0 },
  b_short = { 10, "its decay with age", unit = "1/time", min = 0 },
  around = { 3, "standard deviation of the places around the ring", unit = "degrees", min = 0 },
  along = { 0.01, "standard deviation of the places along the apex", unit = "length", min = 0 },
  samples = { 72, "places on the ring", min = 3 },
}
local model = tunica.phyllotaxis {
  apex = tunica.apex { profile = "dome", growth = 1 }, radius = 1,
  samples = P.samples, params = P, jitter = { angle = P.around, along = P.along }, stop = { primordia = 60 },
}
model:inhibition {
  field = function(d, age) return (1 - math.exp(-P.onset * age)) * math.exp(-P.b_long * age) / d end,
  below = function(t) return P.long * math.min(1, t / P.ramp) end,
}
model:inhibition { field = function(d, age) return math.exp(-P.b_short * age) / d end, below = P.short }
model:primordium { angle = 0 }

local function of_pairs() return model:pattern { first = 21, jugacy = 2 } end

model:view { name = "side", from = "side" }
model:view { name = "top", from = "top" }
model:view { name = "lattice", lattice = true }
model:report {
  angle = function() return of_pairs().mean end,     -- between pairs, of primordia 21 on
  within = function() return of_pairs().intra end,   -- deviation of the two from 180 degrees
  pattern = function() return tostring(model:pattern { first = 21 }) end,
}

return model
