--- Auxin peaks in a sheet of cells that grows and divides.
-- WHAT    cells pump auxin towards neighbours that have more of it; evenly spaced peaks appear, PIN1 turned towards them.
--         With growth, new peaks form where cells have drifted far enough from the old ones.
-- HOW     a cell shares its PIN1 out to its walls by their length and, exponentially, by the auxin behind them (5.7);
--         PIN1 and auxin are made and decay (5.8, 5.9). Cells divide by Errera's rule at a threshold area.
-- TRY     growth=0 (a sheet at rest)   rho=4 (no pattern)   D=3 (more peaks)   b=4   dt=0.02 (one step too long: it fails)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, sections 3.4, 5.5, figs 3.7 and 5.7
local tunica = require "tunica"

local P = tunica.params {
  cells = { 510, "cells at the start", min = 1 },
  T = { 22.5, "transport", min = 0 },
  D = { 4, "diffusion", min = 0 },
  b = { 3, "base of the allocation of PIN1", min = 1 },
  kT = { 1, "saturation of transport", min = 0 },
  rho = { 6, "production of auxin", min = 0 },
  kI = { 1, "saturation of that production", min = 0 },
  mu = { 0.5, "decay of auxin", min = 0 },
  rho_pin0 = { 0.6, "production of PIN1", min = 0 },
  rho_pin = { 0.5, "production of PIN1 for each unit of auxin", min = 0 },
  kP = { 1, "saturation of that production", min = 0 },
  mu_pin = { 1, "decay of PIN1", min = 0 },
  growth = { 0.005, "rate at which lengths grow", min = 0 },
  max_area = { 0.75, "area at which a cell divides", min = 1e-6 },
  variation = { 0.15, "of that area from cell to cell", min = 0, max = 0.9 },
  dt = { 0.01, "time step", min = 1e-9 },
  method = "euler",
}

local tissue = tunica.sheet { cells = P.cells, max_area = P.max_area, variation = P.variation }
tissue:cell { auxin = function(c) return 1 + c:uniform(-0.01, 0.01) end, pin = 0.94 }

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = 60 }

model:derive(function(c) c.pull = P.b ^ c.auxin end)
model:derive(function(c) c.share = c.pin / c:sum(function(n, w) return w.length * n.pull end) end)
model:derive("side", function(s) s.pin = s.cell.share * s.neighbour.pull end)  -- PIN1 on a wall for each unit of its length

model:rate(function(c, d)
  d.auxin = P.rho / (1 + P.kI * c.auxin) - P.mu * c.auxin
  d.pin = (P.rho_pin0 + P.rho_pin * c.auxin) / (1 + P.kP * c.pin) - P.mu_pin * c.pin
end)

model:flux("auxin", function(w, a, b)
  local a_to_b = a.share * b.pull * a.auxin ^ 2 / (1 + P.kT * b.auxin ^ 2)
  local b_to_a = b.share * a.pull * b.auxin ^ 2 / (1 + P.kT * a.auxin ^ 2)
  return w.length * (P.D * (a.auxin - b.auxin) + P.T * (a_to_b - b_to_a))
end)

if P.growth > 0 then
  model:every(0.5, function()
    tissue:grow { rate = P.growth, time = 0.5 }
    tissue:divide { above = P.max_area, variation = P.variation, rule = "errera" }
  end)
end

-- PIN1 is nearly the same in all cells but those of peaks.
local function pin_between_peaks()
  local sum, n = 0, 0
  for c in tissue:cells() do
    if c.auxin < 4 then sum, n = sum + c.pin, n + 1 end
  end
  return n > 0 and sum / n or 0
end

model:view { colour = "auxin", palette = "greens", range = { 0, 12 }, sides = { "pin", colour = "#e02020" }, every = 1, size = { 900, 820 } }
model:report {
  every = 1,
  peaks = function() return (tissue:count_peaks("auxin", 5)) end,
  spacing = function() return (select(2, tissue:peaks("auxin", 5))) end,
  spacing_cv = function() return (select(3, tissue:peaks("auxin", 5))) end,
  highest = function() return tissue:max "auxin" end,
  mean = function() return tissue:mean "auxin" end,
  pin_between_peaks = pin_between_peaks,
}

return model
