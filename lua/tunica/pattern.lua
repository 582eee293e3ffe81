-- SPDX-License-Identifier: MIT
--- Phyllotactic patterns: what a list of primordia is, the numbers of parastichy pairs, and measured lists from files.
--- Angles are in degrees.

local core = require "tunica.core"
local registry = require "tunica.registry"
local csv = require "tunica.csv"
local op, fail = registry.op, registry.fail

local described = { __tostring = function(self) return self.description end }

-- Options of tunica.pattern, and of what is expected.
local options = { "jugacy", "expected", "first", "last" }
local expectations = { "angle", "jugacy", "pair" }

local function check_keys(given, names, what)
  local known, unknown = {}, {}
  for _, name in ipairs(names) do known[name] = true end
  for key in pairs(given) do
    if not known[key] then unknown[#unknown + 1] = key end
  end
  if #unknown == 0 then return end
  local key = unknown[1]
  local hint = type(key) == "string" and core.did_you_mean(key, names) or ""
  if hint == "" then hint = "; there are: " .. table.concat(names, ", ") end
  fail("%s has no %s%s", what, (core.describe(key):gsub("^the text ", "")), hint)
end

op { name = "tunica.pattern", returns = "a table that prints as its description",
  args = {
    { name = "list", type = "list", required = true,
      doc = "primordia, oldest first: angles, or tables { angle =, time =, radius = | x =, y =, z =, left =, right = }; the axis is "
        .. "y, places are all of one moment; left and right: numbers of the older ones that were nearest when it arose" },
    { name = "options", type = "table",
      doc = "{ jugacy = (found if left out), first =, last = (numbers of primordia), "
        .. "expected = { angle =, jugacy =, pair = { m, n } } }" },
  },
  doc = "Reads a phyllotactic pattern: name and the evidence for it, divergence angles as they come and re-ordered along the "
    .. "generative spiral, jugacy, contact pair, allowable interval, plastochrons. With `expected`, field judgement says whether "
    .. "the rules of thesis tables 4.1 (hold) and 4.2 (lenient, strict) are met.",
  source = "thesis 4.3, tables 4.1 and 4.2",
  fn = function(list, given)
    given = given or {}
    check_keys(given, options, "the second argument of tunica.pattern")
    if type(given.expected) == "table" then check_keys(given.expected, expectations, "'expected'") end
    return setmetatable(core.read_pattern(list, given), described)
  end,
  example = [[
local tunica = require "tunica"
local angles = {}
for i = 1, 20 do angles[i] = i * 137.5 end
local pattern = tunica.pattern(angles)
print(pattern)
print(table.concat(pattern.evidence, "\n"))]] }

local function member(name, position)
  return { name = name, type = "integer", min = 1, max = 1000000, required = true, position = position,
    doc = "of the parastichy pair" }
end
local jugacy = { name = "jugacy", type = "integer", min = 1, max = 1000000,
  doc = "greatest common divisor of m and n, from which it is taken" }

op { name = "tunica.sequence", kind = "named", returns = "a list of terms, with name, limit (degrees) and jugacy",
  args = { member("m", 1), member("n", 2), jugacy,
    { name = "count", type = "integer", min = 1, max = 50, default = 10, doc = "number of terms" } },
  doc = "The sequence that holds two parastichy numbers as neighbours, from its start, and the divergence angle it converges to.",
  fn = function(t)
    local found = core.parastichy_sequence(t.m, t.n, t.jugacy, t.count)
    found.description = string.format("%s: <%s, ...>, limit %.4f degrees", found.name, table.concat(found, ", "), found.limit)
    return setmetatable(found, described)
  end,
  example = 'local tunica = require "tunica"\nprint(tunica.sequence { 7, 11 })' }

op { name = "tunica.allowable_interval", kind = "named",
  returns = "the least and the greatest angle; nil if the pair is not visible and opposed at `angle`",
  args = { member("m", 1), member("n", 2),
    { name = "angle", type = "number", min = 0, max = 360, unit = "degrees",
      doc = "that must be in it; the limit of the pair's sequence if left out" },
    jugacy },
  doc = "The divergence angles at which two families of parastichies can be visible and opposed.", source = "thesis 4.3",
  fn = function(t) return core.allowable_interval(t.m, t.n, t.angle, t.jugacy) end,
  example = 'local tunica = require "tunica"\nprint(tunica.allowable_interval { 5, 8 })' }

-- Measured primordia -----------------------------------------------------------------------------------------------

local columns = { "angle", "divergence", "time", "radius", "x", "y", "z" }

--- Column -> its place in the header. A heading may have capitals, and a unit in brackets.
local function find_columns(path, header)
  local at = {}
  for i, heading in ipairs(header.fields) do
    local name = heading:lower():gsub("[%(%[].*$", ""):match "^%s*(.-)%s*$"
    for _, column in ipairs(columns) do
      if name == column then
        if at[name] then fail("%s:%d: there are two columns '%s'", path, header.line, name) end
        at[name] = i
      end
    end
    if name ~= "" and not at[name] then
      local hint = core.did_you_mean(name, columns)
      if #name > 2 and hint ~= "" then fail("%s:%d: column '%s' is not known%s", path, header.line, name, hint) end
    end
  end
  if not (at.angle or at.divergence or at.x and at.z) then
    fail("%s:%d: the first line must name the columns, with angle, or divergence, or x and z among them (also known: time, "
      .. "radius, y); it is: %s", path, header.line, table.concat(header.fields, ", "):sub(1, 200))
  end
  return at
end

local function number_at(path, record, at, name)
  local text = at[name] and record.fields[at[name]]
  text = text and text:match "^%s*(.-)%s*$"
  if not text or text == "" then return nil end
  local value = tonumber(text)
  if not value or value ~= value or value == math.huge or value == -math.huge or text:find "^[+-]?0[xX]" then
    fail("%s:%d: %s must be a number with a decimal point, came '%s'", path, record.line, name, text:sub(1, 40))
  end
  return value
end

local function primordium(path, record, at, before)
  local one = {}
  for _, name in ipairs(columns) do
    if name ~= "divergence" then one[name] = number_at(path, record, at, name) end
  end
  local divergence = number_at(path, record, at, "divergence")
  if not one.angle and not (one.x and one.z) then
    if divergence then
      one.angle = before and before.angle + divergence or divergence
    elseif at.divergence and not before then
      one.angle = 0  -- the first has none
    else
      fail("%s:%d: this primordium has no %s", path, record.line,
        at.angle and "angle" or at.divergence and "divergence" or "x and z")
    end
  end
  if one.radius and one.radius < 0 then
    fail("%s:%d: radius must be 0 or more, came %.10g", path, record.line, one.radius)
  end
  if one.time and before and before.time and one.time < before.time then
    fail("%s:%d: the time falls: primordia are listed oldest first", path, record.line)
  end
  return one
end

op { name = "tunica.read_primordia", kind = "named", returns = "a list for tunica.pattern",
  args = { { name = "file", type = "string", required = true, position = 1,
    doc = "a text file of values separated by commas, semicolons or tabs; its first line names the columns: angle or divergence (degrees), "
      .. "time, radius, x, y, z; others are ignored" } },
  doc = "Measured primordia from a file, oldest first. Without angles, the divergences are added up, or x and z give the angle.",
  fn = function(t)
    local records = csv.read(t.file)
    if not records[1] then fail("%s: the file is empty", t.file) end
    local at, list = find_columns(t.file, records[1]), {}
    -- A divergence in the first line is that from one more, at angle 0.
    if at.divergence and not at.angle and not (at.x and at.z) and records[2] and number_at(t.file, records[2], at, "divergence") then
      list[1] = { angle = 0 }
    end
    for i = 2, #records do list[#list + 1] = primordium(t.file, records[i], at, list[#list]) end
    return list
  end }
