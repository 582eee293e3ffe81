-- SPDX-License-Identifier: MIT
-- Every operation checks what it is given, says what was expected, and points at the line that called it.
local tunica = require "tunica"
local registry = require "tunica.registry"
local check = require "check"

-- Unknown names: the nearest is named.
check.fails(function() local _ = tunica.shet end, "no 'shet'", "did you mean 'sheet'?")
check.fails(function() tunica.sheet = 1 end, "cannot be changed")
check.fails(function() local t = tunica.grid { 3, 3, wrapp = true } end, "tunica.grid", "'wrapp'", "did you mean 'wrap'?")
check.fails(function() local t = tunica.grid { 3, 3, colour = 1 } end, "the options are: columns, rows, wrap, seed")
check.fails(function() local t = tunica.grid { 3, 3, [true] = 1 } end, "no option true")

-- Wrong types and sizes: what was expected and what came.
check.fails(function() local t = tunica.ring { "7" } end, "'cells' must be a whole number from 3", "came the text '7'")
check.fails(function() local t = tunica.ring { 2 } end, "'cells'", "came the number 2")
check.fails(function() local t = tunica.ring { 3.5 } end, "came the number 3.5")
check.fails(function() local t = tunica.ring { 0 / 0 } end, "came the number nan")
check.fails(function() local t = tunica.ring { math.huge } end, "came the number inf")
check.fails(function() local t = tunica.ring {} end, "'cells' is missing")
check.fails(function() local t = tunica.ring() end, "'cells' is missing")
check.fails(function() local t = tunica.ring { 5, cells = 6 } end, "'cells' is given twice")
check.fails(function() local t = tunica.grid { 1e9, 1e9 } end, "'columns' must be", "came the number 1000000000")
check.fails(function() local t = tunica.grid { 3000, 3000 } end, "4000000")
check.fails(function() local t = tunica.grid { 3, 3, wrap = "y" } end, "'none', 'x', 'both'", "came the text 'y'")

local tissue = tunica.hexagons { 4, 4 }
tissue:cell { auxin = 1 }
check.fails(function() tissue.divide { above = 1 } end, "tissue:divide", "with a colon")
check.fails(function() local s = tissue:sum "auxn" end, "must be the name of a column", "did you mean 'auxin'?")
check.fails(function() local s = tissue:sum("auxin", 3) end, "tissue:sum takes 1 argument, came one more: the number 3")
check.fails(function() tissue:grow { rate = 1, rates = { 1, 2 } } end, "one of rate, rates, velocity and on")
check.fails(function() tissue:grow { rates = { 1, "x" } } end, "'rates' must be a list of 2 items", "item 2 is the text 'x'")
check.fails(function() tissue:grow { rate = 0.1, direction = { 1 } } end, "'direction' must be a point or direction")
check.fails(function() local n = tissue:find(1):wall_to(tissue:find(1, "wall")) end, "'other' must be a cell", "came wall 1")
check.fails(function() local n = tissue:find(1):divide { rule = "erera" } end, "did you mean 'errera'?")

-- A plain value stands for the first option; positions and names are the same.
check.equal(#tunica.ring(7), #tunica.ring { cells = 7 })
check.equal(#tunica.grid(3, 4), 12)

-- Every entry is complete; every example runs by itself.
local examples = 0
for _, entry in ipairs(registry.all()) do
  assert(entry.doc:match "%.$", entry.name .. ": the doc is a sentence")
  for _, spec in ipairs(entry.args) do assert(spec.doc, entry.name .. ": " .. spec.name .. " has no doc") end
  if entry.example then
    local chunk = assert(load(entry.example, "=example of " .. entry.name))
    local print_before, io_write = print, io.write
    print = function(...) for i = 1, select("#", ...) do tostring((select(i, ...))) end end -- luacheck: ignore
    local ok, problem = pcall(chunk)
    print, io.write = print_before, io_write -- luacheck: ignore
    assert(ok, problem)
    examples = examples + 1
  end
end
assert(examples > 60)
check.equal(registry.find("tissue:divide").name, "tissue:divide")
check.equal(select(2, registry.find "tissue:devide"), "; did you mean 'tissue:divide'?")
