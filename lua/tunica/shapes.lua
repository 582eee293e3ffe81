-- SPDX-License-Identifier: MIT
--- Curves that a modeller draws, and the apex that they make: contours, functions of one variable, surfaces of revolution.

local core = require "tunica.core"
local registry = require "tunica.registry"
local warnings = require "tunica.warnings"
local curve_text = require "tunica.curve_text"
local op, fail = registry.op, registry.fail

local function is(kind)
  return function(value) return core.shape_kind(value) == kind end
end
for _, kind in ipairs { "contour", "curve", "apex" } do
  registry.type(kind, (kind == "apex" and "an " or "a ") .. kind, is(kind), core.shape_methods[kind])
end

--- The named entries of a list of points; any but `options` are an error.
local function options_of(what, given, options)
  for key in pairs(given) do
    if type(key) == "string" then
      local known = false
      for _, option in ipairs(options) do known = known or option == key end
      if not known then
        fail("%s: there is no option '%s'%s; the options are: %s", what, key, core.did_you_mean(key, options),
          table.concat(options, ", "))
      end
    elseif type(key) ~= "number" then
      fail("%s: expected points and options, came %s as a key", what, core.describe(key))
    end
  end
end

--- What texts (names, files, points) have been used for: text -> "contour", "curve" or "profile". An editor of a parameter
-- that holds such a text can then tell what is wanted.
local uses = {}

local function make_contour(given, item)
  if type(given) == "string" then
    uses[given] = uses[given] == "profile" and "profile" or "contour"
    if not curve_text.is(given) then return (core.load_contour(given, item)) end
    given = curve_text.read(given, "tunica.contour")
  end
  if item then fail("tunica.contour: 'item' belongs to a file with several contours, not to points") end
  options_of("tunica.contour", given, { "degree", "ends", "name" })
  return (core.new_contour(given, given.degree, given.ends, given.name))
end

local function make_curve(given, item)
  if type(given) == "string" then
    uses[given] = "curve"
    if not curve_text.is(given) then return (core.load_curve(given, item)) end
    given = curve_text.read(given, "tunica.curve")
    if given.ends then fail "tunica.curve: 'ends' belongs to a contour; a function has both its ends" end
  end
  if item then fail("tunica.curve: 'item' belongs to a file with several curves, not to points") end
  options_of("tunica.curve", given, { "degree", "name" })
  return (core.new_curve(given, given.degree, given.name))
end

local item = { name = "item", type = "string", doc = "which of the curves of a gallery (.fset, .tset, .cset)" }
local function example(text) return 'local tunica = require "tunica"\n' .. text end

op { name = "tunica.contour", returns = "a contour", source = "thesis 3.3",
  args = { { name = "points", type = "list|string", required = true, doc = "control points { { x, y }, ... }, with " ..
    "degree = (3, or what the points allow), ends = 'clamped' (default), 'open' or 'closed', name = ; or the name of a " ..
    "shipped contour, a file of L-Studio (.con) relative to the script, or points as text: '0,1 1,1 1,-3 degree=2'" }, item },
  doc = "A curve in the plane, drawn as a B-spline: the profile of an apex, the outline of a leaf. A clamped one starts in " ..
    "its first point and ends in its last; an open one does so where these are given three times. A contour never changes.",
  fn = make_contour,
  example = example [[
local dome = tunica.contour "dome"
print(dome:at(0.5))
print(tunica.contour { { 0, 0 }, { 1, 0 }, { 1, -3 }, degree = 2 })]] }

op { name = "tunica.curve", returns = "a curve; f(x) is its value", source = "thesis 3.3",
  args = { { name = "points", type = "list|string", required = true, doc = "points { { x, y }, ... } whose x never " ..
    "decreases, with degree = (3, or what the points allow; 1: straight from point to point), name = ; or the name of a " ..
    "shipped curve, a file of L-Studio (.func) relative to the script, or points as text: '0,0.3 0.5,1 2,1'" }, item },
  doc = "A function of one variable, drawn as a clamped B-spline, as growth along a profile or a threshold in time. Outside " ..
    "its points the values of its ends hold. A curve never changes. In rules and fields those of degree 1 are traced.",
  fn = make_curve,
  example = example [[
local f = tunica.curve { { 0, 0.2 }, { 1, 1 }, { 2, 0 } }
print(f(0.5), f:integral(0, 2))
print(tunica.curve "raised")]] }

--- The straight lines between points as an expression of a symbol x: in a rule or a field that is traced.
core.trace_curves(function(points, x)
  local y = points[1][2]
  for i = 2, #points do
    local from, to = points[i - 1], points[i]
    if to[1] > from[1] and to[2] ~= from[2] then
      local within = core.functions.max(0, core.functions.min(x - from[1], to[1] - from[1]))
      y = y + within * ((to[2] - from[2]) / (to[1] - from[1]))
    end
  end
  return y
end)

-- Contours ---------------------------------------------------------------------------------------------------------

