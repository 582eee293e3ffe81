-- SPDX-License-Identifier: MIT
--- Plots of numbers, and pages of pictures.

local core = require "tunica.core"
local registry = require "tunica.registry"
local picture = require "tunica.chart.picture"
local op, fail = registry.op, registry.fail

-- Colours that stay apart for the colour-blind (after Okabe and Ito 2008).
local colours = { "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444" }
local styles = { "points", "lines", "both", "steps", "impulses" }
local drawn_as = { points = "points pt 7 ps 0.7", lines = "lines lw 1.8", both = "linespoints pt 7 ps 0.7 lw 1",
  steps = "steps lw 1.8", impulses = "impulses lw 2" }
local series_options = { "x", "y", "title", "style", "colour" }

local number = picture.number
--- Text for gnuplot, on one line.
local function quoted(text) return picture.quoted((text:gsub("%c", " "))) end

local function check_numbers(what, list)
  local ok, hint = registry.matches(list, { type = "list", of = "number" })
  if not ok then fail("tunica.plot: '%s' must be a list of numbers, came %s%s", what, core.describe(list), hint or "") end
  return list
end

local function check_keys(what, given, options)
  for key in pairs(given) do
    local known = false
    for _, option in ipairs(options) do known = known or option == key end
    if not known then
      fail("%s has no option %s%s; the options are: %s", what, (core.describe(key):gsub("^the text ", "")),
        type(key) == "string" and core.did_you_mean(key, options) or "", table.concat(options, ", "))
    end
  end
end

local function check_option(what, value, spec)
  if value == nil then return nil end
  local ok, hint = registry.matches(value, spec)
  if not ok then fail("%s must be %s, came %s%s", what, registry.expected(spec), core.describe(value), hint or "") end
  return value
end

local function check_colour(what, value)
  local ok, why = core.is_colour(check_option(what, value, { type = "string" }))
  if not ok then fail("%s: %s", what, why) end
  return value
end

