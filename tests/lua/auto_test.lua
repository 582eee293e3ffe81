-- SPDX-License-Identifier: MIT
-- The method `auto`: what it chooses, that it says why, that it costs no more than half as much again as the best of its
-- candidates, and that a run goes on in the same bits after a restart. And steady states.
local tunica = require "tunica"
local check = require "check"

local function spots(method, tolerance, Dh)
  local tissue = tunica.grid { 30, 30 }
  tissue:cell { a = function(c) return 1.501 * (1 + c:uniform(-.01, .01, "a")) end, h = function(c) return 7.04 * (1 + c:uniform(-.01, .01, "h")) end }
  local model = tunica.model { tissue = tissue, method = method, tolerance = tolerance }
  model:rate(function(c, d)
    d.a = c.a ^ 2 / (1 + c.h) + .02 - .2 * c.a + .2 * c:sum(function(n) return n.a - c.a end)
    d.h = c.a ^ 2 - .32 * c.h + Dh * c:sum(function(n) return n.h - c.h end)
  end)
  return model, tissue
end

local function circles(method, tolerance)  -- no diffusion, smooth: nothing bounds the step but accuracy
  local tissue = tunica.ring { 300 }
  tissue:cell { x = function(c) return 1 + 0.1 * c:uniform() end, y = 0 }
  local model = tunica.model { tissue = tissue, method = method, tolerance = tolerance, signed = { "x", "y" } }
  model:rate(function(c, d) d.x, d.y = c.y, -c.x end)
  return model, tissue
end

local function evaluations(make, method, tolerance, until_time, ...)
  local model = make(method, tolerance, ...)
  model:advance { to = until_time }
  return model.cost.evaluations, model
end

for _, tolerance in ipairs { 1e-2, 1e-3, 1e-4, 1e-5 } do
  for _, case in ipairs { { spots, 100, 4 }, { spots, 30, 100 }, { circles, 100 } } do
    local make, until_time, Dh = unpack(case)
    local best = math.huge
    for _, method in ipairs { "rkc2", "bs32", "dp54" } do best = math.min(best, (evaluations(make, method, tolerance, until_time, Dh))) end
    local own, model = evaluations(make, "auto", tolerance, until_time, Dh)
    assert(own <= 1.5 * best + 150, string.format("auto took %d evaluations at tolerance %g, the best %d (%s)", own, tolerance, best, model.about.why))
    assert(model.about.why:find(model.about.chosen, 1, true) == 1 and model.about.why:find "spectral radius")
  end
end
local _, model = evaluations(spots, "auto", 1e-4, 100, 4)
assert(model.about.chosen == "rkc2", model.about.why)
local _, model = evaluations(circles, "auto", 1e-5, 100)
assert(model.about.chosen == "dp54", model.about.why)

-- without method and dt it is auto; with dt alone forward Euler, as ever
assert(circles(nil, nil).about.method == "auto")
local tissue = tunica.ring { 10 }
assert(tunica.model { tissue = tissue, dt = 1 }:solution().method == "euler")

-- the same bits after going back to a snapshot, also one taken between choices
local model = spots("auto", 1e-4, 4)
model:advance { to = 7 }
local snapshot = model:snapshot()
model:advance { to = 40 }
local hash = model:hash()
model:restore(snapshot)
model:advance { to = 40 }
assert(model:hash() == hash)

-- steady states
local tissue = tunica.line { 200 }
tissue:cell { c = 3, source = function(c) return c.column == 0 and 1 or 0 end }
local model = tunica.model { tissue = tissue }
model:rate(function(c, d) d.c = c.source - .01 * c.c + c:sum(function(n) return n.c - c.c end) end)
local found = model:steady()
assert(found.how == "elimination" and found.stable and math.abs(found.growth + .01) < 1e-14 and found.residual < 1e-15)
assert(math.abs(tissue:sum "c" - 100) < 1e-9 and model.time == 0)
model:advance(50)
assert(math.abs(tissue:sum "c" - 100) < 1e-3, "nothing changes from there")

local model, tissue = spots("auto", 1e-4, 4)
for c in tissue:cells() do c.a, c.h = 1.4, 7.2 end
local found = model:steady()
assert(found.how == "newton" and found.stable == false and found.growth > 0)
assert(math.abs(tissue:max "a" - 1.50101377) < 1e-7 and math.abs(tissue:min "h" - 7.04075728) < 1e-7)

local tissue = tunica.ring { 20 }
tissue:cell { c = 1 }
local model = tunica.model { tissue = tissue }
model:rate(function(c, d) d.c = c:sum(function(n) return n.c - c.c end) end)
check.fails(function() model:steady() end, "not determined")
assert(tissue:min "c" == 1)

-- Rules that cannot be traced: implicit methods and steady states by finite differences, as far as the rules read
local function pumped(traced)
  local tissue = tunica.grid { 8, 8 }
  tissue:cell { u = function(c) return 1 + c:uniform(-.3, .3) end }
  local model = tunica.model { tissue = tissue, method = "bdf", tolerance = 1e-8 }
  model:derive(function(c) c.load = c:sum(function(n) return n.u end) end)
  model:rate(function(c, d)
    local rate = 1 - c.u + 0.1 * c:sum(function(n) return n.load * n.u - c.load * c.u end)
    if not traced and c.id < 0 and c.u > 1e9 then rate = 0 end  -- reads a value to decide: not traced
    d.u = rate
  end)
  return model, tissue
end
local exact, exact_tissue = pumped(true)
local differences, tissue = pumped(false)
exact:advance { to = 3 }
differences:advance { to = 3 }
assert(#differences.about.warnings == 1 and #exact.about.warnings == 0)
for c in tissue:cells() do check.near(c.u, exact_tissue:find(c.id).u, 1e-6, "by differences") end
assert(differences:steady().how == "newton" and exact:steady().how == "newton")
for c in tissue:cells() do check.near(c.u, exact_tissue:find(c.id).u, 1e-8, "steady by differences") end
