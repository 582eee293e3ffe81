--- A growing apex with the neighbourhoods of a cylinder.
-- WHAT    rings of cells move down an apex; where the first ring has gone far enough from the tip, a new one is put in.
-- HOW     each ring has a distance from the tip along the profile; it moves with the speed (3.2) that growth above it gives.
--         Tissue grows near the tip only. All cells of the first ring share the place of the tip.
-- TRY     around=40   limit=0.1   zone=0.6 (rings further apart)   zone=10 (growth everywhere)   profile=dome
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, sections 3.3 and 3.4, figs 3.3 and 3.4
local tunica = require "tunica"

local P = tunica.params {
  around = { 24, "cells in a ring", min = 3 },
  limit = { 0.15, "distance from the tip at which a ring is put in", min = 0.01 },
  rate = { 1, "relative elemental rate of growth", min = 0 },
  zone = { 0.35, "distance from the tip within which tissue grows", min = 0.01 },
  profile = { "hemisphere_cylinder", "form of the apex: a name among the shipped curves, or a file" },
  length = { 3.2, "of the profile; rings further down go", min = 0.5 },
}

-- Growth at the given rate within the zone, none outside.
local growth = tunica.curve { { 0, P.rate }, { P.zone, P.rate }, { 1.01 * P.zone, 0 }, degree = 1 }
local apex = tunica.apex { profile = P.profile, growth = growth }
local tissue = tunica.cylinder { around = P.around, rows = 2 }
tissue:cell { a = function(c) return c.row * P.limit * 0.9 end }  -- distance from the tip along the profile

local model = tunica.model { tissue = tissue, params = P, dt = 0.02, stop = 12 }

local function rows() return math.floor(tissue:max "row") + 1 end
local function place_of_row(row)
  for c in tissue:cells() do
    if c.row == row then return c.a end
  end
end

model:every(0.02, function()
  for c in tissue:cells() do c.a = apex:after(c.a, 0.02) end
  while place_of_row(1) > P.limit do tissue:insert_row(0) end
  while place_of_row(rows() - 1) > P.length and rows() > 2 do tissue:remove_row() end
end)

local function on_apex(c) return apex:position(360 * c.column / P.around, c.a) end

model:view { colour = "a", legend = "distance from the tip", palette = "viridis", place = on_apex, every = 0.25, size = { 760, 800 },
  camera = { direction = { 0, -0.55, -1 }, up = { 0, 1, 0 } } }
model:report { every = 0.5, rings = rows, furthest = function() return tissue:max "a" end }

return model
