--- Growing cells that divide: the shapes of cells under two rules of division.
-- WHAT    one cell grows into a sheet. Under Errera's rule few cells have sharp corners; when the wall goes to the nearest
--         side instead, slivers appear.
-- HOW     lengths grow evenly; a cell divides at a threshold area, by the shortest wall through its centroid (errera) or
--         through the nearest point of its outline (closest_wall). New walls keep away from old junctions and are pinched.
-- TRY     rule=closest_wall   cells=10000   variation=0 (cells divide in step)   gx=2 gy=1 (growth mostly in x)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 3.4, figs 3.6-3.8; L. Errera 1888
local tunica = require "tunica"

local P = tunica.params {
  cells = { 4000, "cells at the end, about", min = 2 },
  rule = { "errera", "rule of division: errera or closest_wall" },
  max_area = { 1, "area at which a cell divides", min = 1e-6 },
  variation = { 0.34, "of that area from cell to cell", min = 0, max = 0.9 },
  gap = { 0.22, "least distance of a new wall from old junctions", min = 0 },
  pinch = { 0.02, "of the new wall's length, by which each end is drawn inwards", min = 0, max = 0.4 },
  gx = { 1, "growth in x", min = 0 },
  gy = { 1, "growth in y", min = 0 },
}

local tissue = tunica.polygon { 8, area = 0.6 }
local model = tunica.model { tissue = tissue, params = P, dt = 0.05, stop = math.log(P.cells) / (P.gx + P.gy) }

model:every(0.01, function()
  tissue:grow { rates = { P.gx, P.gy }, time = 0.01 }
  tissue:divide { above = P.max_area, variation = P.variation, rule = P.rule, gap = P.gap, pinch = P.pinch }
end)

-- Two stages, 12 h apart, of an Arabidopsis shoot apical meristem (segmented in MorphoGraphX; the package mgx2r ships them):
-- interior cells, neighbours across a wall, areas of the mesh.
local real = {
  apex_0h = { sides_4 = 0.054, sides_5 = 0.254, sides_6 = 0.391, sides_7 = 0.258, sides_8 = 0.040, area_cv = 0.273, lewis = 0.193 },
  apex_12h = { sides_4 = 0.040, sides_5 = 0.278, sides_6 = 0.396, sides_7 = 0.248, sides_8 = 0.037, area_cv = 0.260, lewis = 0.180 },
}

local function shapes()
  local s = tissue:statistics()
  local below_60 = 0  -- share of cells with a corner of less than 60 degrees
  for i = 1, 6 do below_60 = below_60 + s.least_angle[i] end
  local out = { below_60_degrees = below_60, area_cv = s.area_cv, lewis = s.lewis_slope, below_45_degrees = s.sharp_cells, mean_sides = s.mean_sides }
  for n = 4, 8 do out["sides_" .. n] = s.shares[n] or 0 end
  return out
end

model:view { colour = function(c) return c.side_count end, legend = "sides", palette = "viridis", range = { 3, 9 }, every = 0.1, size = { 820, 760 } }
model:report {
  model = shapes,
  real = function() return real end,
  least_angles = function() return tissue:statistics().least_angle end,  -- shares by least corner, in steps of 10 degrees
}

return model
