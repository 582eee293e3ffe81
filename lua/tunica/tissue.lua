-- SPDX-License-Identifier: MIT
--- What can be asked of a whole tissue: its elements, its state, and how it stands.

local core = require "tunica.core"
local registry = require "tunica.registry"
local surfaces = require "tunica.surfaces"
local op, fail = registry.op, registry.fail

local setup = [[
local tunica = require "tunica"
local tissue = tunica.hexagons { 4, 4 }
tissue:cell { auxin = function(c) return c:uniform(0, 1) end }
]]

local kinds = { "cell", "wall", "side", "junction" }
local kind_argument = { name = "kind", type = "string", choices = kinds, default = "cell", doc = "kind of element" }

-- Elements ---------------------------------------------------------------------------------------------------------

for _, kind in ipairs(kinds) do
  op { name = "tissue:" .. kind .. "s", fn = function(self) return (core.each(self, kind)) end,
    doc = string.format("Goes through the %ss in the order of their identities. The tissue may change meanwhile: %ss " ..
      "that are gone when their turn comes are left out, new ones do not come.", kind, kind),
    returns = "an iterator: " .. kind,
    example = setup .. string.format("for e in tissue:%ss() do print(e.id) end", kind) }
end
op { name = "tissue:count", fn = core.count, args = { kind_argument }, returns = "a whole number",
  doc = "How many cells, or walls, sides or junctions, there are. #tissue is the number of cells.",
  example = setup .. [[print(tissue:count(), tissue:count "wall")]] }
op { name = "tissue:find", returns = "the element, or nil if it is gone or never was",
  args = { { name = "id", type = "integer", min = 0, max = 2 ^ 32 - 1, required = true, doc = "identity" }, kind_argument },
  doc = "The element with an identity.", fn = function(self, id, kind) return (core.find(self, kind, id)) end,
  example = setup .. [[print(tissue:find(3))]] }
op { name = "tissue.data", kind = "property", fn = core.data, returns = "a table",
  doc = "A table for values of your own that belong to the whole tissue.", source = "thesis table 9.1: S.x",
  example = setup .. [[tissue.data.plastochron = 4.5 print(tissue.data.plastochron)]] }
op { name = "tissue.seed", kind = "property", fn = core.tissue_seed, returns = "a whole number",
  doc = "The seed of the tissue's random numbers.", example = setup .. [[print(tissue.seed)]] }
op { name = "tissue.has_geometry", kind = "property", fn = core.has_geometry, returns = "true or false",
  doc = "Whether cells have places, areas and junctions (sheets), or neighbours only (lines, rings, grids).",
  example = setup .. [[print(tissue.has_geometry)]] }

-- Columns ----------------------------------------------------------------------------------------------------------

local inherit_words = { "copy", "split", "reset" }

--- Value, inheritance of one declared column: 1.0, function(e) ... end, or { value, divide = ... }.
local function declaration(kind, name, given)
  local value, divide = given, nil
  if type(given) == "table" then
    for key in pairs(given) do
      if key ~= 1 and key ~= "value" and key ~= "divide" then
        fail("tissue:%s: column '%s' has no option %s; write { value, divide = 'copy' }", kind, name, core.describe(key))
      end
    end
    value, divide = given[1], given.divide
    if value == nil then value = given.value end
    if value == nil then value = 0 end
  end
  if not registry.matches(value, { type = "number|function" }) then
    fail("tissue:%s: the initial value of '%s' must be a finite number or a function of the %s, came %s", kind, name, kind,
      core.describe(value))
  end
  local ok, hint = registry.matches(divide, { type = "string|function", choices = inherit_words })
  if divide ~= nil and not ok then
    fail("tissue:%s: 'divide' of '%s' must be 'copy', 'split', 'reset' or a function(mother, share) that returns the " ..
      "values of both parts, came %s%s", kind, name, core.describe(divide), hint)
  end
  return value, divide
end

local function declare(kind)
  return function(self, columns)
    for name, given in pairs(columns) do
      if core.methods[kind][name] or core.properties[kind][name] then
        fail("tissue:%s: '%s' means something else for a %s already; choose another name", kind, name, kind)
      end
      core.add_column(self, kind, name, declaration(kind, name, given))
    end
    return self
  end
