--- Cells on the dome of a growing shoot apex.
-- WHAT    cells at the tip of an apex grow, divide and are carried down its flanks, where they leave the picture. Under
--         Errera's rule they look like those of a real apex; when the wall goes to the nearest side, slivers appear.
-- HOW     points move away from the tip along the profile with the speed (3.2) and keep their angle; growth is slower at the
--         tip than around it. Cells divide at a threshold area, and all of it is done on the surface, in space.
-- TRY     rule=closest_wall gap=0.05 pinch=0 (fig. 3.8a)   rule=along (the direction of slower growth)   profile=arabidopsis   colour=clone
--         growth=constant   max_area=0.003   variation=0
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, sections 3.3 and 3.4, figs 3.3, 3.6 and 3.8; L. Errera 1888
local tunica = require "tunica"

local P = tunica.params {
  profile = { "dome", "form of the apex: a name among the shipped curves, or a file" },
  growth = { "raised", "relative elemental growth rate by arc length: likewise" },
  to = { 2.2, "arc length from the tip at which cells leave the picture", min = 0.1 },
  rule = { "errera", "of division: errera, closest_wall or along (the direction of slower growth)" },
  max_area = { 0.012, "area at which a cell divides", min = 1e-4 },
  variation = { 0.3, "of that area from cell to cell", min = 0, max = 0.9 },
  gap = { 0.22, "least distance of a new wall from old junctions, relative to the root of max_area", min = 0, max = 1 },
  pinch = { 0.04, "of the new wall's length, by which each end is drawn inwards", min = 0, max = 0.4 },
  colour = { "area", "what colours show: area, or clone (the descent from the cells at the start)" },
}

local apex = tunica.apex { profile = P.profile, growth = P.growth }
local tissue = tunica.apex_tissue { on = apex, to = P.to, max_area = P.max_area, variation = P.variation }
tissue:cell { clone = function(c) return c:uniform(0, 1, "clone") end }
if P.rule == "along" then tissue:locate { on = apex } end  -- the rule needs to know where cells are

--- The principal direction of slower growth at a cell: walls parallel to it keep cells from getting longer and longer.
local function slower(c)
  local x, _, down = apex:profile(c.a)
  if x > 0 and apex:speed(c.a) * down / x > apex:growth(c.a) then  -- faster around than along the profile
    local x1, y1, z1 = apex:position(c.theta, c.a)
    local x2, y2, z2 = apex:position(c.theta, c.a + 1e-3)
    return x2 - x1, y2 - y1, z2 - z1
  end
  return -math.sin(math.rad(c.theta)), 0, math.cos(math.rad(c.theta))
end

local model = tunica.model { tissue = tissue, params = P, dt = 0.02, stop = 6 }

model:every(0.02, function()
  tissue:grow { on = apex, time = 0.02 }
  tissue:divide { above = P.max_area, variation = P.variation, rule = P.rule, on = apex,
    direction = P.rule == "along" and slower or nil, gap = P.gap * math.sqrt(P.max_area), pinch = P.pinch }
  tissue:remove { on = apex, beyond = P.to }
end)

-- Two stages, 12 h apart, of an Arabidopsis shoot apical meristem (segmented in MorphoGraphX; the package mgx2r ships them):
-- interior cells, neighbours across a wall, areas of the mesh.
local real = {
  apex_0h = { sides_4 = 0.054, sides_5 = 0.254, sides_6 = 0.391, sides_7 = 0.258, sides_8 = 0.040, mean_sides = 5.967, variance_sides = 0.915, area_cv = 0.273 },
  apex_12h = { sides_4 = 0.041, sides_5 = 0.278, sides_6 = 0.396, sides_7 = 0.248, sides_8 = 0.037, mean_sides = 5.963, variance_sides = 0.836, area_cv = 0.260 },
}

local function shapes()
  local s = tissue:statistics()
  local below_60 = 0  -- share of cells with a corner of less than 60 degrees
  for i = 1, 6 do below_60 = below_60 + s.least_angle[i] end
  local out = { mean_sides = s.mean_sides, variance_sides = s.variance_sides, area_cv = s.area_cv,
    below_60_degrees = below_60, below_45_degrees = s.sharp_cells, four_way = s.four_way, lewis = s.lewis_slope }
  for n = 4, 8 do out["sides_" .. n] = s.shares[n] or 0 end
  return out
end

local shown = { every = 0.25, light = true, size = { 820, 760 } }
if P.colour == "clone" then
  shown.colour, shown.range, shown.palette, shown.legend = "clone", { 0, 1 }, "cyclic", false
else
  shown.colour, shown.palette, shown.legend = "area", "viridis", "area"
  shown.range = { 0, P.max_area * (1 + P.variation) }
end
local function view(name, camera)
  local options = { name = name, camera = camera }
  for key, value in pairs(shown) do options[key] = value end
  model:view(options)
end
view("side", { direction = { 0, -0.45, -1 }, up = { 0, 1, 0 } })
view("top", { direction = { 0, -1, 0 }, up = { 0, 0, -1 } })
model:report {
  model = shapes,
  real = function() return real end,
  cells = function() return #tissue end,
}

return model
