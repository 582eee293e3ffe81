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
  print(found.pattern, found.divergences, found.per_whorl, found.within, os.clock())
  check(name == variant, "not " .. variant, found)
  for n in found.per_whorl:gmatch "%d+" do
    check(tonumber(n) == jugacy, "uneven whorls " .. found.per_whorl, found)
    whorls = whorls + 1
  end
  check(whorls >= 8 and found.within == 1, whorls .. " whorls", found)
  if variant == "distichous" then check(math.abs(math.abs(found.mean) - 180) < 3, "mean " .. found.mean, found) end
end

-- Set F1
local found = run { variant = "fibonacci" }
check(found.primordia >= 25 and found.mean > 131 and found.mean < 134 and found.deviation < 8, "no spiral", found)
