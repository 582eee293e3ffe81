--- Spots by an activator and a fast inhibitor, on a grid.
-- WHAT    an activator that makes itself and its own inhibitor; the inhibitor spreads faster, and spots remain.
-- HOW     reaction and diffusion (9.12, 9.13) on 50 x 50 cells with noise at the start.
-- TRY     Dh=100 dt=0.0025 (the inhibitor 25 times faster: few spots remain)   dt=0.063 (one step too long: it fails)
--         method=heun   cells=100
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 9.6
local tunica = require "tunica"

local P = tunica.params {
  cells = { 50, "cells along a side", min = 3 },
  ra = { 1, "production of the activator by itself", min = 0 },
  sa = { 0.02, "production of the activator by default", min = 0 },
  ma = { 0.2, "decay of the activator", min = 0 },
  Da = { 0.2, "diffusion of the activator", min = 0 },
  rh = { 1, "production of the inhibitor by the activator", min = 0 },
  sh = { 0, "production of the inhibitor by default", min = 0 },
  mh = { 0.32, "decay of the inhibitor", min = 0 },
  Dh = { 4, "diffusion of the inhibitor", min = 0 },
  noise = { 0.05, "at the start, relative", min = 0, max = 1 },
  dt = { 0.05, "time step", min = 1e-9 },
  method = "euler",
}

local tissue = tunica.grid { P.cells, P.cells, wrap = "both" }
tissue:cell {
  a = function(c) return 1 + c:uniform(-P.noise, P.noise, "activator") end,
  h = function(c) return 1 + c:uniform(-P.noise, P.noise, "inhibitor") end,
}

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = 150 }

model:rate(function(c, d)
  d.a = P.ra * c.a ^ 2 / (1 + c.h) + P.sa - P.ma * c.a + P.Da * c:sum(function(n) return n.a - c.a end)
  d.h = P.rh * c.a ^ 2 + P.sh - P.mh * c.h + P.Dh * c:sum(function(n) return n.h - c.h end)
end)

model:view { colour = "a", palette = "magma", legend = "activator", every = 5, size = { 700, 640 } }
model:report {
  every = 5,
  spots = function() return tissue:count_peaks "a" end,
  highest = function() return tissue:max "a" end,
  lowest = function() return tissue:min "a" end,
}

return model
