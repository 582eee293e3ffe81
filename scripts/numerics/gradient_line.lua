--- A gradient along a line of cells, made at one end.
-- WHAT    a substance made in the first cell spreads and decays; a gradient forms that falls by the same factor from cell to
--         cell. The model knows the exact steady state of its cells and says how far it still is from it.
-- HOW     production, diffusion and decay (9.5-9.7). Steady state: c_i = C (r^i + r^(2n+1-i)) with q = mu/2D,
--         r = 1 + q - sqrt(q (2 + q)), C = rho / (D (1 - r) (1 - r^2n)).
-- TRY     mu=0.0005 --until 20000 (a gradient as long as the line, slow to form)   n=1000   dt=0.5 (one step too long: it fails)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 9.5 (9.5-9.11)
local tunica = require "tunica"

local P = tunica.params {
  n = { 100, "cells", min = 2 },
  rho = { 1, "production in the first cell", min = 0 },
  D = { 1, "diffusion", min = 1e-9 },
  mu = { 0.01, "decay", min = 1e-12 },
  dt = { 0.4, "time step", min = 1e-9 },
  method = "euler",
}

local tissue = tunica.line { P.n }
tissue:cell { c = 0, source = function(c) return c.column == 0 and 1 or 0 end }

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = 1000 }

model:rate(function(c, d)
  d.c = P.rho * c.source - P.mu * c.c + P.D * c:sum(function(n) return n.c - c.c end)
end)

-- 1 - r and r^k without losing digits where r is near 1
local q = P.mu / (2 * P.D)
local gap = math.sqrt(q * (2 + q)) - q
local log_r = gap < 1e-4 and -gap - gap ^ 2 / 2 - gap ^ 3 / 3 or math.log(1 - gap)
local function power(k) return math.exp(k * log_r) end
local C = P.rho / (P.D * gap * (1 - power(2 * P.n)))
local function exact(i) return C * (power(i) + power(2 * P.n + 1 - i)) end

local function distance()
  local worst = 0
  for c in tissue:cells() do worst = math.max(worst, math.abs(c.c - exact(c.column + 1))) end
  return worst / exact(1)
end

model:view { colour = "c", palette = "greens", every = 20, size = { 1000, 300 } }
model:report {
  every = 20,
  first = function() return tissue:max "c" end,
  last = function() return tissue:min "c" end,
  amount = function() return tissue:sum "c" end,  -- rho / mu in the end
  distance = distance,                             -- from the exact steady state, relative to its highest
}

return model
