---@meta tunica
-- Written by scripts/reference from the registry of operations; for editors only, never run.

---@class tunica.parameters
---@field [string] number|string|boolean

---A tissue
---@class tunica.tissue
---@field data table A table for values of your own that belong to the whole tissue.
---@field seed integer The seed of the tissue's random numbers.
---@field has_geometry boolean Whether cells have places, areas and junctions (sheets), or neighbours only (lines, rings, grids).
local tissue = {}

---Goes through the cells in the order of their identities. The tissue may change meanwhile: cells that are gone when their turn comes are left out, new ones do not come.
---@return fun(): tunica.cell # an iterator: cell
function tissue:cells() end

---Goes through the walls in the order of their identities. The tissue may change meanwhile: walls that are gone when their turn comes are left out, new ones do not come.
---@return fun(): tunica.wall # an iterator: wall
function tissue:walls() end

---Goes through the sides in the order of their identities. The tissue may change meanwhile: sides that are gone when their turn comes are left out, new ones do not come.
---@return fun(): tunica.side # an iterator: side
function tissue:sides() end

---Goes through the junctions in the order of their identities. The tissue may change meanwhile: junctions that are gone when their turn comes are left out, new ones do not come.
---@return fun(): tunica.junction # an iterator: junction
function tissue:junctions() end

---How many cells, or walls, sides or junctions, there are. #tissue is the number of cells.
---@param kind? "cell"|"wall"|"side"|"junction" kind of element (one of 'cell', 'wall', 'side', 'junction'; "cell" if not given)
---@return integer # a whole number
function tissue:count(kind) end

---The element with an identity.
---@param id integer identity (whole number from 0 to 4294967295; needed)
---@param kind? "cell"|"wall"|"side"|"junction" kind of element (one of 'cell', 'wall', 'side', 'junction'; "cell" if not given)
---@return tunica.cell|tunica.wall|tunica.side|tunica.junction|nil # the element, or nil if it is gone or never was
function tissue:find(id, kind) end

---@class tunica.tissue_cell_options
---@field [string] number|function|table name of the column = initial value, or { value, divide = ... }

---Declares state that every cell has: name = value. The value is a number or a function of the cell; or { value, divide = what }, which says what the two parts get when the cell is divided: 'copy' (both the same: concentrations; the default), 'split' (in proportion to area: amounts), 'reset' (the initial value), or a function(mother's value, the first part's share) that returns two values.
---@param options? tunica.tissue_cell_options
---@return tunica.tissue # the tissue
function tissue:cell(options) end

---@class tunica.tissue_wall_options
---@field [string] number|function|table name of the column = initial value, or { value, divide = ... }

---Declares state that every wall has: name = value. The value is a number or a function of the wall; or { value, divide = what }, which says what the two parts get when the wall is divided: 'copy' (both the same: concentrations; the default), 'split' (in proportion to length: amounts), 'reset' (the initial value), or a function(mother's value, the first part's share) that returns two values.
---@param options? tunica.tissue_wall_options
---@return tunica.tissue # the tissue
function tissue:wall(options) end

---@class tunica.tissue_side_options
---@field [string] number|function|table name of the column = initial value, or { value, divide = ... }

---Declares state that every side has: name = value. The value is a number or a function of the side; or { value, divide = what }, which says what the two parts get when the side is divided: 'copy' (both the same: concentrations; the default), 'split' (in proportion to length: amounts), 'reset' (the initial value), or a function(mother's value, the first part's share) that returns two values.
---@param options? tunica.tissue_side_options
---@return tunica.tissue # the tissue
function tissue:side(options) end

---@class tunica.tissue_junction_options
---@field [string] number|function|table name of the column = initial value, or { value, divide = ... }

---Declares state that every junction has: name = value. The value is a number or a function of the junction; or { value, divide = what }, which says what the two parts get when the junction is divided: 'copy' (both the same: concentrations; the default), 'split' (in proportion to length: amounts), 'reset' (the initial value), or a function(mother's value, the first part's share) that returns two values.
---@param options? tunica.tissue_junction_options
---@return tunica.tissue # the tissue
function tissue:junction(options) end

---The greatest value of a column.
---@param column string name of a column of the cells (the name of a column of the cells; needed)
---@return number # a number
function tissue:max(column) end

---The mean of a column over all cells.
---@param column string name of a column of the cells (the name of a column of the cells; needed)
---@return number # a number
function tissue:mean(column) end

---The least value of a column.
---@param column string name of a column of the cells (the name of a column of the cells; needed)
---@return number # a number
function tissue:min(column) end

---The sum of a column over all cells.
---@param column string name of a column of the cells (the name of a column of the cells; needed)
---@return number # a number
function tissue:sum(column) end

---Adds a cell without neighbours; cell:join gives it some. Only in a tissue without geometry.
---@return tunica.cell # the new cell
function tissue:add_cell() end

---Inserts a row of cells into a grid or cylinder, between row `after` and the next. New cells start with the mean of both rows' values. Rows below count one up.
---
---Source: thesis 5.4
---@param after? integer number of the row above (whole number from 0 to 2147483647; 0 if not given)
function tissue:insert_row(after) end

---Removes the last row of a grid or cylinder.
function tissue:remove_row() end

---@class tunica.tissue_remove_options
---@field where? function function(c) that returns true for the cells that go (function)
---@field [1]? function the same
---@field on? tunica.surface instead, on an apex: with `beyond` (surface (tunica.apex, tunica.bulges or tunica.surface))
---@field beyond? number cells go whose centroid is farther than this from the tip, along the profile (number 0 or more; length)

---Removes cells, in the order of their identities. Their handles then say so. Walls that they shared become border walls; without geometry these go. At least one cell must stay.
---@param options? tunica.tissue_remove_options|function
---@return number # the number of cells removed
function tissue:remove(options) end

---Puts the cells into an order in memory in which neighbours lie near each other: rules then run faster on large tissues that have grown. Nothing else changes, identities least of all.
function tissue:renumber() end

---Checks every invariant of the tissue: neighbourhoods consistent, Euler's formula, areas positive, no cell crossing itself, columns of the right length.
---@return boolean # true, or false and a list of sentences
function tissue:validate() end

---A number that two tissues share only if structure, geometry and state are the same to the last bit.
---@return string # 16 hexadecimal digits
function tissue:hash() end

---@class tunica.tissue_grow_options
---@field rate? number all lengths grow at this relative rate: in the time t by the factor exp(rate t) (number; 1 / time)
---@field [1]? number the same
---@field rates? number[] instead: { along, across } a direction (list of 2 items, each a number; 1 / time)
---@field direction? number[] the first of two rates is along this direction (point or direction { x, y } or { x, y, z }; { ... } if not given)
---@field centre? number[] the point that stays where it is (point or direction { x, y } or { x, y, z }; { ... } if not given)
---@field velocity? function instead: function(x, y, z, t) that returns vx, vy (and vz) (function)
---@field on? tunica.surface instead: as this surface grows. Cell columns `theta` and `a`, if both are declared, are kept up to date on an apex (see tissue:locate) (surface (tunica.apex, tunica.bulges or tunica.surface))
---@field time? number how long (number 0 or more; time; 1 if not given)
---@field from? number the time at the start, for a velocity or surface that changes; 0, or that of a surface that bulges, if left out (number; time)
---@field substeps? integer for a velocity: steps within the time (whole number from 1 to 1000; 1 if not given)

---Lets a tissue grow for some time: in the plane uniformly, at two rates, or by a field of velocities, or with the surface it lies on. The structure stays as it is; state is not diluted. If a cell would become impossible that is an error, and nothing moves.
---
---Source: thesis 3.3, 10.2
---@param options? tunica.tissue_grow_options|number
function tissue:grow(options) end

---Moves every junction to where a function puts it. Cells that would be turned over or cross themselves are an error, and nothing moves.
---@param place function function(x, y, z) that returns the new x, y (and z) (function; needed)
function tissue:deform(place) end

---@class tunica.tissue_locate_options
---@field on? tunica.surface the apex that the tissue lies on, bulging or not (surface (tunica.apex, tunica.bulges or tunica.surface); needed)
---@field [1]? tunica.surface the same

---Gives the cells columns `theta` (degrees, 0 on the axis) and `a` (arc length from the tip): the place of the centroid on an apex, for rules that depend on zones. tissue:grow and tissue:divide with the same `on` keep them up to date.
---
---Source: thesis (3.1)
---@param options? tunica.tissue_locate_options|tunica.surface
---@return tunica.tissue # the tissue
function tissue:locate(options) end

---@class tunica.tissue_differentiate_options
---@field on? tunica.bulges the surface with primordia that the tissue lies on (surface that bulges (tunica.bulges); needed)
---@field [1]? tunica.bulges the same

---Gives the cells columns `primordium` (number of the one in which the centroid lies most deeply, 0 outside all) and `closeness` (1 - d/r: 1 at the centre of that primordium, 0 at its rim and outside). tissue:grow and tissue:divide with the same `on` keep them up to date; call it again when a primordium has been added.
---
---Source: thesis (5.10), (5.11)
---@param options? tunica.tissue_differentiate_options|tunica.bulges
---@return tunica.tissue # the tissue
function tissue:differentiate(options) end

---@class tunica.tissue_divide_options
---@field above? number cells divide whose area is above this, and their daughters, until none is (number greater than 0; area)
---@field [1]? number the same
---@field variation? number of that area from cell to cell, relative, uniform; fixed for each cell by the seed of the tissue (number 0 or more and less than 1; 0 if not given)
---@field where? function function(c) that returns true for cells that divide; alone or with `above` (function)
---@field max_cells? integer stops when there are so many (whole number from 1 to 16777216; 1000000 if not given)
---@field rule? "errera"|"closest_wall"|"along"|function where the wall goes: 'errera', the shortest through the centroid (the default); 'closest_wall', towards the nearest point of the outline; 'along' a direction; or function(c) that returns the ends of the wall, x1, y1, x2, y2 (or two points { x, y } or { x, y, z }) (one of 'errera', 'closest_wall', 'along' or function)
---@field direction? number[]|function for 'along': of the new wall; or function(c) that returns it (point or direction { x, y } or { x, y, z } or function)
---@field gap? number least distance of the wall's ends from junctions; 0.15 of the square root of the cell's area if left out (number 0 or more; length)
---@field pinch? number how far the wall's ends are drawn in, as a fraction of its length (number 0 or more and less than 0.5; 0.08 if not given)
---@field on? tunica.surface the surface that the tissue lies on: new junctions are put onto it (surface (tunica.apex, tunica.bulges or tunica.surface))

