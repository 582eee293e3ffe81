-- SPDX-License-Identifier: MIT
-- How a model is solved: methods, tolerance, events located in time, costs, a change of method, growth and division.
local tunica = require "tunica"
local check = require "check"

local ways = {
  { method = "euler", dt = 0.01 }, { method = "heun", dt = 0.01 }, { method = "rk4", dt = 0.01 }, { method = "rkc2", dt = 0.01 },
  { method = "sts", dt = 0.01 }, { method = "bs32" }, { method = "dp54" }, { method = "rkc2" }, { method = "dp54", dt = 0.05, tolerance = 1e-8 },
}

local function with(way, o)
  for k, v in pairs(way) do o[k] = v end
  return tunica.model(o)
end

local function ring(way, rule)
  local tissue = tunica.ring { 20 }
  tissue:cell { auxin = function(c) return 1 + c:uniform(-0.5, 0.5) end }
  local model = with(way, { tissue = tissue })
  model:rate(rule or function(c, d) d.auxin = c:sum(function(n) return n.auxin - c.auxin end) end)
  return model, tissue
end

-- Decay: exp(-t), and when it passes a half.
for _, way in ipairs(ways) do
  local tissue = tunica.ring { 5 }
  tissue:cell { auxin = 1 }
  local model = with(way, { tissue = tissue })
  model:rate(function(c, d) d.auxin = -c.auxin end)
  local half, times = nil, 0
  model:when(function() return tissue:max "auxin" < 0.5 end, function(t) half, times = t, times + 1 end)
  model:advance { to = 2 }
  check.equal(times, 1, "number of events")
  local exact = math.log(2)
  if way.method == "euler" then
    -- the grid of euler: 68 whole steps, then a part of one
    local n = math.floor(math.log(0.5) / math.log(0.99))
    exact = 0.01 * n + (1 - 0.5 / 0.99 ^ n)
  elseif way.method == "sts" then
    local left = 1  -- after a step
    for _, length in ipairs { 0.0467647832, 0.0567989334, 0.0870049301, 0.1858308206, 0.6236005327 } do left = left * (1 - length * 0.01) end
    exact = 0.01 * math.log(0.5) / math.log(left)
  end
  local allowed = (way.method == "heun" or way.method == "sts") and 2e-5 or way.method == "rkc2" and 5e-5 or 2e-6
  check.near(half, exact, allowed, way.method .. ": time of the event")
  check.near(tissue:max "auxin", math.exp(-2), (way.method == "euler" or way.method == "sts") and 2e-3 or 3e-5, way.method)
  check.near(model.time, 2, 1e-9)
end

