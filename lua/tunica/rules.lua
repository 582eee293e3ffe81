-- SPDX-License-Identifier: MIT
--- Rules of a model: called once with symbols to learn their equations; where that is not possible, run as they are.

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local op = registry.op

local rules = {}

-- Functions that take numbers and symbols alike ---------------------------------------------------------------------

local f = core.functions
local x, y = { name = "x", type = "any", required = true, doc = "number or value of a rule" },
  { name = "y", type = "any", required = true, doc = "number or value of a rule" }
local example = [[local tunica = require "tunica" print(tunica.%s)]]

local function declare(name, call, args, doc, fn)
  op { name = "tunica." .. name, args = args, doc = doc, returns = "a number, or a value of the rule",
    example = example:format(call), fn = fn or f[name] }
end

declare("exp", "exp(1)", { x }, "The exponential function.")
declare("log", "log(2)", { x }, "The natural logarithm.")
declare("sqrt", "sqrt(2)", { x }, "The square root.")
declare("sin", "sin(1)", { x }, "The sine of an angle in radians.")
declare("cos", "cos(1)", { x }, "The cosine of an angle in radians.")
declare("tanh", "tanh(1)", { x }, "The hyperbolic tangent.")
declare("abs", "abs(-1)", { x }, "The absolute value.")
declare("pow", "pow(2, 3)", { x, y }, "x to the power of y; the same as x ^ y.")
declare("below", "below(1, 2)", { x, y }, "1 where x < y, else 0.")
declare("at_most", "at_most(1, 2)", { x, y }, "1 where x <= y, else 0.")
declare("above", "above(2, 1)", { x, y }, "1 where x > y, else 0.", function(a, b) return f.below(b, a) end)
declare("at_least", "at_least(2, 1)", { x, y }, "1 where x >= y, else 0.", function(a, b) return f.at_most(b, a) end)
declare("equal", "equal(1, 1)", { x, y }, "1 where x equals y, else 0.")
declare("where", "where(tunica.above(2, 1), 10, 20)", { { name = "condition", type = "any", required = true,
  doc = "not 0 for yes" }, x, y }, "x where the condition holds, else y. Both are computed; join conditions with * (and), max (or).")
declare("clamp", "clamp(5, 0, 1)", { x, { name = "low", type = "any", required = true, doc = "least value" },
  { name = "high", type = "any", required = true, doc = "greatest value" } }, "x kept between low and high.",
  function(v, low, high) return f.min(f.max(v, low), high) end)
declare("step", "step(2)", { x }, "1 where x >= 0, else 0.", function(v) return f.at_most(0, v) end)
declare("hill", "hill(2, 1, 4)", { x, { name = "half", type = "any", required = true, doc = "x at which the value is 1/2" },
  { name = "n", type = "any", default = 2, doc = "steepness" } }, "Saturation x^n / (half^n + x^n), for x >= 0.",
  function(v, half, n)
    for _, value in ipairs { v, half, n } do
      if type(value) ~= "number" and type(value) ~= "userdata" then
        registry.fail("tunica.hill takes numbers or values of a rule, came %s", core.describe(value))
      end
    end
    return v ^ n / (half ^ n + v ^ n)
  end)

local more = { x }
for i = 2, 8 do more[i] = { name = "x" .. i, type = "any", doc = "another" } end
for _, name in ipairs { "min", "max" } do
  local pick = f[name]
  declare(name, name .. "(1, 2)", more, (name == "min" and "The least" or "The greatest") .. " of its arguments (up to eight).",
    function(...)
      local n = select("#", ...)
      while n > 1 and select(n, ...) == nil do n = n - 1 end
      return pick(unpack({ ... }, 1, n))
    end)
end

-- The functions of `math` take symbols too, so that formulas need no prefix.
for _, name in ipairs { "exp", "log", "sqrt", "sin", "cos", "tanh", "abs", "pow", "min", "max" } do
  local plain, symbolic = math[name], f[name]
  math[name] = function(...)
    for i = 1, select("#", ...) do
      if type(select(i, ...)) == "userdata" then return symbolic(...) end
    end
    return plain(...)
  end
end

-- Sums over neighbours, evaluated directly ----------------------------------------------------------------------------

local function over_neighbours(cell, fn, join)
  local total
  for side in cell:sides() do
    local opposite = side.opposite
    if opposite then
      local value = fn(opposite.cell, side.wall, side, opposite)
      if type(value) ~= "number" then
        registry.fail("the function to go over the neighbours must return a number, it returned %s", core.describe(value))
      end
      total = total and join(total, value) or value
    end
  end
  return total or 0
end

local body = { { name = "f", type = "function", required = true, doc = "f(n, w, s, o): neighbour, wall, own and opposite side" } }
local grid = [[local tunica = require "tunica"
local tissue = tunica.grid { 3, 3 }
tissue:cell { auxin = 1 }
print(tissue:find(4):%s(function(n) return n.auxin end))]]
for name, join in pairs { sum = function(a, b) return a + b end, minimum = function(a, b) return f.min(a, b) end,
  maximum = function(a, b) return f.max(a, b) end } do
  op { name = "cell:" .. name, args = body, returns = "a number; 0 for a cell without neighbours", example = grid:format(name),
    doc = "The " .. name .. " of a function over the walls to neighbours, in cyclic order.",
    fn = function(cell, fn) return over_neighbours(cell, fn, join) end }
