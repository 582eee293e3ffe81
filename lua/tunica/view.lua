-- SPDX-License-Identifier: MIT
--- What a model shows: views and their options, pictures as files, pictures in the terminal, movies.

local core = require "tunica.core"
local registry = require "tunica.registry"
local op, fail = registry.op, registry.fail

local view = {}

--- Models without a tissue, which have pictures of their own: { is = function(model), check = function(model, given),
-- draw = function(model, given, title, texts) that returns what view.draw does }.
view.others = {}

local declared_at = setmetatable({}, { __mode = "k" })

--- Notes that a view was declared by the script's present line.
function view.note_place(given) declared_at[given] = registry.where() end

local function other(model)
  for _, kind in ipairs(view.others) do
    if kind.is(model) then return kind end
  end
end

-- Options ------------------------------------------------------------------------------------------------------------

local shown = "the name of a column, or a function that returns a number (nil: no value)"
local arguments = {
  { name = "colour", type = "string|function", doc = "colour of cells: " .. shown },
  { name = "palette", type = "string|list", of = "string", choices = core.palettes(), default = "viridis",
    doc = "colour map, by name or as a list of colours that it runs through" },
  { name = "range", type = "list", count = { 1, 2 }, of = "number",
    doc = "values at the ends of the colour map, { low, high }; by default those that occur (from 0, if they start near it)" },
  { name = "missing", type = "string|table", doc = "colour of cells without a value, by default grey; or { colour, title = } with what " ..
    "the legend calls them" },
  { name = "legend", type = "string|boolean", default = true, doc = "title of the colour bar; false: no legend" },
  { name = "sides", type = "string|function|table", doc = "bands along walls, inside the cell: " .. shown ..
    " of sides; or { column or function, max = value of the widest band, colour =, style = 'width' or 'intensity', " ..
    "width = of the widest band relative to a cell, title = }" },
  { name = "markers", type = "function|table", doc = "cells with a mark: function(c) that returns true or false, or a list " ..
    "of cells; or { function or list, shape = 'ring', 'disc', 'square', 'triangle', 'cross' or 'plus', colour =, size = }" },
  { name = "labels", type = "string|function",
    doc = "text on cells: 'id', the name of a column, or a function that returns text, a number or nil" },
  { name = "title", type = "string|function|boolean", doc = "text above the picture, or a function(t) that returns it; " ..
    "by default the time of a model; false: none" },
  { name = "size", type = "number|list", of = "number", count = { 2, 2 }, min = 16, max = 16384,
    doc = "pixels, { width, height } or one number for both" },
  { name = "bars", type = "boolean", doc = "a line or ring as bars (default) or as squares" },
  { name = "place", type = "function", doc = "function(c) that returns x, y, z: the cells of a grid or cylinder span a surface" },
  { name = "wireframe", type = "boolean", doc = "with place: only lines between neighbours" },
  { name = "camera", type = "table|function", doc = "{ direction = { x, y, z }, up =, perspective = true or false, zoom =, centre =, " ..
    "extent = half of what must fit }; or a function that returns this, so that the camera follows what it looks at" },
  { name = "light", type = "boolean", doc = "a lamp, so that surfaces in space look round; on by default where `place` is given" },
  { name = "background", type = "string", doc = "colour of the ground" },
  { name = "transparent", type = "boolean", doc = "no ground" },
  { name = "outline", type = "string|boolean", doc = "colour of the lines around cells; false: none" },
  { name = "outline_width", type = "number", min = 0, max = 100, unit = "pixels", doc = "of these lines; by default by the size of cells" },
  { name = "plain", type = "string", doc = "colour of cells without `colour`" },
}

local side_options = { "max", "colour", "style", "width", "title" }
local missing_options = { "title" }
local marker_options = { "shape", "colour", "size" }
local camera_options = { "direction", "up", "perspective", "zoom", "centre", "extent" }

--- Every key of `given` but 1 (and further items, with `list`) must be one of `options`.
local function check_keys(what, given, options, list)
  for key in pairs(given) do
    local known = key == 1 or list and type(key) == "number"
    for _, option in ipairs(options) do known = known or option == key end
    if not known then
      fail("%s has no option %s%s; expected %s", what, core.describe(key),
        type(key) == "string" and core.did_you_mean(key, options) or "", table.concat(options, ", "))
    end
  end