end

for _, kind in ipairs(kinds) do
  op { name = "tissue:" .. kind, kind = "named", changes = true, fn = declare(kind), returns = "the tissue",
    rest = { type = "number|function|table", doc = "name of the column = initial value, or { value, divide = ... }" },
    doc = "Declares state that every " .. kind .. " has: name = value. The value is a number or a function of the " ..
      kind .. "; or { value, divide = what }, which says what the two parts get when the " .. kind .. " is divided: " ..
      "'copy' (both the same: concentrations; the default), 'split' (in proportion to " ..
      (kind == "cell" and "area" or "length") .. ": amounts), 'reset' (the initial value), or a function(mother's value, " ..
      "the first part's share) that returns two values.",
    example = [[
local tunica = require "tunica"
local tissue = tunica.hexagons { 3, 3 }
tissue:]] .. kind .. [[ { age = 0, amount = { 5, divide = "split" }, noise = function(e) return e:uniform(0.9, 1.1) end }
]] }
end

local column = { name = "column", type = "column", required = true, doc = "name of a column of the cells" }
for name, words in pairs {
  sum = "The sum of a column over all cells.", mean = "The mean of a column over all cells.",
  min = "The least value of a column.", max = "The greatest value of a column.",
} do
  op { name = "tissue:" .. name, doc = words, args = { column }, returns = "a number",
    fn = function(self, of) return (core[name](self, "cell", of)) end,
    example = setup .. string.format("print(tissue:%s 'auxin')", name) }
end

-- Structure --------------------------------------------------------------------------------------------------------

