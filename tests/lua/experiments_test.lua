-- SPDX-License-Identifier: MIT
-- Cells near a place, supply of a substance, views that are plots.
local tunica = require "tunica"
local check = require "check"

-- Cells near a place
local apex = tunica.apex { cap = { 1.5, 75 }, growth = 0.2 }
local tissue = tunica.apex_tissue { on = apex, cells = 80, max_area = 0.05 }
local x, y, z = apex:position(40, 0.6)
local near = tissue:near { on = apex, theta = 40, a = 0.6, radius = 0.4 }
local function distance(c) return math.sqrt((c.x - x) ^ 2 + (c.y - y) ^ 2 + (c.z - z) ^ 2) end
local within = 0
for c in tissue:cells() do
  if distance(c) <= 0.4 then within = within + 1 end
end
check.equal(#near, within)
assert(within > 3)
for i = 2, #near do assert(distance(near[i - 1]) <= distance(near[i])) end
check.equal(#tissue:near { { x, y, z }, 0.4, count = 2 }, 2)
check.equal(tissue:near({ { x, y, z }, count = 1 })[1].id, near[1].id)
local surface = tunica.bulges { on = apex, radius = 0.3, height = 0.1 }
check.equal(#tissue:near { on = surface, theta = 40, a = 0.6, radius = 0.4 }, within)
check.fails(function() tissue:near { { 9, 9, 9 }, radius = 0.1 } end, "off the tissue")
check.fails(function() tissue:near { { 0, 0, 0 } } end, "how near")
check.fails(function() tissue:near { theta = 3, a = 1, radius = 1 } end, "give place")
check.fails(function() tissue:near { { 0, 0 }, theta = 3, radius = 1 } end, "give place")
check.fails(function() tissue:near { { 0, 0 }, on = apex, radius = 1 } end, "not both")
check.fails(function() tunica.apex { cap = { 1, 60 }, profile = "dome" } end, "not both")

-- Supply: exact for a constant rate without decay, for some time, inherited when cells divide.
local sheet = tunica.sheet { cells = 30, seed = 1 }
sheet:cell { auxin = 1 }
local model = tunica.model { tissue = sheet, dt = 0.01 }
model:rate(function(c, d) d.auxin = 0 * c.auxin end)
local cells = sheet:near { { 0, 0 }, count = 3 }
check.equal(model:supply { "auxin", rate = 5, cells = cells, from = 1, to = 3 }, "auxin_supply")
check.equal(model:supply { "auxin", rate = 2, cells = function() return { cells[1] } end }, "auxin_supply2")
model:at(2, function() cells[2]:divide() end)
model:advance(4)
check.near(cells[1].auxin, 1 + 2 * 5 + 4 * 2, 1e-9)
local supplied = 0
for c in sheet:cells() do
  if math.abs(c.auxin - 11) < 1e-9 then supplied = supplied + 1 end
end
check.equal(supplied, 3)  -- the third cell and both daughters of the second
check.fails(function() model:supply { "auxin", rate = 1, cells = tissue:near { { 0, 0, 0 }, count = 1 } } end, "another tissue")
check.fails(function() model:supply { "auxin", rate = 1, cells = function() end } end, "returned by the function; came nil")
local fourth = sheet:near({ { 2, 0 }, count = 1 })[1]
model:supply { "auxin", rate = 100, cells = { fourth }, from = 5, to = 6 }
model:at(4.5, function() fourth:divide() end)
model:advance(6.5)
local given = 0
for c in sheet:cells() do
  if c.auxin > 90 then given = given + 1 end
end
check.equal(given, 2)  -- both daughters of a cell that has divided meanwhile
check.fails(function() model:supply { "auxn", rate = 1, cells = cells } end, "did you mean 'auxin'")
check.fails(function() model:supply { "auxin", rate = 1, cells = {} } end, "empty list")
check.fails(function() model:supply { "auxin", rate = 1, cells = { 3 } } end, "no cell")
check.fails(function() model:supply { "auxin", rate = 1, cells = cells, from = 1 } end, "at 6.5 already")
check.fails(function() model:supply { "auxin", rate = 1, cells = cells, from = 8, to = 8 } end, "after 'from'")

-- What is gone, or cannot be resumed, is refused and not passed over.
local fifth = sheet:near({ { -2, 0 }, count = 1 })[1]
local one, two = fifth:divide()
check.fails(function() model:supply { "auxin", rate = 1, cells = { one, fifth } } end, "a cell that is gone", "has divided into " .. one.id .. " and " .. two.id)
model:supply { "auxin", rate = 1, cells = function() return { fifth } end, from = 7 }
local ok, why = pcall(model.advance, model, 7.5)
assert(not ok and why:find("a cell that is gone", 1, true), why)
check.fails(function() tunica.ring({ 10 }):near { { 0, 0 }, count = 1 } end, "have no places")
for _, rate in ipairs { 0 / 0, 1 / 0, "5" } do
  check.fails(function() model:supply { "auxin", rate = rate, cells = { one } } end, "'rate' must be a number")
end
local function small()
  local s = tunica.sheet { cells = 30, seed = 1 }
  s:cell { auxin = 1 }
  local m = tunica.model { tissue = s, dt = 0.01 }
  m:rate(function(c, d) d.auxin = 0 * c.auxin end)
  return m, s, s:near { { 0, 0 }, count = 3 }
end
local m, s, c = small()
m:at(1, function() m:supply { "auxin", rate = 1, cells = c } end)
ok, why = pcall(m.advance, m, 2)
assert(not ok and why:find("cannot be called while the model runs", 1, true), why)

-- A snapshot in the middle of a supply: the same state from there, dead cells that functions hold included; back and on again.
m, s, c = small()
m:supply { "auxin", rate = 5, cells = c, from = 1, to = 3 }
m:at(1.5, function() c[2]:divide() end)
m:at(1.7, function() c[3]:remove() end)
local alive
m:at(2.5, function() alive = c[1].alive and not c[2].alive and not c[3].alive end)
for _, middle in ipairs { 0.5, 1, 1.6, 2, 3 } do
  m:advance(middle)
  local snapshot, begin = m:snapshot(), m:hash()
  m:advance(4)
  local whole = m:hash()
  check.equal(alive, true)
  check.near(c[1].auxin, 11, 1e-9)
  m:restore(snapshot)
  check.equal(m:hash(), begin)
  m:advance(4)
  check.equal(m:hash(), whole)
  check.fails(function() return c[2].area end, "has divided into")
  m, s, c = small()
  m:supply { "auxin", rate = 5, cells = c, from = 1, to = 3 }
  m:at(1.5, function() c[2]:divide() end)
  m:at(1.7, function() c[3]:remove() end)
  m:at(2.5, function() alive = c[1].alive and not c[2].alive and not c[3].alive end)
  alive = nil
end

-- A view that is a plot
model:view { name = "curve", plot = function(t) return { y = { 1, 3, 2 }, xlabel = "n", title = "at " .. t } end }
local view = require "tunica.view"
if view.available() then
  assert(view.draw(model, model.views[1]):sub(2, 4) == "PNG")
  check.fails(function() view.draw(model, { plot = function() return 3 end }) end, "must return the options")
  check.fails(function() view.draw(model, { plot = function() return { y = "x" } end }) end, "list of items")
end
check.fails(function() model:view { plot = 3 } end, "function")