end

local function check_value(what, value, spec)
  if value == nil then return nil end
  local ok, hint = registry.matches(value, spec)
  if not ok then fail("%s must be %s, came %s%s", what, registry.expected(spec), core.describe(value), hint or "") end
  return value
end

local function colour(what, value)
  if type(value) ~= "string" then return check_value(what, value, { type = "string" }) end
  local ok, why = core.is_colour(value)
  if not ok then fail("%s: %s", what, why) end
  return value
end

local function option(name, given, key, spec) return check_value(name .. " of " .. key, given[name], spec) end

local function read_sides(given, out)
  if given == nil then return end
  if type(given) ~= "table" then given = { given } end
  check_keys("sides", given, side_options)
  out.sides = check_value("sides", given[1], { type = "string|function" })
  if out.sides == nil then fail("sides: the column is missing; write sides = { 'pin', max = 1 }") end
  out.sides_max = option("max", given, "sides", { type = "number", above = 0 })
  out.sides_colour = colour("colour of sides", given.colour)
  out.sides_style = option("style", given, "sides", { type = "string", choices = { "width", "intensity" } })
  out.sides_width = option("width", given, "sides", { type = "number", min = 0, max = 1 })
  out.sides_title = option("title", given, "sides", { type = "string" })
end

local shapes = { "ring", "disc", "square", "triangle", "cross", "plus" }

local function read_markers(given, out)
  if given == nil then return end
  -- A plain list of cells, or the function alone, is short for { it }.
  if type(given) == "function" or given[1] == nil and next(given) == nil or core.kind(given[1]) == "cell" then given = { given } end
  check_keys("markers", given, marker_options)
  out.marked = check_value("markers", given[1], { type = "function|list", of = "cell" })
  if out.marked == nil then fail("markers: write markers = function(c) ... end, or { function, shape = 'ring' }") end
  out.marker_shape = option("shape", given, "markers", { type = "string", choices = shapes })
  out.marker_colour = colour("colour of markers", given.colour)
  out.marker_size = option("size", given, "markers", { type = "number", above = 0, max = 1000 })
end

local function read_missing(given, out)
  if given == nil then return end
  if type(given) ~= "table" then given = { given } end
  check_keys("missing", given, missing_options)
  if given[1] == nil and given.title == nil then fail("missing: write missing = 'black', or { 'black', title = 'dead' }") end
  out.missing = colour("missing", given[1])
  out.missing_title = option("title", given, "missing", { type = "string" })
end

--- `drawing`: a camera that is a function is asked for now, and not only checked to be one.
local function read_camera(given, out, drawing)
  if given == nil then return end
  if type(given) == "function" then
    if not drawing then return end
    given = given()
    if type(given) ~= "table" then
      fail("camera: the function must return a table { direction = ... }, returned %s", core.describe(given))
    end
  end
  check_keys("camera", given, camera_options)
  out.camera = {}
  for _, name in ipairs { "direction", "up", "centre" } do out.camera[name] = option(name, given, "camera", { type = "vector" }) end
  for _, name in ipairs { "zoom", "extent" } do out.camera[name] = option(name, given, "camera", { type = "number", above = 0 }) end
  out.camera.perspective = option("perspective", given, "camera", { type = "boolean" })
end

local function read_outline(given, out)
  out.outline_width = given.outline_width
  if given.outline == false then out.outline_width = 0 end
  if type(given.outline) == "string" then out.outline = colour("outline", given.outline) end
end

