-- SPDX-License-Identifier: MIT
-- Auxin on the flank of a pin1 mutant: one primordium, whose middle is marked in the pictures, seen from where it is.
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
package.path = here .. "/../../scripts/phyllotaxis/?.lua;" .. package.path
local model = dofile(here .. "/../../scripts/phyllotaxis/auxin_application.lua")
local side
for _, each in ipairs(model.views) do
  if each.name == "side" then side = each end
end

local function marked()
  local count, x, z = 0, 0, 0
  for c in model.tissue:cells() do
    if side.markers[1](c) then count, x, z = count + 1, c.x, c.z end
  end
  return count, x, z
end

model:advance(5)
assert(marked() == 0)
model:advance(8)
local count, x, z = marked()
assert(count == 1, count)
local direction = side.camera.direction
assert(-(direction[1] * x + direction[3] * z) / math.sqrt(x * x + z * z) > 0.85)
