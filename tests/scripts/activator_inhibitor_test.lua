-- SPDX-License-Identifier: MIT
-- The activator and its inhibitor: the state at rest, which no noise leaves alone and a little noise unsettles.
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
local model = dofile(here .. "/../../scripts/numerics/activator_inhibitor.lua")
local tissue, P = model.tissue, model.params
local start = model:snapshot()

for c in tissue:cells() do
  assert(math.abs(c.a / 1.5010138 - 1) < 0.010001 and math.abs(c.h / 7.0407573 - 1) < 0.010001)
end

-- the root of 0.2 a - 0.02 = a^2 / (1 + a^2 / 0.32) is at rest
for c in tissue:cells() do c.a, c.h = 1.5010137671732275, 7.040757278886138 end
model:advance { to = 1 }
assert(math.abs(tissue:max "a" - 1.5010137671732) < 1e-12 and math.abs(tissue:min "h" - 7.0407572788861) < 1e-11)

-- spots
model:restore(start)
model:advance { to = 200 }
local spots
for _, each in ipairs(model.reports) do
  if each.name == "spots" then spots = each.fn() end
end
assert(spots >= 18 and spots <= 28, "spots " .. spots)
assert(tissue:max "a" > 4.5 and tissue:max "a" < 6)

-- the longest step of forward Euler, 0.0619
model:restore(start)
model:solve_with { method = "euler", dt = 0.063 }
assert(not pcall(model.advance, model, 200) and model.failure)
