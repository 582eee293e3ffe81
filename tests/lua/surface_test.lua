-- SPDX-License-Identifier: MIT
-- Surfaces written in Lua, surfaces that bulge, and tissues that grow, divide and are cut on them.
local tunica = require "tunica"
local check = require "check"

--- The unit sphere with its tip at (0, 1, 0); arc lengths from there grow at the rate 0.05.
local function closest(x, y, z)
  local r = math.sqrt(x * x + y * y + z * z)
  return x / r, y / r, z / r
end
local function at(angle, a) return math.sin(a) * math.cos(angle), math.cos(a), math.sin(a) * math.sin(angle) end
local function advance(x, y, z, t, dt)
  return at(math.atan2(z, x), math.atan2(math.sqrt(x * x + z * z), y) * math.exp(0.05 * dt))
end
local function arc(c) return math.atan2(math.sqrt(c.x ^ 2 + c.z ^ 2), c.y) end
local sphere = tunica.surface { advance = advance, closest = closest, normal = closest }

local function cell_on_tip(a)
  local corners = {}
  for i = 0, 7 do corners[i + 1] = { at(-math.pi * i / 4, a) } end
  return tunica.polygons { corners }
end

-- Growth, division and removal, with and without a normal.
local hash
for _, surface in ipairs { sphere, tunica.surface { advance = advance, closest = closest } } do
  local tissue = cell_on_tip(0.15)
  local first = tissue:find(1)
  local divisions = 0
  for step = 1, 60 do
    tissue:grow { on = surface, time = 1, from = step }
    divisions = divisions + tissue:divide { above = 0.05, variation = 0.2, on = surface }
    tissue:remove { where = function(c) return arc(c) > 1.3 end }
  end
  assert(divisions > 80, divisions)
  check.valid(tissue)
  check.equal(tissue:statistics().four_way, 0)
  for j in tissue:junctions() do check.near(j.x ^ 2 + j.y ^ 2 + j.z ^ 2, 1, 1e-12) end
  check.fails(function() print(first.area) end, "has divided into")
  hash = hash or tissue:hash()
  check.equal(tissue:hash(), hash)
  local a, b = tissue:cells()():divide { on = surface, direction = { 0, 1, 0.1 } }
  for _, c in ipairs { a, b } do
    for j in c:junctions() do check.near(j.x ^ 2 + j.y ^ 2 + j.z ^ 2, 1, 1e-12) end
  end
  check.equal(tissue:divide { where = function(c) return c.id == a.id end, on = surface }, 1)
end

