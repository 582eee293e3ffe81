-- SPDX-License-Identifier: MIT
-- The gradient against its exact steady state, and production against decay.
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
local model = dofile(here .. "/../../scripts/numerics/gradient_line.lua")
local tissue, P = model.tissue, model.params

local reports = {}
for _, each in ipairs(model.reports) do reports[each.name] = each.fn end

model:advance { to = 5000 }
assert(reports.distance() < 1e-11, "distance " .. reports.distance())
assert(math.abs(tissue:sum "c" * P.mu / P.rho - 1) < 1e-12)

-- falls by the same factor from cell to cell, away from both ends
local q = P.mu / (2 * P.D)
local r = 1 + q - math.sqrt(q * (2 + q))
for i = 20, 40 do
  local ratio = tissue:find(i + 1).c / tissue:find(i).c
  assert(math.abs(ratio - r) < 1e-4, "ratio " .. ratio)
end
