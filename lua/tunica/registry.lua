-- SPDX-License-Identifier: MIT
--- One entry per user-visible operation. From an entry come the checked function itself, help, the editor stubs, the
-- reference page and the fuzz test.
--
--   op { name = "tissue:divide",      -- "owner:method", "owner.property", "tunica.function" or "prompt.function"
--        changes = true,              -- what rules read or are part of: rules cannot call it
--        runs = true,                 -- changes the state of a model, not its rules
--        kind = "named",              -- "positional" (default), "named" (one table of options) or "property"
--        args = { { name = "above", type = "number", above = 0, unit = "area", doc = "..." }, ... },
--        options = { ... },           -- positional only: what a table given may hold, like args; the function checks it
--        signature = "run([model, ] time)",  -- where what follows from args would not tell
--        rest = { type = "any" },     -- named only: other keys are allowed, with values of this type (columns)
--        doc = "One sentence. More sentences.", returns = "number of divisions", source = "thesis 3.4",
--        example = [[...]],           -- runs by itself
--        fn = function(self, ...) end }   -- functions of the module have no self; named ones get the checked table
--
-- An argument: name, type, doc, unit, default, required = true, position = n (named only: may also be given as t[n], or
-- plainly, without the table), and limits: min, max, above, below (numbers), choices (strings), of (lists: the type of
-- the items; columns: the kind of element), count = { least, most } (lists), infinite = true (inf and nan allowed).
-- A type is one of those in `types` below, or several joined by "|".

local core = require "tunica.core"

local registry = {}
local entries, by_name = {}, {}

local function raise(where, format, ...)
  local text = select("#", ...) > 0 and string.format(format, ...) or format
  if #text > 1000 then text = text:sub(1, 1000) .. " ..." end  -- a value quoted in it was long
  error(where .. text, 0)
end

--- Raises an error that points at the innermost line of the user's own code.
local function fail(format, ...) raise(core.where(), format, ...) end
registry.fail = fail

--- Raises an error that points at a place noted before (registry.where): of the rule that is wrong, not of the call that
-- found it out.
function registry.fail_at(where, format, ...) raise(where == "" and "" or where .. ": ", format, ...) end

--- The innermost line of the user's own code, as "file:line".
function registry.where() return (core.where():gsub(":%s*$", "")) end

-- Types ------------------------------------------------------------------------------------------------------------

local function finite(v) return v == v and v ~= math.huge and v ~= -math.huge end

local function digits(v) return string.format(v == math.floor(v) and math.abs(v) < 1e16 and "%.0f" or "%.14g", v) end

