-- SPDX-License-Identifier: MIT
-- For solvers_bench.cpp: runs the activator-inhibitor problem as a model in Lua and prints what it cost.
-- Environment: SIDE cells along a side, DH, UNTIL, OUT (where the final state goes, as text), and RUNS: "method dt tolerance;..."
local tunica = require "tunica"
local side, Dh, until_time = tonumber(os.getenv "SIDE"), tonumber(os.getenv "DH"), tonumber(os.getenv "UNTIL")

-- SplitMix64, the start that the C++ program makes for itself.
local state = 1ULL
local function draw()
  state = state + 0x9e3779b97f4a7c15ULL
  local z = state
  z = bit.bxor(z, bit.rshift(z, 30)) * 0xbf58476d1ce4e5b9ULL
  z = bit.bxor(z, bit.rshift(z, 27)) * 0x94d049bb133111ebULL
  return tonumber(bit.rshift(bit.bxor(z, bit.rshift(z, 31)), 11)) * 2 ^ -53
end

local tissue = tunica.grid { side, side }
tissue:cell { a = 0, h = 0 }
for c in tissue:cells() do
  c.a = 1.503012 * (1 + .01 * (2 * draw() - 1))
  c.h = 7.075367 * (1 + .01 * (2 * draw() - 1))
end
local model = tunica.model { tissue = tissue, dt = 1e-3 }
model:rate(function(c, d)
  d.a = c.a ^ 2 / (1 + c.h) + .02 - .2 * c.a + .2 * c:sum(function(n) return n.a - c.a end)
  d.h = c.a ^ 2 - .32 * c.h + Dh * c:sum(function(n) return n.h - c.h end)
end)

local start = model:snapshot()
local number = 0
for method, dt, tolerance in os.getenv("RUNS"):gmatch "(%S+) (%S+) (%S+);" do
  local least, cost = math.huge, nil
  for _ = 1, tonumber(os.getenv "REPEATS" or "3") do
    model:restore(start)
    model:solve_with { method = method, dt = tonumber(dt) > 0 and tonumber(dt) or nil, tolerance = tonumber(tolerance) > 0 and tonumber(tolerance) or nil }
    model:advance { to = until_time }
    cost = model.cost
    least = math.min(least, cost.seconds)
    if cost.seconds > 2 then break end
  end
  number = number + 1
  local file = assert(io.open(os.getenv "OUT" .. number, "w"))
  for c in tissue:cells() do file:write(string.format("%.17g %.17g\n", c.a, c.h)) end
  file:close()
  print(string.format("%s %s %s %.9g %d %d", method, dt, tolerance, least, cost.steps, cost.evaluations))
end
