--- Phyllotaxis by two inhibition fields: whorls and spirals from one primordium on.
-- WHAT    as inhibition_single, but primordia begin to inhibit only some time after they have arisen, so that others can
--         arise with them; a second, short-range inhibition keeps these apart. So come decussate and bijugate patterns, too.
-- HOW     long range (4.4): (1 - exp(-onset age)) exp(-b_long age) / distance chooses the place. Short range (4.5):
--         exp(-b_short age) / distance permits it. The long-range threshold rises from 0 at the start.
-- TRY     pattern=distichous, spiro-distichous, fibonacci, lucas, bijugate   long=1 (another threshold)   jitter=2
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.4, fig. 4.9; the values are our own
local tunica = require "tunica"

-- Values that give each pattern, robustly: threshold, rise time, onset and decays.
local patterns = {
  distichous = { long = 0.1, ramp = 0.906, onset = 1.99, b_long = 1.66, b_short = 8.28, short = 3.8 },
  ["spiro-distichous"] = { long = 0.268, ramp = 3.45, onset = 2.35, b_long = 1.47, b_short = 19.3, short = 1.2 },
  fibonacci = { long = 0.614, ramp = 1, onset = 4.28, b_long = 3.4, b_short = 4.18, short = 1.42 },
  lucas = { long = 3.76, ramp = 0.715, onset = 7.63, b_long = 0.559, b_short = 10.7, short = 1.91 },
  decussate = { long = 0.675, ramp = 4.63, onset = 0.661, b_long = 0.401, b_short = 7.76, short = 1.39 },
  bijugate = { long = 1.23, ramp = 4.16, onset = 0.615, b_long = 0.459, b_short = 7.02, short = 0.696 },
}

local P = tunica.params {
  pattern = { "decussate", "whose values are taken: distichous, spiro-distichous, fibonacci, lucas, decussate or bijugate" },
  long = { 0, "threshold of the long-range inhibition; 0: that of the pattern", unit = "1/length", min = 0 },
  short = { 0, "threshold of the short-range inhibition; 0: that of the pattern", unit = "1/length", min = 0 },
  samples = { 360, "places on the ring", min = 3 },
  jitter = { 0, "standard deviation of the samples' angles", unit = "degrees", min = 0 },
  primordia = { 80, "at the end", min = 2 },
}
local values = patterns[P.pattern]
if not values then error("there is no pattern '" .. P.pattern .. "'; there are distichous, spiro-distichous, fibonacci, lucas, decussate " ..
  "and bijugate", 0) end
local long, short = P.long > 0 and P.long or values.long, P.short > 0 and P.short or values.short

local apex = tunica.apex { profile = "dome", growth = 1 }
local model = tunica.phyllotaxis { apex = apex, radius = 1, samples = P.samples, params = P, jitter = { angle = P.jitter },
  stop = { primordia = P.primordia } }

model:inhibition {
  field = function(d, age) return (1 - math.exp(-values.onset * age)) * math.exp(-values.b_long * age) / d end,
  below = function(t) return long * math.min(1, t / values.ramp) end,
}
model:inhibition { field = function(d, age) return math.exp(-values.b_short * age) / d end, below = short }
model:primordium { angle = 0 }

--- What the last 40 are.
local function recent() return model:pattern { first = math.max(1, model.count - 39) } end

model:view { name = "top", from = "top", labels = true }
model:view { name = "side", from = "side" }
model:view { name = "lattice", lattice = true, labels = true }
model:report {
  primordia = function() return model.count end,
  angle = function() return recent().mean end,
  pattern = function() return tostring(recent()) end,
}

return model
