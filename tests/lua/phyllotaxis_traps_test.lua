-- SPDX-License-Identifier: MIT
-- What a model of phyllotaxis must notice: values that change where it cannot see, fields that come back, pauses, misuse.
local tunica = require "tunica"
local check = require "check"

local function make(options)
  options.path = options.path or function(age) return math.exp(age), 0 end
  options.samples = options.samples or 90
  return tunica.phyllotaxis(options)
end
local function plain(d, age) return math.exp(-age) / d end

--- The first field now at an angle (degrees), by hand.
local function by_hand(model, f, angle)
  local sum = 0
  for _, p in ipairs(model:primordia()) do
    local x, z = math.cos(math.rad(angle)), math.sin(math.rad(angle))
    sum = sum + f(math.sqrt((p.x - x) ^ 2 + (p.z - z) ^ 2 + p.y ^ 2), p.age, model.time)
  end
  return sum
end

-- a global, and a value in a table, that events change
decay = 1
local held = { decay = function() return decay end }
for _, f in ipairs { function(d, age) return math.exp(-decay * age) / d end, function(d, age) return math.exp(-held.decay() * age) / d end } do
  decay = 1
  local model = make {}
  model:inhibition { field = f, below = 3 }
  model:at(1, function() decay = 3 end)
  model:advance(2)
  check.near(model:field(3), by_hand(model, f, 3), 1e-9)
end

-- a threshold that a global holds: the insertion is at the event, not later
level = 0.001
local model = make {}
model:inhibition { field = plain, below = function() return level end }
model:at(1.5, function() level = 4 end)
model:advance(2)
check.near(model:primordia()[2].time, 1.5, 1e-12)

-- a rule that decides by the time is run as it is
local stepped = function(d, age, t) return (type(t) == "number" and t > 1 and 5 or 1) * math.exp(-age) / d end
model = make {}
model:inhibition { field = stepped, below = 3 }
model:advance(2)
check.near(model:field(3), by_hand(model, stepped, 3), 1e-9)
assert(#model.about.warnings == 1)

-- shares that come back: with age, and with time
local function at_end(f, drop)
  local m = make { path = function(age) return 1, -age end, drop = drop }
  m:inhibition { field = f, below = 3 }
  m:advance(6.5)
  return m:field(3)
end
local function late(d, age) return (math.exp(-20 * age) + math.exp(-((age - 3) / 0.05) ^ 2)) / d end
local function relaxing(d, age, t) return math.exp(-tunica.where(tunica.above(t, 6), 0.1, 20) * age) / d end
for _, f in ipairs { late, relaxing } do check.near(at_end(f, nil), at_end(f, 0), 1e-5) end

-- thresholds that come and go are not missed, however long the pause
model = make {}
model:inhibition { field = plain, below = function(t) return (t > 60 and t < 70) and 3 or 0 end }
model:advance(100)
assert(model.count > 50, model.count)

-- pauses do not move the time of a condition
local times = {}
for _, pause in ipairs { 100, 0.07 } do
  local m, found = make {}, nil
  m:inhibition { field = plain, below = 3 }
  m:when(function(t) return t >= 1.23456789 end, function(t) found = found or t end)
  for k = 1, math.ceil(2 / pause) do m:advance { to = 2, pause = k * pause } end
  times[#times + 1] = found
end
assert(times[1] == times[2] and math.abs(times[1] - 1.23456789) < 1e-6)

-- old primordia: far beyond all numbers, and still listed
model = tunica.phyllotaxis { apex = tunica.apex { profile = "disk", growth = 1 }, radius = 1, samples = 36 }
model:inhibition { field = plain, below = 0.4 }
model:primordium { angle = 0, age = 800 }
model:advance(1)
assert(model:primordia()[1].a == nil and model:pattern().primordia >= 1)

-- misuse
check.fails(function()
  local m = make {}
  m:inhibition { field = function(d, age) return math.random() * math.exp(-age) / d end, below = 3 }
  m:advance(5)
end, "changes as it is called")
check.fails(function()
  local m = make { path = function(age) return 1 - age, 0 end }
  m:inhibition { field = plain, below = 3 }
  m:advance(5)
end, "crosses the axis")
check.fails(function()
  local one, other = make {}, make { samples = 180 }
  for _, m in ipairs { one, other } do m:inhibition { field = plain, below = 3 } end
  other:restore(one:snapshot())
end, "90 samples", "180")
check.fails(function() make {}:every(1e-12, function() end) end, "would not move on")
check.fails(function() make {}:view { lattice = true, arrows = true } end, "lattice shows no field")
check.fails(function() make {}:view { parastichies = { 0, 0 } } end, "parastichies: two numbers")
check.fails(function()
  local once = tunica.bulges { on = tunica.apex { profile = "dome" }, radius = 0.3, height = 0.01 }
  tunica.bulges { on = once, radius = 0.3, height = 0.01 }
end, "bulges already")
