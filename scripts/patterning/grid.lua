--- Auxin peaks on a square grid, formed from the outside in.
-- WHAT    30 x 30 cells without noise; the border alone breaks the symmetry, and peaks form from the outside in.
-- HOW     the equations of patterning/ring (5.1-5.3), PIN1 shared out to four neighbours; the grid does not wrap.
-- TRY     noise=0.02 (an uneven pattern)   kT=2 (other spacing)   cells=60   dt=0.02 (one step too long: it fails)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.3, fig. 5.4
local tunica = require "tunica"

local P = tunica.params {
  cells = { 30, "cells along a side", min = 2 },
  D = { 1, "diffusion", min = 0 },
  T = { 70, "transport", min = 0 },
  kT = { 1, "saturation of transport by the auxin of the receiving cell", min = 0 },
  pin = { 1, "PIN1 of a cell", min = 0 },
  noise = { 0, "of the auxin at the start, relative", min = 0, max = 1 },
  dt = { 0.01, "time step", min = 1e-9 },
  method = "euler",
}

local tissue = tunica.grid { P.cells, P.cells }
tissue:cell { auxin = function(c) return 1 + c:uniform(-P.noise, P.noise) end }

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = 60 }

model:derive(function(c) c.share = P.pin / c:sum(function(n) return n.auxin end) end)

model:flux("auxin", function(w, a, b)
  local diffusion = P.D * (a.auxin - b.auxin)
  local a_to_b = P.T * a.share * b.auxin * a.auxin / (1 + P.kT * b.auxin)
  local b_to_a = P.T * b.share * a.auxin * b.auxin / (1 + P.kT * a.auxin)
  return diffusion + a_to_b - b_to_a
end)

-- Largest difference between cells that the symmetry of the square makes equal.
local function asymmetry()
  local at, last, worst = {}, P.cells - 1, 0
  for c in tissue:cells() do at[c.row * P.cells + c.column] = c.auxin end
  for row = 0, last do
    for column = 0, last do
      local here = at[row * P.cells + column]
      for _, other in ipairs { at[column * P.cells + row], at[(last - row) * P.cells + column], at[row * P.cells + last - column] } do
        worst = math.max(worst, math.abs(here - other))
      end
    end
  end
  return worst
end

-- When cells at the border, and the one in the middle, first stray from the start by half.
local border, centre = {}, {}
for c in tissue:cells() do
  local middle = math.floor(P.cells / 2)
  if c.row == 0 then border[#border + 1] = c end
  if c.row == middle and c.column == middle then centre[1] = c end
end
local onset = { border = -1, centre = -1 }
local function watch(name, cells)
  local function strays()
    for _, c in ipairs(cells) do
      if math.abs(c.auxin - 1) > 0.5 then return true end
    end
  end
  model:when(strays, function(t)
    if onset[name] < 0 then onset[name] = t end
  end, false)
end
watch("border", border)
watch("centre", centre)

model:view { colour = "auxin", palette = "greens", every = 1, size = { 700, 640 } }
model:report {
  every = 1,
  peaks = function() return tissue:count_peaks "auxin" end,
  highest = function() return tissue:max "auxin" end,
  asymmetry = asymmetry,
  onset_border = function() return onset.border end,
  onset_centre = function() return onset.centre end,
}

return model