op { name = "tissue:add_cell", fn = core.add_cell, returns = "the new cell",
  doc = "Adds a cell without neighbours; cell:join gives it some. Only in a tissue without geometry.",
  example = [[
local tunica = require "tunica"
local tissue = tunica.line { 3 }
local c = tissue:add_cell()
c:join(tissue:find(3))
print(c.valence)]] }
op { name = "tissue:insert_row",
  args = { { name = "after", type = "integer", min = 0, max = 2 ^ 31 - 1, default = 0, doc = "number of the row above" } },
  doc = "Inserts a row of cells into a grid or cylinder, between row `after` and the next. New cells start with the mean " ..
    "of both rows' values. Rows below count one up.", source = "thesis 5.4",
  fn = core.insert_row,
  example = [[
local tunica = require "tunica"
local tissue = tunica.cylinder { around = 10, rows = 4 }
tissue:insert_row(0)
print(tissue:max "row")]] }
op { name = "tissue:remove_row", fn = core.remove_row, doc = "Removes the last row of a grid or cylinder.",
  example = [[
local tunica = require "tunica"
local tissue = tunica.cylinder { around = 10, rows = 4 }
tissue:remove_row()
print(#tissue)]] }
op { name = "tissue:remove", kind = "named", returns = "the number of cells removed",
  args = {
    { name = "where", type = "function", position = 1, doc = "function(c) that returns true for the cells that go" },
    { name = "on", type = "surface", doc = "instead, on an apex: with `beyond`" },
    { name = "beyond", type = "number", min = 0, unit = "length",
      doc = "cells go whose centroid is farther than this from the tip, along the profile" },
  },
  doc = "Removes cells, in the order of their identities. Their handles then say so. Walls that they shared become border walls; " ..
    "without geometry these go. At least one cell must stay.",
  fn = function(self, t)
    if t.where and not t.on and not t.beyond then return (core.remove_cells(self, t.where)) end
    if t.where or not t.on or not t.beyond then
      fail("tissue:remove: give where = function(c) ... end, or on = apex and beyond = arc length")
    end
    return (core.remove_beyond(self, surfaces.core_of(t.on), t.beyond))
  end,
  example = setup .. "print(tissue:remove { where = function(c) return c.x > 2 end })" }
op { name = "tissue:renumber", fn = core.renumber,
  doc = "Puts the cells into an order in memory in which neighbours lie near each other: rules then run faster on large " ..
    "tissues that have grown. Nothing else changes, identities least of all.",
  example = setup .. "tissue:renumber()" }

-- How it stands ----------------------------------------------------------------------------------------------------

op { name = "tissue:validate", returns = "true, or false and a list of sentences",
  doc = "Checks every invariant of the tissue: neighbourhoods consistent, Euler's formula, areas positive, no cell crossing " ..
    "itself, columns of the right length.",
  fn = function(self)
    local found = core.problems(self)
    if #found > 0 then return false, found end
    return true
  end,
  example = setup .. "assert(tissue:validate())" }
op { name = "tissue:hash", fn = core.tissue_hash, returns = "16 hexadecimal digits",
  doc = "A number that two tissues share only if structure, geometry and state are the same to the last bit.",
  example = setup .. "print(tissue:hash())" }

-- Growth and division ----------------------------------------------------------------------------------------------

local sheet = [[
local tunica = require "tunica"
local tissue = tunica.sheet { cells = 20, seed = 1 }
]]

op { name = "tissue:grow", kind = "named", source = "thesis 3.3, 10.2",
  args = {
    { name = "rate", type = "number", position = 1, unit = "1 / time",
      doc = "all lengths grow at this relative rate: in the time t by the factor exp(rate t)" },
    { name = "rates", type = "list", of = "number", count = { 2, 2 }, unit = "1 / time",
      doc = "instead: { along, across } a direction" },
    { name = "direction", type = "vector", default = { 1, 0 }, doc = "the first of two rates is along this direction" },
    { name = "centre", type = "vector", default = { 0, 0 }, doc = "the point that stays where it is" },
    { name = "velocity", type = "function", doc = "instead: function(x, y, z, t) that returns vx, vy (and vz)" },
    { name = "on", type = "surface", doc = "instead: as this surface grows. Cell columns `theta` and `a`, if both are declared, are " ..
      "kept up to date on an apex (see tissue:locate)" },
    { name = "time", type = "number", min = 0, default = 1, unit = "time", doc = "how long" },
    { name = "from", type = "number", unit = "time",
      doc = "the time at the start, for a velocity or surface that changes; 0, or that of a surface that bulges, if left out" },
    { name = "substeps", type = "integer", min = 1, max = 1000, default = 1, doc = "for a velocity: steps within the time" },
  },
  doc = "Lets a tissue grow for some time: in the plane uniformly, at two rates, or by a field of velocities, or with the " ..
    "surface it lies on. The structure stays as it is; state is not diluted. If a cell would become impossible that is an " ..
    "error, and nothing moves.",
  fn = function(self, t)
    local ways = (t.rate and 1 or 0) + (t.rates and 1 or 0) + (t.velocity and 1 or 0) + (t.on and 1 or 0)
    if ways ~= 1 then fail("tissue:grow: give one of rate, rates, velocity and on") end
    if t.on then
      local surface = surfaces.core_of(t.on)
      core.grow_on(self, surface, t.time, t.from)
      core.follow(self, surface)
    elseif t.rate then core.grow_uniform(self, t.time, t.rate, t.centre)
    elseif t.rates then core.grow_anisotropic(self, t.time, t.rates[1], t.rates[2], t.direction, t.centre)
    else core.grow_field(self, t.time, t.velocity, t.from or 0, t.substeps) end
  end,
  example = sheet .. [[
tissue:grow { rate = 0.01, time = 2 }
tissue:grow { rates = { 0.02, 0.01 }, direction = { 0, 1 } }
tissue:grow { velocity = function(x, y, z, t) return 0.1 * x, 0 end }]] }
op { name = "tissue:deform",
  args = { { name = "place", type = "function", required = true, doc = "function(x, y, z) that returns the new x, y (and z)" } },
  doc = "Moves every junction to where a function puts it. Cells that would be turned over or cross themselves are an " ..
    "error, and nothing moves.",
  fn = core.deform,
  example = sheet .. "tissue:deform(function(x, y) return x, y, -0.1 * (x * x + y * y) end)" }

op { name = "tissue:locate", kind = "named", returns = "the tissue", source = "thesis (3.1)",
  args = { { name = "on", type = "surface", required = true, position = 1, doc = "the apex that the tissue lies on, bulging or not" } },
  doc = "Gives the cells columns `theta` (degrees, 0 on the axis) and `a` (arc length from the tip): the place of the centroid " ..
    "on an apex, for rules that depend on zones. tissue:grow and tissue:divide with the same `on` keep them up to date.",
  fn = function(self, t)
    core.locate(self, surfaces.core_of(t.on))
    return self
  end,
  example = [[
local tunica = require "tunica"
local apex = tunica.apex { profile = "dome" }
local tissue = tunica.apex_tissue { on = apex, cells = 20 }
tissue:locate { on = apex }
print(tissue:max "a")]] }

op { name = "tissue:differentiate", kind = "named", returns = "the tissue", source = "thesis (5.10), (5.11)",
  args = { { name = "on", type = "bulges", required = true, position = 1, doc = "the surface with primordia that the tissue lies on" } },
  doc = "Gives the cells columns `primordium` (number of the one in which the centroid lies most deeply, 0 outside all) and " ..
    "`closeness` (1 - d/r: 1 at the centre of that primordium, 0 at its rim and outside). tissue:grow and tissue:divide with " ..
    "the same `on` keep them up to date; call it again when a primordium has been added.",
  fn = function(self, t)
    core.differentiate(self, surfaces.core_of(t.on))
    return self
  end,
  example = [[
local tunica = require "tunica"
local surface = tunica.bulges { on = tunica.apex { profile = "dome" }, radius = 0.3, height = 0 }
local tissue = tunica.apex_tissue { on = surface, cells = 20 }
surface:add { theta = 0, a = 0.2 }
tissue:differentiate { on = surface }
print(tissue:max "closeness")]] }

-- How walls are laid: the same for one cell and for all.
local function division_options(others)
  for _, spec in ipairs {
    { name = "rule", type = "string|function", choices = { "errera", "closest_wall", "along" }, 
      doc = "where the wall goes: 'errera', the shortest through the centroid (the default); 'closest_wall', towards the " ..
        "nearest point of the outline; 'along' a direction; or function(c) that returns the ends of the wall, " ..
        "x1, y1, x2, y2 (or two points { x, y } or { x, y, z })" },
    { name = "direction", type = "vector|function", doc = "for 'along': of the new wall; or function(c) that returns it" },
    { name = "gap", type = "number", min = 0, unit = "length",
      doc = "least distance of the wall's ends from junctions; 0.15 of the square root of the cell's area if left out" },
    { name = "pinch", type = "number", min = 0, below = 0.5, default = 0.08,
      doc = "how far the wall's ends are drawn in, as a fraction of its length" },
    { name = "on", type = "surface", doc = "the surface that the tissue lies on: new junctions are put onto it" },
  } do others[#others + 1] = spec end
  return others
end

local function rule_of(t) return t.rule or (t.direction and "along") or "errera" end

op { name = "tissue:divide", kind = "named", returns = "the number of divisions", source = "thesis 3.4, figs 3.7, 3.8",
  args = division_options {
    { name = "above", type = "number", above = 0, position = 1, unit = "area",
      doc = "cells divide whose area is above this, and their daughters, until none is" },
    { name = "variation", type = "number", min = 0, below = 1, default = 0,
      doc = "of that area from cell to cell, relative, uniform; fixed for each cell by the seed of the tissue" },
    { name = "where", type = "function", doc = "function(c) that returns true for cells that divide; alone or with `above`" },
    { name = "max_cells", type = "integer", min = 1, max = 2 ^ 24, default = 1000000, doc = "stops when there are so many" },
  },
  doc = "Divides cells, in the order of their identities. Four walls never meet in one point, and the ends of the wall are " ..
    "pinched as in living tissue. What daughters get is said where the columns are declared. A cell that cannot be divided " ..
    "as its rule says is an error, raised when all others are divided.",
  fn = function(self, t)
    local surface = t.on and surfaces.core_of(t.on)
    return core.divide_cells(self, t.above, t.variation, t.where, t.max_cells, rule_of(t), t.direction, t.gap, t.pinch, surface)
  end,
  example = sheet .. [[
print(tissue:divide { above = 0.5, variation = 0.1 })
print(tissue:divide { where = function(c) return c.x > 1 end, rule = "closest_wall" })
print(tissue:divide { where = function(c) return c.id < 5 end, rule = function(c) return c.x - 1, c.y, c.x + 1, c.y end })]] }
op { name = "cell:divide", kind = "named", returns = "the two daughters", source = "thesis 3.4",
  args = division_options {},
  doc = "Divides the cell. The cell itself is then gone: its handles are errors that name the daughters.",
  fn = function(self, t)
    local surface = t.on and surfaces.core_of(t.on)
    local first, second = core.divide_cell(self, rule_of(t), t.direction, t.gap, t.pinch, surface)
    if surface then core.follow_around(surface, first, second) end
    return first, second
  end,
  example = sheet .. "local a, b = tissue:cells()():divide { direction = { 0, 1 } }\nprint(a.area, b.area)" }

-- What it comes to -------------------------------------------------------------------------------------------------

op { name = "tissue:statistics", returns = "a table",
  doc = "The shapes of the cells. `cells`, `interior` (those without a border wall; all that follows is of them), " ..
    "`shares[n]` (the fraction of cells with n sides), `mean_sides`, `variance_sides`, `mean_area`, `area_cv`, " ..
    "`area_by_sides[n]` (relative to the mean), `lewis_slope`, `sharp_cells` (the fraction with an angle below 45 " ..
    "degrees), `least_angle[1..18]` (fractions by least angle, in steps of 10 degrees), `mean_least_angle`, and " ..
    "`four_way` (junctions of more than three walls).",
  fn = core.statistics, example = sheet .. "print(tissue:statistics().mean_sides)" }

local above = { name = "above", type = "number", doc = "only higher ones; the mean of the column if left out" }
op { name = "tissue:count_peaks", args = { column, above }, returns = "a whole number", fn = core.count_peaks,
  doc = "How many cells have more than each of their neighbours, and more than `above`.",
  example = setup .. "print(tissue:count_peaks 'auxin')" }
op { name = "tissue:checkerboard", args = { column }, fn = core.checkerboard,
  returns = "a number from -1 to 1, and whether it is beyond what noise gives",
  doc = "How far values go up and down from cell to cell: 1 for a checkerboard on a grid (at most 0.5 on hexagons), 0.2 to 0.7 for " ..
    "noise, negative for anything smooth. Beyond noise it says that a time step was too long, most likely.",
  example = setup .. "print(tissue:checkerboard 'auxin')" }
op { name = "tissue:pair", kind = "named", returns = "two cells, the one with more first; or nothing", source = "thesis 5.5.1",
  args = { { name = "column", type = "column", required = true, position = 1, doc = "name of a column of the cells" },
    { name = "above", type = "number", required = true, position = 2, doc = "both cells have more than this" },
    { name = "where", type = "table", default = {}, doc = "conditions on both cells: { column = value } or { column = { low, high } }" } },
  doc = "Two neighbours that both have more than a threshold: where a primordium starts. Of several such pairs the one whose " ..
    "lower value is highest.",
  fn = function(self, t)
    local names, bounds = {}, {}
    for name in pairs(t.where) do
      if type(name) ~= "string" then fail("tissue:pair: 'where' holds conditions by name of a column, came %s", core.describe(name)) end
      names[#names + 1] = name
    end
    table.sort(names)
    for _, name in ipairs(names) do
      local given = t.where[name]
      local low, high = given, given
      if type(given) == "table" then low, high = given[1], given[2] end
      if low == -math.huge then low = -1e300 end
      if high == math.huge then high = 1e300 end
      if type(low) ~= "number" or type(high) ~= "number" or not (low <= high) then
        fail("tissue:pair: the condition on '%s' must be a number, or { low, high } with low <= high, came %s", name, core.describe(given))
      end
      bounds[#bounds + 1], bounds[#bounds + 2], bounds[#bounds + 3] = name, low, high
    end
    return core.find_pair(self, t.column, t.above, bounds)
  end,
  example = setup .. [[
local a, b = tissue:pair { "auxin", above = 1, where = { x = { 0, 2 } } }
print(a, b)]] }
op { name = "tissue:peaks", args = { column, above }, fn = core.peaks,
  returns = "a list of cells, the mean distance from a peak to the next (0 without geometry), its coefficient of variation",
  doc = "The cells that have more than each of their neighbours, and more than `above`.",
  example = setup .. "local peaks, distance = tissue:peaks 'auxin'\nprint(#peaks, distance)" }
