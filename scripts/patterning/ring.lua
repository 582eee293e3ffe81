--- Auxin peaks on a ring of cells.
-- WHAT    fifty cells in a ring; each sends its auxin to the neighbour that has more; evenly spaced peaks appear.
-- HOW     the efflux carrier PIN1 of a cell is shared out to its two sides in proportion to the neighbours' auxin (5.1);
--         carriers and diffusion move auxin (5.2, 5.3). A little noise at the start breaks the symmetry.
-- TRY     D=1.5 or T=40 (fewer peaks)   D=0.5 or T=180 (more)   D=1 T=17 (none)   dt=0.025 (one step too long: it fails)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.3, figs 5.2 and 5.3
local tunica = require "tunica"

local P = tunica.params {
  cells = { 50, "cells in the ring", min = 3 },
  D = { 1, "diffusion", min = 0 },
  T = { 70, "transport", min = 0 },
  kT = { 2, "saturation of transport by the auxin of the receiving cell", min = 0 },
  pin = { 1, "PIN1 of a cell", min = 0 },
  noise = { 0.02, "of the auxin at the start, relative", min = 0, max = 1 },
  dt = { 0.02, "time step", min = 1e-9 },
  method = "euler",
}

local tissue = tunica.ring { P.cells }
tissue:cell { auxin = function(c) return 1 + c:uniform(-P.noise, P.noise) end }

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = 100 }

-- PIN1 of a cell for each unit of auxin around it: (5.1) without the factor of the neighbour
model:derive(function(c) c.share = P.pin / c:sum(function(n) return n.auxin end) end)

model:flux("auxin", function(w, a, b)
  local diffusion = P.D * (a.auxin - b.auxin)
  local a_to_b = P.T * a.share * b.auxin * a.auxin / (1 + P.kT * b.auxin)
  local b_to_a = P.T * b.share * a.auxin * b.auxin / (1 + P.kT * a.auxin)
  return diffusion + a_to_b - b_to_a
end)

model:view { colour = "auxin", palette = "greens", every = 2, size = { 1000, 400 } }
model:report {
  every = 1,
  peaks = function() return tissue:count_peaks "auxin" end,
  highest = function() return tissue:max "auxin" end,
  auxin = function() return tissue:sum "auxin" end,
}

return model
