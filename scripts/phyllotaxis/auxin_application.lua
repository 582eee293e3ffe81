--- Auxin given to the apex of a pin1 mutant.
-- WHAT    given to the flank, auxin makes one primordium there; given to the tip, a ring of primordia around it.
-- HOW     pin1_mutant, with auxin supplied to the cells near a place for some time; it spreads by diffusion.
-- TRY     variant=tip   theta=90   rate=3 (too little)   to=20 (others follow)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.5.3, figs 5.12b and 5.12c
local tunica = require "tunica"
local shoot = require "parts.shoot"

local P = tunica.params(shoot.with({ rho_pin0 = 0, rho_pin = 0, pin = 0, initial = 0 }, {
  theta = { 0, "where auxin is given: angle", unit = "degrees" },
  a = { 3, "and arc length from the tip", min = 0 },
  reach = { 0.5, "how far from there cells get it", min = 0 },
  rate = { 15, "how much, for each of these cells", unit = "concentration / time", min = 0 },
  from = { 5, "when it is given first", unit = "time", min = 0 },
  to = { 7, "when no more", unit = "time", min = 0 },
  variant = { "flank", "flank or tip" },
  variants = { flank = {}, tip = { a = 0, reach = 1.2, rate = 40, to = 6, height = 0.4 } },
}))

local my = shoot.apex(P)
my.stop = P.from + 5
local model = shoot.model(my)

--- Whether a cell is the middle of a primordium. Without PIN1 the colour of auxin shows none: it is nearly the same everywhere.
local function middle(c)
  if c.closeness == 0 then return false end
  for n in c:neighbours() do
    if n.primordium == c.primordium and n.closeness > c.closeness then return false end
  end
  return true
end
shoot.report(my, nil, { markers = { middle, shape = "disc", colour = "white" },
  camera = P.a > 0 and shoot.facing(my, P.theta) or nil })
model:supply { "auxin", rate = P.rate, from = P.from, to = P.to,
  cells = function() return my.tissue:near { on = my.apex, theta = P.theta, a = P.a, radius = P.reach } end }

--- How the primordia lie: their distance from where auxin was given (flank), the largest gap between two around the tip.
local function gaps()
  local angles = {}
  for i, p in ipairs(my.primordia) do angles[i] = p.angle end
  table.sort(angles)
  local widest = 0
  for i, angle in ipairs(angles) do widest = math.max(widest, ((angles[i + 1] or angles[1] + 360) - angle)) end
  return widest
end
model:report {
  highest = function() return my.tissue:max "auxin" end,
  farthest = function()
    local farthest, x, y, z = 0, my.apex:position(P.theta, P.a)
    for _, p in ipairs(my.primordia) do
      local px, py, pz = my.apex:position(p.angle, p.a)
      farthest = math.max(farthest, math.sqrt((px - x) ^ 2 + (py - y) ^ 2 + (pz - z) ^ 2))
    end
    return farthest
  end,
  widest_gap = gaps,
}

return model