end

-- Tracing ---------------------------------------------------------------------------------------------------------------

--- The line of the first `==` or `~=` between two values, or of a value with a number, in a function or those inside it:
-- such a comparison would be false for any symbol, without a word. Nil if there is none.
local function comparison_line(fn, seen)
  local info = core.bytecode.funcinfo(fn)
  if not info.bytecodes then return nil end
  for pc = 1, info.bytecodes - 1 do
    local code = core.bytecode.funcbc(fn, pc)
    local operation = code and code % 256
    if operation == 4 or operation == 5 or operation == 8 or operation == 9 then
      return core.bytecode.funcinfo(fn, pc).currentline
    end
  end
  for i = 1, info.gcconsts or 0 do
    local inner = core.bytecode.funck(fn, -i)
    local line = type(inner) == "proto" and comparison_line(inner, seen)
    if line then return line end
  end
  if type(fn) ~= "function" then return nil end
  seen[fn] = true
  for _, upvalue in ipairs(core.upvalues(fn)) do
    local value = upvalue[2]
    if type(value) == "function" and not seen[value] and debug.getinfo(value, "S").source:sub(1, 8) ~= "=tunica/" then
      local line = comparison_line(value, seen)
      if line then return line end
    end
  end
end

--- Calls trace(...), which calls `fn` with symbols: true, or false and why not. Returns nil, or why `fn` cannot be traced.
function rules.with_symbols(fn, trace, ...)
  local line = comparison_line(fn, {})
  if line then
    return string.format("line %d compares with == or ~=, which no symbol can answer; use where(equal(x, y), a, b), or decide outside the rule", line)
  end
  params.trace_hook = function(_, name, value) return core.parameter_symbol(name) or value end
  registry.tracing = true
  local went, ok, reason = pcall(trace, ...)
  registry.tracing, params.trace_hook = false, nil
  if not went then error(ok, 0) end
  if ok then return nil end
  reason = tostring(reason)
  if reason:find "attempt to compare" then
    reason = reason .. " (a rule cannot decide by <, <=, >; write where(above(x, y), a, b), min, max, clamp or step)"
  end
  return reason
end

--- Traces one rule into `set` (core.rules). Returns nil, or why it cannot be traced.
function rules.trace(set, rule)
  return rules.with_symbols(rule.fn, core.trace, set, rule.what, rule.kind, rule.fn, rule.where, rule.column)
end

-- Running rules as they are ----------------------------------------------------------------------------------------------

--- Keeps in `written` what a rule sets for an element.
local function keeper(element, written)
  return function(_, name, value)
    core.check_settable(element, name)
    if type(value) ~= "number" then registry.fail("a rule must set '%s' to a number, came %s", name, core.describe(value)) end
    written[name] = value
  end
end

--- Stands for an element in a rule: reads go to the element, what is set is kept in `written`.
local function recorder(element, written)
  return setmetatable({}, {
    __index = function(_, name)
      if written[name] ~= nil then return written[name] end
      local value = element[name]
      if type(value) ~= "function" then return value end
      return function(_, ...) return value(element, ...) end
    end,
    __newindex = keeper(element, written),
  })
end

--- The rates that a rule sets.
local function rates_of(element, written)
  return setmetatable({}, { __index = written, __newindex = keeper(element, written) })
end

local function is_inner(e, kind)
  return kind == "cell" or kind == "side" and e.opposite ~= nil or kind == "wall" and select(2, e:cells()) ~= nil
end