local contour = 'local contour = tunica.contour { { 0, 0 }, { 1, 0 }, { 1, -3 } }\n'
op { name = "contour:at", args = { { name = "u", type = "number", required = true, min = 0, max = 1,
    doc = "place along the curve by its parameter, 0 to 1 (which is not arc length)" } },
  doc = "A point of the contour and the direction of the curve there.", returns = "x, y, and the unit tangent's x, y",
  fn = core.contour_place, example = example(contour .. "print(contour:at(0.5))") }
local along = { { name = "s", type = "number", required = true, unit = "length",
  doc = "arc length from the start, to the contour's length; of a closed contour any, which goes round" } }
op { name = "contour:length", returns = "a number", doc = "The length of the contour, to 1e-12 of it.",
  fn = core.contour_length, example = example(contour .. "print(contour:length())") }
op { name = "contour:along", args = along, returns = "x, y",
  doc = "The point of the contour at an arc length, to 1e-10 of its length.",
  fn = core.contour_along, example = example(contour .. "print(contour:along(contour:length() / 2))") }
op { name = "contour:tangent", args = along, returns = "x, y",
  doc = "The direction of the contour at an arc length, a unit vector; at a corner that of what follows.",
  fn = core.contour_tangent, example = example(contour .. "print(contour:tangent(1))") }
op { name = "contour:closest", returns = "its arc length, x, y",
  args = { { name = "x", type = "number", required = true, min = -1e100, max = 1e100, doc = "of the point" },
    { name = "y", type = "number", required = true, min = -1e100, max = 1e100, doc = "of the point" } },
  doc = "The place of the contour nearest to a point, the first of several; its distance is the least to 1e-10 of the length.",
  fn = core.contour_closest, example = example(contour .. "print(contour:closest(2, -1))") }
op { name = "contour:area", returns = "a number",
  doc = "The area within the contour, positive if it runs counter-clockwise; one that is not closed is closed by a straight " ..
    "line from its end to its start. Exact.",
  fn = core.contour_area, example = example(contour .. "print(contour:area())") }
op { name = "contour:points", doc = "What the contour was drawn from.",
  returns = "a list of { x, y }, the degree, and 'open', 'clamped' or 'closed'", fn = core.contour_points,
  example = example(contour .. "print(#contour:points())") }
op { name = "contour:scaled", args = { { name = "factor", type = "number", required = true, above = 0, max = 1e12,
    doc = "all lengths are multiplied by it" } },
  doc = "The contour in another size.", returns = "a contour",
  fn = function(self, factor) return (core.contour_changed(self, factor, false)) end,
  example = example(contour .. "print(contour:scaled(2))") }
op { name = "contour:reversed", returns = "a contour",
  doc = "The contour run through the other way: a profile must start at the tip.",
  fn = function(self) return (core.contour_changed(self, 1, true)) end,
  example = example(contour .. "print(contour:reversed():at(0))") }
local file = { name = "file", type = "string", required = true, doc = "its path" }
op { name = "contour:text", returns = "a text", example = example(contour .. "print(contour:text())"),
  doc = "The points as text, as tunica.contour reads them: to stand in a parameter or on the command line.",
  fn = function(self)
    local points, degree, ends = core.contour_points(self)
    return curve_text.write(points, degree, ends)
  end }
op { name = "contour:save", args = { file }, fn = function(self, path) core.save_contour(self, path) end,
  doc = "Writes the contour as a file of L-Studio (.con). Such files hold cubic curves: straight lines and single arcs " ..
    "of lower degree become the cubic that is the same." }

-- Functions --------------------------------------------------------------------------------------------------------

local curve = 'local f = tunica.curve { { 0, 0.2 }, { 1, 1 }, { 2, 0 } }\n'
local x = { name = "x", type = "number", required = true, doc = "place" }
op { name = "curve:derivative", args = { x }, returns = "a number",
  doc = "The slope of the curve at x, from the right; 0 outside.", fn = core.curve_derivative,
  example = example(curve .. "print(f:derivative(0.5))") }
op { name = "curve:integral", returns = "a number",
  args = { { name = "from", type = "number", required = true, doc = "start" },
    { name = "to", type = "number", required = true, doc = "end" } },
  doc = "The integral of the curve between two places, exact.", fn = core.curve_integral,
  example = example(curve .. "print(f:integral(0, 1))") }
op { name = "curve:points", doc = "What the curve was drawn from.", returns = "a list of { x, y }, the degree, and the name",
  fn = core.curve_points, example = example(curve .. "print(#f:points())") }
op { name = "curve:text", returns = "a text", example = example(curve .. "print(f:text())"),
  doc = "The points as text, as tunica.curve reads them: to stand in a parameter or on the command line.",
  fn = function(self)
    local points, degree = core.curve_points(self)
    return curve_text.write(points, degree)
  end }
op { name = "curve:save", args = { file }, fn = function(self, path) core.save_curve(self, path) end,
  doc = "Writes the curve as a file of L-Studio (.func)." }

-- The apex ---------------------------------------------------------------------------------------------------------

