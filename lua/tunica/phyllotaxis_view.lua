-- SPDX-License-Identifier: MIT
--- What a model of phyllotaxis shows: its apex with the primordia, by apex_view.

local core = require "tunica.core"
local registry = require "tunica.registry"
local view = require "tunica.view"
local apex_view = require "tunica.apex_view"
local phyllotaxis = require "tunica.phyllotaxis"
local op, fail = registry.op, registry.fail

local far = 9  -- what is further from the ring than so many of its radii is never shown

-- The profile -------------------------------------------------------------------------------------------------------------

--- The part of the profile inside of the ring, where a model that has only a path has none: flat where the path starts level,
-- else a vault that meets it with the same slope. Changes nothing but the picture.
local function vault(radius, height, dx, dy)
  local back = math.min(dx > 0 and 0.5 * radius / dx or math.huge, dy < 0 and -0.7 * radius / dy or math.huge)
  if dy >= 0 or back == math.huge then return { { 0, height } } end
  local x, y, points = radius - back * dx, height - back * dy, {}
  for i = 0, 40 do
    local t = i / 41
    points[i + 1] = { 2 * t * (1 - t) * x + t * t * radius, (1 - t * t) * y + t * t * height }
  end
  return points
end

local function profile_of_path(my, state, oldest)
  local track, radius, step = my.ring.track, my.ring.radius, 2 * state.time_scale
  local x, y = core.call_rule(track, step)
  local points = vault(radius, my.ring.height, x - radius, y - my.ring.height)
  points[#points + 1] = { radius, my.ring.height }
  local age, longest, way = 0, math.max(1.1 * oldest, 100 * step), 0
  while age < longest and way < far * radius and #points < 20000 do
    local last = points[#points]
    age = age + step
    x, y = core.call_rule(track, age)
    way = way + math.sqrt((x - last[1]) ^ 2 + (y - last[2]) ^ 2)
    points[#points + 1] = { math.max(0, x), y }
  end
  return points
end

local function profile_of_apex(my)
  local points, size = {}, my.ring.radius
  for i = 0, 60 * far do
    local x, y = my.apex:profile(size * i / 50)
    points[i + 1] = { math.max(0, x), y }
  end
  return points
end

--- Length along the profile of each of its points.
local function lengths_of(points)
  local list = { 0 }
  for i = 2, #points do
    list[i] = list[i - 1] + math.sqrt((points[i][1] - points[i - 1][1]) ^ 2 + (points[i][2] - points[i - 1][2]) ^ 2)
  end
  return list
end

--- The length along the profile at its point nearest to (x, y); beyond its end what a straight line would have.
local function arc_of(points, lengths, x, y)
  local best, arc = math.huge, 0
  for i = 1, #points do
    local distance = (points[i][1] - x) ^ 2 + (points[i][2] - y) ^ 2
    if distance < best then best, arc = distance, i end
  end
  local a = math.max(1, math.min(arc, #points - 1))
  local function along(i)
    local p, q, length = points[i], points[i + 1], lengths[i + 1] - lengths[i]
    if length == 0 then return 0, math.huge end
    local t = ((x - p[1]) * (q[1] - p[1]) + (y - p[2]) * (q[2] - p[2])) / length ^ 2
    t = math.max(0, i == #points - 1 and t or math.min(1, t))
    return t * length, (p[1] + t * (q[1] - p[1]) - x) ^ 2 + (p[2] + t * (q[2] - p[2]) - y) ^ 2
  end
  local here, near = along(a)
  if a > 1 then
    local before, nearer = along(a - 1)
    if nearer < near then return lengths[a - 1] + before end
  end
  return lengths[a] + here
end

--- The point of the profile at a length along it.
local function point_at(points, lengths, arc)
  local low, high = 1, #points
  while high - low > 1 do
    local middle = math.floor((low + high) / 2)
    if lengths[middle] <= arc then low = middle else high = middle end
  end
  local span = lengths[high] - lengths[low]
  local t = span > 0 and (arc - lengths[low]) / span or 0
  local p, q = points[low], points[high]
  return math.max(0, p[1] + t * (q[1] - p[1])), p[2] + t * (q[2] - p[2])
end

-- The data ----------------------------------------------------------------------------------------------------------------

local function ring_of(my, arc)
  local values, angles = core.inhibition_ring(my.engine, 1)
  local order = {}
  for i = 1, #values do order[i] = { math.deg(angles[i]) % 360, values[i] } end
  table.sort(order, function(a, b) return a[1] < b[1] end)  -- jitter may have moved one past another
  local ring = { arc = arc, radius = my.ring.radius, values = {}, angles = {},
    chosen = math.deg((core.inhibition_minimum(my.engine))) }
  for _, each in ipairs(order) do
    if each[1] ~= ring.angles[#ring.angles] then
      ring.angles[#ring.angles + 1] = each[1]
      ring.values[#ring.values + 1] = math.max(-1e300, math.min(1e300, each[2]))
    end
  end
  return ring
end

--- The contact pair and jugacy of the latest primordia, where there are enough of them to tell. Else nothing: a run must not
-- end because its first pictures have no pattern yet.
local function read_pattern(model, data)
  local ok, pattern = pcall(model.pattern, model, { first = math.max(1, model.count - 39) })
  local pair = ok and pattern.pair
  if not pair or pair[1] % pattern.jugacy ~= 0 or pair[2] % pattern.jugacy ~= 0 then return end
  data.parastichies, data.jugacy = { pair[1], pair[2] }, pattern.jugacy
end

local function divisor(a, b)
  while b > 0 do a, b = b, a % b end
  return a
end

--- The plain table that apex_view draws.
local function data_of(model, given)
  local list = model:primordia()
  local my = phyllotaxis.inside[model]
  local oldest = list[1] and list[1].age or 0
  local points = my.apex and profile_of_apex(my) or profile_of_path(my, core.inhibition_state(my.engine), oldest)
  local lengths = lengths_of(points)
  local data = { profile = points, primordia = {}, jugacy = 1 }
  for _, p in ipairs(list) do
    local arc = arc_of(points, lengths, p.radius, p.y)
    if arc <= lengths[#lengths] then  -- older ones are out of sight
      data.primordia[#data.primordia + 1] = { theta = p.angle, arc = arc, age = p.age, number = p.number, value = p.time }
    end
  end
  data.ring = ring_of(my, arc_of(points, lengths, my.ring.radius, my.ring.height))
  data.field = function(theta, arc)
    local x, y = point_at(points, lengths, arc)
    return core.inhibition_value(my.engine, 1, math.rad(theta), x, y)
  end
  if given.parastichies == true then read_pattern(model, data) end
  if type(given.parastichies) == "table" then
    local common = divisor(given.parastichies[1], given.parastichies[2])
    -- (6, 6) may be whorls of six or of three: as the model has them.
    data.jugacy = my.jugacy > 1 and common % my.jugacy == 0 and my.jugacy or common
    data.parastichies = given.parastichies
  end
  return data
end

--- The threshold of the first inhibitor at a time.
local function threshold_at(my, time)
  local below = my.rules[1].below
  return type(below) == "number" and below or core.call_rule(below, time)
end

--- A plot as bytes of a PNG, with its width and height.
local function plotted(model, given)
  local name = os.tmpname()
  local path = name .. ".png"
  local ok, message = pcall(model.plot, model, { file = path, show = given.plot, lines = given.lines })
  local bytes = ok and core.read_file(path)
  os.remove(name)
  os.remove(path)
  if not ok then error(message, 0) end
  local function number(at)
    local a, b, c, d = bytes:byte(at, at + 3)
    return ((a * 256 + b) * 256 + c) * 256 + d
  end
  return bytes, number(17), number(21)
end

--- As far as the primordia go, but not where those near the ring would be small.
local function nearby(data)
  local reach = 1.4 * data.ring.arc
  for _, p in ipairs(data.primordia) do reach = math.max(reach, p.arc + 0.5 * data.ring.radius) end
  return math.min(reach, data.ring.arc + 4 * data.ring.radius)
end

local others = { "every", "name", "file", "plot", "lines" }
table.insert(view.others, {
  is = phyllotaxis.is_phyllotaxis,
  check = function(_, given) apex_view.settings(given, others) end,
  draw = function(model, given, title, texts)
    if given.plot then return plotted(model, given) end
    local options = {}
    for name, value in pairs(given) do options[name] = value end
    options.title = title
    local data = data_of(model, given)
    options.parastichies = data.parastichies
    if not given.lattice then options.reach = given.reach or nearby(data) end
    return apex_view.draw(data, options, texts, others)
  end })

-- Operations ----------------------------------------------------------------------------------------------------------------

local function with(extra)
  local all = {}
  for i, argument in ipairs(extra) do all[i] = argument end
  for _, argument in ipairs(apex_view.arguments) do all[#all + 1] = argument end
  return all
end

local example = [[
local tunica = require "tunica"
local model = tunica.phyllotaxis { path = function(age) return math.exp(age), 0 end, samples = 90 }
model:inhibition { field = function(d, age) return math.exp(-age) / d end, below = 2.5 }
]]

op { name = "phyllotaxis:view", kind = "named", source = "thesis figs. 4.2, 4.6, 4.9, 4.12",
  args = with { { name = "every", type = "number", above = 0, unit = "time",
    doc = "between pictures; without it, one at the end" },
    { name = "name", type = "string", doc = "of the pictures' folder, where a model has several views" },
    { name = "plot", type = "string", choices = { "divergence", "threshold", "field" },
      doc = "not the apex but a plot, see phyllotaxis:plot" },
    { name = "lines", type = "list", of = "number|table", doc = "straight lines through the plot" } },
  doc = "How the model is to be shown: the apex with its primordia, unrolled, or as a plot. A run writes a picture every so " ..
    "often, and one at its end.",
  example = example .. [[model:view { colour = "age", from = "top", every = 0.5 }]],
  fn = function(model, given)
    apex_view.settings(given, others)
    if given.name and not given.name:match "^[%w_-]+$" then
      fail("name of a view: letters, digits, - and _ only (it names a folder), came '%s'", given.name)
    end
    view.note_place(given)
    table.insert(phyllotaxis.inside[model].views, given)
  end }

op { name = "phyllotaxis:picture", kind = "named", returns = "the path", source = "thesis figs. 4.2, 4.6, 4.9, 4.12",
  args = with { { name = "file", type = "string", required = true, position = 1,
    doc = "path that ends in .png; replaced if it is there" } },
  doc = "Writes a picture of the apex as it is now.",
  example = example .. [[
model:advance(1)
model:picture { os.tmpname() .. ".png", size = 100 }
]],
  fn = function(model, given)
    if not given.file:match "%.png$" then fail("phyllotaxis:picture: the file must end in .png, came '%s'", given.file) end
    view.save(model, given, given.file)
    return given.file
  end }

op { name = "phyllotaxis:plot", kind = "named", returns = "the path, or paths", source = "thesis figs. 4.2, 4.4",
  args = { { name = "file", type = "string|list", of = "string", count = { 1, 10 }, required = true, position = 1,
      doc = "path that ends in .png or .svg, or a list of such; replaced if they are there" },
    { name = "show", type = "string", choices = { "divergence", "threshold", "field" }, default = "divergence",
      doc = "the divergence angle of each primordium; 'threshold': against the first inhibitor's threshold when it was born " ..
        "(what a function of time says of that time now), as transitions are shown; 'field': that inhibitor's field around " ..
        "the ring" },
    { name = "lines", type = "list", of = "number|table", doc = "straight lines through the plot, as in tunica.plot: { 137.5 }" },
    { name = "title", type = "string", doc = "above the plot" },
    { name = "yrange", type = "list", of = "number", count = { 2, 2 }, doc = "{ low, high }" } },
  doc = "Plots the model's primordia or its field as they are now.",
  example = example .. [[
model:advance(2)
local path = os.tmpname() .. ".png"
model:plot { path, lines = { { y = 137.5, text = "limit" } } }
os.remove(path)
]],
  fn = function(model, given)
    local list = model:primordia()
    local my = phyllotaxis.inside[model]
    local options = { file = given.file, title = given.title, yrange = given.yrange, lines = given.lines }
    if given.show == "field" then
      local data = { ring = ring_of(my, 0) }
      data.ring.threshold = not given.lines and threshold_at(my, model.time) or nil
      return registry.module.plot(apex_view.ring_plot(data, options))
    end
    if #list < 2 then fail("phyllotaxis:plot: there is no divergence angle with %d primordia", #list) end
    for _, p in ipairs(list) do p.theta = p.angle end
    if given.show == "threshold" then
      options.x, options.style, options.xlabel = {}, "points", "threshold"
      for i = 2, #list do options.x[i - 1] = threshold_at(my, list[i].time) end
    end
    return registry.module.plot(apex_view.divergence_plot({ primordia = list }, options))
  end }