local function inner_elements(tissue, kind)
  local list = {}
  for e in core.each(tissue, kind) do
    if is_inner(e, kind) then list[#list + 1] = e end
  end
  return list
end

local function call_rule(rule, element, target, time)
  if rule.what == "derive" then
    if rule.kind ~= "wall" then return core.call_rule(rule.fn, target, time) end
    local a, b = element:cells()
    return core.call_rule(rule.fn, target, a, b, time)
  end
  if rule.kind ~= "wall" then return core.call_rule(rule.fn, element, target, time) end
  local a, b = element:cells()
  return core.call_rule(rule.fn, element, target, a, b, time)
end

local function flux_through(rule, wall, a, b, time)
  local flux = core.call_rule(rule.fn, wall, a, b, time)
  if type(flux) ~= "number" then
    registry.fail_at(rule.where, "the flux of '%s' must be a number, the function returned %s", rule.column, core.describe(flux))
  end
  return flux
end

--- What a rule sets at one element, evaluated directly: a table of columns, or the flux under its column.
function rules.evaluate(rule, element, time)
  if rule.what == "flux" then
    local a, b = element:cells()
    return { [rule.column] = flux_through(rule, element, a, b, time) }
  end
  local written = {}
  call_rule(rule, element, (rule.what == "derive" and recorder or rates_of)(element, written), time)
  return written
end

local function different_columns(rule, name, element)
  registry.fail_at(rule.where, "the rule sets '%s' in %s but not in the first %s; set the same columns everywhere", name,
    tostring(element), rule.kind)
end

local function derive_sweep(rule, tissue)
  return function(time)
    if rule.waits then return end
    for _, element in ipairs(inner_elements(tissue, rule.kind)) do
      for name, value in pairs(rules.evaluate(rule, element, time)) do
        if not rule.known[name] then different_columns(rule, name, element) end
        core.put(element, name, value)
      end
    end
  end
end

-- A sweep of rates gives, per column, the values by identity.

local function rate_sweep(rule, tissue)
  return function(time)
    local rates = {}
    if rule.waits then return rates end
    for _, name in ipairs(rule.columns) do rates[name] = {} end
    for _, element in ipairs(inner_elements(tissue, rule.kind)) do
      for name, value in pairs(rules.evaluate(rule, element, time)) do
        if not rates[name] then different_columns(rule, name, element) end
        rates[name][element.id] = value
      end
    end
    return rates
  end
end

local function flux_sweep(rule, tissue)
  return function(time)
    local rates, areas = {}, tissue.has_geometry
    local function add(cell, amount) rates[cell.id] = (rates[cell.id] or 0) + amount / (areas and cell.area or 1) end
    for _, wall in ipairs(inner_elements(tissue, "wall")) do
      local flux = rules.evaluate(rule, wall, time)[rule.column]
      local a, b = wall:cells()
      add(a, -flux)
      add(b, flux)
    end
    return { [rule.column] = rates }
  end
end

--- Adds a rule to `set` to be run directly: once per element and evaluation, by the interpreter. Its columns are those
-- that it sets in the first element; while there is none (no wall in a tissue of one cell) they are not known.
function rules.add_direct(set, rule, tissue)
  local first = inner_elements(tissue, rule.what == "flux" and "wall" or rule.kind)[1]
  rule.columns, rule.known = {}, {}
  if rule.what == "flux" then
    rule.columns[1] = rule.column
  elseif first then
    for name in pairs(rules.evaluate(rule, first, 0)) do
      rule.columns[#rule.columns + 1], rule.known[name] = name, true
    end
    table.sort(rule.columns)
  end
  rule.waits = rule.what ~= "flux" and first == nil
  local sweep = (rule.what == "derive" and derive_sweep or rule.what == "rate" and rate_sweep or flux_sweep)(rule, tissue)
  core.direct(set, rule.what == "derive" and "derive" or "rate", rule.what == "flux" and "cell" or rule.kind, sweep, rule.where,
    rule.columns)
end

--- Whether a rule whose columns were not known can find them out now.
function rules.can_know(rule, tissue) return rule.waits and #inner_elements(tissue, rule.kind) > 0 end

--- Some elements on which to compare a traced rule with direct evaluation: spread over the tissue, the border included.
local function samples(tissue, kind, about)
  local some, count = {}, core.count(tissue, kind)
  local stride = math.max(1, math.floor(count / about))
  local at = 1
  while at <= count do
    local e = core.element(tissue, kind, at)
    if is_inner(e, kind) then
      some[#some + 1] = e
      at = at + stride
    else
      at = at + 1
    end
  end
  if count > 0 and (at - stride ~= count or #some == 0) then
    local last = core.element(tissue, kind, count)
    if is_inner(last, kind) then some[#some + 1] = last end
  end
  return some
end

--- Compares a traced rule (the `index`-th of `set`) with direct evaluation, on about so many elements. Returns nil, or how
-- they differ.
function rules.compare(set, index, rule, tissue, values, time, about)
  for _, element in ipairs(samples(tissue, rule.what == "flux" and "wall" or rule.kind, about)) do
    local direct = rules.evaluate(rule, element, time)
    local traced = core.reference(set, values, time, index, element)
    for name in pairs(traced) do
      if direct[name] == nil then return string.format("evaluated directly it does not set %s in %s", name, tostring(element)) end
    end
    for name, value in pairs(direct) do
      if not traced[name] then return string.format("evaluated directly it sets %s in %s", name, tostring(element)) end
      local number, magnitude = unpack(traced[name])
      local same = number == value or number ~= number and value ~= value
      if not same and not (math.abs(number - value) <= 1e-9 * magnitude) then
        return string.format("evaluated directly it gives %s = %.12g in %s, traced %.12g: it decides something by the values", name,
          value, tostring(element), number)
      end
    end
    if rule.what == "flux" then
      local a, b = element:cells()
      local there, back = flux_through(rule, element, a, b, time), flux_through(rule, element, b, a, time)
      local magnitude = traced[rule.column][2]
      if not (math.abs(there + back) <= 1e-9 * magnitude) and there == there then
        registry.fail_at(rule.where, "the flux from a to b is %.12g, but from b to a %.12g; it must be the same with opposite sign, since which cell is called a is arbitrary",
          there, back)
      end
    end
  end
end

return rules
