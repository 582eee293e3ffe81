-- SPDX-License-Identifier: MIT
-- Handles: right while the tissue changes, errors that say what became of an element.
local tunica = require "tunica"
local check = require "check"

local tissue = tunica.hexagons { 5, 5 }
tissue:cell { auxin = 2, pin = { 1, divide = "split" } }
tissue:side { flow = 0 }
local c = tissue:find(13)

-- Fields
c.auxin = 3
check.equal(tissue:find(13).auxin, 3)
check.near(c.area, 1, 1e-12)
check.fails(function() local _ = c.auxn end, "a cell has no field 'auxn'; did you mean 'auxin'?")
check.fails(function() local _ = c.neighbors end, "did you mean 'neighbours'?")
check.fails(function() local _ = c[1] end, "the number 1 is not a name")
check.fails(function() c.auxn = 1 end, "no column 'auxn'; did you mean 'auxin'?")
check.fails(function() c.area = 1 end, "'area' of a cell follows from its geometry")
check.fails(function() c.auxin = "3" end, "must be a number, came the text '3'")
check.fails(function() c.auxin = nil end, "must be a number, came nil")
check.fails(function() c.auxin = 0 / 0 end, "cell 13", "came the number nan")
check.fails(function() c.auxin = -1 / 0 end, "came the number -inf")
check.fails(function() tissue.auxin = 1 end, "cannot be set on a tissue")
check.fails(function() tissue:cell { valence = 1 } end, "'valence' means something else")
check.fails(function() tissue:cell { auxin = 1 } end, "a cell has 'auxin' already")
check.fails(function() tissue:cell { ["a b"] = 1 } end, "'a b' cannot name a column")

-- Values
check.equal(c, tissue:find(13))
assert(c ~= tissue:find(12) and c ~= nil and c ~= 13 and c ~= tissue and c ~= tissue:find(13, "wall"))
check.equal(tostring(c):match "^cell 13: 6 sides, area 1", "cell 13: 6 sides, area 1")
check.equal(("at " .. c):sub(1, 10), "at cell 13")
check.fails(function() local _ = c + 1 end, "cell 13 is not a number")
check.fails(function() local _ = -c end, "cell 13 is not a number")
check.fails(function() local _ = #c end, "cell 13 is not a number")
check.fails(function() local _ = tissue * 2 end, "a tissue is not a number")
check.equal(getmetatable(c), "a cell")
check.equal(#tissue, 25)
tissue.data.age = 4
check.equal(c.tissue.data.age, 4)
check.equal(c.tissue, tissue)

-- Neighbourhoods are consistent with each other.
for a in tissue:cells() do
  local count, before = 0, nil
  for n, w in a:neighbours() do
    count = count + 1
    check.equal(a:wall_to(n), w)
    check.equal(a:side_to(n).neighbour, n)
    check.equal(a:side_to(n).opposite, n:side_to(a))
    check.equal(a:previous_to(a:next_to(n)), n)
    if before then check.equal(a:next_to(before), n) end
    before = n
  end
  check.equal(count, a.valence)
  for s in a:sides() do
    check.equal(s.cell, a)
    check.equal(s.next.previous, s)
    check.equal(s.to, s.next.from)
    check.equal(s.border, s.neighbour == nil)
  end
end
for w in tissue:walls() do
  local p, q = w:junctions()
  check.near(w.length, math.sqrt((p.x - q.x) ^ 2 + (p.y - q.y) ^ 2), 1e-12)
  local a, b = w:cells()
  if b then check.equal(a:wall_to(b), w) else assert(w.border and a.border) end
end
for j in tissue:junctions() do for a in j:cells() do check.equal(a.kind, "cell") end end
check.fails(function() local _ = c:next_to(tissue:find(1)) end, "neighbour")
check.equal(c:wall_to(tissue:find(1)), nil)

-- After division and removal
local a, b = c:divide { rule = "errera" }
check.equal(c.alive, false)
check.equal(c.id, 13)
check.fails(function() local _ = c.auxin end, "cell 13 has divided into " .. a.id .. " and " .. b.id)
check.fails(function() c.auxin = 1 end, "has divided into")
check.fails(function() local x, y = c:divide() end, "has divided into")
check.fails(function() local _ = a:wall_to(c) end, "has divided into")
check.equal(tostring(c), "cell 13 (has divided into " .. a.id .. " and " .. b.id .. ")")
check.equal(tissue:find(13), nil)
check.near(a.pin + b.pin, 1, 1e-15, "a split amount")
check.equal(a.auxin, 3)
b:remove()
check.fails(function() local _ = b.area end, "cell " .. b.id .. " was removed")
check.fails(function() local _ = tissue:find(2 ^ 33) end, "'id' must be a whole number")
check.equal(tissue:find(10 ^ 9), nil)
check.valid(tissue)

-- Iteration while the tissue changes: those that are gone are left out, new ones do not come.
local last, met = tissue:count(), 0
for e in tissue:cells() do
  met = met + 1
  if e.valence == 6 then e:divide() end
  for n in e.alive and e:neighbours() or function() end do n:remove() break end
end
assert(met < last)
check.valid(tissue)

-- Another tissue's element; a tissue that only its handles keep alive.
local other = tunica.hexagons { 3, 3 }
check.fails(function() local _ = other:find(1):wall_to(a) end, "belongs to another tissue")
local alone = tunica.ring(5):find(2)
for _ = 1, 200 do tunica.line { 2 } end
collectgarbage()
check.equal(alone.valence, 2)
check.equal(#alone.tissue, 5)
check.fails(function() local _ = alone:junctions() end, "without geometry has no junctions")