-- The step ends where the condition became true, to rounding: nothing of the interpolation stays. (That between the ends of a
-- step of sts is a straight line, which only euler's own steps follow.)
for _, way in ipairs(ways) do
  local model, tissue = ring(way, function(c, d, t) d.auxin = 1 + 0.2 * t end)
  local least = tissue:min "auxin"
  local level
  model:when(function() return tissue:min "auxin" >= least + 0.3 end, function() level = tissue:min "auxin" end)
  model:advance { to = 1 }
  check.near(level, least + 0.3, way.method == "sts" and 1e-5 or 1e-7, way.method)
end

-- A condition that an event makes true happens with it; one that is true at the start, at the start.
do
  local model, tissue = ring { method = "euler", dt = 0.03 }
  local when, first
  model:at(0.25, function() tissue:find(3).auxin = 10 end)
  model:when(function() return tissue:max "auxin" > 5 end, function(t) when = t end)
  model:when(function() return #tissue == 20 end, function(t) first = t end)
  model:advance { to = 0.5 }
  check.equal(when, 0.25)
  check.equal(first, 0)
end

-- What only watches changes no step.
do
  local model, tissue = ring { method = "euler", dt = 0.01 }
  local other, same = ring { method = "euler", dt = 0.01 }
  local limit, when = 0.5 * (1 + tissue:max "auxin")
  model:when(function() return tissue:max "auxin" < limit end, function(t) when = t end, false)
  model:advance { to = 1 }
  other:advance { to = 1 }
  check.equal(same:hash(), tissue:hash())
  check.near(when / 0.01, math.floor(when / 0.01 + 0.5), 1e-9)
end

-- After an event within it, a fixed step ends on the grid again.
do
  local model, tissue = ring { method = "heun", dt = 0.01 }
  local limit = 0.1 + 0.9 * tissue:max "auxin"
  model:when(function() return tissue:max "auxin" < limit end, function(t) assert(t > 0 and t < 0.5) end)
  model:advance { to = 0.5 }
  check.equal(model.steps, 51)
end

-- Pauses and conditions: the same bits, also where an output falls into a step before a condition's event.
for _, way in ipairs(ways) do
  local function make()
    local model, tissue = ring(way)
    local limit = tissue:max "auxin"
    for k = 1, 4 do
      model:when(function() return tissue:max "auxin" < 1 + (limit - 1) * (1 - k / 6) end, function() tissue:find(k).auxin = tissue:find(k).auxin + 0.01 end)
    end
    return model, tissue
  end
  local straight, paused, resumed, hopping = make(), make(), make(), make()
  straight:advance { to = 2 }
  local t, snapshot = 0, nil
  repeat
    t = t + 0.07
    repeat local status = paused:advance { to = 2, pause = t } until status == "done" or paused.time >= t - 1e-9
    if not snapshot and t > 0.6 then snapshot = paused:snapshot() end
    hopping:restore(hopping:snapshot())
    while hopping.time < paused.time - 1e-9 do hopping:advance { to = 2, pause = t } end
  until paused.time >= 2 - 1e-9
  check.equal(paused:hash(), straight:hash(), way.method .. " with pauses")
  check.equal(hopping:hash(), straight:hash(), way.method .. " restored at each pause")
  resumed:restore(snapshot)
  resumed:advance { to = 2 }
  check.equal(resumed:hash(), straight:hash(), way.method .. " resumed")
end

-- Adaptive methods pause exactly.
for _, way in ipairs { { method = "dp54" }, { method = "rkc2" }, { method = "bs32" } } do
  local model, tissue = ring(way, function(c, d) d.auxin = -c.auxin end)
  local start = tissue:max "auxin"
  for i = 1, 9 do
    check.equal(model:advance { to = 3, pause = i / 3 }, i < 9 and "paused" or "done")
    check.equal(model.time, i / 3)
    check.near(tissue:max "auxin", start * math.exp(-i / 3), 3e-5, way.method)
  end
end

-- Growth and division, events that change little: the steps go on.
for _, way in ipairs(ways) do
  local function make()
    local tissue = tunica.sheet { cells = 40, seed = 2 }
    tissue:cell { auxin = function(c) return 1 + c:uniform(-0.5, 0.5) end }
    local model = with(way, { tissue = tissue })
    model:rate(function(c, d) d.auxin = c:sum(function(n, w) return w.length * (n.auxin - c.auxin) end) / c.area end)
    model:every(0.2, function() tissue:grow { rate = 0.1, time = 0.2 } end)
    model:every(0.5, function() tissue:divide { above = 1.02 } end)
    return model, tissue
  end
  local ok, model, tissue = pcall(make)
  assert(ok, model)
  model:advance { to = 1.1 }
  local snapshot = model:snapshot()
  model:advance { to = 3 }
  assert(#tissue > 40, "divisions")
  check.valid(tissue)
  if not way.dt then assert(model.cost.steps < 400, way.method .. " takes " .. model.cost.steps .. " steps") end
  local other = make()
  other:restore(snapshot)
  other:advance { to = 3 }
  check.equal(other:hash(), model:hash(), way.method)
end

-- Another method from a state on; snapshots serve under another method.
do
  local model, tissue = ring { method = "euler", dt = 0.01 }
  model:advance { to = 0.5 }
  local snapshot = model:snapshot()
  local function under(solution)
    model:solve_with(solution)
    model:restore(snapshot)
    check.equal(model.time, 0.5)
    model:advance { to = 1 }
    return tissue:max "auxin", model.cost, model:hash()
  end
  local exact = under { method = "dp54", tolerance = 1e-10 }
  for _, way in ipairs(ways) do
    local value, cost, hash = under(way)
    check.near(value, exact, (way.method == "euler" or way.method == "sts") and 1e-3 or 2e-5, way.method)
    assert(cost.steps > 0 and cost.evaluations >= cost.steps and cost.seconds > 0, way.method)
    check.equal(cost.cell_steps, cost.steps * 20)
    local _, _, again = under(way)
    check.equal(again, hash, way.method .. " from the same snapshot again")
  end
  under { method = "euler", dt = 0.005 }
  check.equal(model.cost.steps, 100, "steps of half the length")
  under { dt = 0.01 }
  check.equal(model.cost.steps, 50, "dt alone")
  model:solve_with { method = "rkc2", tolerance = 1e-5 }
  model:advance { to = 1.5 }
  model:solve_with { method = "heun" }  -- with the dt it had
end

-- A method given in an event.
do
  local model = ring { method = "euler", dt = 0.01 }
  model:at(0.5, function() model:solve_with { method = "dp54" } end)
  model:advance { to = 1 }
  check.equal(model.about.method, "dp54")
  check.near(model.about.tolerance, 1e-6, 0)
end

-- Errors
local tissue = tunica.ring { 5 }
tissue:cell { auxin = 1 }
check.fails(function() tunica.model { tissue = tissue, method = "euler" } end, "dt", "euler")
check.fails(function() tunica.model { tissue = tissue, method = "dp54", tolerance = 0 } end, "tolerance", "greater than 0")
check.fails(function() tunica.model { tissue = tissue, method = "dp45" } end, "dp54")
local model = tunica.model { tissue = tissue, method = "rkc2" }
check.fails(function() model:solve_with { method = "rk5" } end, "rk4")
check.fails(function() model:solve_with { method = "euler" } end, "dt")
