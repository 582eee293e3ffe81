-- SPDX-License-Identifier: MIT
--- Plain Lua values (numbers, text, booleans, handles, curves, tables of these) as bytes and back, and the plain values that
-- functions keep in their upvalues: what a checkpoint must hold of a script.

local core = require "tunica.core"

local plain = {}

local function is_plain_table(value) return type(value) == "table" and getmetatable(value) == nil end

local function is_handle(value)
  local kind = type(value) == "userdata" and core.kind(value)
  return (kind == "cell" or kind == "wall" or kind == "side" or kind == "junction") and kind
end

local function is_curve(value) return type(value) == "userdata" and core.shape_kind(value) == "curve" end

-- n number | s text | b boolean | h handle | c curve | t table (entries that are not plain are left out) | N nil
local function encode(value, out, open)
  local kind = type(value)
  if kind == "number" then
    out[#out + 1] = "n" .. (value ~= value and "nan" or string.format("%.17g", value)) .. ";"
  elseif kind == "string" then
    out[#out + 1] = "s" .. #value .. ":" .. value
  elseif kind == "boolean" then
    out[#out + 1] = value and "b1" or "b0"
  elseif is_handle(value) then
    out[#out + 1] = "h" .. core.kind(value) .. ":" .. core.id(value) .. ";"
  elseif is_curve(value) then
    local points, degree, name = core.curve_points(value)
    out[#out + 1] = "c" .. degree .. ";"
    encode(name, out, open)
    encode(points, out, open)
  elseif is_plain_table(value) and not open[value] then
    open[value] = true
    local entries = {}
    for k, v in pairs(value) do
      local kind_of_key = type(k)
      if (kind_of_key == "number" or kind_of_key == "string" or kind_of_key == "boolean") and plain.is_plain(v) then
        entries[#entries + 1] = { k, v }
      end
    end
    out[#out + 1] = "t" .. #entries .. ";"
    for _, entry in ipairs(entries) do
      encode(entry[1], out, open)
      encode(entry[2], out, open)
    end
    open[value] = nil
  else
    out[#out + 1] = "N"
  end
end

function plain.is_plain(value)
  local kind = type(value)
  return kind == "number" or kind == "string" or kind == "boolean" or is_plain_table(value) or is_curve(value)
    or is_handle(value) and true or false
end

function plain.encode(value)
  local out = {}
  encode(value, out, {})
  return table.concat(out)
end

local function decode(text, at, tissue)
  local mark = text:sub(at, at)
  if mark == "n" then
    local number, after = text:match("^([^;]*);()", at + 1)
    return number == "nan" and 0 / 0 or tonumber(number), after
  elseif mark == "s" then
    local size, begin = text:match("^(%d+):()", at + 1)
    return text:sub(begin, begin + size - 1), begin + size
  elseif mark == "b" then
    return text:sub(at + 1, at + 1) == "1", at + 2
  elseif mark == "h" then
    local kind, id, after = text:match("^(%a+):(%d+);()", at + 1)
    return tissue and core.handle(tissue, kind, tonumber(id)), after
  elseif mark == "c" then
    local degree, after = text:match("^(%d+);()", at + 1)
    local name, points
    name, after = decode(text, after, tissue)
    points, after = decode(text, after, tissue)
    return core.new_curve(points, tonumber(degree), name), after
  elseif mark == "t" then
    local count, after = text:match("^(%d+);()", at + 1)
    local value, key, item = {}, nil, nil
    for _ = 1, count do
      key, after = decode(text, after, tissue)
      item, after = decode(text, after, tissue)
      value[key] = item
    end
    return value, after
  end
  return nil, at + 1
end

--- The value again; handles are of `tissue`, also those whose element was gone already.
function plain.decode(text, tissue) return (decode(text, 1, tissue)) end

-- What functions keep -----------------------------------------------------------------------------------------------------

local library = "=tunica/"

local kept = setmetatable({}, { __mode = "k" })

--- An object of the library has state of its own: get() gives it as a plain table, set(table) goes back to it. It is saved
-- with the upvalue that holds the object.
function plain.keep(object, get, set) kept[object] = { get = get, set = set } end

--- Calls visit(key, value, set, whole) for each plain upvalue of the functions in `list`, and of functions these hold, in
-- an order that depends on the script alone. With `whole`, the value is a copy of an object's state.
local function each_upvalue(list, visit)
  local seen, seen_functions, number = {}, {}, 0
  local function walk(fn)
    if seen_functions[fn] or debug.getinfo(fn, "S").source:sub(1, #library) == library then return end
    seen_functions[fn] = true
    for i, upvalue in ipairs(core.upvalues(fn)) do
      local name, value, identity = upvalue[1], upvalue[2], upvalue[3]
      if not seen[identity] then
        seen[identity] = true
        number = number + 1
        if type(value) == "function" then
          walk(value)
        elseif value ~= nil and kept[value] then
          visit(number .. ":" .. name, kept[value].get(), kept[value].set, true)
        elseif value == nil or plain.is_plain(value) then
          visit(number .. ":" .. name, value, function(new) core.set_upvalue(fn, i, new) end)
        end
      end
    end
  end
  for _, fn in ipairs(list) do walk(fn) end
end

--- The plain upvalues as a table key -> value (nil ones as false under "nil:" keys).
function plain.upvalues(list)
  local values, missing = {}, {}
  each_upvalue(list, function(key, value)
    if value == nil then missing[key] = true else values[key] = value end
  end)
  return { values = values, missing = missing }
end

local simple = { number = true, string = true, boolean = true }

--- A table copied, as far as it holds numbers, text, booleans and such tables, so that `same` can compare it; else nil.
local function copy_of(value, depth)
  local copy = {}
  for k, v in pairs(value) do
    if not simple[type(k)] then return nil end
    if simple[type(v)] then
      copy[k] = v
    elseif is_plain_table(v) then
      copy[k] = depth < 10 and copy_of(v, depth + 1) or nil
      if not copy[k] then return nil end
    else
      return nil
    end
  end
  return copy
end

local function same(value, copy)
  for k, v in pairs(copy) do
    local now = value[k]
    local alike = now == v or now ~= now and v ~= v or type(v) == "table" and is_plain_table(now) and same(now, v)
    if not alike then return false end
  end
  for k in pairs(value) do
    if copy[k] == nil then return false end
  end
  return true
end

--- A function that tells whether the plain upvalues of these functions are what they are now, without gathering them. What is no
-- table is compared as it is.
function plain.watch(list)
  local watched, tables, seen = {}, {}, {}
  local function state_of(value) return kept[value] and kept[value].get() or value end
  local function watch_table(value)
    local copy = copy_of(state_of(value), 1)
    local text = not copy and plain.encode(state_of(value))
    tables[#tables + 1] = function()
      local now = state_of(value)
      if copy then return is_plain_table(now) and same(now, copy) end
      return plain.encode(now) == text
    end
  end
  local function walk(fn)
    local about = debug.getinfo(fn, "S")
    if seen[fn] or about.what == "C" or about.source:sub(1, #library) == library then return end
    seen[fn] = true
    local values = {}
    for i, upvalue in ipairs(core.upvalues(fn)) do
      local value = upvalue[2]
      values[i] = value
      if type(value) == "function" then walk(value)
      elseif value ~= nil and (kept[value] or is_plain_table(value)) then watch_table(value) end
    end
    watched[#watched + 1] = { fn, values }
  end
  for _, fn in ipairs(list) do walk(fn) end
  return function()
    for _, w in ipairs(watched) do
      if not core.same_upvalues(w[1], w[2]) then return false end
    end
    for _, unchanged in ipairs(tables) do
      if not unchanged() then return false end
    end
    return true
  end
end

--- A table keeps its identity and gets its old contents back; entries that are not plain stay.
local function refill(old, new)
  for key, value in pairs(old) do
    if new[key] == nil and plain.is_plain(value) then old[key] = nil end
  end
  for key, value in pairs(new) do
    if is_plain_table(old[key]) and is_plain_table(value) then refill(old[key], value) else old[key] = value end
  end
end
plain.refill = refill

function plain.set_upvalues(list, saved)
  each_upvalue(list, function(key, value, set, whole)
    local old = saved.values[key]
    if not whole and is_plain_table(value) and is_plain_table(old) then
      refill(value, old)
    elseif old ~= nil then
      set(old)
    elseif saved.missing[key] then
      set(nil)
    end
  end)
end

-- Globals -----------------------------------------------------------------------------------------------------------------

local at_start = {}
for name in pairs(_G) do at_start[name] = true end

--- The plain globals that the script made.
function plain.globals()
  local made = {}
  for name, value in pairs(_G) do
    if type(name) == "string" and not at_start[name] and plain.is_plain(value) then made[name] = value end
  end
  return made
end

function plain.set_globals(saved)
  for name, value in pairs(plain.globals()) do
    if saved[name] == nil then rawset(_G, name, nil) elseif is_plain_table(value) and is_plain_table(saved[name]) then refill(value, saved[name]) end
  end
  for name, value in pairs(saved) do
    if not is_plain_table(rawget(_G, name)) then rawset(_G, name, value) end
  end
end

return plain
