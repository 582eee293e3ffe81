-- SPDX-License-Identifier: MIT
-- The shipped model of one inhibitor keeps a Fibonacci spiral at its threshold.
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
local model = dofile(here .. "/../../scripts/phyllotaxis/inhibition_single.lua")
model:advance()
local pattern = model:pattern { first = 80 }
assert(pattern.name == "Fibonacci spiral" and pattern.pair[1] == 5 and pattern.pair[2] == 8, tostring(pattern))
assert(math.abs(pattern.mean - 137.71) < 0.1, "angle " .. pattern.mean)
assert(math.abs(pattern.plastochron.mean - 0.0438) < 2e-4, "plastochron " .. pattern.plastochron.mean)
assert(#model.about.warnings == 0)
