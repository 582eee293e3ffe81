-- SPDX-License-Identifier: MIT
--- Pictures of an apex with its primordia, from plain tables; who has a model of one supplies the table.
--
--   data = { profile = { { x, y }, ... },          -- from the tip outwards, x: distance from the axis, y upwards
--     primordia = { { theta =, arc =, age =, radius =, height =, value =, number = }, ... },  -- as they arose; theta in
--                                                  -- degrees, arc: along the profile; radius, height, number may be left out
--     ring = { arc =, values = { ... }, angles = { ... }, threshold =, chosen = },  -- values at angles, by default even
--     field = function(theta, arc),                -- returns a number: for colour = "field"
--     parastichies = { m, n }, jugacy = j }
--
-- All but the profile may be left out.

local core = require "tunica.core"
local registry = require "tunica.registry"
local fail = registry.fail

local apex_view = {}

--- The options of a view of an apex, as arguments of an operation.
apex_view.arguments = {
  { name = "colour", type = "string", choices = { "age", "size", "value", "field", "plain" }, default = "age",
    doc = "what primordia are coloured by; 'field': the surface, or the ring, by inhibition" },
  { name = "from", type = "string", choices = { "top", "oblique", "side" }, default = "top", doc = "where it is seen from" },
  { name = "turn", type = "number", unit = "degrees", default = 0, doc = "of the apex about its axis" },
  { name = "zoom", type = "number", above = 0, max = 1000, default = 1, doc = "1: all is in the picture" },
  { name = "reach", type = "number", above = 0, unit = "length",
    doc = "how much of the profile is shown; by default as far as there are primordia" },
  { name = "parastichies", type = "boolean|list", of = "integer", count = { 2, 2 },
    doc = "curves through primordia n, n + m, n + 2m ...: true for the contact pair, or { m, n }" },
  { name = "lattice", type = "boolean|string", choices = { "angles", "arc", "log" },
    doc = "unrolled, angle across; upright 'angles' (or true): so that angles and circles are kept, 'arc': the length along " ..
      "the profile, 'log': the logarithm of the radius" },
  { name = "arrows", type = "boolean", doc = "on the ring's minima, as long as they are deep; the one taken is black" },
  { name = "labels", type = "boolean", doc = "the primordia's numbers" },
  { name = "palette", type = "string|list", of = "string", choices = core.palettes(),
    doc = "colour map, by name or as a list of colours that it runs through" },
  { name = "range", type = "list", count = { 1, 2 }, of = "number", doc = "values at the ends of the colour map, { low, high }" },
  { name = "legend", type = "string|boolean", default = true, doc = "title of the colour bar; false: no legend" },
  { name = "title", type = "string|function|boolean", doc = "text above the picture, or a function(t) that returns it" },
  { name = "size", type = "number|list", of = "number", count = { 2, 2 }, min = 16, max = 16384,
    doc = "pixels, { width, height } or one number for both" },
  { name = "background", type = "string", doc = "colour of the ground" },
  { name = "transparent", type = "boolean", doc = "no ground" },
  { name = "surface", type = "string", doc = "colour of the apex" },
  { name = "plain", type = "string", doc = "colour of primordia with colour = 'plain'" },
}

local by_name, names = {}, {}
for i, spec in ipairs(apex_view.arguments) do by_name[spec.name], names[i] = spec, spec.name end

local function check_colour(what, value)
  if value == nil then return nil end
  local ok, why = core.is_colour(value)
  if not ok then fail("%s: %s", what, why) end
  return value
end

local function check_size(given, out)
  local size = given.size
  if type(size) == "number" then size = { size, size } end
  for i, side in ipairs(size or {}) do
    if side ~= math.floor(side) or side < 16 or side > 16384 then
      fail("size must be a whole number from 16 to 16384, came %.14g", side)
    end
    out[i == 1 and "width" or "height"] = side
  end
end

--- What core.draw_apex takes, from the options a user gave. Errors: an option that there is not (names the nearest), a value
-- of another kind or out of range. `also`: names of further options that are let through.
function apex_view.settings(given, also)
  local passed = {}
  for _, name in ipairs(also or {}) do passed[name] = true end
  for name, value in pairs(given) do
    local spec = by_name[name]
    if spec then
      local ok, hint = registry.matches(value, spec)
      if not ok then
        fail("'%s' of a view must be %s, came %s%s", name, registry.expected(spec), core.describe(value), hint or "")
      end
    elseif not passed[name] then
      fail("a view of an apex has no option %s%s; the options are: %s", (core.describe(name):gsub("^the text ", "")),
        type(name) == "string" and core.did_you_mean(name, names) or "", table.concat(names, ", "))
    end
  end
  local out = { colour = given.colour, from = given.from, turn = given.turn, zoom = given.zoom, reach = given.reach,
    arrows = given.arrows, labels = given.labels, palette = given.palette, transparent = given.transparent }
  for _, name in ipairs { "background", "surface", "plain" } do out[name] = check_colour(name, given[name]) end
  if type(given.palette) == "table" then
    if #given.palette < 2 then fail("palette: a list needs at least two colours") end
    for _, each in ipairs(given.palette) do check_colour("palette", each) end
  end
  if given.range then
    out.min, out.max = given.range[1], given.range[2]
    if out.max and out.min >= out.max then fail("range must go from low to high, came { %.14g, %.14g }", out.min, out.max) end
  end
  if type(given.legend) == "string" then out.legend_title = given.legend end
  out.legend = given.legend ~= false
  if type(given.title) == "string" then out.title = given.title end  -- a function is called by who knows the time
  if given.lattice and (given.arrows or given.colour == "field") then
    fail("a lattice shows no field: leave out lattice, or %s", given.arrows and "arrows" or "colour = 'field'")
  end
  if type(given.parastichies) == "table" then
    for _, number in ipairs(given.parastichies) do
      if not (number >= 1 and number <= 10000) then
        fail("parastichies: two numbers from 1 to 10000, { 5, 8 }, came { %.14g, %.14g }", given.parastichies[1], given.parastichies[2])
      end
    end
  end
  out.parastichies = given.parastichies and true or nil
  if given.lattice then out.lattice = given.lattice == true and "angles" or given.lattice end
  check_size(given, out)
  return out
