-- SPDX-License-Identifier: MIT
--- Tissues from nothing, from polygons and from files.

local core = require "tunica.core"
local surfaces = require "tunica.surfaces"
local op = require("tunica.registry").op

local most = 4000000
local seed = { name = "seed", type = "integer", min = 0, max = 2 ^ 53,
  doc = "of the tissue's random numbers; the seed of the run if left out" }

local function size(name, position, least, default, doc)
  return { name = name, type = "integer", min = least, max = most, position = position, required = default == nil,
    default = default, doc = doc }
end

local graph = " The tissue has neighbours and walls but no geometry."
local function example(text) return 'local tunica = require "tunica"\n' .. text .. "\nprint(tissue)" end

op { name = "tunica.line", kind = "named", args = { size("cells", 1, 1, nil, "number of cells"), seed },
  doc = "A row of cells." .. graph, returns = "a tissue", source = "thesis fig. 5.2",
  fn = function(t) return (core.build_line(t.cells, t.seed)) end,
  example = example "local tissue = tunica.line { 20 }" }
op { name = "tunica.ring", kind = "named", args = { size("cells", 1, 3, nil, "number of cells"), seed },
  doc = "A closed row of cells." .. graph, returns = "a tissue", source = "thesis figs 5.2, 5.3",
  fn = function(t) return (core.build_ring(t.cells, t.seed)) end,
  example = example "local tissue = tunica.ring { 50 }" }
op { name = "tunica.grid", kind = "named",
  args = { size("columns", 1, 1, nil, "cells in x"), size("rows", 2, 1, nil, "cells in y"),
    { name = "wrap", type = "boolean|string", choices = { "none", "x", "both" }, default = false,
      doc = "'x' joins the first column with the last, 'both' (or true) the first row with the last, too" }, seed },
  doc = "A rectangular grid of cells, each with up to four neighbours." .. graph, returns = "a tissue",
  source = "thesis fig. 5.4",
  fn = function(t)
    local wrap = t.wrap == true and "both" or t.wrap or "none"
    return (core.build_grid(t.columns, t.rows, wrap, t.seed))
  end,
  example = example 'local tissue = tunica.grid { 30, 30, wrap = "x" }' }
op { name = "tunica.cylinder", kind = "named",
  args = { size("around", 1, 3, nil, "cells in a ring"), size("rows", 2, 1, nil, "number of rings"), seed },
  doc = "Rings of cells, one below the other; row 0 is the tip. tissue:insert_row adds rings." .. graph,
  returns = "a tissue", source = "thesis 5.4, fig. 3.4",
  fn = function(t) return (core.build_cylinder(t.around, t.rows, t.seed)) end,
  example = example "local tissue = tunica.cylinder { around = 20, rows = 10 }" }

local area = { name = "area", type = "number", above = 0, max = 1e12, default = 1, unit = "area", doc = "of each cell" }

op { name = "tunica.squares", kind = "named",
  args = { size("columns", 1, 1, nil, "cells in x"), size("rows", 2, 1, nil, "cells in y"), seed },
  doc = "A sheet of unit squares.", returns = "a tissue",
  fn = function(t) return (core.build_squares(t.columns, t.rows, t.seed)) end,
  example = example "local tissue = tunica.squares { 4, 3 }" }
op { name = "tunica.hexagons", kind = "named",
  args = { size("columns", 1, 1, nil, "cells in x"), size("rows", 2, 1, nil, "cells in y"), area, seed },
  doc = "A sheet of regular hexagons, every second row set off by half a cell.", returns = "a tissue",
  fn = function(t) return (core.build_hexagons(t.columns, t.rows, t.area, t.seed)) end,
  example = example "local tissue = tunica.hexagons { 20, 20 }" }
op { name = "tunica.hexagon_disk", kind = "named",
  args = { { name = "radius", type = "integer", min = 0, max = 1000, position = 1, required = true,
    doc = "rings of cells around the one in the middle" }, area, seed },
  doc = "A hexagon of regular hexagons.", returns = "a tissue",
  fn = function(t) return (core.build_hexagon_disk(t.radius, t.area, t.seed)) end,
  example = example "local tissue = tunica.hexagon_disk { 6 }" }
