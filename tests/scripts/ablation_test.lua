-- SPDX-License-Identifier: MIT
-- Ablation: as many cells as asked for die, are black in the pictures, stay dead and undivided, and hold nothing; the camera of the
-- view from the side looks at them. (What becomes of the next primordium: tests/shell/transport_test.sh.)
local here = debug.getinfo(1, "S").source:match "^@(.*)/"
package.path = here .. "/../../scripts/phyllotaxis/?.lua;" .. package.path
local model = dofile(here .. "/../../scripts/phyllotaxis/ablation.lua")
local view = require "tunica.view"
local tissue, P = model.tissue, model.params

local function reported(name)
  for _, report in ipairs(model.reports) do
    if report.name == name then return report.fn() end
  end
end

local side
for _, each in ipairs(model.views) do
  if each.name == "side" then side = each end
end
local function without_colour()
  local count = 0
  for c in tissue:cells() do
    if side.colour(c) == nil then count = count + 1 end
  end
  return count
end

assert(without_colour() == 0)
model:advance(4)
assert(reported "ablated_at" == 0 and without_colour() == 0)
assert(reported "note":find "nothing was ablated")
local t = 4
repeat
  t = t + 0.2
  model:advance(t)
until reported "ablated_at" > 0 or t > 8
local at = reported "ablated_at"
assert(at > 4 and at < 8, at)
assert(reported "note" == "", reported "note")
assert(without_colour() == P.count, without_colour())
assert(side.missing[1] == "black")
assert(reported "cells" == #tissue - P.count)

-- From there on dead cells neither take part nor divide.
local auxin, pin = 0, 0
for c in tissue:cells() do
  if c.living == 0 then auxin, pin = auxin + c.auxin, pin + c.pin end
  for s in c:sides() do
    if c.living == 0 then assert(s.pin == 0) end
    local n = s.neighbour
    if n and n.living == 0 then assert(s.pin == 0) end
  end
end
assert(auxin == 0 and pin == 0)

-- The camera looks against the outward direction of the place.
local direction, x, z, n = side.camera().direction, 0, 0, 0
for c in tissue:cells() do
  if c.living == 0 then x, z, n = x + c.x, z + c.z, n + 1 end
end
local cosine = -(direction[1] * x + direction[3] * z) / math.sqrt(x * x + z * z)
assert(cosine > 0.95, cosine)

-- Black pixels are there, and are not before.
if view.available() then
  local picture = view.draw(model, side)
  local living = {}
  for key, value in pairs(side) do living[key] = value end
  living.missing = "white"
  assert(picture ~= view.draw(model, living))
end
