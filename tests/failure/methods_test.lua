-- SPDX-License-Identifier: MIT
-- Where each method must stop: a rate that becomes infinite stops every one within one step and names the cell; results that
-- look right and are not are told from right ones.
local tunica = require "tunica"
local core = require "tunica.core"

for _, way in ipairs(core.methods_of_solution()) do
  local tissue = tunica.ring { 20 }
  tissue:cell { a = 1, b = 1 }
  local model = tunica.model { tissue = tissue, method = way.name, dt = .1 }
  model:rate(function(c, d, t)
    d.a = -c.a
    d.b = 0.1 / (c.column - 7 + 100 * tunica.below(t, 0.5)) - c.b  -- from t = 0.5 on infinite in the eighth cell
  end)
  model:at(0.5, function() end)
  local ok, message = pcall(model.advance, model, { to = 2 })
  assert(not ok and message:find "b" and message:find "in cell 8 at time 0%.[56] ", way.name .. ": " .. tostring(message))
  local f = model.failure
  assert((f.kind == "not finite" or f.kind == "step size") and f.column == "b" and f.id == 8, way.name .. ": " .. f.kind)
  assert(model.time > 0.3 and model.time <= 0.5 + 1e-9 and tissue:max "b" < 2, way.name .. ": the last good state is kept")
end

-- The grid of solvers that fail in silence: 50 x 50 cells, the inhibitor 25 times faster.
local function spots(o, Dh)
  local tissue = tunica.grid { 50, 50 }
  tissue:cell { a = function(c) return 1.501 * (1 + c:uniform(-.01, .01, "a")) end, h = function(c) return 7.04 * (1 + c:uniform(-.01, .01, "h")) end }
  o.tissue = tissue
  local model = tunica.model(o)
  model:rate(function(c, d)
    d.a = c.a ^ 2 / (1 + c.h) + .02 - .2 * c.a + .2 * c:sum(function(n) return n.a - c.a end)
    d.h = c.a ^ 2 - .32 * c.h + Dh * c:sum(function(n) return n.h - c.h end)
  end)
  return model, tissue
end

-- "Stable for any step": backward Euler's Newton iteration finds no root once spots form, and must not call a NaN converged.
for _, case in ipairs { { "backward_euler", 1 }, { "backward_euler", 2 }, { "crank_nicolson", 4 } } do
  local model, tissue = spots({ method = case[1], dt = case[2] }, 100)
  local ok, message = pcall(model.advance, model, { to = 60 })
  assert(not ok and message:find "newton", case[1] .. ": " .. tostring(message))
  assert(tissue:max "a" == tissue:max "a" and tissue:max "a" < 1e3 and model.time > 0)
end

-- A loose tolerance gives another pattern without a word; against a tighter one the places of the spots show it.
local function places(tolerance)
  local model, tissue = spots({ method = "bdf", tolerance = tolerance }, 100)
  model:advance { to = 45 }
  local found, least = {}, tissue:mean "a" + 0.25 * (tissue:max "a" - tissue:mean "a")
  for c in tissue:cells() do
    local highest = c.a > least
    for n in c:neighbours() do highest = highest and n.a <= c.a end
    if highest then found[#found + 1] = c.id end
  end
  return table.concat(found, " "), model.cost
end
local loose, middle, tight = (places(1e-2)), (places(1e-6)), (places(1e-7))
assert(middle == tight, "the pattern has converged: " .. middle .. " / " .. tight)
assert(loose ~= tight, "at a loose tolerance it is another: " .. loose)
