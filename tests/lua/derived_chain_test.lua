-- SPDX-License-Identifier: MIT
-- A derived column that rules read, and that others derive from: it is written in the last pass and read in earlier ones.
local tunica = require "tunica"
local check = require "check"

local function auxin_after(capped)
  local tissue = tunica.sheet { cells = 40, seed = 2 }
  tissue:cell { auxin = function(c) return 1 + c:uniform(0, 1) end, pin = 1 }
  local model = tunica.model { tissue = tissue, dt = 0.005 }
  local function level(c) return capped and c.level or c.auxin end
  if capped then model:derive(function(c) c.level = tunica.min(c.auxin, 100) end) end
  model:derive(function(c) c.pull = 3 ^ level(c) end)
  model:derive(function(c) c.share = c.pin / c:sum(function(n, w) return w.length * n.pull end) end)
  model:rate(function(c, d) d.auxin = 1 - 0.2 * c.auxin - 10 * tunica.max(0, c.auxin - 100) end)
  model:flux("auxin", function(w, a, b)
    local there = a.share * b.pull * level(a) ^ 2 / (1 + level(b) ^ 2)
    local back = b.share * a.pull * level(b) ^ 2 / (1 + level(a) ^ 2)
    return w.length * (4 * (level(a) - level(b)) + 20 * (there - back))
  end)
  model:advance(0.5)
  if capped then
    for c in tissue:cells() do check.equal(c.level, c.auxin) end
  end
  return tissue
end

local plain, capped = auxin_after(false), auxin_after(true)
for c in plain:cells() do check.near(capped:find(c.id).auxin, c.auxin, 1e-12) end