op { name = "tunica.apex", kind = "named", returns = "an apex", source = "thesis 3.3, equations 3.1 and 3.2",
  args = {
    { name = "profile", type = "contour|string|list",
      doc = "the curve that turns around the y axis, from the tip down: a contour, its name or file, or points; 'dome' if left out" },
    { name = "cap", type = "list", of = "number", count = { 2, 3 },
      doc = "instead of a profile: { radius, slope }, a part of a sphere down to where it falls by `slope` degrees, and from " ..
        "there a straight flank; its length, if it matters, is the third (30 radii if left out)" },
    { name = "growth", type = "number|curve|string|list", default = 1, unit = "1 / time",
      doc = "relative elemental growth rate along the profile, by arc length from the tip: a number, a curve, its name or " ..
        "file, or points" } },
  doc = "A growing surface of revolution with its tip at the top. A point of it is (theta, a): the angle in degrees and the " ..
    "arc length from the tip. With growth it moves away from the tip at the speed v(a), the integral of the rate from 0 to " ..
    "a; theta stays, and so does the form of the surface. Beyond its end the profile goes straight on. An apex never changes.",
  fn = function(t)
    if t.cap and t.profile then fail("tunica.apex: give a profile or a cap, not both") end
    local profile, growth = t.profile or "dome", t.growth
    if t.cap then
      profile = { t.cap[1], t.cap[2], t.cap[3] or 30 * t.cap[1] }
    else
      if type(profile) == "string" then uses[profile] = "profile" end
      if core.shape_kind(profile) ~= "contour" then profile = make_contour(profile) end
    end
    if type(growth) == "string" or type(growth) == "table" then growth = make_curve(growth) end
    local apex, least, place = core.new_apex(profile, growth)
    if least then
      warnings.say("tunica.apex: the rate of growth is negative, %.4g at a = %.4g: the surface shrinks there", least, place)
    end
    local _, widest, hole = apex:measures()
    if hole > 0 and hole < widest then
      warnings.say("tunica.apex: the profile starts %.4g from the axis: the surface has a hole at the tip", hole)
    end
    return apex
  end,
  example = example [[
local apex = tunica.apex { profile = "dome", growth = "raised" }
local ring = apex:arc_at_radius(1)
print(apex:speed(ring), apex:position(90, ring))]] }

local apex = 'local apex = tunica.apex { profile = "dome", growth = "raised" }\n'
local theta = { name = "theta", type = "number", required = true, unit = "degrees", doc = "angle around the axis" }
local a = { name = "a", type = "number", required = true, min = 0, max = 1e12, unit = "length",
  doc = "arc length from the tip" }
local function number(name, fn, doc, args)
  op { name = "apex:" .. name, args = args or { a }, doc = doc, returns = "a number", fn = fn,
    example = example(apex .. "print(apex:" .. name .. "(0.8" .. (args and #args > 1 and ", 2" or "") .. "))") }
end
op { name = "apex:position", args = { theta, a }, doc = "The point of the surface at a place.", returns = "x, y, z",
  source = "thesis (3.1)", fn = core.apex_position, example = example(apex .. "print(apex:position(137.5, 1))") }
op { name = "apex:normal", args = { theta, a }, doc = "The outward unit normal at a place.", returns = "x, y, z",
  fn = core.apex_normal, example = example(apex .. "print(apex:normal(137.5, 1))") }
op { name = "apex:closest", returns = "theta, a",
  args = { { name = "x", type = "number", required = true, doc = "of the point" },
    { name = "y", type = "number", required = true, doc = "of the point" },
    { name = "z", type = "number", required = true, doc = "of the point" } },
  doc = "The place on the surface nearest to a point in space. On the axis theta is 0.", source = "thesis 10.2",
  fn = core.apex_closest, example = example(apex .. "print(apex:closest(1, 0, 1))") }
op { name = "apex:profile", args = { a }, returns = "x, y, and the unit tangent's x, y",
  doc = "The profile at an arc length: distance from the axis and height.",
  fn = core.apex_profile, example = example(apex .. "print(apex:profile(1))") }
op { name = "apex:measures", returns = "three numbers",
  doc = "The length of the profile as drawn, its largest radius, and the radius of the hole at the tip (0: none).",
  fn = core.apex_measures, example = example(apex .. "print(apex:measures())") }
number("speed", core.apex_speed, "The speed at which a point moves away from the tip: the integral of the growth rate.")
number("growth", core.apex_growth, "The relative elemental growth rate at a place.")
number("area", core.apex_area, "The area of the surface from the tip to an arc length.")
number("arc_at_radius", core.apex_arc_at_radius, "The first arc length at which the profile is this far from the axis.",
  { { name = "radius", type = "number", required = true, min = 0, unit = "length", doc = "distance from the axis" } })
number("after", core.apex_after, "Where along the profile a point is after some time; before it, if the time is negative.",
  { a, { name = "dt", type = "number", required = true, unit = "time", doc = "time" } })

return { uses = uses, contour = make_contour, curve = make_curve }