--- What core.draw takes, from the options a user gave (checked one by one already); errors for what does not fit. `drawing`: for
-- a picture of the present, not only to check them.
local function settings_of(given, drawing)
  local out = { palette = given.palette, colour = given.colour, labels = given.labels, bars = given.bars, place = given.place,
    wireframe = given.wireframe, light = given.light, transparent = given.transparent }
  for _, name in ipairs { "background", "plain" } do out[name] = colour(name, given[name]) end
  if type(given.palette) == "table" then
    if #given.palette < 2 then fail("palette: a list needs at least two colours") end
    for _, each in ipairs(given.palette) do colour("palette", each) end
  end
  if given.range then
    out.min, out.max = given.range[1], given.range[2]
    if out.max and out.min >= out.max then fail("range must go from low to high, came { %.14g, %.14g }", out.min, out.max) end
  end
  if type(given.legend) == "string" then out.colour_title = given.legend end
  out.legend = given.legend ~= false
  local size = given.size
  if type(size) == "number" then size = { size, size } end
  if size then
    for _, side in ipairs(size) do check_value("size", side, { type = "integer", min = 16, max = 16384 }) end
    out.width, out.height = size[1], size[2]
  end
  read_sides(given.sides, out)
  read_markers(given.markers, out)
  read_missing(given.missing, out)
  read_camera(given.camera, out, drawing)
  read_outline(given, out)
  return out
end

--- Columns named by a view must exist; those of derive rules do once the rules are bound.
local function check_columns(tissue, settings)
  for _, each in ipairs { { "colour", "cell" }, { "sides", "side" }, { "labels", "cell" } } do
    local name, kind = settings[each[1]], each[2]
    if type(name) == "string" and not (each[1] == "labels" and name == "id") then
      local names, found = core.columns(tissue, kind), false
      for _, known in ipairs(names) do found = found or known == name end
      if not found then
        fail("%s: the %ss have no column '%s'%s", each[1], kind, name, core.did_you_mean(name, names))
      end
    end
  end
end

-- Views of a model ---------------------------------------------------------------------------------------------------

