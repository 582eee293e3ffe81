-- SPDX-License-Identifier: MIT
-- A sheet that grows and divides under a pattern in the making: every method agrees, and the cells divide at the same times
-- and places.
local tunica = require "tunica"
local core = require "tunica.core"

local function run(method)
  local tissue = tunica.sheet { cells = 40, seed = 3 }
  tissue:cell { auxin = { function(c) return 1 + c:uniform(-.2, .2) end, divide = "copy" } }
  -- Fixed steps: short enough for the error asked for; the others by their tolerance.
  local dt = ({ euler = 2e-4, sts = 5e-4, backward_euler = 2e-4, heun = 0.01, rk4 = 0.02, crank_nicolson = 0.02, bicg = 0.02 })[method]
  local model = tunica.model { tissue = tissue, method = method, dt = dt, tolerance = not dt and 1e-4 or nil }
  model:flux("auxin", function(w, a, b) return w.length * (a.auxin - b.auxin) end)
  model:rate(function(c, d) d.auxin = 1 / (1 + c.auxin) - 0.3 * c.auxin + 0.8 * c.auxin ^ 2 / (1 + c.auxin ^ 2) end)
  local divisions = {}
  model:every(0.25, function(t)
    tissue:grow { rate = 0.2, time = 0.25 }
    tissue:divide { above = 1.2 }
    divisions[#divisions + 1] = string.format("%g:%d", t, tissue:count())
  end)
  model:advance { to = 3 }
  return tissue, table.concat(divisions, " ")
end

local reference, expected = run "dp54"
assert(expected:match "%d+$" ~= "40", "cells divide: " .. expected)
local mean = reference:mean "auxin"
for _, way in ipairs(core.methods_of_solution()) do
  local tissue, divisions = run(way.name)
  assert(divisions == expected, way.name .. ": " .. divisions .. " instead of " .. expected)
  assert(math.abs(tissue:mean "auxin" / mean - 1) < 1e-3, way.name)
  for c in reference:cells() do
    local twin = tissue:find(c.id)
    assert(math.abs(twin.x - c.x) < 1e-12 and math.abs(twin.auxin / c.auxin - 1) < 1e-3, way.name .. ": cell " .. c.id)
  end
end
