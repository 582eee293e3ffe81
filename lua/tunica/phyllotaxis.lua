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

local endless = 1e300  -- a time that no run reaches

local inside = setmetatable({}, { __mode = "k" })
local methods = {}

local function is_phyllotaxis(value) return type(value) == "table" and inside[value] ~= nil end
registry.type("phyllotaxis", "a model of phyllotaxis", is_phyllotaxis, methods)

-- The model ---------------------------------------------------------------------------------------------------------------

local public = {
  params = true, name = true, views = true, reports = true, report_every = true, failure = true, stop = true, most = true,
  apex = true,
}
local prepare

local computed = {
  time = function(my) return core.inhibition_state(my.engine).time end,
  steps = function(my) return core.inhibition_state(my.engine).steps end,
  count = function(my) prepare(my) return core.inhibition_state(my.engine).count end,
  about = function(_, model) return methods.describe(model) end,
  cost = function(_, model) return methods.cost_of(model) end,
  finished = function(my) return my.most ~= nil and core.inhibition_state(my.engine).count >= my.most end,
  tables = function(_, model) return { primordia = methods.table_of(model) } end,
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

--- Options within an option: each a number, 0 or more.
local function check_options(name, given, names)
  for key, value in pairs(given or {}) do
    local known = false
    for _, option in ipairs(names) do known = known or option == key end
    if not known then
      local hint = type(key) == "string" and core.did_you_mean(key, names) or ""
      if hint == "" then hint = "; the options are: " .. table.concat(names, ", ") end
      fail("%s: there is no option %s%s", name, (core.describe(key):gsub("^the text ", "")), hint)
    end
    if not (type(value) == "number" and value >= 0 and value < math.huge) then
      fail("%s: '%s' must be a number 0 or more, came %s", name, key, core.describe(value))
    end
  end
end

--- The ring and what moves away from it: { apex, arc, radius } or { radius, height, track }.
local function ring_of(o)
  if (o.apex == nil) == (o.path == nil) then fail "tunica.phyllotaxis: give either 'apex' and 'radius', or 'path'" end
  if o.apex then
    if (o.radius == nil) == (o.arc == nil) then
      fail "tunica.phyllotaxis: say where the ring is on the apex, by 'radius' or by 'arc'"
    end
    local arc = o.arc or o.apex:arc_at_radius(o.radius)
    if o.radius and arc == 0 then
      local length, _, hole = o.apex:measures()
      fail("tunica.phyllotaxis: the first place of the apex with radius %.6g is the rim of the hole at its tip (radius %.6g), "
        .. "from which nothing moves away; say where the ring is by 'arc', between 0 and the profile's length %.6g", o.radius,
        hole, length)
    end
    return { apex = o.apex, arc = arc }
  end
  if o.arc then fail "tunica.phyllotaxis: 'arc' is a place on an apex; a path starts on the ring" end
  local x, y = core.call_rule(o.path, 0)
  if type(x) ~= "number" or type(y) ~= "number" then
    fail("tunica.phyllotaxis: 'path' must be a function(age) that returns x, y; at age 0 it returned %s, %s", core.describe(x),
      core.describe(y))
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
  doc = "A model of phyllotaxis by inhibition: a ring on a growing apex on which primordia are born. To be given " ..
    "model:inhibition, a start (model:initial, model:primordium), events, views and a report.",
  args = {
    { name = "path", type = "function",
      doc = "function(age) that returns x, y: distance from the axis and height of what was on the ring so long ago; " ..
        "instead of an apex" },
    { name = "apex", type = "apex", doc = "the growing surface (tunica.apex)" },
    { name = "radius", type = "number", above = 0, unit = "length", doc = "of the ring on the apex" },
    { name = "arc", type = "number", min = 0, max = 1e12, unit = "length",
      doc = "arc length from the tip to the ring, instead of its radius" },
    { name = "samples", type = "integer", min = 3, max = 100000, default = 360,
      doc = "places on the ring where fields are evaluated" },
    { name = "jugacy", type = "integer", min = 1, max = 1000, default = 1,
      doc = "so many primordia at once, evenly spaced; must divide samples. Not 1: imposed, thresholds then are compared " ..
        "with the mean over the places" },
    { name = "params", type = "any", doc = "the table that tunica.params gave" },
    { name = "jitter", type = "table",
      doc = "{ angle = degrees, along = length }: standard deviations of the places of samples; drawn anew after each " ..
        "insertion" },
    { name = "tie", type = "number", min = 0, max = 1, default = 1e-9,
      doc = "fields nearer than this (relative) are equal, and one is drawn" },
    { name = "tolerance", type = "number", above = 0, max = 1, default = 1e-3,
      doc = "of the time of an insertion, relative to the plastochron" },
    { name = "dt", type = "number", above = 0, unit = "time",
      doc = "longest interval that is searched at once; by default half a plastochron" },
    { name = "located", type = "boolean", default = true,
      doc = "false: fixed steps of dt, insertions at their ends; to compare with" },
    { name = "drop", type = "number", min = 0, below = 1, default = 1e-9,
      doc = "old primordia are left out while their share in the fields is below this part of the threshold, now and later" },
    { name = "most", type = "integer", min = 10, max = 1000000, default = 5000, doc = "and beyond so many, with a warning" },
    { name = "stop", type = "number|table", doc = "when a batch run ends: a time, or { primordia = n }" },
  },
  example = example .. "model:advance(3) print(model)",
  fn = function(o)
    if o.params ~= nil and not params.is(o.params) then
      fail("tunica.phyllotaxis: 'params' must be what tunica.params gave, came %s", core.describe(o.params))
    end
    check_options("tunica.phyllotaxis: jitter", o.jitter, { "angle", "along" })
    if type(o.stop) == "table" then check_options("tunica.phyllotaxis: stop", o.stop, { "primordia", "time" }) end
    if type(o.stop) == "number" and o.stop < 0 then fail("tunica.phyllotaxis: 'stop' must be 0 or more, came %.10g", o.stop) end
    if o.samples % o.jugacy ~= 0 then
      fail("tunica.phyllotaxis: 'samples' must be a multiple of the jugacy: %d samples, jugacy %d", o.samples, o.jugacy)
    end
    if not o.located and not o.dt then
      fail "tunica.phyllotaxis: 'dt' is missing: with located = false steps have a fixed length"
    end
    local ring, jitter = ring_of(o), o.jitter or {}
    local engine
    engine, ring.radius, ring.height = core.inhibition {
      apex = ring.apex, arc = ring.arc, radius = ring.radius, height = ring.height, track = ring.track,
      samples = o.samples, jugacy = o.jugacy, tie = o.tie, tolerance = o.tolerance, dt = o.dt or 0, located = o.located,
      drop = o.drop, most = o.most, jitter_angle = math.rad(jitter.angle or 0), jitter_along = jitter.along or 0,
    }
    local stop = type(o.stop) == "table" and o.stop or { time = o.stop }
    local model = setmetatable({}, meta)
    inside[model] = {
      engine = engine, ring = ring, apex = o.apex, params = o.params or params.current(), jugacy = o.jugacy,
      samples = o.samples, stop = o.stop and (stop.time or endless), most = stop.primordia, rules = {}, starts = {},
      events = {}, conditions = {}, views = {}, reports = {}, warnings = {}, seconds = 0, tolerance = o.tolerance,
      tie = o.tie, drop = o.drop, located = o.located,
    }
    return model
  end }

