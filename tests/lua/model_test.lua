-- SPDX-License-Identifier: MIT
-- tunica.model as a script sees it: rules traced and untraced, events, snapshots, errors.
local tunica = require "tunica"
local check = require "check"

local function sheet(columns)
  local tissue = tunica.sheet { cells = 60, seed = 2 }
  tissue:cell(columns or { auxin = function(c) return c:uniform(0.5, 1.5) end })
  return tissue
end

-- What a rule gives in one Euler step, against a loop written by hand over handles.
local function compare(rule, by_hand)
  local tissue = sheet { auxin = function(c) return c:uniform(0.5, 1.5) end, zone = function(c) return c.id % 3 end }
  local expected = {}
  for c in tissue:cells() do expected[c.id] = c.auxin + 0.01 * by_hand(c) end
  local model = tunica.model { tissue = tissue, dt = 0.01 }
  model:rate(rule)
  model:advance { to = 0.01 }
  for c in tissue:cells() do check.near(c.auxin, expected[c.id], 1e-12 * math.abs(expected[c.id]) + 1e-14, "cell " .. c.id) end
  return model.about
end

local function spread(c)
  local sum = 0
  for n, w in c:neighbours() do sum = sum + w.length * (n.auxin - c.auxin) end
  return sum
end

-- traced
local about = compare(function(c, d) d.auxin = 0.3 * c:sum(function(n, w) return w.length * (n.auxin - c.auxin) end) - c.auxin ^ 2 end,
  function(c) return 0.3 * spread(c) - c.auxin ^ 2 end)
assert(about.rules[1].traced)
-- a sum of a neighbour's sum
about = compare(function(c, d) d.auxin = c:sum(function(n) return n:sum(function(m) return m.auxin end) end) end,
  function(c)
    local sum = 0
    for n in c:neighbours() do
      for m in n:neighbours() do sum = sum + m.auxin end
    end
    return sum
  end)
assert(about.rules[1].traced)
-- decides by == : must be run as it is, not silently wrong
about = compare(function(c, d) if c.zone == 1 then d.auxin = 1 else d.auxin = -1 end end, function(c) return c.zone == 1 and 1 or -1 end)
assert(not about.rules[1].traced and about.warnings[1]:find "==")
-- decides by <
about = compare(function(c, d) if c.auxin < 1 then d.auxin = 1 else d.auxin = 0 end end, function(c) return c.auxin < 1 and 1 or 0 end)
assert(not about.rules[1].traced and about.warnings[1]:find("where", 1, true))
-- the same with where
about = compare(function(c, d) d.auxin = tunica.where(tunica.below(c.auxin, 1), 1, 0) end, function(c) return c.auxin < 1 and 1 or 0 end)
assert(about.rules[1].traced)

-- A flux conserves amounts; a flux that depends on which cell is called a is an error.
do
  local tissue = sheet()
  local function amount()
    local sum = 0
    for c in tissue:cells() do sum = sum + c.auxin * c.area end
    return sum
  end
  local before = amount()
  local model = tunica.model { tissue = tissue, dt = 0.001 }
  model:flux("auxin", function(w, a, b) return w.length * (a.auxin - b.auxin) end)
  model:advance { to = 0.1 }
  check.near(amount(), before, 1e-12 * before)
  local wrong = tunica.model { tissue = sheet(), dt = 0.001 }
  wrong:flux("auxin", function(w, a, b) return w.length * a.auxin end)
  local ok, message = pcall(wrong.advance, wrong, { to = 0.1 })
  assert(not ok and message:find("opposite sign", 1, true), message)
end

-- Parameters and numbers held by rules may change between steps.
do
  local tissue = tunica.ring { 5 }
  tissue:cell { auxin = 0 }
  local P, held = tunica.params { rate = 1 }, 1
  local model = tunica.model { tissue = tissue, params = P, dt = 0.5 }
  model:rate(function(c, d) d.auxin = P.rate * held end)
  model:at(1, function() P.rate = 10 end)
  model:at(2, function() held = 100 end)
  model:advance { to = 3 }
  check.near(tissue:max "auxin", 1 + 10 + 1000, 1e-9)
end