--- One row of numbers: { x =, y =, title =, style =, colour = }, checked, with what it lacks filled in.
local function read_series(given, i, style)
  if type(given) ~= "table" then fail("tunica.plot: a series must be a table { x =, y = }, came %s", core.describe(given)) end
  check_keys("a series of tunica.plot", given, series_options)
  if given.y == nil then fail("tunica.plot: series %d has no 'y'", i) end
  local y, x = check_numbers("y", given.y), given.x and check_numbers("x", given.x)
  if not x then
    x = {}
    for k = 1, #y do x[k] = k end
  end
  if #x ~= #y then fail("tunica.plot: series %d has %d x and %d y", i, #x, #y) end
  local colour = given.colour and check_colour("tunica.plot: colour", given.colour) or colours[(i - 1) % #colours + 1]
  return { x = x, y = y, title = check_option("tunica.plot: title of a series", given.title, { type = "string" }),
    style = check_option("tunica.plot: style", given.style, { type = "string", choices = styles }) or style, colour = colour }
end

local function read_all(given)
  local list = {}
  if given.y then list[1] = read_series({ x = given.x, y = given.y }, 1, given.style) end
  if given.x and not given.y then fail("tunica.plot: 'x' needs 'y'") end
  for _, each in ipairs(given.series or {}) do list[#list + 1] = read_series(each, #list + 1, given.style) end
  if #list == 0 then fail("tunica.plot: give 'y', a list of numbers, or 'series', a list of { x =, y = }") end
  local count = 0
  for _, series in ipairs(list) do count = count + #series.y end
  if count == 0 then fail("tunica.plot: there are no numbers to plot") end
  return list
end

--- Straight lines through the whole plot, with words at their ends: numbers (at y) or { y = or x =, text = }.
local function line_commands(lines)
  local out = {}
  for i, line in ipairs(lines or {}) do
    if type(line) == "number" then line = { y = line } end
    if type(line) ~= "table" then fail("tunica.plot: a line must be a number or { y =, text = }, came %s", core.describe(line)) end
    check_keys("a line of tunica.plot", line, { "x", "y", "text" })
    if (line.x == nil) == (line.y == nil) then fail("tunica.plot: a line has either 'x' or 'y'") end
    local at = check_option("tunica.plot: place of a line", line.x or line.y, { type = "number" })
    local ends = line.y and "graph 0, first %s to graph 1, first %s" or "first %s, graph 0 to first %s, graph 1"
    out[#out + 1] = string.format("set arrow %d from " .. ends .. " nohead dt 2 lw 1.2 lc rgb '#888888' back\n", i, number(at), number(at))
    local text = check_option("tunica.plot: text of a line", line.text, { type = "string" })
    if text then
      local place = line.y and string.format("graph 0.995, first %s right offset 0,0.5", number(at))
        or string.format("first %s, graph 0.98 left offset 0.5,0", number(at))
      out[#out + 1] = string.format("set label %d %s at %s font ',10' textcolor rgb '#666666'\n", i, quoted(text), place)
    end
  end
  return table.concat(out)
end

local function range_command(name, range)
  if not range then return "" end
  if range[1] >= range[2] then fail("tunica.plot: %s must go from low to high, came { %.14g, %.14g }", name, range[1], range[2]) end
  return string.format("set %s [%s:%s]\n", name, number(range[1]), number(range[2]))
end

local look = [[
set border 3 lc rgb '#888888'
set tics nomirror textcolor rgb '#333333'
set grid lc rgb '#d4d4d4' lw 0.7
set key above right horizontal samplen 2 spacing 1.2 reverse Left
]]

local function commands_of(given, list)
  local parts, titled = {}, false
  for i, series in ipairs(list) do
    titled = titled or series.title
    parts[i] = string.format("$series%d using 1:2 with %s lc rgb '%s' %s", i, drawn_as[series.style], series.colour,
      series.title and "title " .. quoted(series.title) or "notitle")
  end
  local out = { look, titled and "" or "unset key\n", range_command("xrange", given.xrange), range_command("yrange", given.yrange),
    line_commands(given.lines), given.log and "set logscale " .. given.log .. "\n" or "" }
  for _, name in ipairs { "title", "xlabel", "ylabel" } do
    if given[name] then
      out[#out + 1] = string.format("set %s %s noenhanced%s\n", name, quoted(given[name]), name == "title" and " font ',15'" or "")
    end
  end
  out[#out + 1] = "plot " .. table.concat(parts, ", ")
  return table.concat(out)
end

--- Folder, name and kind of picture of a path.
local function place_of(path)
  if type(path) ~= "string" or not path:match "%.png$" and not path:match "%.svg$" then
    fail("tunica.plot: a file must end in .png or .svg, came %s", core.describe(path))
  end
  if path:find "%c" then fail("tunica.plot: a file's name must not hold control characters") end
  local folder, name = path:match "^(.*)/([^/]*)$"
  if not folder then folder, name = ".", path end
  local stem, kind = name:match "^(.*)%.(%a+)$"
  return folder == "" and "/" or folder, stem, kind
end

op { name = "tunica.plot", kind = "named", returns = "the path, or paths",
  args = {
    { name = "file", type = "string|list", of = "string", count = { 1, 10 }, required = true, position = 1,
      doc = "path that ends in .png or .svg, or a list of such; replaced if they are there" },
    { name = "y", type = "list", of = "number", doc = "values" },
    { name = "x", type = "list", of = "number", doc = "where they belong; by default 1, 2, 3 ..." },
    { name = "series", type = "list", of = "table", doc = "several rows of values, each { x =, y =, title =, style =, colour = }" },
    { name = "style", type = "string", choices = styles, default = "points", doc = "how values are shown" },
    { name = "lines", type = "list", of = "number|table",
      doc = "straight lines through the plot: a number (its height), or { y = or x =, text = }" },
    { name = "title", type = "string", doc = "above the plot" }, { name = "xlabel", type = "string", doc = "below it" },
    { name = "ylabel", type = "string", doc = "at its left" },
    { name = "xrange", type = "list", of = "number", count = { 2, 2 }, doc = "{ low, high }" },
    { name = "yrange", type = "list", of = "number", count = { 2, 2 }, doc = "{ low, high }" },
    { name = "log", type = "string", choices = { "x", "y", "xy" }, doc = "axes with logarithmic scale" },
    { name = "size", type = "list", of = "integer", count = { 2, 2 }, doc = "pixels, { width, height }; by default 900, 560" },
  },
  doc = "Plots numbers against numbers, by gnuplot. For divergence angles against the number of the primordium, a pattern " ..
    "against a threshold, a field around the ring.",
  example = [[
local tunica = require "tunica"
local path = os.tmpname() .. ".png"
tunica.plot { path, y = { 180, 133, 141, 136, 138, 137 }, lines = { { y = 137.5, text = "limit" } }, xlabel = "primordium" }
os.remove(path)
]],
  fn = function(given)
    local size = given.size or { 900, 560 }
    for _, side in ipairs(size) do
      if side < 100 or side > 16384 then fail("tunica.plot: 'size' must be 100 to 16384 pixels each way, came %.14g", side) end
    end
    local list, data = read_all(given), {}
    for i, series in ipairs(list) do
      local rows = {}
      for k = 1, #series.y do rows[k] = k end
      data[i] = picture.block("series" .. i, rows, function(k) return number(series.x[k]) .. " " .. number(series.y[k]) end)
    end
    local files = type(given.file) == "table" and given.file or { given.file }
    for _, file in ipairs(files) do place_of(file) end
    local commands = commands_of(given, list)
    for _, file in ipairs(files) do
      local folder, name, kind = place_of(file)
      local ok, why = picture.draw(folder, name, size[1], size[2], table.concat(data), commands, { kind })
      if not ok then fail("tunica.plot: %s", why) end
    end
    return given.file
  end }

--- The bytes of a picture given by its path or as they are.
local function bytes_of(given, i)
  if type(given) ~= "string" then fail("tunica.page: picture %d must be a path or the bytes of a PNG, came %s", i, core.describe(given)) end
  if given:sub(1, 4) == "\137PNG" then return given end
  return core.read_file(given)
end

op { name = "tunica.page", kind = "named", returns = "the path", source = "thesis fig. 4.12",
  args = {
    { name = "pictures", type = "list", count = { 1, 10000 }, of = "string", required = true, position = 1,
      doc = "paths of PNG files, or their bytes, row by row" },
    { name = "file", type = "string", required = true, doc = "path that ends in .png; replaced if it is there" },
    { name = "captions", type = "list", of = "string", doc = "words below each picture" },
    { name = "columns", type = "integer", min = 1, max = 10000, doc = "pictures in a row; by default as many as there are rows" },
    { name = "title", type = "string", doc = "above all" },
    { name = "gap", type = "integer", min = 0, max = 1000, default = 12, unit = "pixels", doc = "between pictures" },
    { name = "font", type = "number", above = 0, max = 1000, unit = "pixels", doc = "size of the captions' letters" },
    { name = "background", type = "string", default = "white", doc = "colour of the page" },
  },
  doc = "Puts many pictures on one page, as a PNG file.",
  example = [[
local tunica = require "tunica"
local path = os.tmpname() .. ".png"
tunica.hexagons { 4, 4 }:picture { path, size = 80 }
tunica.page { { path, path }, captions = { "before", "after" }, file = path }
os.remove(path)
]],
  fn = function(given)
    if not given.file:match "%.png$" then fail("tunica.page: the file must end in .png, came '%s'", given.file) end
    local ok, why = core.is_colour(given.background)
    if not ok then fail("tunica.page: background: %s", why) end
    if given.captions and #given.captions > #given.pictures then
      fail("tunica.page: %d captions for %d pictures", #given.captions, #given.pictures)
    end
    local tiles = {}
    for i, each in ipairs(given.pictures) do tiles[i] = { bytes_of(each, i), given.captions and given.captions[i] } end
    core.write_atomic(given.file, (core.page(tiles, { columns = given.columns, gap = given.gap, title = given.title,
      font_size = given.font, background = given.background }, { { "Software", "tunica" } })))
    return given.file
  end }
