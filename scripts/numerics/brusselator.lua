--- Spots of the Brusselator on hexagonal cells.
-- WHAT    a reaction of two substances that would rest if it were stirred; since the second spreads faster, spots appear, each
--         with six others around it.
-- HOW     du/dt = A - (B + 1) u + u^2 v + Du lap u, dv/dt = B u - u^2 v + Dv lap v; the sum over neighbours stands for the Laplacian.
--         From rest, u = A and v = B / A, with a little noise. Patterns need B > (1 + A sqrt(Du / Dv))^2, rest of the whole
--         needs B < 1 + A^2.
-- TRY     B=4 (no pattern)   B=5 (weak spots, slow to come)   sheet=true (irregular cells)   dt=0.03 (too long: it fails)
-- SOURCE  I. Prigogine, R. Lefever, J. Chem. Phys. 48 (1968) 1695; the patterns: B. Pena, C. Perez-Garcia, Phys. Rev. E 64
--         (2001) 056213
local tunica = require "tunica"

local P = tunica.params {
  cells = { 40, "cells along a side", min = 3 },
  sheet = { false, "irregular cells, as of a tissue that has grown, instead of hexagons" },
  A = { 3, "supply of u", min = 1e-6 },
  B = { 6, "turnover of u to v", min = 0 },
  Du = { 1, "diffusion of u", min = 0 },
  Dv = { 8, "diffusion of v", min = 0 },
  noise = { 0.01, "at the start, relative", min = 0, max = 1 },
  dt = { 0.01, "time step", min = 1e-9 },
  method = "euler",
}

local tissue = P.sheet and tunica.sheet { cells = P.cells ^ 2 } or tunica.hexagons { P.cells, P.cells }
tissue:cell {
  u = function(c) return P.A * (1 + c:uniform(-P.noise, P.noise, "u")) end,
  v = function(c) return P.B / P.A * (1 + c:uniform(-P.noise, P.noise, "v")) end,
}

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = 50 }

model:rate(function(c, d)
  d.u = P.A - (P.B + 1) * c.u + c.u ^ 2 * c.v + P.Du * c:sum(function(n) return n.u - c.u end)
  d.v = P.B * c.u - c.u ^ 2 * c.v + P.Dv * c:sum(function(n) return n.v - c.v end)
end)

model:view { colour = "u", palette = "viridis", every = 1, size = { 900, 820 } }
model:report {
  every = 1,
  spots = function() return tissue:count_peaks "u" end,
  spacing = function() return (select(2, tissue:peaks "u")) end,
  highest = function() return tissue:max "u" end,
  lowest = function() return tissue:min "u" end,
}

return model
