-- SPDX-License-Identifier: MIT
-- Rules that could go wrong without a word: each once did.
local tunica = require "tunica"
local check = require "check"

local P = tunica.params { on = true }

local function ring(rule)
  local tissue = tunica.ring { 6 }
  tissue:cell { auxin = function(c) return c.id end, e = 0 }
  local model = tunica.model { tissue = tissue, dt = 0.1, params = P }
  if rule then model:rate(rule) end
  return model, tissue
end

local function grown(model, tissue)
  model:advance { to = 1 }
  return tissue:find(1).auxin - 1
end

-- a parameter that is no number, a value in a table, a value held by a helper: changed by an event half way
local model, tissue = ring(function(c, d) d.auxin = P.on and 1 or 0 end)
model:at(0.5, function() P.on = false end)
check.near(grown(model, tissue), 0.5, 1e-12, "parameter")

local k = { v = 1 }
model, tissue = ring(function(c, d) d.auxin = k.v end)
model:at(0.5, function() k.v = 0 end)
check.near(grown(model, tissue), 0.5, 1e-12, "table")

local held = 1
local function helper(x) return held * x end
model, tissue = ring(function(c, d) d.auxin = helper(1) end)
model:at(0.5, function() held = 0 end)
check.near(grown(model, tissue), 0.5, 1e-12, "helper")

-- what holds at one moment: the model's time, a maximum over the tissue
model, tissue = ring(function(c, d) d.auxin = model.time end)
check.near(grown(model, tissue), 0.45, 1e-12, "model.time")
model, tissue = ring(function(c, d) d.auxin = -0.1 * tissue:max "auxin" * c.auxin end)
local one, six = 1, 6
for _ = 1, 10 do one, six = one - 0.01 * six * one, six - 0.01 * six * six end
check.near(grown(model, tissue), one - 1, 1e-12, "maximum")

-- one particular cell, read by all
model, tissue = ring()
local first = tissue:find(1)
model:rate(function(c, d) d.auxin = first.auxin end)
check.near(grown(model, tissue), 1.1 ^ 10 - 1, 1e-12, "one cell")

-- a rate written before the derived column it reads
model, tissue = ring(function(c, d) d.auxin = -c.e end)
model:derive(function(c) c.e = c.auxin end)
check.near(grown(model, tissue), 0.9 ^ 10 - 1, 1e-12, "rate before derive")

-- a derived column of walls, read from both sides of a wall
model, tissue = ring()
tissue:wall { dk = 0 }
model:derive("wall", function(w, a, b) w.dk = a.auxin + 3 * b.auxin end)
model:rate(function(c, d) d.auxin = c:sum(function(n, w) return w.dk end) end)
local expected = {}
for c in tissue:cells() do
  expected[c.id] = c.auxin
  for n, w in c:neighbours() do
    local a, b = w:cells()
    expected[c.id] = expected[c.id] + 0.1 * (a.auxin + 3 * b.auxin)
  end
end
model:advance { to = 0.1 }
for c in tissue:cells() do check.near(c.auxin, expected[c.id], 1e-12, "cell " .. c.id) end

-- the number of neighbours in arithmetic
local sheet = tunica.hexagons { 3, 3 }
sheet:cell { u = 1, v = 2 }
model = tunica.model { tissue = sheet, dt = 0.01 }
model:rate(function(c, d) d.v = tunica.tanh(c:sum(function() return 1 end)) + c.u * tunica.min(c.valence, c.u) end)
model:advance { to = 0.02 }
for c in sheet:cells() do check.near(c.v, 2 + 0.02 * (math.tanh(c.valence) + math.min(c.valence, 1)), 1e-14) end

local function must_fail(set_up, text)
  local m, t = ring()
  set_up(m, t)
  local ok, message = pcall(m.advance, m, { to = 0.2 })
  assert(not ok and message:find(text, 1, true), "expected '" .. text .. "' in: " .. tostring(message))
  check.equal(#t, 6, "cells")
end

must_fail(function(m) m:rate(function(c, d) d.auxin = 1 end) m:derive(function(c) c.auxin = 7 end) end, "derived")
must_fail(function(m) m:derive(function(c) c.e = c.e + 1 end) end, "refers to itself")
must_fail(function(m) m:rate(function(c, d) m:advance { to = 1 } d.auxin = 0 end) end, "model")
must_fail(function(m) m:rate(function(c, d) pcall(c.remove, c) c:remove() d.auxin = 0 end) end, "structure")
must_fail(function(m)
  m:at(0.1, function() m:advance { to = 2 } end)
  m:rate(function(c, d) d.auxin = 0 end)
end, "while the model runs")

-- math.random in events comes back with a snapshot
model, tissue = ring(function(c, d) d.auxin = 0 end)
model:every(0.1, function() tissue:find(1).auxin = math.random() end)
model:advance { to = 0.3 }
local snapshot = model:snapshot()
model:advance { to = 0.6 }
local hash = model:hash()
model:restore(snapshot)
model:advance { to = 0.6 }
check.equal(model:hash(), hash)

-- A table that a rule holds and an event changes, also behind a metatable or back from no number: rates follow at once.
for what, change in pairs {
  key = function(K) K.y = 5 end,
  metatable = function(K) setmetatable(K, { __index = { y = 5 } }) end,
  nan = function(K) K.z = nil K.y = 5 end,
} do
  local K, count = { x = 1, z = 0 / 0 }, 0
  local changed, t = ring(function(c, d) d.auxin = (K.x or 0) + (K.y or 0) end)
  local before = t:find(1).auxin
  changed:every(1, function()
    count = count + 1
    if count == 20 then change(K) end
  end)
  changed:advance { to = 22 }
  check.near(t:find(1).auxin, before + 20 * 1 + 2 * 6, 1e-9, what)
end

-- Parameters as options are looked at by name.
do
  local _, t = ring(function(c, d) d.auxin = 0 end)
  t:cell(setmetatable({}, { __pairs = function() return next, { level = 2 } end }))
  check.equal(t:find(1).level, 2)
  check.fails(function() tunica.sheet(setmetatable({}, { __pairs = function() return next, { cels = 5 } end })) end, "did you mean 'cells'")
end