-- Removal
local sheet = tunica.hexagons { 4, 4 }
local gone = sheet:find(1)
check.equal(sheet:remove { where = function(c) return c.id < 5 end }, 4)
check.equal(#sheet, 12)
check.equal(gone.alive, false)
check.fails(function() print(gone.x) end, "was removed")
check.equal(sheet:remove(function() return false end), 0)
local before = sheet:hash()
check.fails(function() sheet:remove { where = function() return true end } end, "last cell")
check.fails(function() sheet:remove { where = function(c) c:remove() end } end, "cannot change")
check.fails(function() sheet:remove {} end, "give where")
check.fails(function() sheet:remove { on = sphere } end, "beyond")
check.fails(function() sheet:remove { on = sphere, beyond = 1 } end, "apex")
check.fails(function() sheet:locate { on = sphere } end, "apex")
check.fails(function() sheet:grow { on = sphere, rate = 1 } end, "give one of")
check.fails(function() sheet:grow { on = 3 } end, "a surface")
check.equal(sheet:hash(), before)

-- Functions that fail or return rubbish: the tissue is as before.
local tissue = cell_on_tip(0.5)
before = tissue:hash()
local function but(name, f)
  local functions = { advance = advance, closest = closest, normal = closest }
  functions[name] = f
  return tunica.surface(functions)
end
check.fails(function() tissue:grow { on = but("advance", function(x, y, z) return x, y end) } end, "'advance'", "surface_test.lua:", "came nil")
check.fails(function() tissue:grow { on = but("advance", function(x, y, z) return x, 0 / 0, z end) } end, "finite numbers")
check.fails(function() tissue:grow { on = but("advance", function(x, y, z) return x, "y", z end) } end, "the text 'y'")
check.fails(function() tissue:grow { on = but("normal", function(x, y, z) return 0, 0, 0 end) } end, "length")
check.fails(function() tissue:grow { on = but("normal", function(x, y, z) return -x, -y, -z end) } end, "turn over")
check.fails(function() tissue:divide { above = 0.1, on = but("closest", function() return 1 end) } end, "'closest'")
local _, message = pcall(function() tissue:grow { on = but("advance", function()
  error "no growth today" end) } end)
assert(message:find("surface_test.lua:%d+: no growth today"), message)
check.fails(function() tissue:grow { on = but("advance", function() tissue:grow { rate = 1 } end) } end, "cannot change")
check.fails(function() tissue:divide { above = 0.1, on = but("closest", function() tissue:divide { above = 0.1 } end) } end, "cannot change")
local loop
loop = tunica.surface { advance = advance, closest = function(x, y, z) return loop:closest(x, y, z) end }
assert(not pcall(function() loop:closest(1, 0, 0) end))
check.fails(function() loop:normal(1, 0, 0) end, "no 'normal'")
check.equal(tissue:hash(), before)
check.fails(function() tunica.surface { advance = advance } end, "closest")
check.fails(function() sphere:closer(1, 2, 3) end, "did you mean 'closest'")
check.fails(function() sphere.closest = 1 end, "cannot be set")

-- Bulges
local surface = tunica.bulges { on = sphere, radius = function(age) return 0.2 + 0.01 * age end, height = 0.1 }
surface:add { place = { at(0, 0.3) }, birth = 0 }
surface:add { place = { at(2, 0.3) }, birth = 5 }
check.equal(#surface:list(), 1)
surface:time(10)
check.equal(surface:time(), 10)
local list = surface:list()
check.equal(#list, 2)
check.near(list[2].radius, 0.25, 1e-15)
check.near(list[2].age, 5, 1e-15)
local x, y, z = at(2, 0.3 * math.exp(0.25))
check.near(list[2].x, 1.1 * x, 1e-12)
x, y, z = surface:closest(1.2 * x, 1.2 * y, 1.2 * z)
check.near(x, list[2].x, 1e-9)
check.equal(surface:within(x, y, z), 2)
check.near(select(2, surface:within(x, y, z)), 0, 1e-7)
check.equal(surface:within(0, -1, 0), nil)
tissue = cell_on_tip(0.5)
for _ = 1, 10 do
  tissue:grow { on = surface, time = 1 }
  tissue:divide { above = 0.03, on = surface }
end
check.equal(surface:time(), 20)
check.valid(tissue)
local lifted = 0
for j in tissue:junctions() do
  local cx, cy, cz = surface:closest(j.x, j.y, j.z)
  check.near(math.abs(cx - j.x) + math.abs(cy - j.y) + math.abs(cz - j.z), 0, 1e-6)
  if j.x ^ 2 + j.y ^ 2 + j.z ^ 2 > 1.1 then lifted = lifted + 1 end
end
assert(lifted > 3)
check.fails(function() surface:add { 10, 0.3 } end, "places of an apex")
check.fails(function() surface:add {} end, "place = ")
check.fails(function() tunica.bulges { on = tunica.surface { advance = advance, closest = closest }, radius = 1, height = 1 } end, "normal")
check.fails(function() tunica.bulges { on = sphere, radius = true, height = 1 } end, "'radius'")
local broken = tunica.bulges { on = sphere, radius = 1, height = function() return "high" end }
check.fails(function() broken:add { place = { 0, 1, 0 } } end, "'height'", "finite number")
check.equal(#broken:list(), 0)

-- A snapshot of a model holds the primordia and the time of its surface.
local model = tunica.model { tissue = tissue, dt = 0.5 }
model:every(1, function()
  if model.time == 2 then surface:add { place = { at(4, 0.4) } } end
  tissue:grow { on = surface, time = 1 }
end)
model:advance { to = 1.5 }
local snapshot = model:snapshot()
model:advance { to = 4 }
local there, time = model:hash(), surface:time()
check.equal(#surface:list(), 3)
model:restore(snapshot)
check.equal(#surface:list(), 2)
model:advance { to = 4 }
check.equal(model:hash(), there)
check.equal(surface:time(), time)
check.equal(#surface:list(), 3)

-- Cells on an apex: built, grown, divided and cut, with the places of cells kept up to date.
local apex = tunica.apex { profile = "dome", growth = "raised" }
local function expect_places(tissue)
  for c in tissue:cells() do
    local theta, a = apex:closest(c.x, c.y, c.z)
    check.near(c.theta, theta, 1e-12)
    check.near(c.a, a, 1e-10)  -- from a table
  end
end
tissue = tunica.apex_tissue { on = apex, to = 1, max_area = 0.05, seed = 2 }
check.valid(tissue)
check.equal(tissue:hash(), tunica.apex_tissue({ on = apex, to = 1, max_area = 0.05, seed = 2 }):hash())
check.equal(#tunica.apex_tissue { on = apex, cells = 30 }, 30)
assert(#tissue > 60)
check.fails(function() print(tissue:max "a") end, "column")
tissue:locate { on = apex }
expect_places(tissue)
local removed = 0
for _ = 1, 40 do
  tissue:grow { on = apex, time = 0.05 }
  tissue:divide { above = 0.05, on = apex }
  removed = removed + tissue:remove { on = apex, beyond = 1 }
end
assert(removed > 50)
assert(tissue:max "a" <= 1)
expect_places(tissue)
tissue:find(tissue:cells()().id):divide { on = apex }
expect_places(tissue)
check.valid(tissue)
check.equal(tissue:statistics().four_way, 0)
--- At right angles to a cell's mean plane (twice the vector of its area).
local function normal_of(c)
  local x, y, z, corners = 0, 0, 0, {}
  for j in c:junctions() do corners[#corners + 1] = j end
  for i, p in ipairs(corners) do
    local q = corners[i % #corners + 1]
    local px, py, pz, qx, qy, qz = p.x - c.x, p.y - c.y, p.z - c.z, q.x - c.x, q.y - c.y, q.z - c.z
    x, y, z = x + py * qz - pz * qy, y + pz * qx - px * qz, z + px * qy - py * qx
  end
  return x, y, z
end
local whole, number = tissue:cells()().id, #tissue  -- one that is not divided, while others are
check.fails(function()
  tissue:divide { above = 0.01, on = apex, rule = "along", direction = function(c)
    if c.id == whole then return normal_of(c) end
    return 0, 1, 0.1
  end }
end, "right angles to cell " .. whole)
assert(#tissue > number)
expect_places(tissue)
check.valid(tissue)
check.equal(tissue:statistics().four_way, 0)
for j in tissue:junctions() do
  local x1, y1, z1 = apex:position(apex:closest(j.x, j.y, j.z))
  check.near(math.abs(x1 - j.x) + math.abs(y1 - j.y) + math.abs(z1 - j.z), 0, 1e-9)
end

-- Primordia bulge out of it.
surface = tunica.bulges { on = apex, radius = tunica.curve { { 0, 0.1 }, { 4, 0.3 } }, height = tunica.curve { { 0, 0 }, { 4, 0.2 } } }
for i = 0, 5 do surface:add(i * 137.5, 0.5, i) end
surface:time(6)
check.equal(#surface:list(), 6)
for _ = 1, 5 do
  tissue:grow { on = surface, time = 0.05 }
  tissue:divide { above = 0.05, on = surface }
end
check.near(surface:time(), 6.25, 1e-12)
check.valid(tissue)
expect_places(tissue)
check.fails(function() tunica.apex_tissue { on = apex } end, "one of")
check.fails(function() tunica.apex_tissue { on = apex, to = 1, cells = 3 } end, "one of")
check.fails(function() tunica.apex_tissue { on = tunica.apex { profile = "cylinder" }, to = 1 } end, "hole")
check.fails(function() tunica.apex_tissue { on = tunica.apex { growth = 0 }, to = 1 } end, "does not grow")
check.fails(function() tunica.apex_tissue { on = sphere, to = 1 } end, "apex")

-- Two neighbours above a threshold, and the primordium that starts between them.
do
  local apex = tunica.apex { cap = { 1.5, 75 }, growth = 0.2 }
  check.near(select(2, apex:profile(0.3)), 1.5 * (math.cos(0.2) - 1), 1e-12)
  check.fails(function() tunica.apex { cap = { 1.5, 95 } } end, "at most 90 degrees")
  check.fails(function() tunica.apex { cap = { 0, 75 } } end, "must be positive")
  local tissue = tunica.apex_tissue { on = apex, cells = 40, max_area = 0.1 }
  tissue:cell { auxin = function(c) return c.id end }
  tissue:locate { on = apex }
  local a, b = tissue:pair("auxin", 0)
  local most = 0
  for c in tissue:cells() do
    for n in c:neighbours() do most = math.max(most, math.min(c.auxin, n.auxin)) end
  end
  check.equal(b.auxin, most)
  assert(a.auxin > b.auxin)
  check.equal(tissue:pair("auxin", 1e6), nil)
  local c, d = tissue:pair { "auxin", above = 3, where = { a = { 0, 0.4 } } }
  assert(c.a <= 0.4 and d.a <= 0.4)
  check.equal(tissue:pair { "auxin", above = 3, where = { auxin = 5 } }, nil)  -- one cell only
  check.fails(function() tissue:pair { "auxin", above = 3, where = { b = 1 } } end, "no column 'b'")
  check.fails(function() tissue:pair { "auxin", above = 3, where = { a = { 1, 0 } } } end, "low <= high")
  check.fails(function() tissue:pair { "auxin", above = 3, where = { 1 } } end, "by name")
  check.fails(function() tissue:pair { "auxn", above = 3 } end, "auxin")

  local surface = tunica.bulges { on = apex, radius = tunica.curve { { 0, 0.2 }, { 1, 0.5 }, degree = 1 }, height = 0 }
  check.fails(function() tissue:differentiate { on = apex } end, "bulges")
  surface:add { place = { (a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2 } }
  tissue:differentiate { on = surface }
  local function members()
    local n = 0
    for each in tissue:cells() do
      if each.primordium == 1 then n = n + 1 end
      assert((each.primordium == 1) == (each.closeness > 0))
    end
    return n
  end
  local young = members()
  assert(young > 0)
  tissue:grow { on = surface, time = 1 }  -- which keeps them up to date
  assert(members() > young)
  tissue:divide { above = 0.05, on = surface }
  assert(members() > young)
  check.valid(tissue)
end
