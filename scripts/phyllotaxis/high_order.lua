--- A sunflower's order: (89, 144) parastichies, kept.
-- WHAT    from 250 primordia at the Fibonacci angle, 300 more arise at 137.506 degrees each; 89 spirals run one way, 144 the
--         other.
-- HOW     one inhibitor (4.3) with a steep decay on a flat apex; the divergence angles possible for (89, 144) are 137.5000 to
--         137.5281, so the places on the ring must be near enough to each other: 2880 are, 1440 are not for long.
-- TRY     samples=1440 (order is lost after some 130)   samples=5760
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.3.2; the values are our own
local tunica = require "tunica"

local P = tunica.params {
  b = { 30, "decay of the inhibition with age", unit = "1/time", min = 0 },
  threshold = { 202.13, "of the inhibition", unit = "1/length", min = 0 },
  initial = { 250, "primordia at the start", min = 1 },
  spacing = { 0.00022, "from one to the next of them", unit = "time", min = 0 },
  primordia = { 300, "that then arise", min = 1 },
  samples = { 2880, "places on the ring", min = 3 },
}
local apex = tunica.apex { profile = "disk", growth = 1 }
local model = tunica.phyllotaxis { apex = apex, radius = 1, samples = P.samples, params = P, stop = { primordia = P.initial + P.primordia } }

model:inhibition { field = function(d, age) return math.exp(-P.b * age) / d end, below = P.threshold }
model:initial { count = P.initial, angle = 137.50776, spacing = P.spacing }

local function new() return model:pattern { expected = { angle = 137.50776, pair = { 89, 144 } } } end

model:view { name = "top", from = "top", parastichies = { 89, 144 } }
model:report {
  primordia = function() return model.count end,
  angle = function() return new().mean end,
  pattern = function() return tostring(new()) end,
}

return model
