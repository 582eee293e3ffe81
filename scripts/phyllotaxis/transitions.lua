--- Plants that change their leaf arrangement, by one parameter.
-- WHAT    a pattern is established, then the threshold of the long-range inhibition changes to `factor` times its value over
--         a few plastochrons, and another pattern takes over. `change` chooses one of seven.
-- HOW     two inhibitors (4.4, 4.5). A pattern that is symmetric in itself is left only if something breaks the symmetry, as
--         every living thing does: places on the ring are displaced by `jitter` degrees. Without it, decussate would stay
--         decussate for ever.
-- TRY     change=decussate-bijugate, distichous-fibonacci, whorled-fibonacci, whorled-lucas, whorled-trijugate, bijugate-fibonacci
--         jitter=0 (stays)   change=distichous-fibonacci jitter=0 (two minima at once: decussate)   --seed 2
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.4.1, fig. 4.10; the values are our own
local tunica = require "tunica"

-- shape; threshold long, with its ramp, or initial { primordia, angle, jugacy }; onset, decays, threshold short; then what changes.
local changes = {
  ["decussate-spiral"] = { shape = "cylinder", long = 1.1418, ramp = 3.98, onset = 0.632, b_long = 0.398, b_short = 5.635, short = 0.797,
    after = 60, factor = 1.3, during = 1.84, jitter = 0.3 },
  ["decussate-bijugate"] = { shape = "cylinder", long = 1.1418, ramp = 3.98, onset = 0.632, b_long = 0.398, b_short = 5.635, short = 0.797,
    after = 60, factor = 2, during = 1.84, jitter = 0.3 },
  ["distichous-fibonacci"] = { shape = "dome", long = 0.0923, ramp = 1.32, onset = 2.12, b_long = 2.16, b_short = 7.45, short = 3.47,
    after = 40, factor = 4.79, during = 1.81, jitter = 0.3 },
  ["whorled-fibonacci"] = { shape = "dome", long = 0.868, initial = { 24, 60, 3 }, onset = 0.451, b_long = 0.606, b_short = 7.12, short = 1.03,
    after = 54, factor = 3.57, during = 1.85, jitter = 0.3 },
  ["whorled-lucas"] = { shape = "dome", long = 2.57, initial = { 24, 60, 3 }, onset = 2.5, b_long = 0.539, b_short = 3.16, short = 1.94,
    after = 54, factor = 1.5, during = 1.65, jitter = 0 },
  ["whorled-trijugate"] = { shape = "dome", long = 1.45, initial = { 24, 60, 3 }, onset = 4.19, b_long = 2.31, b_short = 27.2, short = 1.24,
    after = 54, factor = 2.07, during = 1.97, jitter = 0 },
  ["bijugate-fibonacci"] = { shape = "dome", long = 1.8, initial = { 24, 68.75, 2 }, onset = 1.97, b_long = 1.68, b_short = 6.3, short = 1.51,
    after = 54, factor = 0.514, during = 1.89, jitter = 0.3 },
}

local P = tunica.params {
  change = { "decussate-spiral", "from which pattern to which" },
  factor = { 0, "of the threshold, in the end; 0: that of the change", min = 0 },
  jitter = { -1, "standard deviation of the places on the ring; -1: that of the change", unit = "degrees", min = -1 },
  samples = { 360, "places on the ring", min = 3 },
}
local values = changes[P.change]
if not values then
  local names = {}
  for name in pairs(changes) do names[#names + 1] = name end
  table.sort(names)
  error("there is no change '" .. P.change .. "'; there are " .. table.concat(names, ", "), 0)
end

local options = { samples = P.samples, params = P, jitter = { angle = P.jitter < 0 and values.jitter or P.jitter },
  stop = { primordia = values.after + 110 } }
if values.shape == "cylinder" then
  options.path = function(age) return 1, -age end
else
  options.apex, options.radius = tunica.apex { profile = values.shape, growth = 1 }, 1
end
local model = tunica.phyllotaxis(options)

local factor = P.factor > 0 and P.factor or values.factor
local changed = 1e300  -- when the change begins

local function threshold(t)
  local rise = values.ramp and math.min(1, t / values.ramp) or 1
  return values.long * rise * (1 + (factor - 1) * math.max(0, math.min(1, (t - changed) / values.during)))
end

model:inhibition {
  field = function(d, age) return (1 - math.exp(-values.onset * age)) * math.exp(-values.b_long * age) / d end,
  below = threshold,
}
model:inhibition { field = function(d, age) return math.exp(-values.b_short * age) / d end, below = values.short }
if values.initial then
  model:initial { count = values.initial[1], angle = values.initial[2], jugacy = values.initial[3] }
else
  model:primordium { angle = 0 }
end
model:after(values.after, function(t) changed = t end)

model:view { name = "side", from = "side", reach = 12 }
model:view { name = "top", from = "top", reach = 12 }
model:view { name = "lattice", lattice = true }
model:view { name = "divergence", plot = "divergence" }
model:report {
  before = function() return tostring(model:pattern { last = math.min(values.after, model.count) }) end,
  angle = function() return model.count > values.after + 60 and model:pattern { first = values.after + 61 }.mean or nil end,
  after = function() return model.count > values.after + 60 and tostring(model:pattern { first = values.after + 61 }) or nil end,
}

return model