-- Fields --------------------------------------------------------------------------------------------------------------------

local function is_callable(value)
  if type(value) == "function" then return true end
  if type(value) == "number" then return false end
  if core.shape_kind(value) == "curve" then return true end
  local ok, call = pcall(function() return getmetatable(value).__call end)
  return ok and call ~= nil
end

op { name = "phyllotaxis:inhibition", changes = true, kind = "named", source = "thesis 4.1-4.5",
  doc = "An inhibitor: each primordium adds f(distance, age) to its field. A place of the ring is a candidate where the " ..
    "field is below the threshold, for every inhibitor; the candidate with the lowest field of the first inhibitor is where " ..
    "a primordium is born. Then fields are computed again, and so on at the same time until there is no candidate.",
  args = {
    { name = "field", type = "function", required = true,
      doc = "function(d, age, t): share of a primordium of this age at distance d; its unit is that of the threshold" },
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
  require("tunica.warnings").write(text)
end

--- Compares what was traced with the function itself. Returns nil, or how they differ.
local function difference_at(my, k, rule, time)
  for _, age in ipairs { 0, 1e-3, 0.1, 1, 7 } do
    for _, d in ipairs { 0.01, 0.3, 1, 2.5 } do
      local computed_as, direct = core.inhibition_share(my.engine, k, d, age, time), core.call_rule(rule.fn, d, age, time)
      local same = computed_as == direct or computed_as ~= computed_as and direct ~= direct
      if not same and not (math.abs(computed_as - direct) <= 1e-9 * math.max(math.abs(direct), 1e-3)) then
        return string.format("evaluated directly it gives %.12g at distance %g, age %g and time %g, traced %.12g: it " ..
          "decides something by the values", direct, d, age, time, computed_as)
      end
    end
  end
end

--- Whether a rule is told the time.
local function timed(fn) return debug.getinfo(fn, "u").nparams >= 3 or debug.getinfo(fn, "u").isvararg end

local function difference(my, k, rule)
  local now = core.inhibition_state(my.engine).time
  for _, later in ipairs(timed(rule.fn) and { 0, 0.1, 1, 2, 10, 100, 1000 } or { 0 }) do
    local found = difference_at(my, k, rule, now + later)
    if found then return found end
  end
end

local function bind(my)
  local values = values_of(my)
  for k, rule in ipairs(my.rules) do
    local below = rule.below
    local reason = rules.with_symbols(rule.fn, core.inhibition_field, my.engine, k, rule.fn, below, values, false, timed(rule.fn))
      or difference(my, k, rule)
    rule.direct = reason
    if reason then
      core.inhibition_field(my.engine, k, rule.fn, below, values, true, timed(rule.fn))
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
  if type(my.ring.track) == "function" then functions[#functions + 1] = my.ring.track end
  for name, value in pairs(values_of(my)) do all[name] = value end
  return plain.encode { plain.upvalues(functions), all }
end

--- After events: what rules read from elsewhere (globals, tables) may have changed, though nothing they hold has.
local function refresh(my)
  local varying = false
  for k, rule in ipairs(my.rules) do
    if not rule.direct and difference_at(my, k, rule, core.inhibition_state(my.engine).time) then my.held = nil end
    varying = varying or rule.direct or type(rule.below) == "function"
  end
  if varying then core.inhibition_reconsider(my.engine) end
end

--- Fields as the script has them now; and, the first time, the primordia from which the run starts.
function prepare(my)
  if core.in_rule() then fail "a model cannot be run, saved or looked into from inside its own fields and thresholds" end
  if #my.rules == 0 then
    fail "the model has no inhibition: model:inhibition { field = function(d, age) ... end, below = ... }"
  end
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
  doc = "Starts from a lattice: whorls at a constant divergence angle and a constant plastochron, old enough that the next " ..
    "one is due at time 0 and angle 0. Without a spacing the plastochron is that at which the field of these whorls is at " ..
    "the threshold of the first inhibitor.",
  args = { { name = "count", type = "integer", min = 1, max = 100000, required = true,
    doc = "primordia in all; a multiple of the jugacy" },
    { name = "angle", type = "number", required = true, unit = "degrees", doc = "from one primordium (whorl) to the next" },
    { name = "jugacy", type = "integer", min = 1, max = 1000,
      doc = "primordia at once, evenly spaced; that of the model if not given" },
    { name = "spacing", type = "number", above = 0, unit = "time", doc = "from one primordium (whorl) to the next" } },
  example = example .. "model:initial { count = 20, angle = 137.51 } model:advance(1) print(#model.angles)",
  fn = function(model, o)
    local my = inside[model]
    if my.started or #my.starts > 0 then fail "phyllotaxis:initial: the model has its start already" end
    local jugacy = o.jugacy or my.jugacy
    if o.count % jugacy ~= 0 then
      fail("phyllotaxis:initial: 'count' must be a multiple of the jugacy %d, came %d", jugacy, o.count)
    end
    my.starts[1] = function()
      my.spacing = core.inhibition_lattice(my.engine, o.count / jugacy, math.rad(o.angle), jugacy, o.spacing)
    end
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

-- The rest of it ------------------------------------------------------------------------------------------------------

local parts = { inside = inside, methods = methods, prepare = prepare, refresh = refresh, example = example, warn = warn, endless = endless }
for _, part in ipairs { "running", "looking" } do require("tunica.phyllotaxis." .. part)(parts) end

return { is_phyllotaxis = is_phyllotaxis, inside = inside, prepare = prepare }
