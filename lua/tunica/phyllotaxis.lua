-- SPDX-License-Identifier: MIT
--- Phyllotaxis by inhibition fields (thesis chapter 4): a ring on a growing apex on which primordia are born where inhibition
-- by the older ones is below a threshold.

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local rules = require "tunica.rules"
local plain = require "tunica.plain"
local course = require "tunica.course"
local op, fail = registry.op, registry.fail
local values_of = course.values_of

local inside = setmetatable({}, { __mode = "k" })
local methods = {}

local function is_phyllotaxis(value) return type(value) == "table" and inside[value] ~= nil end
registry.type("phyllotaxis", "a model of phyllotaxis", is_phyllotaxis, methods)

-- The model ---------------------------------------------------------------------------------------------------------------

local public = { params = true, name = true, views = true, reports = true, report_every = true, failure = true, stop = true, apex = true }
local prepare

local computed = {
  time = function(my) return core.inhibition_state(my.engine).time end,
  steps = function(my) return core.inhibition_state(my.engine).steps end,
  count = function(my) prepare(my) return core.inhibition_state(my.engine).count end,
  about = function(_, model) return methods.describe(model) end,
  cost = function(_, model) return methods.cost_of(model) end,
  finished = function(my) return my.most ~= nil and core.inhibition_state(my.engine).count >= my.most end,
  angles = function(my)
    prepare(my)
    local list = {}
    for i, p in ipairs(core.inhibition_primordia(my.engine, 1)) do list[i] = math.deg(p.angle) end
    return list
  end,
}

local meta = { __metatable = "phyllotaxis" }

