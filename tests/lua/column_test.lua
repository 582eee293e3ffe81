-- SPDX-License-Identifier: MIT
-- State: how it starts, what daughters get, keyed random numbers.
local tunica = require "tunica"
local check = require "check"

local tissue = tunica.hexagons { 6, 6, seed = 4 }
tissue:cell {
  concentration = function(c) return c.id / 2 end,
  amount = { function(c) return c.id end, divide = "split" },
  age = { 7, divide = "reset" },
  generation = { 0, divide = function(mother, share)
    assert(share > 0 and share < 1)
    return mother + 1, mother + 1
  end },
}
tissue:wall { stiffness = { 2, divide = "copy" } }
tissue:side { pin = function(s) return s.border and 0 or 1 end }
tissue:junction { charge = 5 }

local total = tissue:sum "amount"
for c in tissue:cells() do
  check.equal(c.concentration, c.id / 2)
  c.age = 1
end
local mother = tissue:find(15)
local concentration, amount, area = mother.concentration, mother.amount, mother.area
local a, b = mother:divide { direction = { 1, 2 } }
check.equal(a.concentration, concentration)
check.equal(b.concentration, concentration)
check.near(a.amount / b.amount, a.area / b.area, 0.3) -- displaced and pinched walls change areas a little after the cut
check.near(a.amount + b.amount, amount, 1e-14)
check.near(a.area + b.area, area, 0.1) -- pinching gives some of it to the neighbours
check.equal(a.age, 7)
check.equal(b.generation, 1)
check.equal(a:wall_to(b).stiffness, 2)
tissue:divide { above = 0.3, variation = 0.1 }
check.near(tissue:sum "amount", total, 1e-10)
assert(tissue:max "generation" >= 2)
check.valid(tissue)

-- A rule that fails, or returns rubbish, is an error at its line, and the tissue is as it was.
local function bad_rule(rule, ...)
  local sheet = tunica.hexagons { 3, 3 }
  sheet:cell { x1 = { 1, divide = rule } }
  local before = sheet:hash()
  local ok, message = pcall(function() sheet:find(5):divide() end)
  assert(not ok)
  for _, text in ipairs { ... } do assert(message:find(text, 1, true), message) end
  check.equal(sheet:hash(), before)
  check.valid(sheet)
end
bad_rule(function() error("no daughters today") end, "column_test.lua:", "no daughters today")
bad_rule(function() return 1 end, "x1", "finite number", "nil")
bad_rule(function() return 1, 0 / 0 end, "finite number", "nan")
local sheet
bad_rule(function() sheet:find(1):remove() return 1, 1 end, "attempt to index")

-- Changing the structure from inside is an error.
sheet = tunica.hexagons { 3, 3 }
check.fails(function()
  sheet:cell { twice = { 1, divide = function() sheet:find(1):divide() return 1, 1 end } }
  sheet:find(5):divide()
end, "structure of the tissue cannot change")
check.fails(function() sheet:cell { q = function(c) c:remove() return 1 end } end, "structure of the tissue cannot change")
check.fails(function() sheet:divide { where = function(c) c:remove() end } end, "structure of the tissue cannot change")
check.valid(sheet)

-- Wrong declarations
check.fails(function() sheet:cell { q = "1" } end, "'q' must be a number, or a function, or a table")
check.fails(function() sheet:cell { q = { 1, divide = "splt" } } end, "did you mean 'split'?")
check.fails(function() sheet:cell { q = { 1, divde = "split" } } end, "no option", "divde")
check.fails(function() sheet:cell { q = { function() return 1 end, divide = "reset" } } end, "'reset' needs")
check.fails(function() sheet:cell { q = function() end } end, "must return a finite number, returned nil")
check.fails(function() sheet:cell { q = function() error("here") end } end, "here")
for _, name in ipairs(require("tunica.core").columns(sheet, "cell")) do assert(name ~= "q") end

-- Random numbers are functions of their key.
local c = sheet:find(3)
check.equal(c:uniform(0, 1, "a"), sheet:find(3):uniform(0, 1, "a"))
assert(c:uniform(0, 1, "a") ~= c:uniform(0, 1, "b"))
assert(c:uniform(0, 1, "a") ~= c:uniform(0, 1, "a", 1))
assert(c:uniform() ~= sheet:find(4):uniform())
assert(c:uniform() ~= sheet:find(3, "wall"):uniform())
local sum, squares = 0, 0
for i = 1, 4000 do
  local x, y = c:uniform(2, 4, "mean", i), c:normal(5, 2, "mean", i)
  assert(x >= 2 and x < 4)
  sum, squares = sum + x, squares + (y - 5) ^ 2
end
check.near(sum / 4000, 3, 0.05)
check.near(math.sqrt(squares / 4000), 2, 0.1)
check.equal(tunica.uniform(0, 1, "q", 3), tunica.uniform(0, 1, "q", 3))
