-- SPDX-License-Identifier: MIT
-- tissue:divide, cell:divide, tissue:grow and builders as a script sees them.
local tunica = require "tunica"
local check = require "check"

-- One polygon to many cells, growing between divisions.
local tissue = tunica.polygon { 8, seed = 3 }
tissue:cell { mass = { 1, divide = "split" } }
local divisions = 0
for _ = 1, 140 do
  tissue:grow { rate = 0.02 }
  divisions = divisions + tissue:divide { above = 1, variation = 0.2 }
end
check.equal(#tissue, divisions + 1)
assert(#tissue > 100)
check.valid(tissue)
check.near(tissue:sum "mass", 1, 1e-12)
local statistics = tissue:statistics()
check.equal(statistics.four_way, 0)
check.equal(statistics.cells, #tissue)
check.near(statistics.mean_sides, 5.8, 0.4)
local shares = 0
for n = 0, #statistics.shares do shares = shares + statistics.shares[n] end
check.near(shares, 1, 1e-12)

-- The same script gives the same bits; another seed others.
local function grown(seed)
  local t = tunica.sheet { cells = 60, seed = seed }
  t:divide { above = 0.5, variation = 0.3 }
  return t:hash()
end
check.equal(grown(5), grown(5))
assert(grown(5) ~= grown(6))

-- Rules
local function daughters(options)
  local cell = tunica.squares { 1, 1 }:find(1)
  local a, b = cell:divide(options)
  return a, b, a:wall_to(b)
end
local _, _, wall = daughters { pinch = 0 }
check.near(wall.length, 1, 0.1)
local a, b = daughters { direction = { 1, 0 }, pinch = 0 }
check.near(math.abs(a.y - b.y), 0.5, 0.1)
a, b = daughters { rule = "along", direction = function(c) check.equal(c.kind, "cell") return 0, 1 end, pinch = 0 }
check.near(math.abs(a.x - b.x), 0.5, 0.1)
for _, rule in ipairs {
  function(c) return c.x - 0.3, c.y - 0.5, c.x - 0.3, c.y + 0.5 end,
  function(c) return c.x - 0.3, c.y - 0.5, 0, c.x - 0.3, c.y + 0.5, 0 end,
  function(c) return { c.x - 0.3, c.y - 0.5 }, { c.x - 0.3, c.y + 0.5 } end,
  function(c) return { c.x - 0.3, c.y - 0.5, 0 }, { c.x - 0.3, c.y + 0.5, 0 } end,
} do
  a, b = daughters { rule = rule, pinch = 0, gap = 0.05 }
  check.near(math.min(a.area, b.area), 0.2, 1e-9)
end

-- Functions that return rubbish
local sheet = tunica.hexagons { 3, 3 }
local before = sheet:hash()
for text, rule in pairs {
  ["0 numbers"] = function() end,
  ["3 numbers"] = function() return 1, 2, 3 end,
  ["must be a finite number, came nan"] = function() return 0 / 0, 1, 2, 3 end,
  ["came the text"] = function() return "x", 1, 2, 3 end,
  ["came true"] = function() return true end,
  ["came a table"] = function() return { {}, {} } end,
} do
  local ok, message = pcall(function() sheet:divide { above = 0.1, rule = rule } end)
  assert(not ok and message:find(text:gsub("came nan", "came the number nan"), 1, true), message)
end
check.fails(function() sheet:divide { above = 0.1, rule = function() error("no rule") end } end, "no rule")
check.fails(function() sheet:divide { above = 0.1, rule = function(c) sheet:grow { rate = 0.1 } end } end, "structure")
check.fails(function() sheet:divide { above = 0.1, rule = function(c) sheet:divide { above = 0.1 } end } end, "structure")
check.fails(function() sheet:divide { above = 0.1, rule = function(c) return 50, 50, 51, 51 end } end, "cell 1")
check.fails(function() sheet:divide { above = 0.1, rule = "along" } end, "needs a direction")
check.fails(function() sheet:divide { above = 0.1, direction = { 0, 0 } } end, "direction")
check.fails(function() sheet:divide {} end, "which cells divide")
check.fails(function() tunica.ring { 5 }:divide { above = 1 } end, "without geometry")
check.equal(sheet:hash(), before)

-- A cell that its rule cannot divide is an error that names it; the others are divided, and the tissue is whole.
local function across(c) return c.id == 4 and 0 or 1, 0, 1 end
for _, options in ipairs { { above = 0.6 }, { where = function() return true end } } do
  local t = tunica.hexagons { 3, 3 }
  options.rule, options.direction = "along", across
  local ok, message = pcall(t.divide, t, options)
  assert(not ok and message:find("right angles to cell 4 (elsewhere there were 8 divisions)", 1, true), message)
  check.equal(#t, 17)
  check.valid(t)
  check.equal(t:find(4).alive, true)
  options.rule, options.direction = "errera", nil
  if options.above then check.equal(t:divide(options), 1) end
end

-- Where; how many
check.equal(sheet:divide { where = function(c) return c.border end }, 8)
check.equal(sheet:divide { above = 0.6, where = function(c) return not c.border end }, 1)
check.equal(sheet:divide { above = 0.001, max_cells = 40 }, 40 - 18)
check.valid(sheet)

-- Growth
local grid = tunica.squares { 3, 3 }
grid:grow { rates = { math.log(2), 0 }, direction = { 0, 1 } }
check.near(grid:sum "area", 18, 1e-12)
check.near(grid:find(9).y / grid:find(9).x, 2, 1e-12)
grid:grow { velocity = function(x, y, z, t) return 0.1 * x, 0 end, time = 2, substeps = 20 }
check.near(grid:sum "area", 18 * math.exp(0.2), 1e-8)
before = grid:hash()
check.fails(function() grid:grow { velocity = function() end } end, "must be a finite number, came nil")
check.fails(function() grid:grow { velocity = function(x) return x * 1e300 * 1e300, 0 end } end, "came the number")
check.fails(function() grid:grow { velocity = function() grid:find(1):remove() end } end, "structure")
check.fails(function() grid:deform(function(x, y) return -x, y end) end, "cell 1")
check.fails(function() grid:grow { rate = 1e6 } end, "cell")
check.equal(grid:hash(), before)
grid:deform(function(x, y) return x, y, -0.1 * (x * x + y * y) end)
check.valid(grid)
assert(grid:find(9).z < -1)
a, b = grid:find(5):divide()
check.valid(grid)

-- Polygons
local two = tunica.polygons { { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, { { 1, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 } } }
check.near(two:find(1):wall_to(two:find(2)).length, 1, 0)
check.fails(function() local t = tunica.polygons { { { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } } } end, "polygon")
check.fails(function() local t = tunica.polygons { { { 0, 0 }, { 1, 1 } } } end, "polygon")
check.fails(function() local t = tunica.polygons { { { 0, 0 }, { 1, "x" }, { 1, 1 } } } end, "corner 2 of polygon 1")
check.fails(function() local t = tunica.polygons { { { 0, 0 }, { 1 }, { 1, 1 } } } end, "corner 2 of polygon 1")
check.fails(function() local t = tunica.polygons {} end, "'cells' must be a list")
check.fails(function() local t = tunica.load "no/such/file.ply" end, "no/such/file.ply")
check.fails(function() local t = tunica.load { "/" } end, "/")

-- Rows of a cylinder
local cylinder = tunica.cylinder { around = 8, rows = 4 }
cylinder:cell { morphogen = function(c) return c.row end }
cylinder:insert_row(1)
check.equal(#cylinder, 40)
check.equal(cylinder:max "row", 4)
local values = {}
for c in cylinder:cells() do values[c.row] = c.morphogen end
check.equal(values[2], 1.5)
cylinder:remove_row()
check.equal(#cylinder, 32)
check.fails(function() cylinder:insert_row(77) end, "row")
check.valid(cylinder)

-- Peaks
local line = tunica.line { 9 }
line:cell { auxin = function(c) return math.sin(c.column * math.pi / 2) + c.column / 100 end }
check.equal(line:count_peaks "auxin", 3) -- columns 1 and 5, and the end of the line
local peaks, distance = line:peaks("auxin", 1.03)
check.equal(#peaks, 1)
check.equal(peaks[1].column, 5)
check.equal(distance, 0)