function meta.__index(model, key)
  if methods[key] then return methods[key] end
  local my = inside[model]
  if computed[key] then
    if registry.tracing then fail("model.%s in a field cannot be traced; a field gets distance, age and time", key) end
    return computed[key](my, model)
  end
  if public[key] then return my[key] end
  local names = {}
  for _, list in ipairs { computed, public, methods } do
    for name in pairs(list) do names[#names + 1] = name end
  end
  fail("a model of phyllotaxis has no '%s'%s", tostring(key), type(key) == "string" and core.did_you_mean(key, names) or "")
end

function meta.__newindex(model, key, value)
  if key == "name" and type(value) == "string" then inside[model].name = value return end
  fail("'%s' of a model cannot be set; use its operations (model:inhibition, model:at, ...)", tostring(key))
end

function meta.__tostring(model)
  local my = inside[model]
  local s = core.inhibition_state(my.engine)
  return string.format("phyllotaxis %s: %d primordia, %d inhibitions, time %.6g", my.name or "", s.count, #my.rules, s.time)
end

local function check_options(name, given, known)
  for key, value in pairs(given or {}) do
    if not known[key] then
      local names = {}
      for option in pairs(known) do names[#names + 1] = option end
      fail("%s: there is no option %s%s", name, core.describe(key), type(key) == "string" and core.did_you_mean(key, names) or "")
    end
    local ok = type(value) == "number" and value >= 0 and value < math.huge
    if not ok then fail("%s: '%s' must be a number 0 or more, came %s", name, key, core.describe(value)) end
  end
end

--- The ring and what moves away from it: radius, height, track, displaced.
local function ring_of(o)
  if (o.apex == nil) == (o.path == nil) then fail "tunica.phyllotaxis: give either 'apex' and 'radius', or 'path'" end
  local x, y = core.call_rule(o.path, 0)
  if type(x) ~= "number" or type(y) ~= "number" then
    fail("tunica.phyllotaxis: 'path' must be a function(age) that returns x, y; at age 0 it returned %s, %s", core.describe(x), core.describe(y))
  end
  if o.radius and math.abs(o.radius - x) > 1e-9 * x then
    fail("tunica.phyllotaxis: 'radius' is %.10g, but the path starts at x = %.10g; leave one of them out", o.radius, x)
  end
  return { radius = x, height = y, track = o.path }
end

local header = [[local tunica = require "tunica"
local model = tunica.phyllotaxis { path = function(age) return math.exp(age), 0 end, samples = 90 }
]]
local example = header .. [[model:inhibition { field = function(d, age) return math.exp(-age) / d end, below = 2.5 }
]]

op { name = "tunica.phyllotaxis", kind = "named", returns = "a model of phyllotaxis", source = "thesis 4",
  doc = "A model of phyllotaxis by inhibition: a ring on a growing apex on which primordia are born. To be given model:inhibition, a start (model:initial, model:primordium), events, views and a report.",
  args = {
    { name = "path", type = "function", doc = "function(age) that returns x, y: distance from the axis and height of what was on the ring so long ago; instead of an apex" },
    { name = "apex", type = "any", doc = "the growing surface (tunica.apex)" },
    { name = "radius", type = "number", above = 0, unit = "length", doc = "of the ring on the apex" },
    { name = "samples", type = "integer", min = 3, max = 100000, default = 360, doc = "places on the ring where fields are evaluated" },
    { name = "jugacy", type = "integer", min = 1, max = 1000, default = 1, doc = "so many primordia at once, evenly spaced; must divide samples. Not 1: imposed, thresholds then are compared with the mean over the places" },
    { name = "params", type = "any", doc = "the table that tunica.params gave" },
    { name = "jitter", type = "table", doc = "{ angle = degrees, along = length }: standard deviations of the places of samples; drawn anew after each insertion" },
    { name = "tie", type = "number", min = 0, max = 1, default = 1e-9, doc = "fields nearer than this (relative) are equal, and one is drawn" },
    { name = "tolerance", type = "number", above = 0, max = 1, default = 1e-3, doc = "of the time of an insertion, relative to the plastochron" },
    { name = "dt", type = "number", above = 0, unit = "time", doc = "longest interval that is searched at once; by default half a plastochron" },
    { name = "located", type = "boolean", default = true, doc = "false: fixed steps of dt, insertions at their ends; to compare with" },
    { name = "drop", type = "number", min = 0, below = 1, default = 1e-9, doc = "old primordia are left out while their share in the fields is below this part of the threshold, now and later" },
    { name = "most", type = "integer", min = 10, max = 1000000, default = 5000, doc = "and beyond so many, with a warning" },
    { name = "stop", type = "number|table", doc = "when a batch run ends: a time, or { primordia = n }" },
  },
  example = example .. "model:advance(3) print(model)",
  fn = function(o)
    if o.params ~= nil and not params.is(o.params) then
      fail("tunica.phyllotaxis: 'params' must be what tunica.params gave, came %s", core.describe(o.params))
    end
    check_options("tunica.phyllotaxis: jitter", o.jitter, { angle = true, along = true })
    if type(o.stop) == "table" then check_options("tunica.phyllotaxis: stop", o.stop, { primordia = true, time = true }) end
    if type(o.stop) == "number" and o.stop < 0 then fail("tunica.phyllotaxis: 'stop' must be 0 or more, came %.10g", o.stop) end
    if o.samples % o.jugacy ~= 0 then
      fail("tunica.phyllotaxis: 'samples' must be a multiple of the jugacy: %d samples, jugacy %d", o.samples, o.jugacy)
    end
    if not o.located and not o.dt then fail "tunica.phyllotaxis: 'dt' is missing: with located = false steps have a fixed length" end
    local ring, jitter = ring_of(o), o.jitter or {}
    local engine = core.inhibition { radius = ring.radius, height = ring.height, track = ring.track, displaced = ring.displaced,
      samples = o.samples, jugacy = o.jugacy, tie = o.tie, tolerance = o.tolerance, dt = o.dt or 0, located = o.located, drop = o.drop,
      most = o.most, jitter_angle = math.rad(jitter.angle or 0), jitter_along = jitter.along or 0 }
    local stop = type(o.stop) == "table" and o.stop or { time = o.stop }
    local model = setmetatable({}, meta)
    inside[model] = { engine = engine, ring = ring, apex = o.apex, params = o.params or params.current(), jugacy = o.jugacy, samples = o.samples,
      stop = o.stop and (stop.time or math.huge), most = stop.primordia, rules = {}, starts = {}, events = {}, conditions = {}, views = {},
      reports = {}, warnings = {}, seconds = 0, tolerance = o.tolerance, tie = o.tie, drop = o.drop, located = o.located }
    return model
  end }

-- Fields --------------------------------------------------------------------------------------------------------------------

local function is_callable(value)
  if type(value) == "function" then return true end
  if type(value) == "number" then return false end
  local ok, call = pcall(function() return getmetatable(value).__call end)
  return ok and call ~= nil
end

op { name = "phyllotaxis:inhibition", changes = true, kind = "named", source = "thesis 4.1-4.5",
  doc = "An inhibitor: each primordium adds f(distance, age) to its field. A place of the ring is a candidate where the field is below the threshold, for every inhibitor; the candidate with the lowest field of the first inhibitor is where a primordium is born. Then fields are computed again, and so on at the same time until there is no candidate.",
  args = {
    { name = "field", type = "function", required = true, doc = "function(d, age, t): share of a primordium of this age at distance d; its unit is that of the threshold" },
    { name = "below", type = "any", required = true, doc = "threshold: a number, a function(t), or a curve over time" },
  },
  example = example .. "model:advance(1) print(#model.angles)",
  fn = function(model, o)
    local my = inside[model]
    if type(o.below) ~= "number" and not is_callable(o.below) then
      fail("phyllotaxis:inhibition: 'below' must be a number, a function(t) or a curve, came %s", core.describe(o.below))
    end
    if type(o.below) == "number" and not (math.abs(o.below) < math.huge) then
      fail("phyllotaxis:inhibition: 'below' must be a finite number, came %s", core.describe(o.below))
    end
    if #my.rules >= 8 then fail "phyllotaxis:inhibition: there are 8 inhibitors already" end
    local below = o.below
    if type(below) ~= "number" and type(below) ~= "function" then below = function(t) return o.below(t) end end
    my.rules[#my.rules + 1] = { what = "inhibition", kind = "ring", fn = o.field, below = below, where = registry.where() }
    my.held = nil
  end }

local function warn(my, text)
  for _, said in ipairs(my.warnings) do
    if said == text then return end
  end
  my.warnings[#my.warnings + 1] = text
  io.stderr:write("tunica: ", text, "\n")
end

--- Compares what was traced with the function itself. Returns nil, or how they differ.
local function difference(my, k, rule)
  local time = core.inhibition_state(my.engine).time
  for _, age in ipairs { 0, 1e-3, 0.1, 1, 7 } do
    for _, d in ipairs { 0.01, 0.3, 1, 2.5 } do
      local computed_as, direct = core.inhibition_share(my.engine, k, d, age, time), core.call_rule(rule.fn, d, age, time)
      local same = computed_as == direct or computed_as ~= computed_as and direct ~= direct
      if not same and not (math.abs(computed_as - direct) <= 1e-9 * math.max(math.abs(direct), 1e-3)) then
        return string.format("evaluated directly it gives %.12g at distance %g and age %g, traced %.12g: it decides something by the values",
          direct, d, age, computed_as)
      end
    end
  end
end

local function bind(my)
  local values = values_of(my)
  for k, rule in ipairs(my.rules) do
    local below = rule.below
    local reason = rules.with_symbols(rule.fn, core.inhibition_field, my.engine, k, rule.fn, below, values, false)
      or difference(my, k, rule)
    rule.direct = reason
    if reason then
      core.inhibition_field(my.engine, k, rule.fn, below, values, true)
      warn(my, string.format("%s: this field is run by the interpreter, some hundred times slower: %s", rule.where, reason))
    end
  end
  core.inhibition_changed(my.engine)
end

--- Everything the fields and thresholds hold from outside.
local function held_values(my)
  local functions, all = {}, {}
  for _, rule in ipairs(my.rules) do
    functions[#functions + 1] = rule.fn
    if type(rule.below) == "function" then functions[#functions + 1] = rule.below end
  end
  for name, value in pairs(values_of(my)) do all[name] = value end
  return plain.encode { plain.upvalues(functions), all }
end

--- Fields as the script has them now; and, the first time, the primordia from which the run starts.
function prepare(my)
  if core.in_rule() then fail "a model cannot be run, saved or looked into from inside its own fields and thresholds" end
  if #my.rules == 0 then fail "the model has no inhibition: model:inhibition { field = function(d, age) ... end, below = ... }" end
  local held = held_values(my)
  if held ~= my.held then
    bind(my)
    my.held = held
  end
  if my.started then return end
  my.started = true
  local went, message = pcall(function()
    for _, start in ipairs(my.starts) do start() end
    if #my.starts == 0 then core.inhibition_random(my.engine) end
  end)
  if not went then
    my.started = false
    error(message, 0)
  end
end

-- Start -----------------------------------------------------------------------------------------------------------------------

op { name = "phyllotaxis:initial", changes = true, kind = "named",
  doc = "Starts from a lattice: whorls at a constant divergence angle and a constant plastochron, old enough that the next one is due at time 0 and angle 0. Without a spacing the plastochron is that at which the field of these whorls is at the threshold of the first inhibitor.",
  args = { { name = "count", type = "integer", min = 1, max = 100000, required = true, doc = "primordia in all; a multiple of the jugacy" },
    { name = "angle", type = "number", required = true, unit = "degrees", doc = "from one primordium (whorl) to the next" },
    { name = "jugacy", type = "integer", min = 1, max = 1000, doc = "primordia at once, evenly spaced; that of the model if not given" },
    { name = "spacing", type = "number", above = 0, unit = "time", doc = "from one primordium (whorl) to the next" } },
  example = example .. "model:initial { count = 20, angle = 137.51 } model:advance(1) print(#model.angles)",
  fn = function(model, o)
    local my = inside[model]
    if my.started or #my.starts > 0 then fail "phyllotaxis:initial: the model has its start already" end
    local jugacy = o.jugacy or my.jugacy
    if o.count % jugacy ~= 0 then fail("phyllotaxis:initial: 'count' must be a multiple of the jugacy %d, came %d", jugacy, o.count) end
    my.starts[1] = function() my.spacing = core.inhibition_lattice(my.engine, o.count / jugacy, math.rad(o.angle), jugacy, o.spacing) end
  end }

op { name = "phyllotaxis:primordium", changes = true, kind = "named",
  doc = "A primordium that is there at the start (the oldest is given first), or that comes now, by an event.",
  args = { { name = "angle", type = "number", required = true, unit = "degrees", doc = "around the axis" },
    { name = "age", type = "number", min = 0, default = 0, unit = "time", doc = "time since it was on the ring" } },
  example = example .. "model:primordium { angle = 0, age = 0.2 } model:advance(1) print(#model.angles)",
  fn = function(model, o)
    local my = inside[model]
    local function start() core.inhibition_primordium(my.engine, math.rad(o.angle), o.age) end
    if my.started then start() else my.starts[#my.starts + 1] = start end
  end }

-- Events ------------------------------------------------------------------------------------------------------------------------

course.operations("phyllotaxis", inside, example, {
  doc = "It is asked at the start, after events and insertions, and between insertions, where the time is found at which it became true.",
  located = "false: it is asked only after insertions and search intervals, and its time is not found",
  example = "model:when(function(t) return #model.angles > 5 end, function(t) print(t) end)",
  report = "primordia = function() return #model.angles end" })

op { name = "phyllotaxis:after", changes = true,
  args = { { name = "count", type = "integer", min = 1, required = true, doc = "number of the primordium; those of the start count" },
    { name = "event", type = "function", required = true, doc = "function(t)" } },
  doc = "Something that happens once, when the model has so many primordia: a threshold is changed, say.",
  example = example .. "model:after(4, function(t) print(t) end) model:advance(1)",
  fn = function(model, count, fn) table.insert(inside[model].events, { kind = "after", time = count, fn = fn, fired = 0 }) end }

local function nothing() end

local function fire_counts(my, now)
  local fired = false
  for _, e in ipairs(my.events) do
    if e.kind == "after" and e.fired == 0 and core.inhibition_state(my.engine).count >= e.time then
      e.fn(now)
      e.fired, fired = 1, true
    end
  end
  return fired
end

local function test_conditions(my, now)
  for _, c in ipairs(my.conditions) do
    local holds = c.test(now) and true or false
    local becomes = holds and not c.holds
    c.holds = holds
    if becomes then c.fn(now) end
  end
end

local function any_becomes(my, time)
  for _, c in ipairs(my.conditions) do
    if c.located and not c.holds and c.test(time) then return true end
  end
  return false
end

--- The earliest time from `low` to `high`, between which nothing is inserted, at which a condition becomes true; nil if none does.
local function locate(my, low, high)
  local function holds_at(time)
    core.inhibition_show(my.engine, time)
    return any_becomes(my, time)
  end
  local near = 1e-9 * (high - low)
  local found
  local went, message = pcall(function()
    if not holds_at(high) then return end
    local first, last = low, high
    while last - first > near do
      local middle = first + (last - first) / 2
      if middle <= first or middle >= last then break end
      if holds_at(middle) then last = middle else first = middle end
    end
    found = last
  end)
  core.inhibition_show(my.engine, low)
  if not went then error(message, 0) end
  return found
end

-- Running -----------------------------------------------------------------------------------------------------------------------

--- Nothing has come for so long that nothing will: an error for a run that ends with a number of primordia.
local function check_patience(my, s)
  local scale = math.max(s.plastochron, 100 * s.time_scale)
  local since = math.max(s.last_birth, 0)
  if my.most and s.count > 0 and s.time - since > 1e4 * scale then
    local angle, value = core.inhibition_minimum(my.engine)
    fail("no place on the ring has been below the threshold since t = %.6g (now t = %.6g): the lowest field of the first inhibition is %.6g, at %.4g degrees; the run was to end with %d primordia and has %d",
      since, s.time, value, math.deg(angle), my.most, s.count)
  end
end

--- Up to the next thing of interest. Returns a status that ends the run, or nil.
local function go_on(my, target)
  local before = core.inhibition_state(my.engine).time
  if #my.conditions > 0 then
    local known = core.inhibition_known(my.engine)
    if not known then return "interrupted" end
    local high = math.min(known, target)
    local found = high > before and locate(my, before, high)
    if found then
      core.inhibition_show(my.engine, found)
      test_conditions(my, found)
      return
    end
  end
  local status = core.inhibition_advance(my.engine, target)
  if status == "interrupted" then return status end
  local s = core.inhibition_state(my.engine)
  if status == "inserted" then fire_counts(my, s.time) end
  if status == "clear" then check_patience(my, s) end
  prepare(my)
  if #my.conditions > 0 then test_conditions(my, s.time) end
end

local function advance(model, o)
  local my = inside[model]
  prepare(my)
  my.failure = nil
  local deadline = o.seconds and core.now() + o.seconds
  local first, stepped = true, false
  while true do
    local now = model.time
    local fired = course.fire(my, now, 0, nothing)
    fired = fire_counts(my, now) or fired
    if fired or first then
      prepare(my)
      test_conditions(my, now)
      prepare(my)
    end
    first = false
    if now >= o.to or model.finished then return "done" end
    if o.pause and stepped and now >= o.pause then return "paused" end
    if core.cancelled() then return "interrupted" end
    local target = course.next_event(my, o.to)
    if o.pause and o.pause > now then target = math.min(target, o.pause) end
    local status = go_on(my, math.max(target, now))
    stepped = true
    if status then return status end
    prepare(my)
    if deadline and core.now() >= deadline and model.time < o.to then return "out of time" end
  end
end

op { name = "phyllotaxis:advance", kind = "named", returns = "'done', 'paused', 'out of time' or 'interrupted'",
  doc = "Runs the model to a time, or to the number of primordia at which it stops, events included. How often it pauses changes no primordium.",
  args = { { name = "to", type = "number", position = 1, unit = "time", doc = "until when; may be left out if the model stops with a number of primordia" },
    { name = "pause", type = "number", infinite = true, unit = "time", doc = "stop then" },
    { name = "seconds", type = "number", min = 0, unit = "s", doc = "stop after so much time on the clock" } },
  example = example .. "model:advance { to = 1 } print(model.time)",
  fn = function(model, o)
    local my = inside[model]
    if my.advancing then fail "phyllotaxis:advance cannot be called while the model runs, in an event or a condition" end
    o.to = o.to or my.most and 1e300
    if not o.to then fail "phyllotaxis:advance: 'to' is missing: until when? (Or stop = { primordia = n } in tunica.phyllotaxis)" end
    my.advancing = true
    local begun = core.now()
    local ok, status = pcall(advance, model, o)
    my.seconds = my.seconds + core.now() - begun
    my.advancing = false
    if not ok then error(status, 0) end
    if core.inhibition_state(my.engine).overflowed then
      warn(my, "old primordia were left out because there were too many (most), though their inhibition still counts")
    end
    return status
  end }

-- What there is -------------------------------------------------------------------------------------------------------------------

--- In (-180, 180].
local function turn(from, to)
  local angle = to - from
  return angle - 360 * math.ceil((angle - 180) / 360)
end

op { name = "phyllotaxis:primordia", returns = "a list of { number, angle, time, age, x, y, z, radius, divergence, jugacy, initial }",
  doc = "All primordia, the oldest first: angle and divergence (from the one before, -180 to 180) in degrees, time of birth, age, place in space, distance from the axis (radius).",
  example = example .. "model:advance(1) for _, p in ipairs(model:primordia()) do print(p.number, p.angle, p.age) end",
  fn = function(model)
    local my = inside[model]
    prepare(my)
    local now, before = model.time, nil
    local list = core.inhibition_primordia(my.engine, 1)
    for i, p in ipairs(list) do
      local theta = p.angle
      p.number, p.time, p.age, p.jugacy = i, p.birth, math.max(0, now - p.birth), my.jugacy
      p.angle, p.radius = math.deg(theta), p.x
      p.x, p.z = p.radius * math.cos(theta), p.radius * math.sin(theta)
      p.divergence, p.birth = before and turn(before, p.angle) or nil, nil
      before = p.angle
    end
    return list
  end }

op { name = "phyllotaxis:field", returns = "a number",
  doc = "The field of an inhibitor now, at a place on the ring or elsewhere.",
  args = { { name = "theta", type = "number", required = true, unit = "degrees", doc = "angle of the place" },
    { name = "x", type = "number", min = 0, unit = "length", doc = "its distance from the axis; that of the ring if not given" },
    { name = "y", type = "number", unit = "length", doc = "its height; that of the ring if not given" },
    { name = "which", type = "integer", min = 1, max = 8, default = 1, doc = "number of the inhibitor" } },
  example = example .. "model:primordium { angle = 0 } print(model:field(180))",
  fn = function(model, theta, x, y, which)
    local my = inside[model]
    prepare(my)
    if which > #my.rules then fail("phyllotaxis:field: there are %d inhibitors, came number %d", #my.rules, which) end
    return core.inhibition_value(my.engine, which, math.rad(theta), x or my.ring.radius, y or my.ring.height)
  end }

op { name = "phyllotaxis:minimum", returns = "the angle (degrees), the field there, and whether it is below every threshold",
  doc = "The place on the ring where the field of the first inhibitor is lowest now, among the candidates if there are any.",
  example = example .. "model:advance(1) print(model:minimum())",
  fn = function(model)
    local my = inside[model]
    prepare(my)
    local angle, value, candidate = core.inhibition_minimum(my.engine)
    return math.deg(angle), value, candidate
  end }

-- What changes, as bytes -------------------------------------------------------------------------------------------------------

op { name = "phyllotaxis:snapshot", returns = "text", example = example .. "print(#model:snapshot())",
  doc = "Everything that changes during a run: primordia, time, events, parameters, and the plain values that functions of the model keep.",
  fn = function(model)
    local my = inside[model]
    prepare(my)
    return core.pack { inhibition = core.inhibition_save(my.engine), random = core.random_state(), script = course.save(my) }
  end }

op { name = "phyllotaxis:restore", changes = true, args = { { name = "snapshot", type = "string", required = true, doc = "what model:snapshot() gave" } },
  doc = "Goes back to a snapshot of the same script.", example = example .. "local s = model:snapshot() model:advance(1) model:restore(s) print(model.time)",
  fn = function(model, bytes)
    local my = inside[model]
    local parts = core.unpack(bytes)
    if not (parts.inhibition and parts.script and parts.random) then fail "this is no snapshot of a model of phyllotaxis" end
    prepare(my)
    course.check(my, parts.script)
    core.random_state(parts.random)
    course.restore(my, parts.script)
    prepare(my)  -- may bind the fields anew
    core.inhibition_load(my.engine, parts.inhibition)
  end }

-- For the record ------------------------------------------------------------------------------------------------------------------

--- What the model has cost since it was made.
function methods.cost_of(model)
  local my = inside[model]
  local s = core.inhibition_state(my.engine)
  return { seconds = my.seconds, steps = s.steps, evaluations = s.evaluations, pairs = s.pairs }
end

--- For run.json: how it is solved, rules, warnings, cost.
function methods.describe(model)
  local my = inside[model]
  prepare(my)
  local listed = {}
  for i, r in ipairs(my.rules) do
    listed[i] = { rule = r.what, where = r.where, traced = not r.direct, reason = r.direct or nil }
  end
  local counts = methods.cost_of(model)
  local seconds = counts.seconds
  counts.seconds = nil
  return { method = "inhibition", title = my.located and "insertions located in time" or "insertions at the ends of fixed steps",
    samples = my.samples, jugacy = my.jugacy, tolerance = my.tolerance, tie = my.tie, drop = my.drop, spacing = my.spacing, rules = listed,
    warnings = my.warnings, counts = counts,
    cost = { seconds = seconds, ns_per_pair = counts.pairs > 0 and seconds / counts.pairs * 1e9 or nil } }
end

return { is_phyllotaxis = is_phyllotaxis, inside = inside }