---Divides cells, in the order of their identities. Four walls never meet in one point, and the ends of the wall are pinched as in living tissue. What daughters get is said where the columns are declared. A cell that cannot be divided as its rule says is an error, raised when all others are divided.
---
---Source: thesis 3.4, figs 3.7, 3.8
---@param options? tunica.tissue_divide_options|number
---@return number # the number of divisions
function tissue:divide(options) end

---The shapes of the cells. `cells`, `interior` (those without a border wall; all that follows is of them), `shares[n]` (the fraction of cells with n sides), `mean_sides`, `variance_sides`, `mean_area`, `area_cv`, `area_by_sides[n]` (relative to the mean), `lewis_slope`, `sharp_cells` (the fraction with an angle below 45 degrees), `least_angle[1..18]` (fractions by least angle, in steps of 10 degrees), `mean_least_angle`, and `four_way` (junctions of more than three walls).
---@return table # a table
function tissue:statistics() end

---How many cells have more than each of their neighbours, and more than `above`.
---@param column string name of a column of the cells (the name of a column of the cells; needed)
---@param above? number only higher ones; the mean of the column if left out (number)
---@return integer # a whole number
function tissue:count_peaks(column, above) end

---How far values go up and down from cell to cell: 1 for a checkerboard on a grid (at most 0.5 on hexagons), 0.2 to 0.7 for noise, negative for anything smooth. Beyond noise it says that a time step was too long, most likely.
---@param column string name of a column of the cells (the name of a column of the cells; needed)
---@return number # a number from -1 to 1, and whether it is beyond what noise gives
function tissue:checkerboard(column) end

---@class tunica.tissue_pair_options
---@field column? string name of a column of the cells (the name of a column of the cells; needed)
---@field [1]? string the same
---@field above? number both cells have more than this (number; needed)
---@field [2]? number the same
---@field where? table conditions on both cells: { column = value } or { column = { low, high } } (table; {} if not given)

---Two neighbours that both have more than a threshold: where a primordium starts. Of several such pairs the one whose lower value is highest.
---
---Source: thesis 5.5.1
---@param options? tunica.tissue_pair_options|string
---@return tunica.cell? first, tunica.cell? second # two cells, the one with more first; or nothing
function tissue:pair(options) end

---The cells that have more than each of their neighbours, and more than `above`.
---@param column string name of a column of the cells (the name of a column of the cells; needed)
---@param above? number only higher ones; the mean of the column if left out (number)
---@return table # a list of cells, the mean distance from a peak to the next (0 without geometry), its coefficient of variation
function tissue:peaks(column, above) end

---@class tunica.tissue_picture_options
---@field file? string path that ends in .png; replaced if it is there (text; needed)
---@field [1]? string the same
---@field colour? string|function colour of cells: the name of a column, or a function that returns a number (nil: no value) (text or function)
---@field palette? "cividis"|"cyclic"|"diverging"|"greens"|"greys"|"inferno"|"magma"|"viridis"|string[] colour map, by name or as a list of colours that it runs through (one of 'cividis', 'cyclic', 'diverging', 'greens', 'greys', 'inferno', 'magma', 'viridis' or list of items, each text; "viridis" if not given)
---@field range? number[] values at the ends of the colour map, { low, high }; by default those that occur (from 0, if they start near it) (list of 1 to 2 items, each a number)
---@field missing? string|table colour of cells without a value, by default grey; or { colour, title = } with what the legend calls them (text or table)
---@field legend? string|boolean title of the colour bar; false: no legend (text, or true or false; true if not given)
---@field sides? string|function|table bands along walls, inside the cell: the name of a column, or a function that returns a number (nil: no value) of sides; or { column or function, max = value of the widest band, colour =, style = 'width' or 'intensity', width = of the widest band relative to a cell, title = } (text or function or table)
---@field markers? function|table cells with a mark: function(c) that returns true or false, or a list of cells; or { function or list, shape = 'ring', 'disc', 'square', 'triangle', 'cross' or 'plus', colour =, size = } (function or table)
---@field labels? string|function text on cells: 'id', the name of a column, or a function that returns text, a number or nil (text or function)
---@field title? string|function|boolean text above the picture, or a function(t) that returns it; by default the time of a model; false: none (text or function, or true or false)
---@field size? number|number[] pixels, { width, height } or one number for both (number from 16 to 16384 or list of 2 items, each a number)
---@field bars? boolean a line or ring as bars (default) or as squares (true or false)
---@field place? function function(c) that returns x, y, z: the cells of a grid or cylinder span a surface (function)
---@field wireframe? boolean with place: only lines between neighbours (true or false)
---@field camera? table|function { direction = { x, y, z }, up =, perspective = true or false, zoom =, centre =, extent = half of what must fit }; or a function that returns this, so that the camera follows what it looks at (table or function)
---@field light? boolean a lamp, so that surfaces in space look round; on by default where `place` is given (true or false)
---@field background? string colour of the ground (text)
---@field transparent? boolean no ground (true or false)
---@field outline? string|boolean colour of the lines around cells; false: none (text, or true or false)
---@field outline_width? number of these lines; by default by the size of cells (number from 0 to 100; pixels)
---@field plain? string colour of cells without `colour` (text)

---Writes a picture of the tissue as it is now.
---
---Source: thesis figs. 3.4, 5.2, 5.4, 5.7
---@param options? tunica.tissue_picture_options|string
---@return string # the path
function tissue:picture(options) end

---@class tunica.tissue_show_options
---@field colour? string|function colour of cells: the name of a column, or a function that returns a number (nil: no value) (text or function)
---@field palette? "cividis"|"cyclic"|"diverging"|"greens"|"greys"|"inferno"|"magma"|"viridis"|string[] colour map, by name or as a list of colours that it runs through (one of 'cividis', 'cyclic', 'diverging', 'greens', 'greys', 'inferno', 'magma', 'viridis' or list of items, each text; "viridis" if not given)
---@field range? number[] values at the ends of the colour map, { low, high }; by default those that occur (from 0, if they start near it) (list of 1 to 2 items, each a number)
---@field missing? string|table colour of cells without a value, by default grey; or { colour, title = } with what the legend calls them (text or table)
---@field legend? string|boolean title of the colour bar; false: no legend (text, or true or false; true if not given)
---@field sides? string|function|table bands along walls, inside the cell: the name of a column, or a function that returns a number (nil: no value) of sides; or { column or function, max = value of the widest band, colour =, style = 'width' or 'intensity', width = of the widest band relative to a cell, title = } (text or function or table)
---@field markers? function|table cells with a mark: function(c) that returns true or false, or a list of cells; or { function or list, shape = 'ring', 'disc', 'square', 'triangle', 'cross' or 'plus', colour =, size = } (function or table)
---@field labels? string|function text on cells: 'id', the name of a column, or a function that returns text, a number or nil (text or function)
---@field title? string|function|boolean text above the picture, or a function(t) that returns it; by default the time of a model; false: none (text or function, or true or false)
---@field size? number|number[] pixels, { width, height } or one number for both (number from 16 to 16384 or list of 2 items, each a number)
---@field bars? boolean a line or ring as bars (default) or as squares (true or false)
---@field place? function function(c) that returns x, y, z: the cells of a grid or cylinder span a surface (function)
---@field wireframe? boolean with place: only lines between neighbours (true or false)
---@field camera? table|function { direction = { x, y, z }, up =, perspective = true or false, zoom =, centre =, extent = half of what must fit }; or a function that returns this, so that the camera follows what it looks at (table or function)
---@field light? boolean a lamp, so that surfaces in space look round; on by default where `place` is given (true or false)
---@field background? string colour of the ground (text)
---@field transparent? boolean no ground (true or false)
---@field outline? string|boolean colour of the lines around cells; false: none (text, or true or false)
---@field outline_width? number of these lines; by default by the size of cells (number from 0 to 100; pixels)
---@field plain? string colour of cells without `colour` (text)

---Shows a picture of the tissue in the terminal. Where the output is no terminal, or one that cannot show pictures, it is written to a temporary file, whose path is printed.
---@param options? tunica.tissue_show_options
function tissue:show(options) end

---@class tunica.tissue_near_options
---@field place? number[] a point { x, y } or { x, y, z } (point or direction { x, y } or { x, y, z })
---@field [1]? number[] the same
---@field radius? number cells whose centroid is so near (number 0 or more; length)
---@field [2]? number the same
---@field count? integer at most so many; without a radius the nearest ones (whole number 1 or more)
---@field on? tunica.surface instead of a point: an apex, with (surface (tunica.apex, tunica.bulges or tunica.surface))
---@field theta? number angle around its axis, and (number; degrees)
---@field a? number arc length from its tip (number 0 or more; length)

---The cells near a place: to be removed (ablation: for _, c in ipairs(tissue:near { ... }) do c:remove() end), to be given a value, or for model:supply. Distances are those in space. No cell within the radius is refused: the place may be off the tissue. With a count alone it is the nearest ones, however far they are.
---
---Source: thesis 5.5.3
---@param options? tunica.tissue_near_options|number[]
---@return table # a list of cells, the nearest first
function tissue:near(options) end

---A cell
---@class tunica.cell
---@field [string] number
---@field id integer The identity of the cell: a whole number that never changes and is never used again. Handles are not the same as table keys: write t[c.id].
---@field alive boolean Whether the cell is still there: false after it has divided or was removed.
---@field kind string The word 'cell'.
---@field tissue tunica.tissue The tissue that the cell belongs to.
---@field border boolean Whether one of the cell's walls has no cell on its other side.
---@field valence integer The number of neighbouring cells.
---@field side_count integer The number of sides: of walls, those of the border among them.
local cell = {}

---Goes through the neighbouring cells in cyclic order, counter-clockwise seen from outside; with each comes the wall to it. A neighbour across several walls comes once.
---@return fun(): tunica.cell, tunica.wall # an iterator: neighbour, wall
function cell:neighbours() end

