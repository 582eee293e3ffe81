--- Spots by an activator and an inhibitor: the test problem of the methods of integration.
-- WHAT    an activator that makes itself and a faster inhibitor, from a state at rest with a little noise. As printed, about
--         two dozen spots; with the inhibitor 25 times faster, a stiff problem of which two spots are left at t = 300.
-- HOW     (9.12, 9.13) on 50 x 50 cells; nothing passes the border. The state at rest is found here, where both rates are 0.
-- TRY     stiff=true dt=0.002 --until 300   dt=0.063 (one step too long: it fails)   method=heun   start=splitmix
--         then: tunica chart numerics/activator_inhibitor --until 50      tunica stability numerics/activator_inhibitor --until 50
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, sections 9.5-9.7. It prints no parameters: these are a fit to the
--         number of spots and the largest steps that it names
local tunica = require "tunica"

local P = tunica.params {
  cells = { 50, "cells along a side", min = 3 },
  stiff = { false, "the inhibitor 25 times faster" },
  ra = { 1, "production of the activator by itself", min = 0 },
  sa = { 0.02, "production of the activator by default", min = 0 },
  ma = { 0.2, "decay of the activator", min = 0 },
  Da = { 0.2, "diffusion of the activator", min = 0 },
  rh = { 1, "production of the inhibitor by the activator", min = 0 },
  sh = { 0, "production of the inhibitor by default", min = 0 },
  mh = { 0.32, "decay of the inhibitor", min = 0 },
  Dh = { 4, "diffusion of the inhibitor", min = 0 },
  noise = { 0.01, "at the start, relative", min = 0, max = 1 },
  start = { "cells", "random numbers of the noise: cells (each has its own) or splitmix (one row of them, cell by cell)" },
  dt = { 0.05, "time step", min = 1e-9 },
  method = "euler",
}
if P.stiff then P.Dh = 25 * P.Dh end

-- The state at rest: h = (rh a^2 + sh) / mh, and a from the other equation, by halving an interval that holds it.
local function at_rest()
  local function h_of(a) return (P.rh * a ^ 2 + P.sh) / P.mh end
  local low, high = 0, (P.sa + P.ra * P.mh / math.max(P.rh, 1e-9)) / P.ma + 1
  for _ = 1, 200 do
    local a = (low + high) / 2
    if P.ra * a ^ 2 / (1 + h_of(a)) + P.sa > P.ma * a then low = a else high = a end
  end
  return low, h_of(low)
end
local a0, h0 = at_rest()

-- SplitMix64 (Steele, Lea, Flood 2014): the start of a run elsewhere, to compare figures with.
local function splitmix(seed)
  local state = 0ULL + seed
  return function()
    state = state + 0x9e3779b97f4a7c15ULL
    local z = state
    z = bit.bxor(z, bit.rshift(z, 30)) * 0xbf58476d1ce4e5b9ULL
    z = bit.bxor(z, bit.rshift(z, 27)) * 0x94d049bb133111ebULL
    return tonumber(bit.rshift(bit.bxor(z, bit.rshift(z, 31)), 11)) * 2 ^ -53
  end
end

local tissue = tunica.grid { P.cells, P.cells }
tissue:cell {
  a = function(c) return a0 * (1 + c:uniform(-P.noise, P.noise, "activator")) end,
  h = function(c) return h0 * (1 + c:uniform(-P.noise, P.noise, "inhibitor")) end,
}
if P.start == "splitmix" then
  local draw = splitmix(1)
  for c in tissue:cells() do  -- around 1.503012, 7.075367, as there: 0.1 and 0.5 % off the rest of the parameters above
    c.a = 1.503012 * (1 + P.noise * (2 * draw() - 1))
    c.h = 7.075367 * (1 + P.noise * (2 * draw() - 1))
  end
end

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = 150 }

model:rate(function(c, d)
  d.a = P.ra * c.a ^ 2 / (1 + c.h) + P.sa - P.ma * c.a + P.Da * c:sum(function(n) return n.a - c.a end)
  d.h = P.rh * c.a ^ 2 + P.sh - P.mh * c.h + P.Dh * c:sum(function(n) return n.h - c.h end)
end)

-- Spots: cells with more activator than all eight around them, and well above the mean.
local function spots()
  local at, mean = {}, tissue:mean "a"
  local least, found = mean + 0.25 * (tissue:max "a" - mean), 0
  for c in tissue:cells() do at[(c.row + 1) * (P.cells + 2) + c.column + 1] = c.a end
  for c in tissue:cells() do
    local k, highest = (c.row + 1) * (P.cells + 2) + c.column + 1, c.a > least
    for row = -1, 1 do
      for column = -1, 1 do
        local other = at[k + row * (P.cells + 2) + column]
        highest = highest and (other == nil or other <= c.a)
      end
    end
    found = found + (highest and 1 or 0)
  end
  return found
end

model:view { colour = "a", palette = "magma", legend = "activator", every = 5, size = { 700, 640 } }
model:report {
  every = 5,
  spots = spots,
  highest = function() return tissue:max "a" end,
  lowest = function() return tissue:min "a" end,
  inhibitor = function() return tissue:mean "h" end,
}

return model
