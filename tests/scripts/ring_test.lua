-- SPDX-License-Identifier: MIT
-- The ring against its dispersion relation: sigma(q) = q (A (1/(1+kT a0) - q/2) - D), A = T P / (2 (1+kT a0)), q = 2(1-cos k).
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
local model = dofile(here .. "/../../scripts/patterning/ring.lua")
local tissue, P = model.tissue, model.params
local start = model:snapshot()

local function amplitude(mode)
  local sum = 0
  for c in tissue:cells() do sum = sum + (c.auxin - 1) * math.cos(2 * math.pi * mode * c.column / #tissue) end
  return sum
end

local expected = { [3] = 0.29067, [4] = 0.35767, [5] = 0.25239, [6] = -0.14806 }
for mode, rate in pairs(expected) do
  model:restore(start)
  for c in tissue:cells() do c.auxin = 1 + 1e-7 * math.cos(2 * math.pi * mode * c.column / #tissue) end
  local before, steps = amplitude(mode), 5
  model:advance { to = steps * P.dt }
  -- Euler multiplies by (1 + dt sigma) at each step
  local measured = ((amplitude(mode) / before) ^ (1 / steps) - 1) / P.dt
  assert(math.abs(measured - rate) < 1e-4, string.format("measured %.6f, theory %.5f", measured, rate))
end

-- auxin is conserved
do
  model:restore(start)
  local before = tissue:sum "auxin"
  model:advance { to = 20 }
  assert(math.abs(tissue:sum "auxin" / before - 1) < 1e-12)
end

-- no pattern below the threshold T = 18 D
do
  model:restore(start)
  P.T = 17
  model:advance { to = 300 }
  local mean, most = tissue:mean "auxin", tissue:max "auxin"
  assert(most - mean < 2e-2, "spread " .. most - mean)
  P.T = 30
  model:advance { to = 900 }
  assert(tissue:max "auxin" > 1.2, "highest " .. tissue:max "auxin")
end