op { name = "tunica.polygon", kind = "named",
  args = { { name = "sides", type = "integer", min = 3, max = 10000, position = 1, default = 6, doc = "number of sides" },
    area, seed },
  doc = "One cell, a regular polygon around the origin, to grow a tissue from.", returns = "a tissue",
  fn = function(t) return (core.build_polygon(t.sides, t.area, t.seed)) end,
  example = example "local tissue = tunica.polygon { 8, area = 2 }" }
op { name = "tunica.sheet", kind = "named",
  args = { size("cells", 1, 1, nil, "number of cells"),
    { name = "max_area", type = "number", above = 0, max = 1e12, default = 0.75, unit = "area",
      doc = "area at which a cell divides; the mean comes to about 0.7 of it" },
    { name = "variation", type = "number", min = 0, below = 1, default = 0.2, doc = "of that area from cell to cell, relative" },
    { name = "growth", type = "number", above = 0, max = 1, default = 0.02,
      doc = "relative growth of all areas between two divisions" }, seed },
  doc = "A sheet of cells grown from one octagon by growth and division, as irregular as living tissue.",
  returns = "a tissue", source = "thesis 3.4",
  fn = function(t) return (core.build_sheet(t.cells, t.max_area, t.variation, t.growth, t.seed)) end,
  example = example "local tissue = tunica.sheet { cells = 50, seed = 3 }" }
op { name = "tunica.apex_tissue", kind = "named",
  args = { { name = "on", type = "surface", required = true, doc = "the apex" },
    { name = "to", type = "number", above = 0, max = 1e12, unit = "length",
      doc = "arc length from the tip up to which the cells cover it" },
    { name = "cells", type = "integer", min = 1, max = 1000000, doc = "instead: the number of cells" },
    { name = "max_area", type = "number", above = 0, max = 1e12, default = 0.01, unit = "area",
      doc = "area at which a cell divides; the mean comes to about 0.7 of it" },
    { name = "variation", type = "number", min = 0, below = 1, default = 0.3, doc = "of that area from cell to cell, relative" },
    { name = "growth", type = "number", above = 0, max = 1, default = 0.02,
      doc = "relative growth of areas between two divisions, at most, where growth is fastest" }, seed },
  doc = "The cells of an apex, grown from one octagon at its tip by the growth of the apex and by division.",
  returns = "a tissue", source = "thesis 3.3, 3.4, figs 3.6, 3.7",
  fn = function(t)
    return (core.build_apex_tissue(surfaces.core_of(t.on), t.to or 0, t.cells or 0, t.max_area, t.variation, t.growth, t.seed))
  end,
  example = example 'local apex = tunica.apex { profile = "dome" }\nlocal tissue = tunica.apex_tissue { on = apex, to = 0.5 }' }
op { name = "tunica.polygons", returns = "a tissue",
  args = { { name = "cells", type = "list", of = "list", count = { 1 }, required = true,
      doc = "polygons, each a list of corners { x, y } or { x, y, z }" },
    { name = "tolerance", type = "number", min = 0, default = 1e-9, unit = "length",
      doc = "corners nearer to each other than this are one junction" }, seed },
  doc = "A tissue from given polygons. Polygons that share two corners share a wall.",
  fn = function(cells, tolerance, of) return (core.build_polygons(cells, tolerance, of)) end,
  example = example "local tissue = tunica.polygons { { {0,0}, {1,0}, {1,1}, {0,1} }, { {1,0}, {2,0}, {2,1}, {1,1} } }" }
op { name = "tunica.load", kind = "named", returns = "a tissue",
  args = { { name = "file", type = "string", required = true, position = 1, doc = "path of a cell mesh of MorphoGraphX" },
    { name = "walls", type = "string", choices = { "straight", "traced" }, default = "straight",
      doc = "'straight' between junctions, or 'traced' with every point of the mesh" }, seed },
  doc = "A tissue from a file: a cell mesh as MorphoGraphX writes it (PLY). The cells have a column `label`.",
  fn = function(t) return (core.load_tissue(t.file, t.walls, t.seed)) end }
