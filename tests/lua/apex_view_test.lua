-- SPDX-License-Identifier: MIT
--- Pictures of apices from plain tables, plots, pages: what is drawn, and what wrong data and options say.

local check = require "check"
local tunica = require "tunica"
local core = require "tunica.core"
local apex_view = require "tunica.apex_view"

local function spiral(count)
  local data = { profile = {}, primordia = {}, ring = { arc = 0.6, values = {}, threshold = 1 }, parastichies = { 3, 5 } }
  for i = 0, 40 do data.profile[i + 1] = { math.sin(i * math.pi / 80), math.cos(i * math.pi / 80) } end
  data.profile[42] = { 1, -4 }
  for i = 1, count do
    data.primordia[i] = { theta = 137.5 * i, arc = 0.6 + 0.12 * (count - i), age = count - i, value = i }
  end
  for i = 1, 90 do data.ring.values[i] = 2 + math.cos(math.rad(8 * i)) end
  data.field = function(theta, arc) return arc + math.cos(math.rad(theta)) end
  return data
end

local data = spiral(20)

local function draw(options, of)
  options.size = options.size or 150
  return (apex_view.draw(of or data, options))
end

-- Every option draws, and shows.
local plain = draw {}
assert(plain:sub(1, 4) == "\137PNG")
assert(plain == draw { colour = "age", from = "top", turn = 0, zoom = 1, legend = true })
for _, options in ipairs {
  { colour = "size" }, { colour = "value" }, { colour = "plain" }, { colour = "field" }, { from = "side" }, { from = "oblique" },
  { turn = 30 }, { zoom = 2 }, { reach = 1.5 }, { parastichies = true }, { parastichies = { 5, 8 } }, { lattice = true },
  { lattice = "arc" }, { lattice = "log" }, { arrows = true }, { labels = true }, { palette = { "red", "blue" } },
  { range = { 0, 5 } }, { legend = "plastochrons" }, { legend = false }, { title = "spiral" }, { background = "black" },
  { transparent = true }, { surface = "white" },
} do
  local png = draw(options)
  assert(png:sub(1, 4) == "\137PNG" and png ~= plain, next(options))
end
local png, width, height = apex_view.draw(data, { size = { 120, 90 } }, { { "tunica:time", "3" } })
check.equal(width, 120) check.equal(height, 90)
assert(png:find("tunica:time", 1, true))
assert(draw({}, { profile = { { 0, 0 }, { 1, 0 } } }))  -- an apex alone

-- The library's own options are let through where they are named.
apex_view.draw(data, { size = 50, every = 1 }, nil, { "every" })

local function refuses(words, options, change)
  local of = spiral(20)
  if change then change(of) end
  options.size = options.size or 60
  check.fails(function() apex_view.draw(of, options) end, words)
end
refuses("did you mean 'colour'", { color = "age" })
refuses("did you mean 'age'", { colour = "agee" })
refuses("did you mean 'side'", { from = "sid" })
refuses("did you mean 'angles'", { lattice = "angle" })
refuses("did you mean 'viridis'", { palette = "virids" })
refuses("at least two colours", { palette = { "red" } })
refuses("from low to high", { range = { 2, 1 } })
refuses("size must be a whole number", { size = { 100.5, 100 } })
refuses("did you mean 'white'", { surface = "whit" })
refuses("'zoom' of a view", { zoom = 0 })
refuses("came the number nan", { turn = 0 / 0 })
refuses("multiples of the jugacy", { parastichies = { 3, 5 } }, function(d) d.jugacy = 2 end)
refuses("pair", { parastichies = true }, function(d) d.parastichies = nil end)
refuses("two different points", {}, function(d) d.profile = {} end)
refuses("two different points", {}, function(d) d.profile = nil end)
refuses("a point of the profile", {}, function(d) d.profile[3] = { 1 } end)
refuses("x >= 0", {}, function(d) d.profile[1] = { -1, 0 } end)
refuses("finite", {}, function(d) d.profile[1] = { 0, 0 / 0 } end)
refuses("primordium 2 has no 'arc'", {}, function(d) d.primordia[2] = { theta = 1 } end)
refuses("theta", {}, function(d) d.primordia[2].theta = "up" end)
refuses("radius of primordium 2", {}, function(d) d.primordia[2].radius = 0 end)
refuses("no 'arc'", {}, function(d) d.ring = {} end)
refuses("no ring with values", { arrows = true }, function(d) d.ring = nil end)
refuses("90 values", { arrows = true }, function(d) d.ring.angles = { 1, 2 } end)
refuses("number everywhere", { colour = "field" }, function(d) d.field = function() end end)
refuses("shows no field", { colour = "field", lattice = true })
refuses("a whole number", {}, function(d) d.jugacy = 1.5 end)
check.fails(function() apex_view.draw(1, {}) end, "must be a table")

-- Divergence angles are folded alike for an apex and its mirror image.
local mirrored = spiral(20)
for _, p in ipairs(mirrored.primordia) do p.theta = -p.theta end
for i, angle in ipairs(apex_view.divergences(mirrored.primordia)) do
  check.near(angle, 137.5, 1e-9)
  check.near(apex_view.divergences(data.primordia)[i], 137.5, 1e-9)
end

-- Plots and pages.
local name = os.tmpname()
os.remove(name)
local function exists(path)
  local file = io.open(path, "rb")
  if file then file:close() end
  return file ~= nil
end
local function plot(options)
  options.file = options.file or name .. ".png"
  return tunica.plot(options)
