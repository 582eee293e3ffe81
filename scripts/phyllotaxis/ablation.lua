--- Laser ablation of cells where a primordium is about to start.
-- WHAT    the next primordium is displaced: it starts beside the cells that are dead, or elsewhere.
-- HOW     transport_apex; when auxin outside primordia comes near the threshold somewhere, the cells there die: they stay, black in
--         the pictures, and grow with the apex, but make, carry and divide nothing.
-- TRY     count=0 (the control)   after=12   count=9
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.5.3, fig. 5.13
local tunica = require "tunica"
local shoot = require "parts.shoot"

local P = tunica.params(shoot.with({}, {
  after = { 4, "from when on a primordium about to start is looked for", unit = "time", min = 0 },
  incipient = { 0.6, "auxin outside primordia at which it is found, as a share of the threshold", min = 0, max = 1 },
  count = { 5, "how many cells are killed there", min = 0, max = 1000 },
}))

if P.count ~= math.floor(P.count) then error("count must be a whole number, came " .. P.count, 0) end
local my = shoot.apex(P)
my.tissue:cell { living = 1 }
my.mortal, my.stop = true, P.after + 4
local model = shoot.model(my)
local found = {}  -- the place, and how many primordia there were
shoot.report(my, nil, {
  colour = function(c) return c.living > 0 and c.auxin or nil end, legend = "auxin", missing = { "black", title = "ablated" },
  camera = function() return shoot.facing(my, found.angle or 90) end,
})

--- The cell with the most auxin outside primordia, in the peripheral zone.
local function incipient()
  local best
  for c in my.tissue:cells() do
    local outside = c.primordium == 0 and c.a > P.central and c.a < P.central + P.peripheral
    if outside and (not best or c.auxin > best.auxin) then best = c end
  end
  return best
end

model:every(P.step, function(t)
  if found.angle or t < P.after then return end
  local cell = incipient()
  if not cell or cell.auxin < P.incipient * P.Th then return end
  found.angle, found.a = my.apex:closest(cell.x, cell.y, cell.z)
  found.time, found.before = t, #my.primordia
  if P.count > 0 then
    if P.count >= #my.tissue then error(string.format("count = %d would kill all of the %d cells", P.count, #my.tissue), 0) end
    for _, c in ipairs(my.tissue:near { { cell.x, cell.y, cell.z }, count = P.count }) do c.living, c.auxin, c.pin = 0, 0, 0 end
  end
end)

--- Where auxin jumps over the threshold between two looks, there is nothing to ablate.
function my.note()
  return not found.time and string.format("nothing was ablated: from t = %g on auxin outside primordia was never seen at %g of the " ..
    "threshold; lower incipient, or take another seed", P.after, P.incipient) or nil
end

local function following() return found.before and my.primordia[found.before + 1] end
model:report {
  ablated_at = function() return found.time or 0 end,
  ablated_angle = function() return (found.angle or 0) % 360 end,
  next_angle = function() return following() and following().angle or 0 end,
  delay = function() return following() and following().time - found.time or 0 end,
  displaced = function()
    if not following() then return 0 end
    local d = math.abs(following().angle - found.angle) % 360
    return math.min(d, 360 - d)
  end,
}

return model
