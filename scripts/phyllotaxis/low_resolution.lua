--- Nineteen places on the ring, and still a spiral.
-- WHAT    neither 7 nor 8 steps of 360/19 degrees (132.6, 151.6) lies within the interval 135 to 144 in which (5, 8)
--         parastichies are possible. The primordia take 8, 7, 7, 8, 7, 7 ... steps: 138.95 degrees on average.
-- HOW     one inhibitor (4.3) whose threshold rises at the start.
-- TRY     samples=20   samples=38   samples=1440
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.5
local tunica = require "tunica"

local P = tunica.params {
  b = { 0.65, "decay of the inhibition with age", unit = "1/time", min = 0 },
  from = { 0.429, "threshold at the start", unit = "1/length", min = 0 },
  to = { 1.97, "threshold in the end", unit = "1/length", min = 0 },
  ramp = { 0.77, "time in which it rises", unit = "time", min = 1e-9 },
  samples = { 19, "places on the ring", min = 3 },
}
local apex = tunica.apex { profile = "disk", growth = 1 }
local model = tunica.phyllotaxis { apex = apex, radius = 1, samples = P.samples, params = P, stop = { primordia = 300 } }

model:inhibition {
  field = function(d, age) return math.exp(-P.b * age) / d end,
  below = function(t) return P.from + (P.to - P.from) * math.min(1, t / P.ramp) end,
}
model:primordium { angle = 0 }

--- Steps from primordium to primordium, in places, of the last `count`; and their mean in degrees.
local function steps(count)
  local list, words, sum = model:primordia(), {}, 0
  for i = math.max(2, #list - count + 1), #list do
    local step = math.abs(list[i].divergence) * P.samples / 360
    words[#words + 1], sum = string.format("%.0f", step), sum + step
  end
  return table.concat(words, " "), #words > 0 and sum / #words * 360 / P.samples or nil
end

model:view { name = "top", from = "top", reach = 12 }
model:report { steps = function() return (steps(24)) end, angle = function() return select(2, steps(120)) end }

return model
