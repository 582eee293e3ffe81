-- SPDX-License-Identifier: MIT
-- A model of phyllotaxis: its words, its events, what it says of wrong input, and that the same script gives the same bits.
local tunica = require "tunica"
local check = require "check"

local P = tunica.params { b = 1, threshold = 5, long = 1 }

local function disk(options, below, field)
  options = options or {}
  options.path = options.path or function(age) return math.exp(age), 0 end
  options.samples = options.samples or 180
  local model = tunica.phyllotaxis(options)
  model:inhibition { field = field or function(d, age) return math.exp(-P.b * age) / d end, below = below or P.threshold }
  return model
end

-- The field of one primordium is exact; divergences, ages and places are told.
do
  local model = disk({}, 1e-9)
  model:primordium { angle = 0, age = 1 }
  local e = math.exp(1)
  check.near(model:field(0), 1 / e / (e - 1), 1e-15)
  check.near(model:field(180), 1 / e / (e + 1), 1e-15)
  check.near(model:field(180, e, 0), 1 / e / (2 * e), 1e-15)
  local p = model:primordia()[1]
  check.near(p.x, e, 1e-15)
  check.equal(p.number, 1)
  check.equal(p.initial, true)
  check.equal(p.divergence, nil)
end

-- Lattice start; what follows is near the angle at which it started.
do
  local model = disk { stop = { primordia = 120 } }
  model:initial { count = 30, angle = 137.51 }
  check.equal(model:advance(), "done")
  local list = model:primordia()
  check.equal(#list, 120)
  check.equal(model.count, 120)
  for i = 90, 120 do check.near(math.abs(list[i].divergence), 137.1, 3, "divergence") end
  check.near(list[31].time, 0, 1e-3)
  check.near((list[31].angle + 180) % 360, 180, 4)
  assert(tostring(model:pattern()):find "Fibonacci")
  assert(model:pattern { expected = { angle = 137.51 } }.judgement.hold)
end

-- Pauses, pictures and snapshots change no bit; a snapshot is gone back to.
local function course(pauses)
  local model = disk({ jitter = { angle = 0.5, along = 0 }, samples = 90 }, function(t) return 3 + math.sin(t) end)
  local log, seen = {}, 0
  model:every(0.5, function(t) seen = seen + #model.angles log[#log + 1] = t end)
  model:after(20, function(t) P.b = 1.2 log[#log + 1] = "after " .. #model.angles end)
  model:at(1.25, function(t) log[#log + 1] = "at " .. t end)
  model:when(function() return #model.angles >= 10 end, function(t) log[#log + 1] = "ten " .. t end)
  model:when(function(t) return t > 0.7123 end, function(t) log[#log + 1] = string.format("time %.6f", t) end)
  for _, pause in ipairs(pauses) do
    model:advance { to = 3, pause = pause }
    check.near(model.time, pause, 0)
    local same = model:snapshot()
    model:advance { to = 3, pause = pause + 0.3 }
    model:restore(same)
    check.equal(model:hash(), tunica and require("tunica.core").hash(same))
  end
  model:advance(3)
  P.b = 1
  return model:hash(), table.concat(log, ", "), seen, table.concat(model.angles, " ")
end
do
  local whole = { course {} }
  local again = { course {} }
  for i = 1, 4 do check.equal(again[i], whole[i]) end
  local paused = { course { 0.1, 0.333, 0.9, 2.5 } }
  check.equal(paused[1], whole[1])
  check.equal(paused[3], whole[3])
  check.equal(paused[4], whole[4])
  assert(whole[2]:find "time 0.7123" and whole[2]:find "after 20" and whole[2]:find "at 1.25", whole[2])
end

-- On an apex the same as on the path that it is.
do
  local apex = tunica.phyllotaxis { apex = tunica.apex { profile = "disk", growth = 1 }, radius = 1, samples = 180 }
  apex:inhibition { field = function(d, age) return math.exp(-age) / d end, below = 5 }
  local path = disk()
  for _, model in ipairs { apex, path } do
    model:initial { count = 30, angle = 137.51 }
    model:advance(2)
  end
  check.equal(table.concat(apex.angles, " "), table.concat(path.angles, " "))
  local a, p = apex:primordia(), path:primordia()
  for i = 1, #a do
    check.near(a[i].time, p[i].time, 1e-7)
    if a[i].age < 10 then check.near(a[i].a / p[i].radius, 1, 1e-6) end
  end
  check.near(apex:field(50, 1.5), path:field(50, 1.5), 1e-5)
end

-- A rule that cannot be traced gives the same; parameters are read as everywhere.
do
  local traced, direct = disk({ samples = 36 }, 2.5), disk({ samples = 36 }, 2.5, function(d, age)
    if age == 0 then return 1 / d end
    return math.exp(-P.b * age) / d
  end)
  traced:advance(1)
  direct:advance(1)
  check.equal(table.concat(direct.angles, " "), table.concat(traced.angles, " "))
  check.equal(traced.about.rules[1].traced, true)
  check.equal(direct.about.rules[1].traced, false)
  assert(direct.about.warnings[1]:find "interpreter")
end

-- Imposed pairs come at the same time, exactly opposite; two inhibitors; fields of any form.
do
  local pairs_of = disk({ jugacy = 2 }, 1.5)
  pairs_of:advance(6)
  local list = pairs_of:primordia()
  for i = 2, #list, 2 do
    check.near(math.abs(list[i].divergence), 180, 1e-9)
    check.equal(list[i].time, list[i - 1].time)
  end
  local other = disk({ path = function(age) return 1, -age end }, 0.2, function(d, age) return math.exp(-3 * d) / (1 + age) end)
  other:advance(5)
  assert(#other.angles > 5)
end

-- A parameter changed by an event is heeded at once.
do
  local model = disk({}, function() return P.threshold end)
  P.threshold = 1
  model:at(2, function() P.threshold = 6 end)
  model:advance(2)
  local before = #model.angles
  model:advance(3)
  assert(#model.angles > 3 * before, #model.angles .. " after " .. before)
  P.threshold = 5
end

-- Wrong input.
local function says(f, text)
  local ok, message = pcall(f)
  assert(not ok and message:find(text, 1, true), tostring(message))
end
local function options(more)
  more.path = more.path or function(age) return 1, -age end
  return more
end
check.fails(function() tunica.phyllotaxis {} end, "either 'apex' and 'radius', or 'path'")
check.fails(function() tunica.phyllotaxis(options { samples = 2 }) end, "'samples' must be", "3")
check.fails(function() tunica.phyllotaxis(options { samples = 7, jugacy = 2 }) end, "multiple of the jugacy: 7 samples, jugacy 2")
check.fails(function() tunica.phyllotaxis(options { radius = 2 }) end, "'radius' is 2, but the path starts at x = 1")
check.fails(function() tunica.phyllotaxis(options { located = false }) end, "'dt' is missing")
check.fails(function() tunica.phyllotaxis(options { jitter = { angel = 1 } }) end, "'angel'; the options are: angle, along")
check.fails(function() tunica.phyllotaxis { path = function() return 1, 0 end } end, "does not move away")
check.fails(function() tunica.phyllotaxis { path = function() return "x" end } end, "returns x, y")
check.fails(function() tunica.phyllotaxis { path = function(age) return -1, age end } end, "radius greater than 0")
check.fails(function() tunica.phyllotaxis(options {}):advance(1) end, "no inhibition")
says(function() disk({}, "x") end, "'below' must be a number, a function(t) or a curve, came the text 'x'")
says(function() disk({}, 0 / 0) end, "'below' must be a finite number")
check.fails(function() disk({}, function() return 0 / 0 end):advance(1) end, "threshold of inhibition 1 is not a number at t = 0")
check.fails(function() disk({}, function() return "x" end):advance(1) end, "a threshold must be a number, came the text 'x'")
check.fails(function() disk({}, 5, function(d, age) return math.log(age - d) end):advance(1) end, "not a number at distance", "age")
check.fails(function() disk({}, 5, function() return "x" end):advance(1) end, "must be a number")
check.fails(function() disk({}, 1e6, function(d) return math.exp(-d) end):advance(1) end, "inserted at t = 0", "threshold is too high")
check.fails(function() disk({ stop = { primordia = 9 } }, 1e-9, function(d) return 1 end):advance() end, "below the threshold since t = 0", "has 1")
check.fails(function() disk():primordium { angle = 0, age = -1 } end, "'age' must be")
check.fails(function() local m = disk() m:primordium { angle = 0, age = 1 } m:primordium { angle = 0, age = 2 } m:advance(1) end, "from the oldest to the youngest")
check.fails(function() local m = disk() m:initial { count = 3, angle = 90, jugacy = 2 } end, "multiple of the jugacy 2, came 3")
check.fails(function() local m = disk() m:advance(1) m:initial { count = 3, angle = 90 } end, "has its start already")
check.fails(function() local m = disk() local _ = m.primordium_ end, "no 'primordium_'", "did you mean")
check.fails(function() disk():field(0, 1, 0, 3) end, "there are 1 inhibitors, came number 3")
check.fails(function() local m m = disk({}, function() return #m.angles end) m:advance(1) end, "from inside its own fields and thresholds")
check.fails(function() disk():advance() end, "'to' is missing")
check.fails(function() disk():restore "x" end, "")
check.fails(function() disk():view { colour = "agee" } end, "did you mean 'age'")

-- On a cylinder the ring is given by 'arc': growth that ends there is the same as a way straight down.
do
  local growth = tunica.curve { { 0, 1 }, { 1, 1 }, { 1 + 1e-9, 0 }, degree = 1 }
  local apex = tunica.apex { profile = "cylinder", growth = growth }
  local function run(ring)
    ring.samples = 90
    local model = tunica.phyllotaxis(ring)
    model:inhibition { field = function(d) return math.exp(-3 * d) end, below = 0.1 }
    model:advance(12)
    return model
  end
  local on_apex, on_path = run { apex = apex, arc = 1 }, run { path = function(age) return 1, -age end }
  check.equal(#on_apex.angles, #on_path.angles)
  check.equal(on_apex:pattern().pair[1], on_path:pattern().pair[1])
  check.equal(on_apex:pattern().pair[2], on_path:pattern().pair[2])
  check.equal(tostring(on_apex:pattern()):match "contact pair %b()", "contact pair (2,4)")
  says(function() run { apex = apex, radius = 1 } end, "rim of the hole at its tip", "by 'arc', between 0 and the profile's length 6")
  local shrinking = tunica.apex { profile = "cylinder", growth = -1 }
  says(function() run { apex = shrinking, arc = 1 } end, "(arc 1) does not move away from the tip", "rate of growth that is positive")
end

-- A model that failed goes on when what was wrong is set right.
do
  local bad = true
  local model = disk({}, function(t) return bad and t > 0.5 and 0 / 0 or 2 end)
  assert(not pcall(model.advance, model, 2))
  bad = false
  check.equal(model:advance(2), "done")
  local other = disk({}, 2)
  other:advance(2)
  check.equal(#other.angles, #model.angles)
end
