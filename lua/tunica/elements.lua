-- SPDX-License-Identifier: MIT
--- What can be asked of a cell, a wall, a side or a junction: identity, neighbourhood, random numbers.

local core = require "tunica.core"
local op = require("tunica.registry").op

local kinds = { "cell", "wall", "side", "junction" }

-- Every example starts from this tissue and model text runs by itself.
local setup = [[
local tunica = require "tunica"
local tissue = tunica.hexagons { 3, 3 }
local c = tissue:find(5)
]]

local function property(name, returns, doc, fn, example)
  op { name = name, kind = "property", returns = returns, doc = doc, fn = fn, example = setup .. example }
end

for _, kind in ipairs(kinds) do
  local take = kind == "cell" and "local e = c\n" or string.format("local e = tissue:find(1, %q)\n", kind)
  property(kind .. ".id", "a whole number",
    "The identity of the " .. kind .. ": a whole number that never changes and is never used again. " ..
    "Handles are not the same as table keys: write t[" .. kind:sub(1, 1) .. ".id].", core.id, take .. "print(e.id)")
  property(kind .. ".alive", "true or false",
    "Whether the " .. kind .. " is still there: false after it has divided or was removed.",
    core.alive, take .. "print(e.alive)")
  property(kind .. ".kind", "text", "The word '" .. kind .. "'.", core.kind, take .. "print(e.kind)")
  property(kind .. ".tissue", "the tissue", "The tissue that the " .. kind .. " belongs to.", core.tissue_of,
    take .. "print(e.tissue)")
  property(kind .. ".border", "true or false", ({
    cell = "Whether one of the cell's walls has no cell on its other side.",
    wall = "Whether the wall has a cell on one side only.",
    side = "Whether there is no cell across the side.",
    junction = "Whether the junction lies on the border of the tissue.",
  })[kind], core.border, take .. "print(e.border)")
end

-- Cells ------------------------------------------------------------------------------------------------------------

property("cell.valence", "a whole number", "The number of neighbouring cells.", core.valence, "print(c.valence)")
property("cell.side_count", "a whole number", "The number of sides: of walls, those of the border among them.", core.side_count,
  "print(c.side_count)")

op { name = "cell:neighbours", fn = core.neighbours,
  doc = "Goes through the neighbouring cells in cyclic order, counter-clockwise seen from outside; with each comes the wall " ..
    "to it. A neighbour across several walls comes once.",
  returns = "an iterator: neighbour, wall",
  example = setup .. [[for n, w in c:neighbours() do print(n.id, w.length) end]] }
op { name = "cell:walls", fn = core.cell_walls, doc = "Goes through the walls of the cell in cyclic order.",
  returns = "an iterator: wall", example = setup .. [[for w in c:walls() do print(w.length) end]] }
op { name = "cell:sides", fn = core.cell_sides, doc = "Goes through the sides of the cell in cyclic order.",
  returns = "an iterator: side", example = setup .. [[for s in c:sides() do print(s.wall.length) end]] }
op { name = "cell:junctions", fn = core.cell_junctions,
  doc = "Goes through the junctions of the cell in cyclic order. Needs a tissue with geometry.",
  returns = "an iterator: junction", example = setup .. [[for j in c:junctions() do print(j.x, j.y) end]] }

local neighbour = { name = "neighbour", type = "cell", required = true, doc = "a neighbour of the cell" }
local other = { name = "other", type = "cell", required = true, doc = "another cell" }
local first = "local n = c:neighbours()()\n"

op { name = "cell:next_to", fn = core.next_to, args = { neighbour },
  doc = "The neighbour after a given one, counter-clockwise. Borders are stepped over.", returns = "a cell",
  source = "thesis table 9.1: nextto n in v", example = setup .. first .. [[print(c:next_to(n).id)]] }
op { name = "cell:previous_to", fn = core.previous_to, args = { neighbour },
  doc = "The neighbour before a given one: the next one clockwise. Borders are stepped over.", returns = "a cell",
  source = "thesis table 9.1: prevto n in v", example = setup .. first .. [[print(c:previous_to(n).id)]] }
op { name = "cell:wall_to", fn = core.wall_to, args = { other },
  doc = "The wall between two cells, or nil if they are not neighbours.", returns = "a wall or nil",
  example = setup .. first .. [[print(c:wall_to(n).length)]] }
op { name = "cell:side_to", fn = core.side_to, args = { other },
  doc = "The side of this cell that faces another, or nil if they are not neighbours. What one cell does to another, as " ..
    "PIN1 in a membrane, is state of this side.", returns = "a side or nil",
  source = "thesis table 9.1: v^n", example = setup .. first .. [[print(c:side_to(n).id, n:side_to(c).id)]] }

-- Walls, sides, junctions ------------------------------------------------------------------------------------------

local wall = "local w = c:walls()()\n"
op { name = "wall:cells", fn = core.wall_cells, doc = "The one or two cells that share the wall.",
  returns = "cell, cell or nil at the border", example = setup .. wall .. [[local a, b = w:cells() print(a.id, b)]] }
op { name = "wall:sides", fn = core.wall_sides, doc = "The one or two sides of the wall.",
  returns = "side, side or nil at the border", example = setup .. wall .. [[print(w:sides())]] }
op { name = "wall:junctions", fn = core.wall_junctions,
  doc = "The two ends of the wall. Needs a tissue with geometry.", returns = "junction, junction",
  example = setup .. wall .. [[local p, q = w:junctions() print(p.x, q.x)]] }

local side = "local s = c:sides()()\n"
property("side.cell", "cell", "The cell that the side belongs to.", core.side_cell, side .. "print(s.cell.id)")
property("side.neighbour", "cell or nil at the border", "The cell across, or nil at the border.", core.side_neighbour,
  side .. "print(s.neighbour)")