local function with(extra)
  local all = {}
  for i, argument in ipairs(extra) do all[i] = argument end
  for _, argument in ipairs(arguments) do all[#all + 1] = argument end
  return all
end

op { name = "model:view", kind = "named", source = "thesis figs. 3.4, 5.2, 5.4, 5.7",
  args = with { { name = "every", type = "number", above = 0, unit = "time", doc = "between pictures; without it, one at the end" },
    { name = "name", type = "string", doc = "of the pictures' folder, where a model has several views" },
    { name = "plot", type = "function", doc = "instead of the tissue: function(t) that returns the options of a tunica.plot, without a file" } },
  doc = "How the model is to be shown: cells coloured by a column, bands along their walls, marks and labels; or numbers, as a plot. " ..
    "A run writes a picture every so often, and one at its end.",
  example = [[
local tunica = require "tunica"
local tissue = tunica.ring { 50 }
tissue:cell { auxin = function(c) return c:uniform(0, 1) end }
local model = tunica.model { tissue = tissue, dt = 0.01 }
model:view { colour = "auxin", palette = "greens", every = 1 }
]],
  fn = function(model, given)
    if not given.plot then settings_of(given) end
    if given.name and not given.name:match "^[%w_-]+$" then
      fail("name of a view: letters, digits, - and _ only (it names a folder), came '%s'", given.name)
    end
    view.note_place(given)
    model:add_view(given)
  end }

local function title_of(model, given)
  local title = given.title
  if title == false then return nil end
  if type(title) == "function" then title = title(model and model.time or 0) end
  if type(title) == "number" then title = tostring(title) end
  if type(title) == "string" then return title end
  if title ~= nil and title ~= true then fail("title: the function must return text, returned %s", core.describe(title)) end
  if model and (given.every or title) then return string.format("t = %.6g", model.time) end
end

--- What a picture says of where it comes from.
local function texts_of(model)
  local texts = { { "Software", "tunica" } }
  if not model then return texts end
  if model.name then texts[#texts + 1] = { "tunica:model", tostring(model.name) } end
  texts[#texts + 1] = { "tunica:time", core.shortest(model.time) }
  texts[#texts + 1] = { "tunica:seed", core.shortest(core.seed()) }
  if model.params then texts[#texts + 1] = { "tunica:parameters", core.encode(require("tunica.params").values(model.params)) } end
  return texts
end

--- A view that is a plot, as bytes of a PNG.
local function draw_plot(model, given)
  local options = given.plot(model.time)
  if type(options) ~= "table" then fail("view: the function 'plot' must return the options of tunica.plot, returned %s", core.describe(options)) end
  local name = os.tmpname()
  os.remove(name)
  local plotted = { file = name .. ".png", title = title_of(model, given), size = given.size }
  for key, value in pairs(options) do plotted[key] = value end
  registry.module.plot(plotted)
  local bytes = core.read_file(plotted.file)
  os.remove(plotted.file)
  return bytes
end

local function draw(model, given)
  local kind = other(model)
  if kind then return kind.draw(model, given, title_of(model, given), texts_of(model)) end
  if given.plot then return draw_plot(model, given) end
  local settings = settings_of(given, true)
  settings.title = title_of(model, given)
  check_columns(model.tissue, settings)
  return core.draw(model.tissue, settings, texts_of(model))
end

--- What is said of an error from a view: with the line that declared the view, unless it names one of the script already.
local function with_place(given, message)
  local where = declared_at[given]
  if core.cancelled() or not where then return message end
  if type(message) ~= "string" then
    return string.format("%s: a function of this view raised an error that is not text but %s", where, core.describe(message))
  end
  return message:find "^[^\n]-:%d+: " and message or where .. ": " .. message
end

--- The picture of a model by one of its views: bytes of a PNG, width, height, what is around its content (for core.terminal_picture;
-- nil for plots). It changes nothing, so random numbers that functions of
-- the view draw are those that come next.
function view.draw(model, given)
  local random = core.random_state()
  local ok, png, width, height, around = pcall(draw, model, given)
  core.random_state(random)
  if not ok then error(with_place(given, png), 0) end
  return png, width, height, around
end

--- The same, into a file, which is replaced as one act.
function view.save(model, given, path)
  core.write_atomic(path, (view.draw(model, given)))
end

--- Raises an error if a view names a column that the model's tissue does not have. To be called when the rules are bound.
function view.check(model)
  local kind = other(model)
  for _, given in ipairs(kind and model.views or {}) do kind.check(model, given) end
  if kind then return end
  for _, given in ipairs(model.views) do
    if not given.plot then check_columns(model.tissue, settings_of(given)) end
  end
end

--- True if pictures can be drawn here; else false and why not.
function view.available()
  local name, why = core.renderer()
  return name ~= nil, why
end

--- A film (.mp4) of PNG files, in order. Returns the number of pictures.
function view.movie(path, files, frames_per_second)
  local movie = core.movie(path, frames_per_second or 24)
  for _, file in ipairs(files) do core.movie_add(movie, core.read_file(file)) end
  return core.movie_finish(movie)
end

-- Pictures of a tissue -----------------------------------------------------------------------------------------------

local setup = [[
local tunica = require "tunica"
local tissue = tunica.hexagons { 6, 6 }
tissue:cell { auxin = function(c) return c:uniform(0, 1) end }
]]

local function draw_tissue(tissue, given)
  local settings = settings_of(given, true)
  settings.title = title_of(nil, given)
  check_columns(tissue, settings)
  return core.draw(tissue, settings, texts_of())
end

op { name = "tissue:picture", kind = "named", returns = "the path", source = "thesis figs. 3.4, 5.2, 5.4, 5.7",
  args = with { { name = "file", type = "string", required = true, position = 1, doc = "path that ends in .png; replaced if it is there" } },
  doc = "Writes a picture of the tissue as it is now.",
  example = setup .. [[tissue:picture { os.tmpname() .. ".png", colour = "auxin", size = 200 }]],
  fn = function(tissue, given)
    if not given.file:match "%.png$" then fail("tissue:picture: the file must end in .png, came '%s'", given.file) end
    core.write_atomic(given.file, (draw_tissue(tissue, given)))
    return given.file
  end }

op { name = "tissue:show", kind = "named", args = arguments,
  doc = "Shows a picture of the tissue in the terminal. Where the output is no terminal, or one that cannot show pictures, " ..
    "it is written to a temporary file, whose path is printed.",
  example = setup .. [[tissue:show { colour = "auxin", size = 100 }]],
  fn = function(tissue, given)
    local png, _, _, around = draw_tissue(tissue, given)
    local text = core.terminal_picture(png, around)
    if text then
      io.write(text)
      io.flush()
      return
    end
    local name = os.tmpname()
    os.remove(name)
    core.write_atomic(name .. ".png", png)
    print(name .. ".png")
  end }

return view
