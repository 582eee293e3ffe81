-- SPDX-License-Identifier: MIT
-- Curves in rules, fields and thresholds: those straight from point to point are traced, others say why not; a curve that
-- a script exchanges counts at once and is part of a snapshot.
local tunica = require "tunica"
local check = require "check"

local straight = tunica.curve { { -1, 3 }, { 0, 0.5 }, { 0.5, 0.5 }, { 2, 2 }, { 2.5, -1 }, degree = 1 }
local bent = tunica.curve { { 0, 0.5 }, { 1, 2 }, { 2, 0 }, { 3, 1 } }
local flat = tunica.curve { { 0, 0.25 } }

--- A model whose rates are what fn(c, t) gives, and what its first rule's entry in run.json says.
local function model_of(fn)
  local tissue = tunica.ring { 40 }
  tissue:cell { x0 = function(c) return c.id * 0.1 - 1.5 end, total = 0 }
  local model = tunica.model { tissue = tissue, dt = 0.125, method = "euler", signed = { "total", "x0" } }
  model:rate(function(c, d) d.x0 = 0 d.total = fn(c.x0) end)
  return model, tissue
end

-- The same values as when it is called with numbers, in all its parts, at its points and beyond.
local model, tissue = model_of(function(x) return straight(x) + flat(x) end)
model:advance(0.125)
check.equal(model.about.rules[1].traced, true)
for c in tissue:cells() do check.near(c.total, 0.125 * (straight(c.x0) + 0.25), 1e-15) end

-- Its derivative is exact where an implicit method needs it.
local implicit = tunica.ring { 3 }
implicit:cell { y = 0.6 }
local decay = tunica.model { tissue = implicit, dt = 0.01, method = "bdf" }
decay:rate(function(c, d) d.y = 0.5 - straight(c.y) end)
decay:advance(5)
check.near(implicit:max "y", 0.5, 0.02)

-- Other curves are computed, by the interpreter, and the reason is said.
model, tissue = model_of(function(x) return bent(x) end)
model:advance(0.125)
local rule = model.about.rules[1]
check.equal(rule.traced, false)
assert(rule.reason:find("degree = 1", 1, true), rule.reason)
for c in tissue:cells() do check.near(c.total, 0.125 * bent(c.x0), 1e-15) end

-- A curve exchanged by an event counts from then on; going back to a snapshot brings the old one back.
local rate = tunica.curve { { 0, 1 }, { 1, 1 }, degree = 1, name = "slow" }
local grown = tunica.ring { 3 }
grown:cell { y = 0 }
local changing = tunica.model { tissue = grown, dt = 0.25, method = "euler" }
changing:rate(function(c, d, t) d.y = rate(t) end)
changing:at(1, function() rate = tunica.curve { { 0, 3 }, { 9, 3 }, degree = 1, name = "fast" } end)
changing:advance(0.5)
local before = changing:snapshot()
changing:advance(2)
check.near(grown:max "y", 4, 1e-14)
changing:restore(before)
check.equal(tostring(rate), "curve 'slow' from x = 0 to 1, values 1 to 1")
changing:advance(2)
check.near(grown:max "y", 4, 1e-14)

-- Thresholds over time: a curve, and the function that is the same.
local function births(below, field)
  local spiral = tunica.phyllotaxis { path = function(age) return math.exp(age), 0 end, samples = 90 }
  spiral:inhibition { field = field or function(d, age) return math.exp(-age) / d end, below = below }
  spiral:advance(3)
  return spiral
end
local falling = tunica.curve { { 0, 2.5 }, { 1, 2.6 }, { 3, 2 } }
local by_curve, by_function = births(falling), births(function(t) return falling(t) end)
assert(#by_curve.angles > 10)
check.equal(by_curve:hash(), by_function:hash())

-- In fields, by age and by time.
local share = tunica.curve { { 0, 1 }, { 1, 0.5 }, { 4, 0 }, degree = 1 }
local aging = births(2.5, function(d, age) return share(age) / d end)
check.equal(aging.about.rules[1].traced, true)
local expected = 0
for _, p in ipairs(aging:primordia()) do
  expected = expected + share(p.age) / math.sqrt((1 - p.x) ^ 2 + p.y ^ 2 + p.z ^ 2)
end
check.near(aging:field(0), expected, 1e-9)
