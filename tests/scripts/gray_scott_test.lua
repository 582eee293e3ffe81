-- SPDX-License-Identifier: MIT
-- The patch becomes spots, which divide and spread; without a patch nothing happens.
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
local model = dofile(here .. "/../../scripts/numerics/gray_scott.lua")
local tissue = model.tissue
local start = model:snapshot()

local function spots() return tissue:count_peaks("v", 0.15) end
model:advance { to = 1500 }
local before = spots()
model:advance { to = 5000 }
assert(before >= 4 and spots() > before, before .. " spots, then " .. spots())
assert(tissue:max "v" < 0.5 and tissue:min "v" >= 0 and tissue:max "u" <= 1)

model:restore(start)
for c in tissue:cells() do c.u, c.v = 1, 0 end
model:advance { to = 100 }
assert(tissue:max "v" == 0 and tissue:min "u" == 1)
