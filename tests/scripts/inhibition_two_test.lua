-- SPDX-License-Identifier: MIT
-- The shipped model of two inhibitors: decussate from one primordium on; bijugate or a spiral when the threshold rises later.
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
local model = dofile(here .. "/../../scripts/phyllotaxis/inhibition_two.lua")
local P = model.params
local start = model:snapshot()

local function run(change)
  model:restore(start)
  P.change = change
  model:advance()
  return model:pattern { first = 21, last = 60 }, model:pattern { first = 121, last = 200 }
end

for change, expected in pairs { [1] = "decussate", [1.3] = "Fibonacci spiral", [2] = "bijugate Fibonacci spiral" } do
  local before, after = run(change)
  assert(before.name == "decussate" and math.abs(before.mean - 90) < 0.5, tostring(before))
  assert(after.name == expected, string.format("threshold times %g: %s", change, tostring(after)))
end
