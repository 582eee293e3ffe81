-- SPDX-License-Identifier: MIT
--- Pictures from Lua: what is drawn, and what wrong options say.

local tunica = require "tunica"
local view = require "tunica.view"

local function expect_error(words, fn, ...)
  local ok, message = pcall(fn, ...)
  assert(not ok, "no error: " .. words)
  assert(tostring(message):find(words, 1, true), "expected '" .. words .. "', got: " .. tostring(message))
end

local function content(path)
  local file = assert(io.open(path, "rb"))
  local bytes = file:read "*a"
  file:close()
  return bytes
end

local tissue = tunica.hexagons { 4, 4 }
tissue:cell { auxin = function(c) return c.x end }
tissue:side { pin = 0.5 }
local path = os.tmpname()
os.remove(path)
path = path .. ".png"

-- The same tissue gives the same bytes; a function gives what the column gives.
local function bytes_of(options)
  options[1], options.size = path, 120
  assert(tissue:picture(options) == path)
  return content(path)
end
local by_column = bytes_of { colour = "auxin", sides = "pin", labels = "id" }
assert(by_column:sub(2, 4) == "PNG")
assert(by_column == bytes_of { colour = "auxin", sides = { "pin" }, labels = "id" })
assert(by_column ~= bytes_of { colour = "auxin" })
assert(bytes_of { colour = "auxin" } == bytes_of { colour = function(c) return c.auxin end, legend = "auxin" })
local marked = {}
for c in tissue:cells() do
  if c.auxin > 2 then marked[#marked + 1] = c end
end
assert(bytes_of { markers = marked } == bytes_of { markers = { function(c) return c.auxin > 2 end, shape = "ring" } })
assert(bytes_of { markers = {} } == bytes_of {})
bytes_of { colour = "auxin", palette = { "white", "#ff0000" }, range = { 0, 2 }, transparent = true, outline = false,
  title = "t", legend = false, camera = { zoom = 2, centre = { 1, 1 }, perspective = true } }

-- Cells without a value in a colour and by a name of one's own; a camera that is asked for at each picture.
local function some(c) return c.auxin > 2 and c.auxin or nil end
local grey = bytes_of { colour = some }
assert(grey ~= bytes_of { colour = some, missing = "black" })
assert(grey ~= bytes_of { colour = some, missing = { title = "dead" } })
assert(bytes_of { colour = some, missing = "black" } == bytes_of { colour = some, missing = { "black", title = "no value" } })
local zoom = 1
local function camera() return { zoom = zoom } end
assert(bytes_of { camera = camera } == bytes_of { camera = { zoom = 1 } })
zoom = 2
assert(bytes_of { camera = camera } == bytes_of { camera = { zoom = 2 } })

local dome = tunica.cylinder { 8, 5 }
dome:picture { path, size = 120, wireframe = true,
  place = function(c) return math.cos(c.column * math.pi / 4), math.sin(c.column * math.pi / 4), -c.row end }

for _, wrong in ipairs {
  { "did you mean 'auxin'", { colour = "auxim" } },
  { "did you mean 'colour'", { color = "auxin" } },
  { "did you mean 'viridis'", { palette = "virids" } },
  { "did you mean 'pin'", { sides = "pun" } },
  { "sides has no option", { sides = { "pin", maks = 1 } } },
  { "the column is missing", { sides = {} } },
  { "did you mean 'white'", { background = "whte" } },
  { "at least two colours", { palette = { "red" } } },
  { "from low to high", { range = { 2, 1 } } },
  { "size must be a whole number", { size = { 10, 10 } } },
  { "without geometry", { place = function() return 0, 0, 0 end } },
  { "finite number", { place = function() return 0 / 0 end } },
  { "must return a number or nil", { colour = function() return {} end } },
  { "structure of the tissue cannot change", { colour = function(c) c:remove() end } },
  { "no field 'nothing'", { labels = function(c) return c.nothing end } },
  { "bars", { bars = true } },
  { "each a cell", { markers = { { 1 } } } },
  { "camera has no option", { camera = { form = 1 } } },
  { "camera has no option", { camera = function() return { form = 1 } end } },
  { "camera: the function must return a table", { camera = function() end } },
  { "did you mean 'black'", { missing = "blak" } },
  { "missing has no option", { missing = { "black", name = "dead" } } },
  { "missing: write", { missing = {} } },
} do
  local options = wrong[2]
  options[1] = path
  local of = wrong[1] == "finite number" and tunica.grid { 3, 3 } or tissue
  expect_error(wrong[1], of.picture, of, options)
end
expect_error("must end in .png", tissue.picture, tissue, { "picture.jpg" })
expect_error("is missing", tissue.picture, tissue, {})
os.remove(path)

-- Views of a model: checked where they are declared, and again when they are drawn.
local model = tunica.model { tissue = tissue, dt = 0.1 }
expect_error("did you mean 'every'", model.view, model, { evry = 1 })
expect_error("name of a view", model.view, model, { name = "../up" })
model:view { colour = "auxin", every = 1, size = 100 }
view.check(model)
local png, width, height = view.draw(model, model.views[1])
assert(png:sub(2, 4) == "PNG" and width == 100 and height == 100)
assert(png:find("tunica:time", 1, true))
model:view { colour = "later" }
expect_error("no column 'later'", view.check, model)
