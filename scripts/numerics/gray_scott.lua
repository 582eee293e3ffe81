--- Spots that divide and stripes that branch: the model of Gray and Scott.
-- WHAT    a substance fed from outside is eaten by another, which makes more of itself from it and decays. From a patch in the
--         middle, spots spread and divide until they fill the sheet; with other numbers, stripes and worms.
-- HOW     du/dt = Du lap u - u v^2 + F (1 - u), dv/dt = Dv lap v + u v^2 - (F + k) v; on hexagons the Laplacian is 2/3 of the sum
--         over neighbours of the difference. The start is the patch of u = 1/2, v = 1/4 with 1 % noise, as in the source.
-- TRY     F=0.037 k=0.06 (a labyrinth)   F=0.03 k=0.062 (spots that divide)   sheet=true (irregular cells)   cells=120
-- SOURCE  J. E. Pearson, Science 261 (1993) 189; P. Gray, S. K. Scott, Chem. Eng. Sci. 39 (1984) 1087
local tunica = require "tunica"

local P = tunica.params {
  cells = { 70, "cells along a side", min = 8 },
  sheet = { false, "irregular cells, as of a tissue that has grown, instead of hexagons" },
  F = { 0.035, "feeding", min = 0 },
  k = { 0.065, "decay of the second", min = 0 },
  Du = { 0.16, "diffusion of the first", min = 0 },
  Dv = { 0.08, "diffusion of the second", min = 0 },
  noise = { 0.01, "of the patch at the start, relative", min = 0, max = 1 },
  dt = { 1, "time step", min = 1e-9 },
  method = "euler",
}

local tissue = P.sheet and tunica.sheet { cells = P.cells ^ 2 } or tunica.hexagons { P.cells, P.cells }

-- The patch: cells within a sixth of the sheet's width around its middle.
local x, y, n = 0, 0, tissue:count()
for c in tissue:cells() do x, y = x + c.x / n, y + c.y / n end
local radius = math.sqrt(tissue:sum "area") / 6
local function within(c, inside, outside)
  if math.abs(c.x - x) > radius or math.abs(c.y - y) > radius then return outside end
  return inside * (1 + c:uniform(-P.noise, P.noise))
end
tissue:cell { u = function(c) return within(c, 0.5, 1) end, v = function(c) return within(c, 0.25, 0) end }

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = 5000 }

model:rate(function(c, d)
  local eaten = c.u * c.v ^ 2
  d.u = P.F * (1 - c.u) - eaten + P.Du * 2 / 3 * c:sum(function(n) return n.u - c.u end)
  d.v = eaten - (P.F + P.k) * c.v + P.Dv * 2 / 3 * c:sum(function(n) return n.v - c.v end)
end)

model:view { colour = "v", palette = "viridis", every = 100, size = { 900, 820 } }
model:report {
  every = 100,
  spots = function() return tissue:count_peaks("v", 0.15) end,
  highest = function() return tissue:max "v" end,
  lowest = function() return tissue:min "v" end,
  covered = function()
    local covered = 0
    for c in tissue:cells() do covered = covered + (c.v > 0.1 and 1 or 0) end
    return covered / tissue:count()
  end,
}

return model