end

local angles, rows = 180, 90  -- where a field is sampled: every 2 degrees

--- Samples a field between the tip and the end of what is shown.
local function sampled(field, reach)
  local out = { angles = angles, arcs = {}, values = {} }
  for row = 0, rows do
    local arc = reach * row / rows
    out.arcs[row + 1] = arc
    for i = 0, angles - 1 do
      local value = field(360 * i / angles, arc)
      if type(value) ~= "number" or value ~= value then
        fail("the field must be a number everywhere; at angle %.6g, arc %.6g it is %s", 360 * i / angles, arc, core.describe(value))
      end
      out.values[#out.values + 1] = math.max(-1e300, math.min(1e300, value))
    end
  end
  return out
end

local function reach_of(data)
  local reach = data.ring and data.ring.arc and 2 * data.ring.arc or 0
  for _, p in ipairs(data.primordia or {}) do reach = math.max(reach, p.arc + 1.5 * (p.radius or 0)) end
  for i = 2, reach == 0 and #data.profile or 0 do
    local a, b = data.profile[i - 1], data.profile[i]
    reach = reach + math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2)
  end
  return reach
end

--- The picture of an apex: bytes of a PNG, width, height. `texts`: list of { keyword, text } to be kept in the file;
-- `also`: options of others. Errors: as settings; data of another kind; what the options ask for is not among the data.
function apex_view.draw(data, given, texts, also)
  local settings = apex_view.settings(given, also)
  if type(data) ~= "table" then fail("the data of an apex must be a table, came %s", core.describe(data)) end
  local copy = {}
  for key, value in pairs(data) do copy[key] = value end
  if type(given.parastichies) == "table" then copy.parastichies = given.parastichies end
  if type(data.field) == "function" then
    copy.field = nil
    if settings.colour == "field" then
      settings.reach = settings.reach or reach_of(data)
      copy.field = sampled(data.field, settings.reach)
    end
  end
  return core.draw_apex(copy, settings, texts or { { "Software", "tunica" } })
end

-- Plots: options for tunica.plot ------------------------------------------------------------------------------------------

--- The angle from each primordium to the next, 0 to 360 degrees, folded so that most are below 180: an apex and its mirror
-- image read alike.
function apex_view.divergences(primordia)
  local list, above = {}, 0
  for i = 2, #primordia do
    list[i - 1] = (primordia[i].theta - primordia[i - 1].theta) % 360
    if list[i - 1] > 180 then above = above + 1 end
  end
  if above > #list / 2 then
    for i, angle in ipairs(list) do list[i] = 360 - angle end
  end
  return list
end

local function with(options, given)
  for key, value in pairs(given or {}) do options[key] = value end
  return options
end

--- Divergence angle against the number of the primordium. `given`: further options of tunica.plot (lines = { 137.5 }, file =).
function apex_view.divergence_plot(data, given)
  local y, x = apex_view.divergences(data.primordia), {}
  for i = 1, #y do x[i] = data.primordia[i + 1].number or i + 1 end
  return with({ x = x, y = y, style = "both", xlabel = "primordium", ylabel = "divergence angle, degrees" }, given)
end

--- Where a plot of a field ends that has a pole, at a primordium just born; nil if it has none.
local function below_poles(values, threshold)
  local sorted = {}
  for i, value in ipairs(values) do sorted[i] = value end
  table.sort(sorted)
  local low, high = math.min(sorted[1], threshold or sorted[1]), sorted[math.ceil(0.75 * #sorted)]
  if sorted[1] < 0 or high <= 0 or sorted[#sorted] < 3 * high then return nil end
  return { 0.9 * low, math.max(2 * high - low, 1.1 * (threshold or 0)) }
end

--- The inhibition around the ring, with the threshold as a line.
function apex_view.ring_plot(data, given)
  local ring, x = data.ring, {}
  if not ring or not ring.values then fail("the data has no ring with values to plot") end
  for i = 1, #ring.values do x[i] = ring.angles and ring.angles[i] or 360 * (i - 1) / #ring.values end
  return with({ x = x, y = ring.values, style = "lines", xlabel = "angle around the ring, degrees", ylabel = "inhibition",
    xrange = { 0, 360 }, yrange = below_poles(ring.values, ring.threshold),
    lines = ring.threshold and { { y = ring.threshold, text = "threshold" } } or nil }, given)
end

return apex_view