property("side.wall", "wall", "The wall that the side is half of.", core.side_wall, side .. "print(s.wall.length)")
property("side.opposite", "side or nil at the border", "The side of the cell across, or nil at the border.", core.side_opposite,
  side .. "print(s.opposite)")
property("side.next", "side", "The next side of the same cell, counter-clockwise.", core.side_next, side .. "print(s.next.id)")
property("side.previous", "side", "The side of the same cell before this one.", core.side_previous,
  side .. "print(s.previous.id)")
property("side.from", "junction", "The junction where the side begins. Needs a tissue with geometry.", core.side_from,
  side .. "print(s.from.x)")
property("side.to", "junction", "The junction where the side ends. Needs a tissue with geometry.", core.side_to_junction,
  side .. "print(s.to.x)")

for _, axis in ipairs { "x", "y", "z" } do
  property("junction." .. axis, "a number", "The " .. axis .. " coordinate of the junction.", core["junction_" .. axis],
    string.format("print(tissue:find(1, 'junction').%s)", axis))
end
op { name = "junction:cells", fn = core.junction_cells,
  doc = "Goes through the cells that meet in the junction, counter-clockwise.", returns = "an iterator: cell",
  example = setup .. [[for n in tissue:find(1, "junction"):cells() do print(n.id) end]] }

-- Random numbers ---------------------------------------------------------------------------------------------------

local purpose = { name = "purpose", type = "string", default = "", doc = "what the number is for: others get others" }
local draw = { name = "draw", type = "integer", min = 0, max = 2 ^ 32 - 1, default = 0,
  doc = "which number of many for this purpose, such as the step" }
local keyed = " The number depends on nothing but the seed and these arguments: the same call gives the same number, in " ..
  "whatever order and however often cells are visited. Count `draw` up for fresh ones."

local function distributions(owner, of, subject, fn)
  op { name = owner .. "uniform", fn = fn "uniform",
    args = { { name = "low", type = "number", default = 0, doc = "lower limit" },
      { name = "high", type = "number", default = 1, doc = "upper limit" }, purpose, draw },
    doc = "A random number from `low` to `high`" .. of .. "." .. keyed, returns = "a number",
    example = setup .. "print(" .. subject .. "uniform(0, 1, 'start'))" }
  op { name = owner .. "normal", fn = fn "normal",
    args = { { name = "mean", type = "number", default = 0, doc = "mean" },
      { name = "deviation", type = "number", min = 0, default = 1, doc = "standard deviation" }, purpose, draw },
    doc = "A normally distributed random number" .. of .. "." .. keyed, returns = "a number",
    example = setup .. "print(" .. subject .. "normal(10, 2, 'size'))" }
end

for _, kind in ipairs(kinds) do
  local subject = kind == "cell" and "c:" or string.format("tissue:find(1, %q):", kind)
  distributions(kind .. ":", " that belongs to the " .. kind, subject, function(name)
    return function(self, a, b, what, which) return (core.random_number(self, name, a, b, what, which)) end
  end)
end
distributions("tunica.", ", by the seed of the run", "tunica.", function(name)
  return function(a, b, what, which) return (core.random_number(nil, name, a, b, what, which)) end
end)

-- Changing the structure -------------------------------------------------------------------------------------------

op { name = "cell:remove", fn = core.remove_cell,
  doc = "Removes the cell (ablation). Its walls with other cells become border walls; without geometry they go. The last " ..
    "cell of a tissue stays.",
  example = setup .. "c:remove()\nprint(c.alive)" }

local grid = [[
local tunica = require "tunica"
local tissue = tunica.line { 4 }
local a, b, c, d = tissue:find(1), tissue:find(2), tissue:find(3), tissue:find(4)
]]
local graphs = " Only in a tissue without geometry."
local of_this, of_other = "a neighbour of this cell", "a neighbour of the other cell"
op { name = "cell:join", kind = "named", returns = "the wall between them", source = "thesis table 9.1: splice",
  args = { { name = "cell", type = "cell", required = true, position = 1, doc = "the new neighbour" },
    { name = "after", type = "cell", doc = of_this .. ", after which the new one comes" },
    { name = "before", type = "cell", doc = of_this .. ", before which the new one comes" },
    { name = "other_after", type = "cell", doc = of_other .. ", after which this cell comes there" },
    { name = "other_before", type = "cell", doc = of_other .. ", before which this cell comes there" } },
  doc = "Makes two cells neighbours of each other. Each comes last in the cyclic order of the other, or where you say." ..
    graphs,
  fn = function(self, t)
    return (core.join(self, t.cell, t.after, t.before, t.other_after, t.other_before))
  end,
  example = grid .. "b:join { d, after = a }\nfor n in b:neighbours() do print(n.id) end" }
op { name = "cell:separate", fn = core.separate,
  args = { { name = "neighbour", type = "cell", required = true, doc = "a neighbour of the cell" } },
  doc = "Makes two neighbouring cells strangers: the wall between them goes." .. graphs,
  example = grid .. "b:separate(c)\nprint(b.valence)" }
op { name = "cell:set_neighbours", fn = core.set_neighbours, source = "thesis table 9.1: make {a,b,c} nb_of v",
  args = { { name = "neighbours", type = "list", of = "cell", required = true, doc = "all neighbours, in cyclic order" } },
  doc = "Makes the given cells, in this cyclic order, the neighbours of the cell, and no others." .. graphs,
  example = grid .. "b:set_neighbours { d, c, a }\nfor n in b:neighbours() do print(n.id) end" }
