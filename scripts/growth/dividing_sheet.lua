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
  variation = { 0.3, "of that area from cell to cell", min = 0, max = 0.9 },
  gx = { 1, "growth in x", min = 0 },
  gy = { 1, "growth in y", min = 0 },
}

local tissue = tunica.polygon { 8, area = 0.6 }
local model = tunica.model { tissue = tissue, params = P, dt = 0.05, stop = math.log(P.cells) / (P.gx + P.gy) }

model:every(0.01, function()
  tissue:grow { rates = { P.gx, P.gy }, time = 0.01 }
  tissue:divide { above = P.max_area, variation = P.variation, rule = P.rule }
end)

-- Two stages, 12 h apart, of an Arabidopsis shoot apical meristem (segmented in MorphoGraphX; the package mgx2r ships them):
-- interior cells, neighbours across a wall, areas of the mesh.
local real = {
  apex_0h = { sides_4 = 0.054, sides_5 = 0.254, sides_6 = 0.391, sides_7 = 0.258, sides_8 = 0.040, area_cv = 0.273, lewis = 0.193 },
  apex_12h = { sides_4 = 0.040, sides_5 = 0.278, sides_6 = 0.396, sides_7 = 0.248, sides_8 = 0.037, area_cv = 0.260, lewis = 0.180 },
}

local function shapes()
  local s = tissue:statistics()
  local out = { area_cv = s.area_cv, lewis = s.lewis_slope, sharp_cells = s.sharp_cells, mean_sides = s.mean_sides }
  for n = 4, 8 do out["sides_" .. n] = s.shares[n] or 0 end
  return out
end

model:view { colour = function(c) return c.side_count end, legend = "sides", palette = "viridis", range = { 3, 9 }, every = 0.1, size = { 820, 760 } }
model:report {
  model = shapes,
  real = function() return real end,
}

return model
