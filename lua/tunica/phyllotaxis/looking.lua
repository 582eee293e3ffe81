-- SPDX-License-Identifier: MIT
--- Looking at a model of phyllotaxis: its primordia, its fields, and the record of a run.

local core = require "tunica.core"
local registry = require "tunica.registry"
local op, fail = registry.op, registry.fail

return function(parts)

local inside, methods, prepare, example = parts.inside, parts.methods, parts.prepare, parts.example

-- What there is -------------------------------------------------------------------------------------------------------

--- In (-180, 180].
local function turn(from, to)
  local angle = to - from
  return angle - 360 * math.ceil((angle - 180) / 360)
end

--- Arc length from the tip at an age; nil where it is beyond all numbers.
local function arc_after(my, age)
  local ok, arc = pcall(my.apex.after, my.apex, my.ring.arc, age)
  return ok and arc or nil
end

op { name = "phyllotaxis:primordia",
  returns = "a list of { number, angle, time, age, a, x, y, z, radius, divergence, jugacy, initial }",
  doc = "All primordia, the oldest first: angle and divergence (from the one before, -180 to 180) in degrees, time of " ..
    "birth, age, arc length from the tip (a, on an apex), place in space, distance from the axis (radius).",
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
      p.a = my.apex and arc_after(my, p.age) or nil
      p.divergence, p.birth = before and turn(before, p.angle) or nil, nil
      before = p.angle
    end
    return list
  end }

--- For the run directory: primordia.csv.
function methods.table_of(model)
  local columns = { "number", "time", "angle", "divergence", "plastochron", "x", "y", "z", "initial" }
  local lines, list = {}, model:primordia()
  lines[1] = table.concat(columns, ",")
  for i, p in ipairs(list) do
    p.plastochron = list[i - 1] and p.time - list[i - 1].time
    local fields = {}
    for k, name in ipairs(columns) do
      local value = p[name]
      fields[k] = type(value) == "number" and core.shortest(value) or value == nil and "" or tostring(value)
    end
    lines[i + 1] = table.concat(fields, ",")
  end
  return table.concat(lines, "\n") .. "\n"
end

op { name = "phyllotaxis:field", returns = "a number",
  doc = "The field of an inhibitor now, at a place on the ring or elsewhere.",
  args = { { name = "theta", type = "number", required = true, unit = "degrees", doc = "angle of the place" },
    { name = "a", type = "number", min = 0, max = 1e12, unit = "length",
      doc = "its arc length from the tip of the apex; that of the ring if not given. Of a model without an apex: its " ..
        "distance from the axis" },
    { name = "y", type = "number", unit = "length",
      doc = "its height, of a model without an apex; that of the ring if not given" },
    { name = "which", type = "integer", min = 1, max = 8, default = 1, doc = "number of the inhibitor" } },
  example = example .. "model:primordium { angle = 0 } print(model:field(180))",
  fn = function(model, theta, a, y, which)
    local my = inside[model]
    prepare(my)
    if which > #my.rules then fail("phyllotaxis:field: there are %d inhibitors, came number %d", #my.rules, which) end
    if y and my.apex then
      fail "phyllotaxis:field: 'y' is of a model without an apex; here the arc length says where the place is"
    end
    local x = a
    if a and my.apex then x, y = my.apex:position(0, a) end
    return core.inhibition_value(my.engine, which, math.rad(theta), x or my.ring.radius, y or my.ring.height)
  end }

op { name = "phyllotaxis:pattern", kind = "named", returns = "what tunica.pattern gives",
  doc = "What the pattern of its primordia is, those of the start left out: see tunica.pattern.",
  args = { { name = "first", type = "integer", min = 1,
    doc = "number of the first primordium that counts; by default the first one that the run inserted" },
    { name = "last", type = "integer", min = 1, doc = "number of the last one; by default the youngest" },
    { name = "jugacy", type = "integer", min = 1, max = 1000, doc = "found if left out, or imposed by the model" },
    { name = "expected", type = "table", doc = "{ angle =, jugacy =, pair = { m, n } }" } },
  example = example .. "model:advance(3) print(model:pattern())",
  fn = function(model, o)
    local my, list = inside[model], model:primordia()
    local first = o.first or 1
    while not o.first and list[first] and list[first].initial and #list - first > 1 do first = first + 1 end
    for i = first, math.min(o.last or #list, #list) do list[i].left, list[i].right = core.inhibition_neighbours(my.engine, i) end
    return registry.module.pattern(list, { first = first, last = o.last, jugacy = o.jugacy or my.jugacy > 1 and my.jugacy or nil,
      expected = o.expected })
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

-- For the record ------------------------------------------------------------------------------------------------------

--- For charts of methods, which are of models with rates.
function methods.state_columns()
  fail("a model of phyllotaxis has no rates, so there are no methods of integration to compare; its accuracy is set by " ..
    "samples and tolerance")
end

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
    samples = my.samples, jugacy = my.jugacy, tolerance = my.tolerance, tie = my.tie, drop = my.drop, spacing = my.spacing,
    rules = listed, warnings = my.warnings, counts = counts,
    cost = { seconds = seconds, ns_per_pair = counts.pairs > 0 and seconds / counts.pairs * 1e9 or nil } }
end

end