---Goes through the walls of the cell in cyclic order.
---@return fun(): tunica.wall # an iterator: wall
function cell:walls() end

---Goes through the sides of the cell in cyclic order.
---@return fun(): tunica.side # an iterator: side
function cell:sides() end

---Goes through the junctions of the cell in cyclic order. Needs a tissue with geometry.
---@return fun(): tunica.junction # an iterator: junction
function cell:junctions() end

---The neighbour after a given one, counter-clockwise. Borders are stepped over.
---
---Source: thesis table 9.1: nextto n in v
---@param neighbour tunica.cell a neighbour of the cell (cell; needed)
---@return tunica.cell # a cell
function cell:next_to(neighbour) end

---The neighbour before a given one: the next one clockwise. Borders are stepped over.
---
---Source: thesis table 9.1: prevto n in v
---@param neighbour tunica.cell a neighbour of the cell (cell; needed)
---@return tunica.cell # a cell
function cell:previous_to(neighbour) end

---The wall between two cells, or nil if they are not neighbours.
---@param other tunica.cell another cell (cell; needed)
---@return tunica.wall # a wall or nil
function cell:wall_to(other) end

---The side of this cell that faces another, or nil if they are not neighbours. What one cell does to another, as PIN1 in a membrane, is state of this side.
---
---Source: thesis table 9.1: v^n
---@param other tunica.cell another cell (cell; needed)
---@return tunica.side # a side or nil
function cell:side_to(other) end

