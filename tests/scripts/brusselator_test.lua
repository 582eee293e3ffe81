-- SPDX-License-Identifier: MIT
-- Spots above the threshold B = (1 + A sqrt(Du / Dv))^2, rest below it.
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
local model = dofile(here .. "/../../scripts/numerics/brusselator.lua")
local tissue, P = model.tissue, model.params
local start = model:snapshot()

local threshold = (1 + P.A * math.sqrt(P.Du / P.Dv)) ^ 2
assert(P.B > threshold and P.B < 1 + P.A ^ 2)
model:advance { to = 50 }
local spots = tissue:count_peaks "u"
assert(spots >= 40 and spots <= 80, "spots " .. spots)

model:restore(start)
P.B = 0.9 * threshold
for c in tissue:cells() do c.v = P.B / P.A end
model:advance { to = 50 }
assert(tissue:max "u" - tissue:min "u" < 1e-3)