local function range_words(spec)
  local words = {}
  if spec.min and spec.max then words[1] = string.format("from %s to %s", digits(spec.min), digits(spec.max))
  elseif spec.min then words[1] = string.format("%s or more", digits(spec.min))
  elseif spec.max then words[1] = string.format("%s or less", digits(spec.max)) end
  if spec.above then words[#words + 1] = string.format("greater than %s", digits(spec.above)) end
  if spec.below then words[#words + 1] = string.format("less than %s", digits(spec.below)) end
  return #words > 0 and " " .. table.concat(words, " and ") or ""
end

local function in_range(v, spec)
  if not spec.infinite and not finite(v) then return false end
  return not (spec.min and not (v >= spec.min) or spec.max and not (v <= spec.max)
    or spec.above and not (v > spec.above) or spec.below and not (v < spec.below))
end

local types = {}

types.any = { words = function() return "a value" end, is = function(v) return v ~= nil end }
types.boolean = { words = function() return "true or false" end, is = function(v) return type(v) == "boolean" end }
types["function"] = { words = function() return "a function" end, is = function(v) return type(v) == "function" end }
types.table = { words = function() return "a table" end, is = function(v) return type(v) == "table" end }
types.number = {
  words = function(spec) return "a number" .. range_words(spec) end,
  is = function(v, spec) return type(v) == "number" and in_range(v, spec) end,
}
types.integer = {
  words = function(spec) return "a whole number" .. range_words(spec) end,
  is = function(v, spec) return type(v) == "number" and finite(v) and v == math.floor(v) and in_range(v, spec) end,
}
types.string = {
  words = function(spec)
    if spec.choices then return "one of '" .. table.concat(spec.choices, "', '") .. "'" end
    return "text"
  end,
  is = function(v, spec)
    if type(v) ~= "string" then return false end
    if not spec.choices then return true end
    for _, choice in ipairs(spec.choices) do
      if v == choice then return true end
    end
    return false, core.did_you_mean(v, spec.choices)
  end,
}
types.vector = {
  words = function() return "a point or direction { x, y } or { x, y, z }" end,
  is = function(v)
    if type(v) ~= "table" or not (#v == 2 or #v == 3) then return false end
    for i = 1, #v do
      if type(v[i]) ~= "number" or not finite(v[i]) then return false end
    end
    return true
  end,
}
types.column = {
  words = function(spec) return "the name of a column of the " .. (spec.of or "cell") .. "s" end,
  is = function(v, spec, self)
    if type(v) ~= "string" then return false end
    local names = core.columns(core.kind(self) == "tissue" and self or core.tissue_of(self), spec.of or "cell")
    for _, name in ipairs(names) do
      if name == v then return true end
    end
    return false, core.did_you_mean(v, names)
  end,
}
types.list = {
  words = function(spec)
    local count = spec.count and (spec.count[1] == spec.count[2] and spec.count[1] .. " items" or spec.count[2] and
      string.format("%d to %d items", spec.count[1], spec.count[2]) or spec.count[1] .. " or more items") or "items"
    return "a list of " .. count .. (spec.of and ", each " .. registry.expected({ type = spec.of }) or "")
  end,
  is = function(v, spec, self)
    if type(v) ~= "table" then return false end
    if spec.count and (#v < spec.count[1] or spec.count[2] and #v > spec.count[2]) then return false end
    for i = 1, #v do
      if spec.of and not registry.matches(v[i], { type = spec.of }, self) then
        return false, "; item " .. i .. " is " .. core.describe(v[i])
      end
    end
    return true
  end,
}
for _, kind in ipairs { "cell", "wall", "side", "junction", "tissue" } do
  types[kind] = { words = function() return "a " .. kind end, is = function(v) return core.kind(v) == kind end }
end

--- Adds a type for argument specifications, and as owner of methods: `methods` is the table that gets the functions of
-- operations named "name:...".
function registry.type(name, words, is, methods)
  assert(not types[name], "type " .. name .. " is declared twice")
  types[name] = { words = function() return words end, is = is, methods = methods }
end

local lists = {}  -- by what a specification says, "number|function": the names

local function types_of(spec)
  local list = lists[spec.type]
  if not list then
    list = {}
    for name in spec.type:gmatch "[^|]+" do list[#list + 1] = name end
    lists[spec.type] = list
  end
  return list
end

function registry.expected(spec)
  local words = {}
  for _, name in ipairs(types_of(spec)) do words[#words + 1] = types[name].words(spec) end
  return table.concat(words, ", or ")
end

--- True if the value fits the specification; else false and what may help ("; did you mean ...").
function registry.matches(value, spec, self)
  local hint = ""
  for _, name in ipairs(types_of(spec)) do
    local ok, more = types[name].is(value, spec, self)
    if ok then return true end
    hint = more and more ~= "" and more or hint
  end
  return false, hint
end

-- Checking ---------------------------------------------------------------------------------------------------------

local function check_value(entry, spec, value, self)
  if value == nil then
    if spec.required then fail("%s: '%s' is missing: %s", entry.title, spec.name, registry.expected(spec)) end
    return spec.default
  end
  local ok, hint = registry.matches(value, spec, self)
  if not ok then
    fail("%s: '%s' must be %s, came %s%s", entry.title, spec.name, registry.expected(spec), core.describe(value), hint)
  end
  return value
end

local function check_positional(entry, self, ...)
  local given, count = { ... }, #entry.args
  for i = count + 1, select("#", ...) do
    if given[i] ~= nil then
      fail("%s takes %s, came one more: %s", entry.title, count == 0 and "no arguments" or count == 1 and "1 argument" or
        count .. " arguments", core.describe(given[i]))
    end
  end
  for i = 1, count do given[i] = check_value(entry, entry.args[i], given[i], self) end
  return unpack(given, 1, count)
end

local function names_of(entry)
  local names = {}
  for i, spec in ipairs(entry.args) do names[i] = spec.name end
  return names
end

--- Moves t[1], t[2] ... to the options that may be given by position.
local function check_key(entry, key, value, out)
  for _, spec in ipairs(entry.args) do
    if spec.position == key then
      if out[spec.name] ~= nil then fail("%s: '%s' is given twice", entry.title, spec.name) end
      out[spec.name] = value
      return
    end
  end
  if entry.rest and type(key) == "string" then
    out[key] = value
    return
  end
  local names = names_of(entry)
  local hint = type(key) == "string" and core.did_you_mean(key, names) or ""
  if hint == "" then hint = #names > 0 and "; the options are: " .. table.concat(names, ", ") or "; it has none" end
  fail("%s: there is no option %s%s", entry.title, (core.describe(key):gsub("^the text ", "")), hint)
end

local function gather(entry, ...)
  local given = ...
  if type(given) == "table" and select("#", ...) == 1 and not entry.plain_table then return given end
  local positional = {}
  for i = 1, select("#", ...) do
    local value = select(i, ...)
    if value ~= nil then positional[i] = value end
  end
  if next(positional) and not entry.positions then
    fail("%s takes a table of options: %s { ... }, came %s", entry.title, entry.title, core.describe(given))
  end
  return positional
end

local function check_named(entry, self, ...)
  local given, out, by_key, args = gather(entry, ...), {}, entry.by_key, entry.args
  local others = getmetatable(given) ~= nil  -- one like tunica.params shows what it holds to `pairs` alone
  for key, value in next, given do
    if by_key[key] then out[key] = value else others = true end
  end
  if others then
    for key, value in pairs(given) do
      if not by_key[key] then check_key(entry, key, value, out) end
    end
  end
  for i = 1, #args do
    local spec = args[i]
    local name = spec.name
    if out[name] ~= nil or spec.required then check_value(entry, spec, out[name], self) else out[name] = spec.default end
  end
  if entry.rest then
    for key, value in pairs(out) do
      if not by_key[key] then
        check_value(entry, setmetatable({ name = key }, { __index = entry.rest }), value, self)
      end
    end
  end
  return out
end

-- Declaring --------------------------------------------------------------------------------------------------------

-- Owners whose functions have no self.
local modules = { tunica = {}, prompt = {} }

local function make_function(entry)
  local fn, check = entry.fn, entry.kind == "named" and check_named or check_positional
  if modules[entry.owner] then
    return function(...) return fn(check(entry, nil, ...)) end
  end
  local is = types[entry.owner].is
  return function(self, ...)
    if registry.tracing then
      fail("%s gives what holds at one moment, so a rule that calls it cannot be traced", entry.name)
    end
    if entry.changes and core.in_rule() then fail("%s: a rule cannot call it; rules only compute", entry.name) end
    if not is(self) then
      fail("%s: write it with a colon, behind a %s; before the colon came %s", entry.name, entry.owner, core.describe(self))
    end
    if registry.before_change and (entry.changes or entry.runs) then registry.before_change(self) end
    return fn(self, check(entry, self, ...))
  end
end

local function check_declaration(entry)
  local owner, mark, member = entry.name:match("^(%a+)([.:])([%a_][%w_]*)$")
  assert(owner, "an operation is named owner:method, owner.property or tunica.function, not " .. entry.name)
  assert(not by_name[entry.name], entry.name .. " is declared twice")
  assert(entry.doc and entry.doc ~= "", entry.name .. " has no doc")
  assert(type(entry.fn) == "function", entry.name .. " has no fn")
  entry.owner, entry.member = owner, member
  entry.title = owner == "prompt" and member or entry.name  -- as it is written
  entry.kind, entry.args = entry.kind or "positional", entry.args or {}
  assert((mark == ":") == (not modules[owner] and entry.kind ~= "property"), entry.name .. ": wrong mark for its kind")
  entry.by_key = {}
  for i, spec in ipairs(entry.args) do
    assert(spec.name and spec.type, entry.name .. ": argument " .. i .. " needs name and type")
    for _, name in ipairs(types_of(spec)) do assert(types[name], entry.name .. ": there is no type " .. name) end
    entry.by_key[spec.name] = spec
    entry.positions = entry.positions or spec.position ~= nil
  end
end

--- Declares an operation (see the top of this file) and returns its checked function.
function registry.op(entry)
  check_declaration(entry)
  by_name[entry.name], entries[#entries + 1] = entry, entry
  if entry.kind == "property" then
    core.properties[entry.owner][entry.member] = entry.fn
    return entry.fn
  end
  entry.call = make_function(entry)
  local methods = modules[entry.owner] or core.methods[entry.owner] or types[entry.owner].methods
  assert(methods, "nothing is known of the owner of " .. entry.name)
  methods[entry.member] = entry.call
  return entry.call
end

--- True while a rule is called with symbols: operations on real cells, tissues and models are then errors.
registry.tracing = false

--- Set by the prompt: function(self), called before an operation that changes something.
registry.before_change = nil

--- The functions of the module `tunica`, and those that only the prompt has.
registry.module, registry.prompt = modules.tunica, modules.prompt

--- Every entry, in the order of declaration.
function registry.all()
  local copy = {}
  for i, entry in ipairs(entries) do copy[i] = entry end
  return copy
end

--- The entry of a name ("tissue:divide", "tunica.sheet"), or nil and the nearest name's hint.
function registry.find(name)
  if by_name[name] then return by_name[name] end
  local names = {}
  for i, entry in ipairs(entries) do names[i] = entry.name end
  return nil, core.did_you_mean(tostring(name), names)
end

return registry