-- Events: order, times, and what a snapshot brings back: tissue, time, counters that functions keep.
do
  local tissue = sheet()
  local model = tunica.model { tissue = tissue, dt = 0.03 }
  local seen, count = {}, 0
  model:rate(function(c, d) d.auxin = 0.1 end)
  model:every(0.1, function(t) count = count + 1 seen[#seen + 1] = t end)
  model:at(0.25, function() tissue:divide { above = 0.4 } end)
  model:when(function() return #tissue > 60 end, function() seen.grown = true end)
  model:advance { to = 0.15 }
  local snapshot, hash = model:snapshot(), model:hash()
  model:advance { to = 0.5 }
  local after = model:hash()
  check.equal(count, 5)
  check.near(seen[3], 0.3, 1e-12)
  assert(seen.grown and #tissue > 60)
  model:restore(snapshot)
  check.equal(model:hash(), hash, "hash")
  check.equal(count, 1, "count")
  check.equal(#seen, 1, "times seen")
  check.equal(#tissue, 60, "cells")
  model:advance { to = 0.5 }
  check.equal(model:hash(), after, "hash after going on from the snapshot")
  check.valid(tissue)
end

-- Events more often than steps: each at its time, with the state of that time.
do
  local tissue = tunica.ring { 5 }
  tissue:cell { auxin = 0 }
  local model = tunica.model { tissue = tissue, dt = 1 }
  model:rate(function(c, d) d.auxin = 2 end)
  local often, seldom = 0, 0
  model:every(0.3, function(t)
    often = often + 1
    check.near(t, 0.3 * often, 1e-12)
    check.near(tissue:max "auxin", 2 * t, 1e-9)
  end)
  model:every(0.002, function() seldom = seldom + 1 end)
  model:advance { to = 3 }
  check.equal(often, 10)
  check.equal(seldom, 1500)
end

-- Columns of sides: derived, and with rates.
do
  local tissue = sheet()
  tissue:side { level = 1 }
  local model = tunica.model { tissue = tissue, dt = 0.1 }
  model:derive("side", function(s) s.step = s.neighbour.auxin - s.cell.auxin end)
  model:rate("side", function(s, d) d.level = s.step - s.opposite.step end)
  model:advance { to = 0.1 }
  for s in tissue:sides() do
    if s.neighbour then
      check.near(s.step, s.neighbour.auxin - s.cell.auxin, 1e-15)
      check.near(s.level, 1 + 0.1 * 2 * s.step, 1e-12)
    else
      check.equal(s.level, 1, "level of a border side")
    end
  end
end

-- Errors say what and where.
local tissue = sheet()
local model = tunica.model { tissue = tissue, dt = 0.1 }
check.fails(function() tunica.model { tissue = tissue, dt = -1 } end, "dt", "greater than 0")
check.fails(function() tunica.model { tissue = tissue, dt = 1, methd = "euler" } end, "methd", "method")
check.fails(function() tunica.model { tissue = tissue, dt = 1, method = "eulr" } end, "euler")
check.fails(function() model:rate(5) end, "or a function")
check.fails(function() model:rate(print, print) end, "one rule at a time")
check.fails(function() model:derive(print, print) end, "one rule at a time")
check.fails(function() model:rate("cell", print, print) end, "one more")
check.fails(function() model:every(-1, print) end, "interval")
check.fails(function() model:every(1e-12, print) end, "interval 1e-12", "dt = 0.1")
check.fails(function() return model.tim end, "time")
do
  local bad = tunica.model { tissue = sheet(), dt = 0.1 }
  bad:rate(function(c, d) d.auxin = c.auxn end)
  local ok, message = pcall(bad.advance, bad, { to = 1 })
  assert(not ok and message:find("auxn", 1, true) and message:find("auxin", 1, true) and message:find("model_test.lua:%d+"), message)
  check.fails(function()
    local misspelt = tunica.model { tissue = sheet(), dt = 0.1, signed = { "auxin", "auxn" } }
    misspelt:rate(function(c, d) d.auxin = 0 end)
    misspelt:advance { to = 1 }
  end, "'auxn'", "did you mean 'auxin'")
  local changing = tunica.model { tissue = sheet(), dt = 0.1 }
  changing:rate(function(c, d)
    if c.auxin > 0 then c:remove() end
    d.auxin = 0
  end)
  ok, message = pcall(changing.advance, changing, { to = 1 })
  assert(not ok and message:find("structure", 1, true), message)
end