---A random number from `low` to `high` that belongs to the cell. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param low? number lower limit (number; 0 if not given)
---@param high? number upper limit (number; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function cell:uniform(low, high, purpose, draw) end

---A normally distributed random number that belongs to the cell. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param mean? number mean (number; 0 if not given)
---@param deviation? number standard deviation (number 0 or more; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function cell:normal(mean, deviation, purpose, draw) end

---Removes the cell (ablation). Its walls with other cells become border walls; without geometry they go. The last cell of a tissue stays.
function cell:remove() end

---@class tunica.cell_join_options
---@field cell? tunica.cell the new neighbour (cell; needed)
---@field [1]? tunica.cell the same
---@field after? tunica.cell a neighbour of this cell, after which the new one comes (cell)
---@field before? tunica.cell a neighbour of this cell, before which the new one comes (cell)
---@field other_after? tunica.cell a neighbour of the other cell, after which this cell comes there (cell)
---@field other_before? tunica.cell a neighbour of the other cell, before which this cell comes there (cell)

---Makes two cells neighbours of each other. Each comes last in the cyclic order of the other, or where you say. Only in a tissue without geometry.
---
---Source: thesis table 9.1: splice
---@param options? tunica.cell_join_options|tunica.cell
---@return tunica.wall # the wall between them
function cell:join(options) end

---Makes two neighbouring cells strangers: the wall between them goes. Only in a tissue without geometry.
---@param neighbour tunica.cell a neighbour of the cell (cell; needed)
function cell:separate(neighbour) end

---Makes the given cells, in this cyclic order, the neighbours of the cell, and no others. Only in a tissue without geometry.
---
---Source: thesis table 9.1: make {a,b,c} nb_of v
---@param neighbours tunica.cell[] all neighbours, in cyclic order (list of items, each a cell; needed)
function cell:set_neighbours(neighbours) end

---@class tunica.cell_divide_options
---@field rule? "errera"|"closest_wall"|"along"|function where the wall goes: 'errera', the shortest through the centroid (the default); 'closest_wall', towards the nearest point of the outline; 'along' a direction; or function(c) that returns the ends of the wall, x1, y1, x2, y2 (or two points { x, y } or { x, y, z }) (one of 'errera', 'closest_wall', 'along' or function)
---@field direction? number[]|function for 'along': of the new wall; or function(c) that returns it (point or direction { x, y } or { x, y, z } or function)
---@field gap? number least distance of the wall's ends from junctions; 0.15 of the square root of the cell's area if left out (number 0 or more; length)
---@field pinch? number how far the wall's ends are drawn in, as a fraction of its length (number 0 or more and less than 0.5; 0.08 if not given)
---@field on? tunica.surface the surface that the tissue lies on: new junctions are put onto it (surface (tunica.apex, tunica.bulges or tunica.surface))

---Divides the cell. The cell itself is then gone: its handles are errors that name the daughters.
---
---Source: thesis 3.4
---@param options? tunica.cell_divide_options
---@return tunica.cell, tunica.cell # the two daughters
function cell:divide(options) end

---The maximum of a function over the walls to neighbours, in cyclic order.
---@param f function f(n, w, s, o): neighbour, wall, own and opposite side (function; needed)
---@return number # a number; 0 for a cell without neighbours
function cell:maximum(f) end

---The minimum of a function over the walls to neighbours, in cyclic order.
---@param f function f(n, w, s, o): neighbour, wall, own and opposite side (function; needed)
---@return number # a number; 0 for a cell without neighbours
function cell:minimum(f) end

---The sum of a function over the walls to neighbours, in cyclic order.
---@param f function f(n, w, s, o): neighbour, wall, own and opposite side (function; needed)
---@return number # a number; 0 for a cell without neighbours
function cell:sum(f) end

---A wall between two cells, or at the border
---@class tunica.wall
---@field [string] number
---@field id integer The identity of the wall: a whole number that never changes and is never used again. Handles are not the same as table keys: write t[w.id].
---@field alive boolean Whether the wall is still there: false after it has divided or was removed.
---@field kind string The word 'wall'.
---@field tissue tunica.tissue The tissue that the wall belongs to.
---@field border boolean Whether the wall has a cell on one side only.
local wall = {}

---The one or two cells that share the wall.
---@return tunica.cell, tunica.cell? # cell, cell or nil at the border
function wall:cells() end

---The one or two sides of the wall.
---@return tunica.side, tunica.side? # side, side or nil at the border
function wall:sides() end

---The two ends of the wall. Needs a tissue with geometry.
---@return tunica.junction, tunica.junction # junction, junction
function wall:junctions() end

---A random number from `low` to `high` that belongs to the wall. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param low? number lower limit (number; 0 if not given)
---@param high? number upper limit (number; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function wall:uniform(low, high, purpose, draw) end

---A normally distributed random number that belongs to the wall. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param mean? number mean (number; 0 if not given)
---@param deviation? number standard deviation (number 0 or more; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function wall:normal(mean, deviation, purpose, draw) end

---A wall as one of its cells sees it
---@class tunica.side
---@field [string] number
---@field id integer The identity of the side: a whole number that never changes and is never used again. Handles are not the same as table keys: write t[s.id].
---@field alive boolean Whether the side is still there: false after it has divided or was removed.
---@field kind string The word 'side'.
---@field tissue tunica.tissue The tissue that the side belongs to.
---@field border boolean Whether there is no cell across the side.
---@field cell tunica.cell The cell that the side belongs to.
---@field neighbour tunica.cell? The cell across, or nil at the border.
---@field wall tunica.wall The wall that the side is half of.
---@field opposite tunica.side? The side of the cell across, or nil at the border.
---@field next tunica.side The next side of the same cell, counter-clockwise.
---@field previous tunica.side The side of the same cell before this one.
---@field from tunica.junction The junction where the side begins. Needs a tissue with geometry.
---@field to tunica.junction The junction where the side ends. Needs a tissue with geometry.
local side = {}

---A random number from `low` to `high` that belongs to the side. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param low? number lower limit (number; 0 if not given)
---@param high? number upper limit (number; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function side:uniform(low, high, purpose, draw) end

---A normally distributed random number that belongs to the side. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param mean? number mean (number; 0 if not given)
---@param deviation? number standard deviation (number 0 or more; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function side:normal(mean, deviation, purpose, draw) end

---A point where walls meet
---@class tunica.junction
---@field [string] number
---@field id integer The identity of the junction: a whole number that never changes and is never used again. Handles are not the same as table keys: write t[j.id].
---@field alive boolean Whether the junction is still there: false after it has divided or was removed.
---@field kind string The word 'junction'.
---@field tissue tunica.tissue The tissue that the junction belongs to.
---@field border boolean Whether the junction lies on the border of the tissue.
---@field x number The x coordinate of the junction.
---@field y number The y coordinate of the junction.
---@field z number The z coordinate of the junction.
local junction = {}

---Goes through the cells that meet in the junction, counter-clockwise.
---@return fun(): tunica.cell # an iterator: cell
function junction:cells() end

---A random number from `low` to `high` that belongs to the junction. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param low? number lower limit (number; 0 if not given)
---@param high? number upper limit (number; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function junction:uniform(low, high, purpose, draw) end

---A normally distributed random number that belongs to the junction. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param mean? number mean (number; 0 if not given)
---@param deviation? number standard deviation (number 0 or more; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function junction:normal(mean, deviation, purpose, draw) end

---A model of a tissue
---@class tunica.model
---@field time number
---@field steps integer
---@field tissue tunica.tissue
---@field params tunica.parameters
---@field name string
---@field about table
---@field cost table
---@field stop number
local model = {}

---Columns that follow from others at every moment: function(c, t) c.x = ... end; for sides function(s, t), for walls function(w, a, b, t).
---@param element "cell"|"side"|"wall"|function the rule for cells; or 'cell', 'side' or 'wall', and then the rule (one of 'cell', 'side', 'wall' or function; needed)
---@param rule? function the rule, if an element was named (function)
function model:derive(element, rule) end

---Rates of change: function(c, d, t) d.x = ... end; for sides function(s, d, t), for walls function(w, d, a, b, t). Rates of several rules are added.
---
---Source: thesis 9.1
---@param element "cell"|"side"|"wall"|function the rule for cells; or 'cell', 'side' or 'wall', and then the rule (one of 'cell', 'side', 'wall' or function; needed)
---@param rule? function the rule, if an element was named (function)
function model:rate(element, rule) end

---Transport through walls: what leaves a arrives in b. The concentration changes by the amount divided by the cell's area (by the amount itself in a tissue without geometry).
---
---Source: thesis 5.9
---@param column string the concentration that is carried (text; needed)
---@param flux function function(w, a, b, t): amount per time through wall w from cell a to cell b (function; needed)
function model:flux(column, flux) end

---Something that happens at regular times: growth, division.
---@param interval number first after one interval (number greater than 0; time; needed)
---@param event function function(t) (function; needed)
function model:every(interval, event) end

---Something that happens once.
---@param time number when (number 0 or more; time; needed)
---@param event function function(t) (function; needed)
function model:at(time, event) end

---Something that happens each time a condition becomes true. It is asked at the start, after events, and after each step; when it has become true in a step, the step is taken anew to end where it did.
---@param condition function function(t): true or false; it must change nothing (function; needed)
---@param event function function(t) (function; needed)
---@param located? boolean false: it happens at the end of the step, and changes no step; for what only watches (true or false; true if not given)
function model:when(condition, event, located) end

---@class tunica.model_report_options
---@field every? number interval of the time series; without it there is none (number greater than 0; time)
---@field [string] function 

---What the model says at its end, by name: functions that return a number, text or a table. With `every` also as a time series.
---@param options? tunica.model_report_options
function model:report(options) end

---A fingerprint of everything that changes; equal states have equal ones.
---@return string # 16 hexadecimal digits
function model:hash() end

---@class tunica.model_advance_options
---@field to? number until when (number; time; needed)
---@field [1]? number the same
---@field pause? number stop then (with fixed steps: after the first that ends then or later) (number; time)
---@field seconds? number stop after so much time on the clock (number 0 or more; s)

---Runs the model to a time, events included. How often it pauses changes no step.
---@param options? tunica.model_advance_options|number
---@return string # 'done', 'paused', 'out of time' or 'interrupted'
function model:advance(options) end

---Everything that changes during a run: the tissue, the time, the events, parameters, and the plain values (numbers, text, tables of them) that functions of the model keep.
---@return string # text
function model:snapshot() end

---Goes back to a snapshot of the same script. Rules, events and reports that the model was given since go. The method stays the one in use (model:solve_with).
---@param snapshot string what model:snapshot() gave (text; needed)
function model:restore(snapshot) end

---@class tunica.model_solve_with_options
---@field method? "euler"|"sts"|"heun"|"rk4"|"bs32"|"dp54"|"rkc2"|"backward_euler"|"crank_nicolson"|"bicg"|"bdf"|"auto" method of integration (euler: forward Euler, order 1; sts: super-time-stepping, five unequal Euler steps, for diffusion, order 1; heun: explicit trapezoid (Heun), order 2; rk4: classical Runge-Kutta, order 4; bs32: Bogacki-Shampine 3(2), order 3, adaptive; dp54: Dormand-Prince 5(4), order 5, adaptive; rkc2: Runge-Kutta-Chebyshev, for diffusion, order 2, adaptive; backward_euler: backward Euler, modified Newton, order 1; crank_nicolson: Crank-Nicolson, modified Newton, order 2; bicg: Crank-Nicolson, Newton with biconjugate gradients, order 2; bdf: backward differentiation formulas (CVODE), order 5, adaptive; auto: what costs least, tried on the way, order 0, adaptive) (one of 'euler', 'sts', 'heun', 'rk4', 'bs32', 'dp54', 'rkc2', 'backward_euler', 'crank_nicolson', 'bicg', 'bdf', 'auto')
---@field dt? number step; of adaptive methods the longest, and may be left out. rkc2 with dt and no tolerance takes fixed steps (number greater than 0; time)
---@field tolerance? number adaptive methods: error allowed in one step, relative to each value and its column's root mean square (number 1 or less and greater than 0)

---Changes how the model is solved from now on; state and time stay. A new method begins with its own dt (fixed steps: the old one, unless given) and tolerance.
---@param options? tunica.model_solve_with_options
function model:solve_with(options) end

---@class tunica.model_steady_options
---@field tolerance? number of what is left of the rates, relative to their terms (number greater than 0; 1e-10 if not given)
---@field stability? boolean whether to look if small disturbances decay (true or false; true if not given)

---Goes to a state in which nothing changes by the rates as they are at the present time; time stays, events do not happen. Linear rules are solved directly, others by Newton's method from the present state. If there is none, or it is not determined, nothing changes.
---
---Source: thesis 9.5
---@param options? tunica.model_steady_options
---@return table # a table: how (elimination, sparse factors, newton), iterations, residual, growth (largest real part found among the eigenvalues of the Jacobian), stable
function model:steady(options) end

---@class tunica.model_view_options
---@field every? number between pictures; without it, one at the end (number greater than 0; time)
---@field name? string of the pictures' folder, where a model has several views (text)
---@field plot? function instead of the tissue: function(t) that returns the options of a tunica.plot, without a file (function)
---@field colour? string|function colour of cells: the name of a column, or a function that returns a number (nil: no value) (text or function)
---@field palette? "cividis"|"cyclic"|"diverging"|"greens"|"greys"|"inferno"|"magma"|"viridis"|string[] colour map, by name or as a list of colours that it runs through (one of 'cividis', 'cyclic', 'diverging', 'greens', 'greys', 'inferno', 'magma', 'viridis' or list of items, each text; "viridis" if not given)
---@field range? number[] values at the ends of the colour map, { low, high }; by default those that occur (from 0, if they start near it) (list of 1 to 2 items, each a number)
---@field missing? string|table colour of cells without a value, by default grey; or { colour, title = } with what the legend calls them (text or table)
---@field legend? string|boolean title of the colour bar; false: no legend (text, or true or false; true if not given)
---@field sides? string|function|table bands along walls, inside the cell: the name of a column, or a function that returns a number (nil: no value) of sides; or { column or function, max = value of the widest band, colour =, style = 'width' or 'intensity', width = of the widest band relative to a cell, title = } (text or function or table)
---@field markers? function|table cells with a mark: function(c) that returns true or false, or a list of cells; or { function or list, shape = 'ring', 'disc', 'square', 'triangle', 'cross' or 'plus', colour =, size = } (function or table)
---@field labels? string|function text on cells: 'id', the name of a column, or a function that returns text, a number or nil (text or function)
---@field title? string|function|boolean text above the picture, or a function(t) that returns it; by default the time of a model; false: none (text or function, or true or false)
---@field size? number|number[] pixels, { width, height } or one number for both (number from 16 to 16384 or list of 2 items, each a number)
---@field bars? boolean a line or ring as bars (default) or as squares (true or false)
---@field place? function function(c) that returns x, y, z: the cells of a grid or cylinder span a surface (function)
---@field wireframe? boolean with place: only lines between neighbours (true or false)
---@field camera? table|function { direction = { x, y, z }, up =, perspective = true or false, zoom =, centre =, extent = half of what must fit }; or a function that returns this, so that the camera follows what it looks at (table or function)
---@field light? boolean a lamp, so that surfaces in space look round; on by default where `place` is given (true or false)
---@field background? string colour of the ground (text)
---@field transparent? boolean no ground (true or false)
---@field outline? string|boolean colour of the lines around cells; false: none (text, or true or false)
---@field outline_width? number of these lines; by default by the size of cells (number from 0 to 100; pixels)
---@field plain? string colour of cells without `colour` (text)

---How the model is to be shown: cells coloured by a column, bands along their walls, marks and labels; or numbers, as a plot. A run writes a picture every so often, and one at its end.
---
---Source: thesis figs. 3.4, 5.2, 5.4, 5.7
---@param options? tunica.model_view_options
function model:view(options) end

---@class tunica.model_supply_options
---@field column? string what is supplied: a column with a rate or flux (text; needed)
---@field [1]? string the same
---@field rate? number added to its rate of change in these cells: concentration per time; below 0 it is taken out, and the run ends where nothing is left to be taken (unless the column is `signed`) (number; needed)
---@field cells? any[]|function the cells; or a function that returns them, called when the supply starts (list of items or function; needed)
---@field from? number when it starts: now, if left out (number 0 or more; time)
---@field to? number when it ends: never, if left out (number 0 or more; time)

---Applies a substance to cells of a model, from a time on and for a time: a drop of auxin on an apex. The cells keep what they got as they grow and move, and so do their daughters. What is supplied now stands in a column of its own.
---
---Source: thesis 5.5.3, fig. 5.12
---@param options? tunica.model_supply_options|string
---@return string # text: the name of the new column
function model:supply(options) end

---A model of phyllotaxis by inhibition
---@class tunica.phyllotaxis
---@field time number
---@field steps integer
---@field count integer
---@field angles number[]
---@field finished boolean
---@field params tunica.parameters
---@field name string
---@field apex tunica.apex
---@field about table
---@field cost table
local phyllotaxis = {}

---@class tunica.phyllotaxis_inhibition_options
---@field field? function function(d, age, t): share of a primordium of this age at distance d; its unit is that of the threshold (function; needed)
---@field below? any threshold: a number, a function(t), or a curve over time

---An inhibitor: each primordium adds f(distance, age) to its field. A place of the ring is a candidate where the field is below the threshold, for every inhibitor; the candidate with the lowest field of the first inhibitor is where a primordium is born. Then fields are computed again, and so on at the same time until there is no candidate.
---
---Source: thesis 4.1-4.5
---@param options? tunica.phyllotaxis_inhibition_options
function phyllotaxis:inhibition(options) end

---@class tunica.phyllotaxis_initial_options
---@field count? integer primordia in all; a multiple of the jugacy (whole number from 1 to 100000; needed)
---@field angle? number from one primordium (whorl) to the next (number; degrees; needed)
---@field jugacy? integer primordia at once, evenly spaced; that of the model if not given (whole number from 1 to 1000)
---@field spacing? number from one primordium (whorl) to the next (number greater than 0; time)

---Starts from a lattice: whorls at a constant divergence angle and a constant plastochron, old enough that the next one is due at time 0 and angle 0. Without a spacing the plastochron is that at which the field of these whorls is at the threshold of the first inhibitor.
---@param options? tunica.phyllotaxis_initial_options
function phyllotaxis:initial(options) end

---@class tunica.phyllotaxis_primordium_options
---@field angle? number around the axis (number; degrees; needed)
---@field age? number time since it was on the ring (number 0 or more; time; 0 if not given)

---A primordium that is there at the start (the oldest is given first), or that comes now, by an event.
---@param options? tunica.phyllotaxis_primordium_options
function phyllotaxis:primordium(options) end

---Something that happens at regular times: growth, division.
---@param interval number first after one interval (number greater than 0; time; needed)
---@param event function function(t) (function; needed)
function phyllotaxis:every(interval, event) end

---Something that happens once.
---@param time number when (number 0 or more; time; needed)
---@param event function function(t) (function; needed)
function phyllotaxis:at(time, event) end

---Something that happens each time a condition becomes true. It is asked at the start, after events and insertions, and between insertions, where the time is found at which it became true.
---@param condition function function(t): true or false; it must change nothing (function; needed)
---@param event function function(t) (function; needed)
---@param located? boolean false: it is asked only after insertions and search intervals, and its time is not found (true or false; true if not given)
function phyllotaxis:when(condition, event, located) end

---@class tunica.phyllotaxis_report_options
---@field every? number interval of the time series; without it there is none (number greater than 0; time)
---@field [string] function 

---What the model says at its end, by name: functions that return a number, text or a table. With `every` also as a time series.
---@param options? tunica.phyllotaxis_report_options
function phyllotaxis:report(options) end

---A fingerprint of everything that changes; equal states have equal ones.
---@return string # 16 hexadecimal digits
function phyllotaxis:hash() end

---Something that happens once, when the model has so many primordia: a threshold is changed, say.
---@param count integer number of the primordium; those of the start count (whole number 1 or more; needed)
---@param event function function(t) (function; needed)
function phyllotaxis:after(count, event) end

---@class tunica.phyllotaxis_advance_options
---@field to? number until when; may be left out if the model stops with a number of primordia (number; time)
---@field [1]? number the same
---@field pause? number stop then (number; time)
---@field seconds? number stop after so much time on the clock (number 0 or more; s)

---Runs the model to a time, or to the number of primordia at which it stops, events included. How often it pauses changes no primordium.
---@param options? tunica.phyllotaxis_advance_options|number
---@return string # 'done', 'paused', 'out of time' or 'interrupted'
function phyllotaxis:advance(options) end

---Everything that changes during a run: primordia, time, events, parameters, and the plain values that functions of the model keep.
---@return string # text
function phyllotaxis:snapshot() end

---Goes back to a snapshot of the same script.
---@param snapshot string what model:snapshot() gave (text; needed)
function phyllotaxis:restore(snapshot) end

---All primordia, the oldest first: angle and divergence (from the one before, -180 to 180) in degrees, time of birth, age, arc length from the tip (a, on an apex), place in space, distance from the axis (radius).
---@return table # a list of { number, angle, time, age, a, x, y, z, radius, divergence, jugacy, initial }
function phyllotaxis:primordia() end

---The field of an inhibitor now, at a place on the ring or elsewhere.
---@param theta number angle of the place (number; degrees; needed)
---@param a? number its arc length from the tip of the apex; that of the ring if not given. Of a model without an apex: its distance from the axis (number from 0 to 1000000000000; length)
---@param y? number its height, of a model without an apex; that of the ring if not given (number; length)
---@param which? integer number of the inhibitor (whole number from 1 to 8; 1 if not given)
---@return number # a number
function phyllotaxis:field(theta, a, y, which) end

---@class tunica.phyllotaxis_pattern_options
---@field first? integer number of the first primordium that counts; by default the first one that the run inserted (whole number 1 or more)
---@field last? integer number of the last one; by default the youngest (whole number 1 or more)
---@field jugacy? integer found if left out, or imposed by the model (whole number from 1 to 1000)
---@field expected? table { angle =, jugacy =, pair = { m, n } } (table)

---What the pattern of its primordia is, those of the start left out: see tunica.pattern.
---@param options? tunica.phyllotaxis_pattern_options
---@return table # what tunica.pattern gives
function phyllotaxis:pattern(options) end

---The place on the ring where the field of the first inhibitor is lowest now, among the candidates if there are any.
---@return number angle, number field, boolean below # the angle (degrees), the field there, and whether it is below every threshold
function phyllotaxis:minimum() end

---@class tunica.phyllotaxis_view_options
---@field every? number between pictures; without it, one at the end (number greater than 0; time)
---@field name? string of the pictures' folder, where a model has several views (text)
---@field plot? "divergence"|"threshold"|"field" not the apex but a plot, see phyllotaxis:plot (one of 'divergence', 'threshold', 'field')
---@field lines? any[] straight lines through the plot (list of items, each a number or table)
---@field colour? "age"|"size"|"value"|"field"|"plain" what primordia are coloured by; 'field': the surface, or the ring, by inhibition (one of 'age', 'size', 'value', 'field', 'plain'; "age" if not given)
---@field from? "top"|"oblique"|"side" where it is seen from (one of 'top', 'oblique', 'side'; "top" if not given)
---@field turn? number of the apex about its axis (number; degrees; 0 if not given)
---@field zoom? number 1: all is in the picture (number 1000 or less and greater than 0; 1 if not given)
---@field reach? number how much of the profile is shown; by default as far as there are primordia (number greater than 0; length)
---@field parastichies? boolean|integer[] curves through primordia n, n + m, n + 2m ...: true for the contact pair, or { m, n } (true or false or list of 2 items, each a whole number)
---@field lattice? boolean|"angles"|"arc"|"log" unrolled, angle across; upright 'angles' (or true): so that angles and circles are kept, 'arc': the length along the profile, 'log': the logarithm of the radius (true or false, or one of 'angles', 'arc', 'log')
---@field arrows? boolean on the ring's minima, as long as they are deep; the one taken is black (true or false)
---@field labels? boolean the primordia's numbers (true or false)
---@field palette? "cividis"|"cyclic"|"diverging"|"greens"|"greys"|"inferno"|"magma"|"viridis"|string[] colour map, by name or as a list of colours that it runs through (one of 'cividis', 'cyclic', 'diverging', 'greens', 'greys', 'inferno', 'magma', 'viridis' or list of items, each text)
---@field range? number[] values at the ends of the colour map, { low, high } (list of 1 to 2 items, each a number)
---@field legend? string|boolean title of the colour bar; false: no legend (text, or true or false; true if not given)
---@field title? string|function|boolean text above the picture, or a function(t) that returns it (text or function, or true or false)
---@field size? number|number[] pixels, { width, height } or one number for both (number from 16 to 16384 or list of 2 items, each a number)
---@field background? string colour of the ground (text)
---@field transparent? boolean no ground (true or false)
---@field surface? string colour of the apex (text)
---@field plain? string colour of primordia with colour = 'plain' (text)

---How the model is to be shown: the apex with its primordia, unrolled, or as a plot. A run writes a picture every so often, and one at its end.
---
---Source: thesis figs. 4.2, 4.6, 4.9, 4.12
---@param options? tunica.phyllotaxis_view_options
function phyllotaxis:view(options) end

---@class tunica.phyllotaxis_picture_options
---@field file? string path that ends in .png; replaced if it is there (text; needed)
---@field [1]? string the same
---@field colour? "age"|"size"|"value"|"field"|"plain" what primordia are coloured by; 'field': the surface, or the ring, by inhibition (one of 'age', 'size', 'value', 'field', 'plain'; "age" if not given)
---@field from? "top"|"oblique"|"side" where it is seen from (one of 'top', 'oblique', 'side'; "top" if not given)
---@field turn? number of the apex about its axis (number; degrees; 0 if not given)
---@field zoom? number 1: all is in the picture (number 1000 or less and greater than 0; 1 if not given)
---@field reach? number how much of the profile is shown; by default as far as there are primordia (number greater than 0; length)
---@field parastichies? boolean|integer[] curves through primordia n, n + m, n + 2m ...: true for the contact pair, or { m, n } (true or false or list of 2 items, each a whole number)
---@field lattice? boolean|"angles"|"arc"|"log" unrolled, angle across; upright 'angles' (or true): so that angles and circles are kept, 'arc': the length along the profile, 'log': the logarithm of the radius (true or false, or one of 'angles', 'arc', 'log')
---@field arrows? boolean on the ring's minima, as long as they are deep; the one taken is black (true or false)
---@field labels? boolean the primordia's numbers (true or false)
---@field palette? "cividis"|"cyclic"|"diverging"|"greens"|"greys"|"inferno"|"magma"|"viridis"|string[] colour map, by name or as a list of colours that it runs through (one of 'cividis', 'cyclic', 'diverging', 'greens', 'greys', 'inferno', 'magma', 'viridis' or list of items, each text)
---@field range? number[] values at the ends of the colour map, { low, high } (list of 1 to 2 items, each a number)
---@field legend? string|boolean title of the colour bar; false: no legend (text, or true or false; true if not given)
---@field title? string|function|boolean text above the picture, or a function(t) that returns it (text or function, or true or false)
---@field size? number|number[] pixels, { width, height } or one number for both (number from 16 to 16384 or list of 2 items, each a number)
---@field background? string colour of the ground (text)
---@field transparent? boolean no ground (true or false)
---@field surface? string colour of the apex (text)
---@field plain? string colour of primordia with colour = 'plain' (text)

---Writes a picture of the apex as it is now.
---
---Source: thesis figs. 4.2, 4.6, 4.9, 4.12
---@param options? tunica.phyllotaxis_picture_options|string
---@return string # the path
function phyllotaxis:picture(options) end

---@class tunica.phyllotaxis_plot_options
---@field file? string|string[] path that ends in .png or .svg, or a list of such; replaced if they are there (text or list of 1 to 10 items, each text; needed)
---@field [1]? string|string[] the same
---@field show? "divergence"|"threshold"|"field" the divergence angle of each primordium; 'threshold': against the first inhibitor's threshold when it was born (what a function of time says of that time now), as transitions are shown; 'field': that inhibitor's field around the ring (one of 'divergence', 'threshold', 'field'; "divergence" if not given)
---@field lines? any[] straight lines through the plot, as in tunica.plot: { 137.5 } (list of items, each a number or table)
---@field title? string above the plot (text)
---@field yrange? number[] { low, high } (list of 2 items, each a number)

---Plots the model's primordia or its field as they are now.
---
---Source: thesis figs. 4.2, 4.4
---@param options? tunica.phyllotaxis_plot_options|string|string[]
---@return string|string[] # the path, or paths
function phyllotaxis:plot(options) end

---A curve in the plane
---@class tunica.contour
local contour = {}

---A point of the contour and the direction of the curve there.
---@param u number place along the curve by its parameter, 0 to 1 (which is not arc length) (number from 0 to 1; needed)
---@return number x, number y, number tangent_x, number tangent_y # x, y, and the unit tangent's x, y
function contour:at(u) end

---The length of the contour, to 1e-12 of it.
---@return number # a number
function contour:length() end

---The point of the contour at an arc length, to 1e-10 of its length.
---@param s number arc length from the start, to the contour's length; of a closed contour any, which goes round (number; length; needed)
---@return number x, number y # x, y
function contour:along(s) end

---The direction of the contour at an arc length, a unit vector; at a corner that of what follows.
---@param s number arc length from the start, to the contour's length; of a closed contour any, which goes round (number; length; needed)
---@return number x, number y # x, y
function contour:tangent(s) end

---The place of the contour nearest to a point, the first of several; its distance is the least to 1e-10 of the length.
---@param x number of the point (number from -1e+100 to 1e+100; needed)
---@param y number of the point (number from -1e+100 to 1e+100; needed)
---@return number arc, number x, number y # its arc length, x, y
function contour:closest(x, y) end

---The area within the contour, positive if it runs counter-clockwise; one that is not closed is closed by a straight line from its end to its start. Exact.
---@return number # a number
function contour:area() end

---What the contour was drawn from.
---@return table # a list of { x, y }, the degree, and 'open', 'clamped' or 'closed'
function contour:points() end

---The contour in another size.
---@param factor number all lengths are multiplied by it (number 1000000000000 or less and greater than 0; needed)
---@return tunica.contour # a contour
function contour:scaled(factor) end

---The contour run through the other way: a profile must start at the tip.
---@return tunica.contour # a contour
function contour:reversed() end

---The points as text, as tunica.contour reads them: to stand in a parameter or on the command line.
---@return string # a text
function contour:text() end

---Writes the contour as a file of L-Studio (.con). Such files hold cubic curves: straight lines and single arcs of lower degree become the cubic that is the same.
---@param file string its path (text; needed)
function contour:save(file) end

---A function drawn as a curve
---@class tunica.curve
local curve = {}

---The slope of the curve at x, from the right; 0 outside.
---@param x number place (number; needed)
---@return number # a number
function curve:derivative(x) end

---The integral of the curve between two places, exact.
---@param from number start (number; needed)
---@param to number end (number; needed)
---@return number # a number
function curve:integral(from, to) end

---What the curve was drawn from.
---@return table # a list of { x, y }, the degree, and the name
function curve:points() end

---The points as text, as tunica.curve reads them: to stand in a parameter or on the command line.
---@return string # a text
function curve:text() end

---Writes the curve as a file of L-Studio (.func).
---@param file string its path (text; needed)
function curve:save(file) end

---A surface of revolution that grows
---@class tunica.apex
local apex = {}

---The point of the surface at a place.
---
---Source: thesis (3.1)
---@param theta number angle around the axis (number; degrees; needed)
---@param a number arc length from the tip (number from 0 to 1000000000000; length; needed)
---@return number x, number y, number z # x, y, z
function apex:position(theta, a) end

---The outward unit normal at a place.
---@param theta number angle around the axis (number; degrees; needed)
---@param a number arc length from the tip (number from 0 to 1000000000000; length; needed)
---@return number x, number y, number z # x, y, z
function apex:normal(theta, a) end

---The place on the surface nearest to a point in space. On the axis theta is 0.
---
---Source: thesis 10.2
---@param x number of the point (number; needed)
---@param y number of the point (number; needed)
---@param z number of the point (number; needed)
---@return number theta, number a # theta, a
function apex:closest(x, y, z) end

---The profile at an arc length: distance from the axis and height.
---@param a number arc length from the tip (number from 0 to 1000000000000; length; needed)
---@return number x, number y, number tangent_x, number tangent_y # x, y, and the unit tangent's x, y
function apex:profile(a) end

---The length of the profile as drawn, its largest radius, and the radius of the hole at the tip (0: none).
---@return number, number, number # three numbers
function apex:measures() end

---The speed at which a point moves away from the tip: the integral of the growth rate.
---@param a number arc length from the tip (number from 0 to 1000000000000; length; needed)
---@return number # a number
function apex:speed(a) end

---The relative elemental growth rate at a place.
---@param a number arc length from the tip (number from 0 to 1000000000000; length; needed)
---@return number # a number
function apex:growth(a) end

---The area of the surface from the tip to an arc length.
---@param a number arc length from the tip (number from 0 to 1000000000000; length; needed)
---@return number # a number
function apex:area(a) end

---The first arc length at which the profile is this far from the axis.
---@param radius number distance from the axis (number 0 or more; length; needed)
---@return number # a number
function apex:arc_at_radius(radius) end

---Where along the profile a point is after some time; before it, if the time is negative.
---@param a number arc length from the tip (number from 0 to 1000000000000; length; needed)
---@param dt number time (number; time; needed)
---@return number # a number
function apex:after(a, dt) end

---A surface given by functions
---@class tunica.surface
local surface = {}

---The point of the surface closest to a point.
---
---Source: thesis 10.2
---@param x number coordinate of a point in space (number; needed)
---@param y number coordinate of a point in space (number; needed)
---@param z number coordinate of a point in space (number; needed)
---@return number x, number y, number z # x, y, z
function surface:closest(x, y, z) end

---The direction outward where the surface is closest to a point.
---@param x number coordinate of a point (number; needed)
---@param y number coordinate of a point (number; needed)
---@param z number coordinate of a point (number; needed)
---@return number x, number y, number z # x, y, z, of length 1
function surface:normal(x, y, z) end

---Where a point of the surface will be.
---
---Source: thesis 10.2
---@param x number coordinate of a point of the surface (number; needed)
---@param y number coordinate of a point of the surface (number; needed)
---@param z number coordinate of a point of the surface (number; needed)
---@param dt number how long it grows (number; time; needed)
---@param from? number the time at the start (number; time; 0 if not given)
---@return number x, number y, number z # x, y, z
function surface:advance(x, y, z, dt, from) end

---A surface with primordia
---@class tunica.bulges
local bulges = {}

---@class tunica.bulges_add_options
---@field theta? number angle of its centre on an apex (number; degrees)
---@field [1]? number the same
---@field a? number arc length of its centre from the tip of the apex (number 0 or more; length)
---@field [2]? number the same
---@field birth? number when it is born; now, if left out (number; time)
---@field [3]? number the same
---@field place? number[] instead of theta and a: a point { x, y, z } of any surface (point or direction { x, y } or { x, y, z })

---Adds a primordium.
---
---Source: thesis 5.5
---@param options? tunica.bulges_add_options|number
function bulges:add(options) end

---The time of the surface; or sets it.
---@param t? number the new time; left out: it stays (number; time)
---@return number # a number
function bulges:time(t) end

---The primordia that are there now: number in the order of adding, top, radius, height and age.
---@return table # a list of tables { which =, x =, y =, z =, radius =, height =, age = }
function bulges:list() end

---The primordium in which a point of the surface lies most deeply. Distances are on the surface without primordia.
---
---Source: thesis (5.10), (5.11)
---@param x number coordinate of a point of the surface (number; needed)
---@param y number coordinate of a point of the surface (number; needed)
---@param z number coordinate of a point of the surface (number; needed)
---@return number # the number of the primordium, distance from its centre / radius; nothing outside all
function bulges:within(x, y, z) end

---@class tunica
local tunica = {}

---1 where x > y, else 0.
---@param x any number or value of a rule
---@param y any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.above(x, y) end

---The absolute value.
---@param x any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.abs(x) end

---@class tunica.allowable_interval_options
---@field m? integer of the parastichy pair (whole number from 1 to 1000000; needed)
---@field [1]? integer the same
---@field n? integer of the parastichy pair (whole number from 1 to 1000000; needed)
---@field [2]? integer the same
---@field angle? number that must be in it; the limit of the pair's sequence if left out (number from 0 to 360; degrees)
---@field jugacy? integer greatest common divisor of m and n, from which it is taken (whole number from 1 to 1000000)

---The divergence angles at which two families of parastichies can be visible and opposed.
---
---Source: thesis 4.3
---@param options? tunica.allowable_interval_options|integer
---@return number? least, number? greatest # the least and the greatest angle; nil if the pair is not visible and opposed at `angle`
function tunica.allowable_interval(options) end

---@class tunica.apex_options
---@field profile? tunica.contour|string|any[] the curve that turns around the y axis, from the tip down: a contour, its name or file, or points; 'dome' if left out (contour, or text or list of items)
---@field cap? number[] instead of a profile: { radius, slope }, a part of a sphere down to where it falls by `slope` degrees, and from there a straight flank; its length, if it matters, is the third (30 radii if left out) (list of 2 to 3 items, each a number)
---@field growth? number|tunica.curve|string|any[] relative elemental growth rate along the profile, by arc length from the tip: a number, a curve, its name or file, or points (number or curve, or text or list of items; 1 / time; 1 if not given)

---A growing surface of revolution with its tip at the top. A point of it is (theta, a): the angle in degrees and the arc length from the tip. With growth it moves away from the tip at the speed v(a), the integral of the rate from 0 to a; theta stays, and so does the form of the surface. Beyond its end the profile goes straight on. An apex never changes.
---
---Source: thesis 3.3, equations 3.1 and 3.2
---@param options? tunica.apex_options
---@return tunica.apex # an apex
function tunica.apex(options) end

---@class tunica.apex_tissue_options
---@field on? tunica.surface the apex (surface (tunica.apex, tunica.bulges or tunica.surface); needed)
---@field to? number arc length from the tip up to which the cells cover it (number 1000000000000 or less and greater than 0; length)
---@field cells? integer instead: the number of cells (whole number from 1 to 1000000)
---@field max_area? number area at which a cell divides; the mean comes to about 0.7 of it (number 1000000000000 or less and greater than 0; area; 0.01 if not given)
---@field variation? number of that area from cell to cell, relative (number 0 or more and less than 1; 0.3 if not given)
---@field growth? number relative growth of areas between two divisions, at most, where growth is fastest (number 1 or less and greater than 0; 0.02 if not given)
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---The cells of an apex, grown from one octagon at its tip by the growth of the apex and by division.
---
---Source: thesis 3.3, 3.4, figs 3.6, 3.7
---@param options? tunica.apex_tissue_options
---@return tunica.tissue # a tissue
function tunica.apex_tissue(options) end

---1 where x >= y, else 0.
---@param x any number or value of a rule
---@param y any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.at_least(x, y) end

---1 where x <= y, else 0.
---@param x any number or value of a rule
---@param y any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.at_most(x, y) end

---1 where x < y, else 0.
---@param x any number or value of a rule
---@param y any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.below(x, y) end

---@class tunica.bulges_options
---@field on? tunica.surface the surface without primordia, as tunica.apex (surface (tunica.apex, tunica.bulges or tunica.surface); needed)
---@field radius? any of a primordium: a number, or a curve or function of its age
---@field height? any of a primordium, likewise

---A surface out of which primordia bulge. Each is carried along by the growth of the surface below; points nearer to its centre than its radius r are lifted along the normal by height (1 - (d/r)^2)^2. Where some overlap the highest counts, smoothly. The surface has a time, which tissue:grow { on = surface } moves on. A checkpoint holds its primordia if it is a local of the script that functions of the model use.
---
---Source: thesis 5.5, fig. 5.8
---@param options? tunica.bulges_options
---@return tunica.surface # a surface
function tunica.bulges(options) end

---x kept between low and high.
---@param x any number or value of a rule
---@param low any least value
---@param high any greatest value
---@return number # a number, or a value of the rule
function tunica.clamp(x, low, high) end

---A curve in the plane, drawn as a B-spline: the profile of an apex, the outline of a leaf. A clamped one starts in its first point and ends in its last; an open one does so where these are given three times. A contour never changes.
---
---Source: thesis 3.3
---@param points any[]|string control points { { x, y }, ... }, with degree = (3, or what the points allow), ends = 'clamped' (default), 'open' or 'closed', name = ; or the name of a shipped contour, a file of L-Studio (.con) relative to the script, or points as text: '0,1 1,1 1,-3 degree=2' (list of items, or text; needed)
---@param item? string which of the curves of a gallery (.fset, .tset, .cset) (text)
---@return tunica.contour # a contour
function tunica.contour(points, item) end

---The cosine of an angle in radians.
---@param x any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.cos(x) end

---A function of one variable, drawn as a clamped B-spline, as growth along a profile or a threshold in time. Outside its points the values of its ends hold. A curve never changes. In rules and fields those of degree 1 are traced.
---
---Source: thesis 3.3
---@param points any[]|string points { { x, y }, ... } whose x never decreases, with degree = (3, or what the points allow; 1: straight from point to point), name = ; or the name of a shipped curve, a file of L-Studio (.func) relative to the script, or points as text: '0,0.3 0.5,1 2,1' (list of items, or text; needed)
---@param item? string which of the curves of a gallery (.fset, .tset, .cset) (text)
---@return tunica.curve # a curve; f(x) is its value
function tunica.curve(points, item) end

---@class tunica.cylinder_options
---@field around? integer cells in a ring (whole number from 3 to 4000000; needed)
---@field [1]? integer the same
---@field rows? integer number of rings (whole number from 1 to 4000000; needed)
---@field [2]? integer the same
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---Rings of cells, one below the other; row 0 is the tip. tissue:insert_row adds rings. The tissue has neighbours and walls but no geometry.
---
---Source: thesis 5.4, fig. 3.4
---@param options? tunica.cylinder_options|integer
---@return tunica.tissue # a tissue
function tunica.cylinder(options) end

---1 where x equals y, else 0.
---@param x any number or value of a rule
---@param y any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.equal(x, y) end

---The exponential function.
---@param x any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.exp(x) end

---@class tunica.grid_options
---@field columns? integer cells in x (whole number from 1 to 4000000; needed)
---@field [1]? integer the same
---@field rows? integer cells in y (whole number from 1 to 4000000; needed)
---@field [2]? integer the same
---@field wrap? boolean|"none"|"x"|"both" 'x' joins the first column with the last, 'both' (or true) the first row with the last, too (true or false, or one of 'none', 'x', 'both'; false if not given)
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---A rectangular grid of cells, each with up to four neighbours. The tissue has neighbours and walls but no geometry.
---
---Source: thesis fig. 5.4
---@param options? tunica.grid_options|integer
---@return tunica.tissue # a tissue
function tunica.grid(options) end

---@class tunica.hexagon_disk_options
---@field radius? integer rings of cells around the one in the middle (whole number from 0 to 1000; needed)
---@field [1]? integer the same
---@field area? number of each cell (number 1000000000000 or less and greater than 0; area; 1 if not given)
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---A hexagon of regular hexagons.
---@param options? tunica.hexagon_disk_options|integer
---@return tunica.tissue # a tissue
function tunica.hexagon_disk(options) end

---@class tunica.hexagons_options
---@field columns? integer cells in x (whole number from 1 to 4000000; needed)
---@field [1]? integer the same
---@field rows? integer cells in y (whole number from 1 to 4000000; needed)
---@field [2]? integer the same
---@field area? number of each cell (number 1000000000000 or less and greater than 0; area; 1 if not given)
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---A sheet of regular hexagons, every second row set off by half a cell.
---@param options? tunica.hexagons_options|integer
---@return tunica.tissue # a tissue
function tunica.hexagons(options) end

---Saturation x^n / (half^n + x^n), for x >= 0.
---@param x any number or value of a rule
---@param half any x at which the value is 1/2
---@param n? any steepness
---@return number # a number, or a value of the rule
function tunica.hill(x, half, n) end

---@class tunica.line_options
---@field cells? integer number of cells (whole number from 1 to 4000000; needed)
---@field [1]? integer the same
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---A row of cells. The tissue has neighbours and walls but no geometry.
---
---Source: thesis fig. 5.2
---@param options? tunica.line_options|integer
---@return tunica.tissue # a tissue
function tunica.line(options) end

---@class tunica.load_options
---@field file? string path of a cell mesh of MorphoGraphX (text; needed)
---@field [1]? string the same
---@field walls? "straight"|"traced" 'straight' between junctions, or 'traced' with every point of the mesh (one of 'straight', 'traced'; "straight" if not given)
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---A tissue from a file: a cell mesh as MorphoGraphX writes it (PLY). The cells have a column `label`.
---@param options? tunica.load_options|string
---@return tunica.tissue # a tissue
function tunica.load(options) end

---The natural logarithm.
---@param x any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.log(x) end

---The greatest of its arguments (up to eight).
---@param x any number or value of a rule
---@param x2? any another
---@param x3? any another
---@param x4? any another
---@param x5? any another
---@param x6? any another
---@param x7? any another
---@param x8? any another
---@return number # a number, or a value of the rule
function tunica.max(x, x2, x3, x4, x5, x6, x7, x8) end

---The least of its arguments (up to eight).
---@param x any number or value of a rule
---@param x2? any another
---@param x3? any another
---@param x4? any another
---@param x5? any another
---@param x6? any another
---@param x7? any another
---@param x8? any another
---@return number # a number, or a value of the rule
function tunica.min(x, x2, x3, x4, x5, x6, x7, x8) end

---@class tunica.model_options
---@field tissue? tunica.tissue the tissue (tissue; needed)
---@field params? any the table that tunica.params gave
---@field dt? number step; of adaptive methods the longest, and may be left out. rkc2 with dt and no tolerance takes fixed steps (number greater than 0; time)
---@field method? "euler"|"sts"|"heun"|"rk4"|"bs32"|"dp54"|"rkc2"|"backward_euler"|"crank_nicolson"|"bicg"|"bdf"|"auto" method of integration (euler: forward Euler, order 1; sts: super-time-stepping, five unequal Euler steps, for diffusion, order 1; heun: explicit trapezoid (Heun), order 2; rk4: classical Runge-Kutta, order 4; bs32: Bogacki-Shampine 3(2), order 3, adaptive; dp54: Dormand-Prince 5(4), order 5, adaptive; rkc2: Runge-Kutta-Chebyshev, for diffusion, order 2, adaptive; backward_euler: backward Euler, modified Newton, order 1; crank_nicolson: Crank-Nicolson, modified Newton, order 2; bicg: Crank-Nicolson, Newton with biconjugate gradients, order 2; bdf: backward differentiation formulas (CVODE), order 5, adaptive; auto: what costs least, tried on the way, order 0, adaptive); if not given, euler where dt is given, else auto (one of 'euler', 'sts', 'heun', 'rk4', 'bs32', 'dp54', 'rkc2', 'backward_euler', 'crank_nicolson', 'bicg', 'bdf', 'auto')
---@field tolerance? number adaptive methods: error allowed in one step, relative to each value and its column's root mean square; 1e-6 if not given (number 1 or less and greater than 0)
---@field threads? integer threads for tissues of 5,000 cells and more; the result does not depend on it (whole number from 1 to 64; 1 if not given)
---@field stop? number when a batch run ends, unless --until says so (number 0 or more; time)
---@field signed? string[] columns that may become negative (list of items, each text; {} if not given)

---A model of a tissue: to be given rules (derive, rate, flux), events (every, at, when), views and a report.
---@param options? tunica.model_options
---@return tunica.model # a model
function tunica.model(options) end

---A normally distributed random number, by the seed of the run. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param mean? number mean (number; 0 if not given)
---@param deviation? number standard deviation (number 0 or more; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function tunica.normal(mean, deviation, purpose, draw) end

---@class tunica.page_options
---@field pictures? string[] paths of PNG files, or their bytes, row by row (list of 1 to 10000 items, each text; needed)
---@field [1]? string[] the same
---@field file? string path that ends in .png; replaced if it is there (text; needed)
---@field captions? string[] words below each picture (list of items, each text)
---@field columns? integer pictures in a row; by default as many as there are rows (whole number from 1 to 10000)
---@field title? string above all (text)
---@field gap? integer between pictures (whole number from 0 to 1000; pixels; 12 if not given)
---@field font? number size of the captions' letters (number 1000 or less and greater than 0; pixels)
---@field background? string colour of the page (text; "white" if not given)

---Puts many pictures on one page, as a PNG file.
---
---Source: thesis fig. 4.12
---@param options? tunica.page_options|string[]
---@return string # the path
function tunica.page(options) end

---@class tunica.params_options
---@field [string] any 

---The parameters of the model with their defaults. On the command line, name=value changes one. A parameter is given by its default, or with its meaning and limits: D = { 1.0, "diffusion", unit = "um2/s", min = 0 }. With variants = { name = { parameter = value, ... }, ... } the parameter `variant` chooses one, whose values become the defaults.
---@param options? tunica.params_options
---@return tunica.parameters # the parameters; P.name reads one
function tunica.params(options) end

---Reads a phyllotactic pattern: name and the evidence for it, divergence angles as they come and re-ordered along the generative spiral, jugacy, contact pair, allowable interval, plastochrons. With `expected`, field judgement says whether the rules of thesis tables 4.1 (hold) and 4.2 (lenient, strict) are met.
---
---Source: thesis 4.3, tables 4.1 and 4.2
---@param list any[] primordia, oldest first: angles, or tables { angle =, time =, radius = | x =, y =, z =, left =, right = }; the axis is y, places are all of one moment; left and right: numbers of the older ones that were nearest when it arose (list of items; needed)
---@param options? table { jugacy = (found if left out), first =, last = (numbers of primordia), expected = { angle =, jugacy =, pair = { m, n } } } (table)
---@return table # a table that prints as its description
function tunica.pattern(list, options) end

---@class tunica.phyllotaxis_options
---@field path? function function(age) that returns x, y: distance from the axis and height of what was on the ring so long ago; instead of an apex (function)
---@field apex? tunica.apex the growing surface (tunica.apex) (apex)
---@field radius? number of the ring on the apex (number greater than 0; length)
---@field arc? number arc length from the tip to the ring, instead of its radius (number from 0 to 1000000000000; length)
---@field samples? integer places on the ring where fields are evaluated (whole number from 3 to 100000; 360 if not given)
---@field jugacy? integer so many primordia at once, evenly spaced; must divide samples. Not 1: imposed, thresholds then are compared with the mean over the places (whole number from 1 to 1000; 1 if not given)
---@field params? any the table that tunica.params gave
---@field jitter? table { angle = degrees, along = length }: standard deviations of the places of samples; drawn anew after each insertion (table)
---@field tie? number fields nearer than this (relative) are equal, and one is drawn (number from 0 to 1; 1e-09 if not given)
---@field tolerance? number of the time of an insertion, relative to the plastochron (number 1 or less and greater than 0; 0.001 if not given)
---@field dt? number longest interval that is searched at once; by default half a plastochron (number greater than 0; time)
---@field located? boolean false: fixed steps of dt, insertions at their ends; to compare with (true or false; true if not given)
---@field drop? number old primordia are left out while their share in the fields is below this part of the threshold, now and later (number 0 or more and less than 1; 1e-09 if not given)
---@field most? integer and beyond so many, with a warning (whole number from 10 to 1000000; 5000 if not given)
---@field stop? number|table when a batch run ends: a time, or { primordia = n } (number or table)

---A model of phyllotaxis by inhibition: a ring on a growing apex on which primordia are born. To be given model:inhibition, a start (model:initial, model:primordium), events, views and a report.
---
---Source: thesis 4
---@param options? tunica.phyllotaxis_options
---@return tunica.phyllotaxis # a model of phyllotaxis
function tunica.phyllotaxis(options) end

---@class tunica.plot_options
---@field file? string|string[] path that ends in .png or .svg, or a list of such; replaced if they are there (text or list of 1 to 10 items, each text; needed)
---@field [1]? string|string[] the same
---@field y? number[] values (list of items, each a number)
---@field x? number[] where they belong; by default 1, 2, 3 ... (list of items, each a number)
---@field series? table[] several rows of values, each { x =, y =, title =, style =, colour = } (list of items, each a table)
---@field style? "points"|"lines"|"both"|"steps"|"impulses" how values are shown (one of 'points', 'lines', 'both', 'steps', 'impulses'; "points" if not given)
---@field lines? any[] straight lines through the plot: a number (its height), or { y = or x =, text = } (list of items, each a number or table)
---@field title? string above the plot (text)
---@field xlabel? string below it (text)
---@field ylabel? string at its left (text)
---@field xrange? number[] { low, high } (list of 2 items, each a number)
---@field yrange? number[] { low, high } (list of 2 items, each a number)
---@field log? "x"|"y"|"xy" axes with logarithmic scale (one of 'x', 'y', 'xy')
---@field size? integer[] pixels, { width, height }; by default 900, 560 (list of 2 items, each a whole number)

---Plots numbers against numbers, by gnuplot. For divergence angles against the number of the primordium, a pattern against a threshold, a field around the ring.
---@param options? tunica.plot_options|string|string[]
---@return string|string[] # the path, or paths
function tunica.plot(options) end

---@class tunica.polygon_options
---@field sides? integer number of sides (whole number from 3 to 10000; 6 if not given)
---@field [1]? integer the same
---@field area? number of each cell (number 1000000000000 or less and greater than 0; area; 1 if not given)
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---One cell, a regular polygon around the origin, to grow a tissue from.
---@param options? tunica.polygon_options|integer
---@return tunica.tissue # a tissue
function tunica.polygon(options) end

---A tissue from given polygons. Polygons that share two corners share a wall.
---@param cells any[] polygons, each a list of corners { x, y } or { x, y, z } (list of 1 or more items, each a list of items; needed)
---@param tolerance? number corners nearer to each other than this are one junction (number 0 or more; length; 1e-09 if not given)
---@param seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)
---@return tunica.tissue # a tissue
function tunica.polygons(cells, tolerance, seed) end

---x to the power of y; the same as x ^ y.
---@param x any number or value of a rule
---@param y any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.pow(x, y) end

---@class tunica.read_primordia_options
---@field file? string a text file of values separated by commas, semicolons or tabs; its first line names the columns: angle or divergence (degrees), time, radius, x, y, z; others are ignored (text; needed)
---@field [1]? string the same

---Measured primordia from a file, oldest first. Without angles, the divergences are added up, or x and z give the angle.
---@param options? tunica.read_primordia_options|string
---@return table # a list for tunica.pattern
function tunica.read_primordia(options) end

---@class tunica.ring_options
---@field cells? integer number of cells (whole number from 3 to 4000000; needed)
---@field [1]? integer the same
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---A closed row of cells. The tissue has neighbours and walls but no geometry.
---
---Source: thesis figs 5.2, 5.3
---@param options? tunica.ring_options|integer
---@return tunica.tissue # a tissue
function tunica.ring(options) end

---@class tunica.sequence_options
---@field m? integer of the parastichy pair (whole number from 1 to 1000000; needed)
---@field [1]? integer the same
---@field n? integer of the parastichy pair (whole number from 1 to 1000000; needed)
---@field [2]? integer the same
---@field jugacy? integer greatest common divisor of m and n, from which it is taken (whole number from 1 to 1000000)
---@field count? integer number of terms (whole number from 1 to 50; 10 if not given)

---The sequence that holds two parastichy numbers as neighbours, from its start, and the divergence angle it converges to.
---@param options? tunica.sequence_options|integer
---@return table # a list of terms, with name, limit (degrees) and jugacy
function tunica.sequence(options) end

---@class tunica.sheet_options
---@field cells? integer number of cells (whole number from 1 to 4000000; needed)
---@field [1]? integer the same
---@field max_area? number area at which a cell divides; the mean comes to about 0.7 of it (number 1000000000000 or less and greater than 0; area; 0.75 if not given)
---@field variation? number of that area from cell to cell, relative (number 0 or more and less than 1; 0.2 if not given)
---@field growth? number relative growth of all areas between two divisions (number 1 or less and greater than 0; 0.02 if not given)
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---A sheet of cells grown from one octagon by growth and division, as irregular as living tissue.
---
---Source: thesis 3.4
---@param options? tunica.sheet_options|integer
---@return tunica.tissue # a tissue
function tunica.sheet(options) end

---The sine of an angle in radians.
---@param x any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.sin(x) end

---The square root.
---@param x any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.sqrt(x) end

---@class tunica.squares_options
---@field columns? integer cells in x (whole number from 1 to 4000000; needed)
---@field [1]? integer the same
---@field rows? integer cells in y (whole number from 1 to 4000000; needed)
---@field [2]? integer the same
---@field seed? integer of the tissue's random numbers; the seed of the run if left out (whole number from 0 to 9007199254740992)

---A sheet of unit squares.
---@param options? tunica.squares_options|integer
---@return tunica.tissue # a tissue
function tunica.squares(options) end

---1 where x >= 0, else 0.
---@param x any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.step(x) end

---@class tunica.surface_options
---@field advance? function function(x, y, z, t, dt) that returns where a point of the surface will be: x, y, z (function; needed)
---@field closest? function function(x, y, z) that returns the point of the surface closest to a point in space (function; needed)
---@field normal? function function(x, y, z) that returns the direction outward there; without it, cells keep facing where they do (function)

---A growing surface by its two operations. It serves wherever the built-in ones do: tissue:grow { on = surface }, tissue:divide { ..., on = surface }.
---
---Source: thesis 10.2
---@param options? tunica.surface_options
---@return tunica.surface # a surface
function tunica.surface(options) end

---The hyperbolic tangent.
---@param x any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.tanh(x) end

---A random number from `low` to `high`, by the seed of the run. The number depends on nothing but the seed and these arguments: the same call gives the same number, in whatever order and however often cells are visited. Count `draw` up for fresh ones.
---@param low? number lower limit (number; 0 if not given)
---@param high? number upper limit (number; 1 if not given)
---@param purpose? string what the number is for: others get others (text; "" if not given)
---@param draw? integer which number of many for this purpose, such as the step (whole number from 0 to 4294967295; 0 if not given)
---@return number # a number
function tunica.uniform(low, high, purpose, draw) end

---x where the condition holds, else y. Both are computed; join conditions with * (and), max (or).
---@param condition any not 0 for yes
---@param x any number or value of a rule
---@param y any number or value of a rule
---@return number # a number, or a value of the rule
function tunica.where(condition, x, y) end

return tunica
