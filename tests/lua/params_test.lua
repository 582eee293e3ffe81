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

-- Variants: their values are defaults, and what they name must be there.
params.forget()
P = params.declare { T = { 22.5, "transport", min = 0 }, D = 4, variant = { "a", "which" }, variants = { a = {}, b = { T = 3 } } }
assert(P.T == 22.5 and P.variant == "a" and params.declared(P).variant.choices[2] == "b")
params.forget()
P = params.declare { T = { 22.5, "transport" }, variant = { "b", "which" }, variants = { a = {}, b = { T = 3 } } }
assert(P.T == 3 and params.declared(P).T.default == 3)
fails(function() P.variant = "a" end, "variants are chosen on loading: on the command line, variant=a")
fails(function() P.variant = "c" end, "no variant 'c'")
P.variant = "b"
params.go_back(P, { variant = "a", T = 4 })
assert(P.variant == "a" and P.T == 4)
params.forget()
P = params.declare { variants = { 5, "a number by this name" } }
assert(P.variants == 5)
local function refused(given, words)
  params.forget()
  fails(function() params.declare(given) end, words)
end
refused({ T = 1, variants = { a = {} } }, "variant = ")
refused({ T = 1, variant = 3, variants = { a = {} } }, "variant = ")
refused({ T = 1, variant = "c", variants = { abc = {}, d = {} } }, "no variant 'c'")
refused({ Temp = 1, variant = "a", variants = { a = { Tempo = 2 } } }, "did you mean 'Temp'")
refused({ T = { 1, min = 0 }, variant = "a", variants = { a = { T = -2 } } }, "at least 0")
refused({ T = 1, variant = "a", variants = { a = { variant = "b" } } }, "no parameter 'variant'")
refused({ T = 1, variant = "a", variants = { a = 3 } }, "expected name = ")