end
local drawable = pcall(core.gnuplot, "set output")
if drawable then
  check.equal(plot { y = { 1, 2, 3 } }, name .. ".png")
  assert(core.read_file(name .. ".png"):sub(1, 4) == "\137PNG")
  tunica.plot { { name .. "_both.png", name .. "_both.svg" }, x = { 1, 2 }, y = { 3, 4 }, lines = { 3.5, { y = 3, text = "it's low" }, { x = 1.5 } },
    title = "two\nlines", xlabel = "x", ylabel = "y", xrange = { 0, 3 }, yrange = { 1, 5 }, log = "y", size = { 300, 200 } }
  assert(exists(name .. "_both.png") and exists(name .. "_both.svg"))
  plot { series = { { y = { 1, 2 }, title = "a", style = "lines" }, { x = { 2, 1 }, y = { 1, 2 }, colour = "red" } }, style = "both" }
  plot(apex_view.divergence_plot(data, { lines = { { y = 137.5, text = "limit" } } }))
  plot(apex_view.ring_plot(data))
end

-- Models of phyllotaxis show themselves.
local view = require "tunica.view"
local function model_on(path)
  local model = tunica.phyllotaxis { path = path, samples = 90 }
  model:inhibition { field = function(d, age) return math.exp(-age) / d end, below = 3 }
  return model
end
local flat, round = model_on(function(age) return math.exp(age), 0 end), model_on(function(age) return 1, -age end)
for _, model in ipairs { flat, round } do
  -- Before anything has happened there is no pattern, and none is asked for.
  for _, options in ipairs { {}, { parastichies = true }, { lattice = true, parastichies = true, labels = true },
    { colour = "field", arrows = true } } do
    options[1], options.size = name .. ".png", 80
    check.equal(model:picture(options), name .. ".png")
  end
  model:advance(2)
  for _, options in ipairs { {}, { from = "side", labels = true }, { colour = "field", arrows = true, reach = 2 }, { lattice = true },
    { parastichies = { 1, 2 }, turn = 90 } } do
    options[1], options.size = name .. ".png", 80
    model:picture(options)
    assert(core.read_file(name .. ".png"):sub(1, 4) == "\137PNG")
  end
end

-- The contact pair is read from the primordia.
local spiral_model = model_on(function(age) return math.exp(age), 0 end)
for i = 0, 29 do spiral_model:primordium { angle = 137.5 * i, age = 0.05 * (30 - i) } end
local function shown(parastichies)
  spiral_model:picture { name .. ".png", size = 120, parastichies = parastichies }
  return core.read_file(name .. ".png")
end
local found = tunica.pattern(spiral_model:primordia()).pair
assert(shown(true) == shown { found[1], found[2] } and shown(true) ~= shown(false))

local before = flat:hash()
flat:picture { name .. ".png", size = 60, colour = "field" }
check.equal(flat:hash(), before, "a picture changes nothing")
flat:view { colour = "age", every = 1, size = 60 }
flat:view { lattice = "log", name = "lattice", size = 60, title = function(t) return "at " .. t end }
view.check(flat)
assert(view.draw(flat, flat.views[1]):find("tunica:time", 1, true))
view.draw(flat, flat.views[2])
check.fails(function() flat:view { color = "age" } end, "did you mean 'colour'")
check.fails(function() flat:view { name = "../up" } end, "name of a view")
check.fails(function() flat:picture { "a.jpg" } end, "must end in .png")
check.fails(function() model_on(function(age) return 1, -age end):plot { name .. ".png" } end, "no divergence angle")
if drawable then
  flat:plot { name .. ".png", lines = { 137.5 } }
  flat:plot { name .. ".png", show = "threshold" }
  round:plot { name .. ".png", show = "field", title = "field" }
end

for _, wrong in ipairs {
  { "give 'y'", {} }, { "'x' needs 'y'", { x = { 1 } } }, { "2 x and 1 y", { x = { 1, 2 }, y = { 1 } } },
  { "did you mean 'title'", { series = { { y = { 1 }, titl = "a" } } } }, { "has no 'y'", { series = { {} } } },
  { "did you mean 'lines'", { y = { 1 }, style = "line" } }, { "no numbers", { y = {} } },
  { "each a number", { y = { 1, 0 / 0 } } }, { "either 'x' or 'y'", { y = { 1 }, lines = { { text = "a" } } } },
  { "from low to high", { y = { 1 }, xrange = { 2, 1 } } }, { "100 to 16384", { y = { 1 }, size = { 10, 10 } } },
  { "control characters", { y = { 1 }, file = "a\nb.png" } }, { "must end in .png or .svg", { y = { 1 }, file = "a.jpg" } }, { "did you mean 'red'", { series = { { y = { 1 }, colour = "redd" } } } },
} do
  check.fails(function() plot(wrong[2]) end, wrong[1])
end

local page = name .. "_page.png"
check.equal(tunica.page { { plain, plain, plain }, captions = { "a", "b" }, columns = 2, file = page, title = "t" }, page)
tunica.page { { page, plain }, file = page, gap = 0, background = "black" }
check.fails(function() tunica.page { { "no/such.png" }, file = page } end, "no/such.png")
check.fails(function() tunica.page { {}, file = page } end, "1 to 10000 items")
check.fails(function() tunica.page { { plain }, file = "page.jpg" } end, "must end in .png")
check.fails(function() tunica.page { { plain }, captions = { "a", "b" }, file = page } end, "2 captions")
check.fails(function() tunica.page { { "\137PNG broken" }, file = page } end, "PNG")
check.fails(function() tunica.page { { plain, plain }, columns = 1, gap = 1000, file = page, background = "blak" } end, "black")

for _, path in ipairs { name .. ".png", name .. "_both.png", name .. "_both.svg", page } do os.remove(path) end
