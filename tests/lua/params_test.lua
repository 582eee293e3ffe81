-- SPDX-License-Identifier: MIT
-- tunica.params: defaults, limits, access. What the command line does is in tests/shell.
local params = require "tunica.params"

local check = require "check"
local fails = check.fails

fails(function() params.declare({ a = {} }) end, "default")
fails(function() params.declare({ a = { { 1 } } }) end, "default")
fails(function() params.declare({ a = 0 / 0 }) end, "finite")
fails(function() params.declare({ a = math.huge }) end, "finite")
fails(function() params.declare({ a = { 0, min = 1 } }) end, "at least 1")
fails(function() params.declare({ a = { 0, units = "m" } }) end, "did you mean 'unit'")
fails(function() params.declare({ ["a b"] = 1 }) end, "cannot name")

local P = params.declare { D = { 1.5, "diffusion", unit = "um2/s", min = 0, max = 10 }, wet = true, rule = "errera" }
assert(P.D == 1.5 and P.wet == true and P.rule == "errera")
fails(function() return P.rules end, "did you mean 'rule'")
fails(function() P.E = 1 end, "no parameter 'E'")
fails(function() P.D = "x" end, "expected a number, got 'x'")
fails(function() P.D = 0 / 0 end, "finite")
fails(function() P.D = 11 end, "at most 10")
fails(function() P.wet = 1 end, "expected a boolean")
fails(function() return P[1] end, "names")
P.D = 3
assert(P.D == 3 and params.values(P).D == 3)

local names = {}
for name in pairs(P) do names[#names + 1] = name end
assert(table.concat(names, " ") == "D rule wet")
assert(tostring(P):find("D = 3", 1, true))
assert(params.is(P) and not params.is {} and not params.is(nil) and params.current() == P)

-- While a rule is traced, numbers are symbols; other parameters stay what they are.
params.trace_hook = function(of, name, value) return { of, name, value } end
local symbol = P.D
assert(symbol[1] == P and symbol[2] == "D" and symbol[3] == 3 and P.wet == true)
params.trace_hook = nil
fails(function() params.declare({ x = 1 }) end, "before")
