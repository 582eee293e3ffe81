-- SPDX-License-Identifier: MIT
-- Phyllotaxis on a cylinder: whorls by the number of cells around, all else the same; spirals that go on from peaks put there.
local core = require "tunica.core"
local params = require "tunica.params"
local script = debug.getinfo(1, "S").source:match "^@(.*)/" .. "/../../scripts/phyllotaxis/transport_cylinder.lua"

--- The reports at the end of a run, by name. Arguments as on the command line.
local function run(arguments)
  local given = core.overrides()
  for name in pairs(given) do given[name] = nil end
  for name, value in pairs(arguments) do given[name] = tostring(value) end
  params.forget()
  local model, found = dofile(script), {}
  model:advance { to = model.stop }
  for _, each in ipairs(model.reports) do found[each.name] = each.fn() end
  return found
end

local function check(condition, what, found)
  assert(condition, string.format("%s: %s; divergences %s", what, found.pattern, found.divergences))
end

-- Set W: the same values but for the number of cells in a ring
for variant, jugacy in pairs { distichous = 1, decussate = 2, tricussate = 3 } do
  local found = run { variant = variant }
  local name, whorls = found.pattern:match "^(%a+)", 0
  check(name == variant, "not " .. variant, found)
  for n in found.per_whorl:gmatch "%d+" do
    check(tonumber(n) == jugacy, "uneven whorls " .. found.per_whorl, found)
    whorls = whorls + 1
  end
  check(whorls >= 8 and found.within == 1, whorls .. " whorls", found)
  if variant == "distichous" then check(math.abs(math.abs(found.mean) - 180) < 3, "mean " .. found.mean, found) end
end

-- Spirals that go on from peaks put there, nearly without noise
local function spiral(arguments, least, low, high, deviation)
  local found = run(arguments)
  check(found.primordia >= least, found.primordia .. " primordia", found)
  check(found.mean > low and found.mean < high and found.deviation < deviation, "no spiral", found)
  return found
end
spiral({ variant = "fibonacci", insertions = 120 }, 25, 131, 134, 8)
local lucas = spiral({ variant = "lucas", insertions = 70 }, 20, 96, 103, 6)
local turning = spiral({ variant = "spiro_distichous", insertions = 80 }, 20, 165, 172, 6)
assert(lucas.within > 0.9 and turning.within > 0.9)
