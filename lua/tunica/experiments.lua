-- SPDX-License-Identifier: MIT
--- What an experimenter does to a tissue while a model runs: cells near a place are found, to be removed or changed, and
-- substances are applied to them.

local core = require "tunica.core"
local registry = require "tunica.registry"
local surfaces = require "tunica.surfaces"
local models = require "tunica.model"
local op, fail = registry.op, registry.fail

local setup = [[
local tunica = require "tunica"
local apex = tunica.apex { profile = "dome" }
local tissue = tunica.apex_tissue { on = apex, cells = 40 }
]]

--- The point that is meant: { x, y, z }, or theta and a on an apex.
local function place_of(t)
  if t.place and not t.theta and not t.a then return t.place[1], t.place[2], t.place[3] or 0 end
  if t.place or not (t.theta and t.a and t.on) then
    fail("tissue:near: give place = { x, y, z }, or on = apex with theta and a")
  end
  local surface = t.on
  if not core.is_on_apex(surfaces.core_of(surface)) then fail("tissue:near: theta and a are places of an apex; give place = { x, y, z }") end
  local apex = surfaces.apex_below(surface)
  local x, y, z = apex:position(t.theta, t.a)
  if surface == apex then return x, y, z end
  return surface:closest(x, y, z)
end

op { name = "tissue:near", kind = "named", returns = "a list of cells, the nearest first", source = "thesis 5.5.3",
  args = {
    { name = "place", type = "vector", position = 1, doc = "a point { x, y } or { x, y, z }" },
    { name = "radius", type = "number", min = 0, position = 2, unit = "length", doc = "cells whose centroid is so near" },
    { name = "count", type = "integer", min = 1, doc = "at most so many; without a radius the nearest ones" },
    { name = "on", type = "surface", doc = "instead of a point: an apex, with" },
    { name = "theta", type = "number", unit = "degrees", doc = "angle around its axis, and" },
    { name = "a", type = "number", min = 0, unit = "length", doc = "arc length from its tip" },
  },
  doc = "The cells near a place: to be removed (ablation: for _, c in ipairs(tissue:near { ... }) do c:remove() end), to be given a " ..
    "value, or for model:supply. Distances are those in space. No cell within the radius is refused: the place may be off " ..
    "the tissue. With a count alone it is the nearest ones, however far they are.",
  fn = function(self, t)
    if t.place and t.on then fail("tissue:near: give place = { x, y, z }, or on = apex with theta and a, not both") end
    if not self.has_geometry then fail("tissue:near: the cells of this tissue have no places: it has no geometry") end
    if not t.radius and not t.count then fail("tissue:near: how near? give a radius, or the count of cells") end
    local x, y, z = place_of(t)
    local found = {}
    for c in self:cells() do
      local d = math.sqrt((c.x - x) ^ 2 + (c.y - y) ^ 2 + (c.z - z) ^ 2)
      if not t.radius or d <= t.radius then found[#found + 1] = { d = d, cell = c } end
    end
    if #found == 0 then
      fail("tissue:near: no cell is within %.4g of (%.4g, %.4g, %.4g): the place is off the tissue, or the radius less than a cell",
        t.radius, x, y, z)
    end
    table.sort(found, function(p, q) return p.d < q.d or p.d == q.d and core.id(p.cell) < core.id(q.cell) end)
    local cells = {}
    for i = 1, math.min(#found, t.count or #found) do cells[i] = found[i].cell end
    return cells
  end,
  example = setup .. "print(#tissue:near { on = apex, theta = 0, a = 0.2, radius = 0.15 })\n" ..
    "for _, c in ipairs(tissue:near { { 0.2, 0, 0 }, count = 3 }) do c:remove() end" }

op { name = "model:supply", kind = "named", changes = true, source = "thesis 5.5.3, fig. 5.12", returns = "text: the name of the new column",
  args = {
    { name = "column", type = "string", required = true, position = 1, doc = "what is supplied: a column with a rate or flux" },
    { name = "rate", type = "number", required = true, doc = "added to its rate of change in these cells: concentration per time; " ..
      "below 0 it is taken out, and the run ends where nothing is left to be taken (unless the column is `signed`)" },
    { name = "cells", type = "list|function", required = true,
      doc = "the cells; or a function that returns them, called when the supply starts" },
    { name = "from", type = "number", min = 0, unit = "time", doc = "when it starts: now, if left out" },
    { name = "to", type = "number", min = 0, unit = "time", doc = "when it ends: never, if left out" },
  },
  doc = "Applies a substance to cells of a model, from a time on and for a time: a drop of auxin on an apex. The cells keep what " ..
    "they got as they grow and move, and so do their daughters. What is supplied now stands in a column of its own.",
  example = [[
local tunica = require "tunica"
local tissue = tunica.sheet { cells = 30, seed = 1 }
tissue:cell { auxin = 1 }
local model = tunica.model { tissue = tissue, dt = 0.01 }
model:rate(function(c, d) d.auxin = -0.1 * c.auxin end)
model:supply { "auxin", rate = 5, cells = tissue:near { { 0, 0 }, count = 3 }, from = 0, to = 1 }
model:advance(2)
print(tissue:max "auxin")]],
  fn = function(model, t)
    if models.inside[model].advancing then
      fail("model:supply cannot be called while the model runs, in an event or a condition: the rule it adds would be missing when the " ..
        "script is loaded to resume the run. Call it before, with 'from' and a function for the cells; or let the script's own rate add " ..
        "a column that the event sets")
    end
    local tissue = model.tissue
    local from, to = t.from or model.time, t.to
    if from < model.time then fail("model:supply: 'from' is %.6g, but the model is at %.6g already", from, model.time) end
    if to and to <= from then fail("model:supply: 'to' must come after 'from' (%.6g), came %.6g", from, to) end
    local known, taken = {}, {}
    for _, name in ipairs(core.columns(tissue, "cell")) do known[#known + 1], taken[name] = name, true end
    if not taken[t.column] then
      fail("model:supply: the cells have no column '%s'%s", t.column, core.did_you_mean(t.column, known))
    end
    local name, number = t.column .. "_supply", 1
    while taken[name] do number = number + 1 name = t.column .. "_supply" .. number end
    local column, marks = t.column, name .. "_place"
    local function check_cells(cells)
      if type(cells) ~= "table" or #cells == 0 then
        fail("model:supply: 'cells' must be a list of cells%s; came %s", type(t.cells) == "function" and ", returned by the function" or
          ", or a function that returns one", type(cells) == "table" and "an empty list" or core.describe(cells))
      end
      for _, c in ipairs(cells) do
        if core.kind(c) ~= "cell" then fail("model:supply: 'cells' holds %s, which is no cell", core.describe(c)) end
        if core.tissue_of(c) ~= tissue then fail("model:supply: 'cells' holds a cell of another tissue") end
        if not c.alive then
          local _, why = pcall(core.neighbours, c)
          fail("model:supply: 'cells' holds a cell that is gone: %s", (tostring(why):gsub("^[^\n]-:%d+: ", "")))
        end
      end
    end
    local later = from > model.time and type(t.cells) == "table"
    if type(t.cells) == "table" then check_cells(t.cells) end
    tissue:cell { [name] = 0 }
    if later then  -- daughters inherit the mark until it starts
      tissue:cell { [marks] = 0 }
      for _, c in ipairs(t.cells) do c[marks] = 1 end
    end
    local function start()
      if later then
        for c in tissue:cells() do
          if c[marks] > 0 then c[name] = t.rate end
        end
        return
      end
      local cells = t.cells
      if type(cells) == "function" then
        cells = cells()
        check_cells(cells)
      end
      for _, c in ipairs(cells) do c[name] = t.rate end
    end
    if from <= model.time then start() else model:at(from, start) end
    if to then
      model:at(to, function()
        for c in tissue:cells() do c[name] = 0 end
      end)
    end
    model:rate(function(c, d) d[column] = c[name] end)
    return name
  end }

return {}
