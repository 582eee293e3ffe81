-- SPDX-License-Identifier: MIT
-- What a script sees of patterns of primordia; the reading itself is tested in tests/field.
local tunica = require "tunica"
local check = require "check"

local function spiral(count, angle, rise)
  local list = {}
  for i = 1, count do
    local theta = math.rad(i * angle)
    list[i] = { angle = i * angle, time = 0.5 * i, x = math.cos(theta), y = -rise * (count - i), z = math.sin(theta) }
  end
  return list
end

local pattern = tunica.pattern(spiral(40, 137.5, 0.02))
check.equal(pattern.name, "Fibonacci spiral")
check.near(pattern.mean, 137.5, 1e-9)
check.near(pattern.plastochron.mean, 0.5, 1e-12)
check.equal(#pattern.raw, 39)
check.equal(#pattern.order, 40)
check.equal(pattern.hand, 1)
assert(tunica.sequence { pattern.pair[1], pattern.pair[2] }.name == "Fibonacci spiral")
assert(pattern.interval[1] < 137.5 and pattern.interval[2] > 137.5)
assert(tostring(pattern):find("Fibonacci spiral: 40 primordia", 1, true), tostring(pattern))
assert(#pattern.evidence >= 3 and pattern.judgement == nil)

-- Plain angles, radii, and places without angles.
check.equal(tunica.pattern({ 0, 180, 0, 180, 0, 180, 0, 180 }).name, "distichous")
check.equal(tunica.pattern({ 0, 180, 90, 270, 0, 180, 90, 270, 0, 180 }).name, "decussate")
local outer, bare = {}, {}
for i = 1, 30 do
  outer[i] = { angle = -137.5 * i, radius = 1.1 ^ (30 - i) }
  bare[i] = { x = outer[i].radius * math.cos(math.rad(outer[i].angle)), z = outer[i].radius * math.sin(math.rad(outer[i].angle)) }
end
check.near(tunica.pattern(outer).ratio.mean, 1.1, 1e-9)
check.equal(tunica.pattern(outer).hand, -1)
check.equal(tunica.pattern(bare).pair[2], tunica.pattern(outer).pair[2])
check.equal(tunica.pattern({}).name, "too few")
check.equal(tunica.pattern({ 1, 2, 3 }).enough, false)

-- A part of the list; expectations.
local half = tunica.pattern(spiral(40, 137.5, 0.02), { first = 21, expected = { angle = 137.51 } })
check.equal(half.primordia, 20)
check.equal(half.order[1], 21)
assert(half.judgement.lenient and half.judgement.strict and half.judgement.hold, half.judgement.why)
local wrong = tunica.pattern(spiral(40, 137.5, 0.02), { expected = { angle = 68.75, jugacy = 2, pair = { 6, 10 } } })
assert(not wrong.judgement.lenient and wrong.judgement.why:find("intra", 1, true), wrong.judgement.why)
check.equal(tunica.pattern(spiral(40, 137.5, 0.02), { jugacy = 2 }).jugacy, 2)

check.fails(function() local p = tunica.pattern({ 0, 10, "x" }) end, "primordium 3", "came the text 'x'")
check.fails(function() local p = tunica.pattern({ { angel = 3 } }) end, "primordium 1 has no 'angle'")
check.fails(function() local p = tunica.pattern({ { angle = 0 / 0 } }) end, "'angle' of primordium 1", "nan")
check.fails(function() local p = tunica.pattern({ { angle = 1, radius = -1 } }) end, "'radius' of primordium 1")
check.fails(function() local p = tunica.pattern({ { angle = 0, time = 2 }, { angle = 1, time = 1 } }) end, "oldest first")
check.fails(function() local p = tunica.pattern({ 1 }, { jugacyy = 2 }) end, "did you mean 'jugacy'?")
check.fails(function() local p = tunica.pattern({ 1 }, { jugacy = 0 }) end, "'jugacy' must be a whole number from 1")
check.fails(function() local p = tunica.pattern({ 1 }, { expected = { angl = 1 } }) end, "did you mean 'angle'?")
check.fails(function() local p = tunica.pattern({ 1 }, { expected = { angle = 100, jugacy = 2 } }) end, "from 0 to 90 degrees")

-- Numbers of pairs.
local low, high = tunica.allowable_interval { 5, 8 }
check.near(low, 135, 1e-9)
check.near(high, 144, 1e-9)
check.near(select(2, tunica.allowable_interval { 8, 13 }), 138.4615, 1e-4)
check.equal(tunica.allowable_interval { 8, 13, angle = 100 }, nil)
local lucas = tunica.sequence { 6, 8, count = 4 }
check.equal(table.concat(lucas, " "), "2 6 8 14")
check.equal(lucas.name, "bijugate Lucas spiral")
check.near(lucas.limit, 49.7508, 1e-4)
assert(tostring(lucas):find "<2, 6, 8, 14, ...>")
check.fails(function() local s = tunica.sequence { 6, 8, jugacy = 1 } end, "jugacy 2")
check.fails(function() local s = tunica.sequence { 0, 8 } end, "'m' must be")

-- Files.
local path = os.tmpname()
local function written(text)
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
  return path
end
local list = tunica.read_primordia(written 'Angle (deg),"time [h]",note\r\n0,0,first\r\n137.5,1,"a, ""quoted""\nnote"\r\n275,2,\r\n')
check.equal(#list, 3)
check.equal(list[3].angle, 275)
check.equal(list[2].time, 1)
list = tunica.read_primordia(written "\239\187\191divergence;radius\n;3\n137;2\n\n140;1")
check.equal(list[3].angle, 277)
check.equal(list[1].radius, 3)
list = tunica.read_primordia(written "x\ty\tz\r1\t0\t0\r0\t0\t1\r")
check.equal(#tunica.pattern(list).raw, 1)
check.near(tunica.pattern(list).raw[1], 90, 1e-9)
check.fails(function() local l = tunica.read_primordia(written "angle\n1\nx") end, ":3: angle must be a number", "came 'x'")
check.fails(function() local l = tunica.read_primordia(written "angle;time\n1;2\n1,5;3") end, ":3: angle must be a number with a decimal point")
check.fails(function() local l = tunica.read_primordia(written "angle,time\n1,2\n3") end, ":3: 1 values, but the first line has 2")
check.fails(function() local l = tunica.read_primordia(written "anglle\n1") end, ":1: column 'anglle'", "did you mean 'angle'?")
check.fails(function() local l = tunica.read_primordia(written "width\n1") end, ":1: the first line must name the columns")
check.fails(function() local l = tunica.read_primordia(written "angle,angle\n1,1") end, "two columns 'angle'")
check.fails(function() local l = tunica.read_primordia(written 'angle,note\n1,"open') end, ":2: a quoted value does not end")
check.fails(function() local l = tunica.read_primordia(written "angle,time\n1,2\n3,1") end, ":3: the time falls")
check.fails(function() local l = tunica.read_primordia(written "angle,time\n,2") end, ":2: this primordium has no angle")
check.fails(function() local l = tunica.read_primordia(written "angle\n1e999") end, ":2: angle must be")
check.fails(function() local l = tunica.read_primordia(written "") end, "the file is empty")
check.fails(function() local l = tunica.read_primordia(written "a\0b") end, "zero byte")
check.fails(function() local l = tunica.read_primordia "/" end, "cannot read")
check.fails(function() local l = tunica.read_primordia "no/such/file.csv" end, "cannot read no/such/file.csv")
os.remove(path)

-- Each figure is explained in share/doc/patterns.md.
do
  local text = assert(io.open((arg[0]:match "^.*/" or "./") .. "../../share/doc/patterns.md")):read "*a"
  local list = {}
  for i = 1, 30 do list[i] = { angle = i * 137.5, time = i, radius = 2 ^ ((30 - i) / 10) } end
  local pattern = tunica.pattern(list, { expected = { angle = 137.5, pair = { 5, 8 } } })
  local names = 0
  for name in pairs(pattern) do
    names = names + 1
    if name ~= "evidence" then assert(text:find("\n|[^|]*`" .. name .. "[%[`]"), name) end
  end
  assert(names > 30, names)
  for name in pairs(pattern.judgement) do assert(text:find(name, 1, true), name) end
end
