-- SPDX-License-Identifier: MIT
-- The editor of curves without a terminal: pictures as text, keys, mouse; curves as text; where a result goes.
local tunica = require "tunica"
local core = require "tunica.core"
local screen = require "tunica.prompt.screen"
local curve_editor = require "tunica.prompt.curve_editor"
local picture = require "tunica.prompt.curve_picture"
local check = require "check"

-- Curves as text --------------------------------------------------------------------------------------------------------

local f = tunica.curve "0,0.3 0.5,1 2,1"
check.equal(f(0), 0.3)
check.equal(f(2), 1)
check.equal(f:text(), "0,0.3 0.5,1 2,1")
check.near(tunica.curve("0,.3 .5,1 2,1 degree=1")(0.25), 0.65, 1e-15)
check.equal(tunica.curve("  -1,2e-3\n 4,5 ")(4), 5)
check.equal(tunica.contour("0,0 1,0 1,1 0,1 ends=closed"):text(), "0,0 1,0 1,1 0,1 ends=closed")
check.equal(tunica.contour("0,0 1,0 1,1 degree=1"):length(), 2)
check.equal(tunica.curve("3,0.1"):text(), "3,0.1")
for _, each in ipairs { tunica.curve "raised", tunica.curve { { 0, 1 / 3 }, { 1e-9, 2 }, { 5, -1 }, { 5, 2 }, { 7, 1e20 } } } do
  local again = tunica.curve(each:text())
  for x = -1, 8, 0.37 do check.equal(again(x), each(x), "a curve and its text") end
end
check.equal(tunica.contour(tunica.contour("dome"):text()):length(), tunica.contour("dome"):length())
check.fails(function() tunica.curve "0,1 2" end, "expected x,y or degree=3", "came '2'")
check.fails(function() tunica.curve "0,1 1,2 dgree=2" end, "came 'dgree=2'")
check.fails(function() tunica.curve "0,1 1,2 degree=9" end, "'degree'")
check.fails(function() tunica.curve "0,1 1,2 ends=open" end, "'ends' belongs to a contour")
check.fails(function() tunica.contour "0,1 1,2 3,3 ends=shut" end, "one of 'open', 'clamped', 'closed'")
check.fails(function() tunica.curve "1,1 0,1" end, "x must not decrease")
check.fails(function() tunica.curve "0,nan 1,1" end, "point")
check.fails(function() tunica.curve "0,1/2" end, "no curve and no file")
check.equal(tunica.apex { profile = "0,0 1,0 1,-2", growth = "0,1 1,2" }:growth(1), 2)

-- The picture -----------------------------------------------------------------------------------------------------------

local function editor(points, more)
  local o = { kind = "curve", points = points, degree = 3 }
  for key, value in pairs(more or {}) do o[key] = value end
  return assert(curve_editor.new(o))
end

local function text_of(e, width, height) return picture.text((e:draw(width, height))) end

local line = editor({ { 0, 0 }, { 1, 1 }, { 2, 0 } }, { degree = 1, title = "tent" })
line:press "1"
check.equal(text_of(line, 40, 16), [[
tent (changed): curve, 3 points, degr...
 1.1|               o*
    |             ******
    |           ***    ***
    |         ***        ***
0.55|       ***            **
    |     ***                **
    |   ***                    **
    |  **                       ***
   0|@*                           **o
    +-----------------------------------
     0               1.1             2.2
point 1 of 3: 0, 0; step 0.02
f(0) = 0, f(2) = 0, most 1 at 1
arrows move, Tab next, a add, d delete,
u undo, s to a file, Enter done, Ctrl...]], "the picture")

--- Every row fills at most the width, and there are at most `height`.
local function fits(e, width, height)
  local rows = 0
  for row in (text_of(e, width, height) .. "\n"):gmatch "(.-)\n" do
    rows = rows + 1
    assert(screen.length(row) <= width, width .. ": " .. row)
  end
  assert(rows <= height, rows .. " rows of " .. height)
end

local dome, dome_degree, dome_ends = tunica.contour("dome"):points()
local closed = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }
for _, unicode in ipairs { false, true } do
  screen.unicode = unicode
  for _, e in ipairs { line, editor(dome, { kind = "contour", degree = dome_degree, ends = dome_ends, profile = true }),
    editor(closed, { kind = "contour", ends = "closed" }), editor { { 3, 5 } }, editor { { 3, 0 } }, editor { { 1, 1 }, { 1, 2 } },
    editor { { -1e14, 1e-14 }, { 1e14, 2e-14 } }, editor { { 0, 1 }, { 1e-12, 1 } },
    editor({ { 1, 1 }, { 1, 1 } }, { kind = "contour" }) } do
    for _, size in ipairs { { 20, 8 }, { 40, 10 }, { 40, 24 }, { 80, 24 }, { 81, 25 }, { 200, 60 }, { 10, 5 }, { 30, 7 }, { 1, 1 } } do
      fits(e, size[1], size[2])
      e:press "s"
      fits(e, size[1], size[2])
      e:press "ctrl-c"
    end
  end
end
-- A circle is as high as wide: a character is twice as high as wide.
local round = editor({ { 1, 0 }, { 1, 1 }, { -1, 1 }, { -1, -1 }, { 1, -1 } }, { kind = "contour", ends = "closed" })
round:draw(81, 30)
local c0, r0 = round.frame.cell(-1, -1)
local c1, r1 = round.frame.cell(1, 1)
check.near((c1 - c0) / (r0 - r1), 2, 1e-12, "the same scale in both directions")
screen.unicode = false

-- Keys ------------------------------------------------------------------------------------------------------------------

local function typed(e, keys)
  for key in keys:gmatch "%S+" do e:press(key) end
  return e
end

local function expect(e, text) check.equal(e:text(), text) end

local start = { { 0, 0.3 }, { 0.5, 1 }, { 2, 1 } }
expect(typed(editor(start), "up up right"), "0.02,0.34 0.5,1 2,1")
expect(typed(editor(start), "shift-down n left"), "0,0.298 0.48,1 2,1")
expect(typed(editor(start), "+ up - - up"), "0,0.502 0.5,1 2,1")
expect(typed(editor(start), "backtab a"), "0,0.3 0.5,1 2,1 3.5,1")
expect(typed(editor(start), "tab a d d"), "0,0.3 0.5,1")
expect(typed(editor(start), "d d d d"), "2,1")
expect(typed(editor(start), "right right n d u u u"), "0,0.3 0.5,1 2,1")
expect(typed(editor(start), "right right n d u u u r r u"), "0.04,0.3 0.5,1 2,1")
expect(typed(editor(start), "1 up"), "0,0.32 0.5,1 2,1 degree=1")
expect(typed(editor(closed, { kind = "contour", ends = "closed" }), "d d d"), "1,0 1,1 0,1 degree=3 ends=closed")
check.equal(typed(editor(start), "q").outcome, "accept")
check.equal(typed(editor(start), "d enter").outcome, "accept")
check.equal(typed(editor(start), "d ctrl-c").outcome, "leave")
check.equal(typed(editor(start), "u x escape other").outcome, nil)
-- Functions keep their points in order; contours need not.
expect(typed(editor({ { 0, 0 }, { 0.01, 1 }, { 1, 0 } }), "right right"), "0.01,0 0.01,1 1,0")
expect(typed(editor({ { 0, 0 }, { 0.01, 1 }, { 1, 0 } }, { kind = "contour" }), "right right"), "0.04,0 0.01,1 1,0")
-- What would be refused is said, and not taken.
local profile = editor({ { 0, 0 }, { 1, 0 }, { 1, -2 } }, { kind = "contour", profile = true })
typed(profile, "+ left left left enter")
assert(not profile.outcome and profile.wrong, "a profile across the axis")
assert(text_of(profile, 40, 24):find "refused: ", text_of(profile, 40, 24))
typed(profile, "u enter")
check.equal(profile.outcome, "accept")
-- Many points are too much.
local many = {}
for i = 1, 2000 do many[i] = { i, 0 } end
check.equal(select(2, curve_editor.new { kind = "curve", points = many, degree = 3 }),
  "a curve of 2000 points is too much for an editor of points (at most 1000)")

-- Mouse -----------------------------------------------------------------------------------------------------------------

local m = editor(start)
m:draw(80, 40)
local function cell(i)
  local c, r = m.frame.cell(m.points[i][1], m.points[i][2])
  return math.floor(c + 0.5) + m.frame.left, math.floor(r + 0.5) + m.frame.top
end
local c, r = cell(2)
m:press("mouse-press", c + 1, r)
m:press("mouse-release", c + 1, r)
check.equal(m.selected, 2)
m:press("mouse-press", c, r)
m:press("mouse-release", c + 30, r + 10)
assert(m.points[2][1] > 0.5 and m.points[2][2] < 1, m:text())
assert(#m:text() < 30, "few digits: " .. m:text())
m:press "u"
expect(m, "0,0.3 0.5,1 2,1")
c, r = cell(3)
m:press("mouse-press", c - 10, r + 8)
m:press("mouse-release", c - 10, r + 8)
check.equal(#m.points, 4)
check.equal(m.selected, 3)
m:press("mouse-other", c - 10, r + 8)
expect(m, "0,0.3 0.5,1 2,1")
for _, place in ipairs { { 0, 0 }, { 79, 39 }, { -5, 3 }, { 500, 2 } } do
  m:press("mouse-press", place[1], place[2])
  m:press("mouse-release", place[1], place[2])
end
expect(m, "0,0.3 0.5,1 2,1")

-- Any keys whatever: no error, points in order, undone to the start.
local names = { "up", "down", "left", "right", "shift-up", "shift-left", "shift-right", "shift-down", "tab", "backtab", "a", "d", "u", "r",
  "e", "f", "s", "+", "-", "1", "2", "3", "?", "enter", "backspace", "ctrl-u", "home", "end", "ü", "0", ",", "9", "mouse-press",
  "mouse-release", "mouse-other", "escape" }
for case = 1, 30 do
  local kind = ({ "curve", "contour", "closed" })[case % 3 + 1]
  local e = kind == "curve" and editor(start) or editor(closed, { kind = "contour", ends = kind == "closed" and "closed" or "clamped" })
  local before = e:text()
  e.save = function() error "no" end
  local x = case
  for i = 1, 200 do
    x = (x * 16807) % 2147483647
    if i % 8 == 0 then e:draw(60, 24) end
    local key = names[x % #names + 1]
    e:press(key, math.floor(x / 7) % 60, math.floor(x / 11) % 24)
    for k = 2, #e.points do assert(kind ~= "curve" or e.points[k][1] >= e.points[k - 1][1], "order after " .. key) end
    assert(e.selected >= 1 and e.selected <= #e.points, key)
  end
  e:press "ctrl-c" e:press " "
  e.question, e.helping = nil, false
  for _ = 1, 301 do e:press "u" end
  expect(e, before)
end

-- Where the result goes -------------------------------------------------------------------------------------------------

local desk = require "tunica.prompt.desk"
local work = require "tunica.prompt.work"
local folder = os.tmpname()
os.remove(folder)
core.mkdir(folder)
local said
local write = io.write
io.write = function(...) said = said .. table.concat({ ... }) end -- luacheck: ignore
local g = setmetatable({}, { __index = _G })
for name, fn in pairs(work) do rawset(g, name, fn) end
g.tunica, desk.globals = tunica, g

local function run(text)
  said = ""
  desk.begin_line(text)
  local chunk = assert(loadstring(text, "=(prompt)"))
  setfenv(chunk, g)
  local ok, result = pcall(chunk)
  desk.end_line(ok)
  return ok, result
end
local function tell(text, expected)
  local ok, result = run(text)
  if not ok or not said:find(expected or "", 1, true) then error(text .. " said: " .. said .. tostring(result), 2) end
  return result
end
local function refused(text, expected)
  local ok, message = run(text)
  if ok or not message:find(expected, 1, true) then error(text .. ": " .. tostring(message), 2) end
end

core.write_atomic(folder .. "/m.lua", [[
local tunica = require "tunica"
local P = tunica.params { size = { 1, "of it" }, made = { "0,1 1,2", "rate" }, other = { "0,1 1,2", "rate" }, word = { "hello" } }
local made, other = tunica.curve(P.made), tunica.curve(P.other)
local tissue = tunica.ring { 5 }
tissue:cell { s = 0 }
local model = tunica.model { tissue = tissue, params = P, dt = 0.1 }
model:every(0.1, function() for c in tissue:cells() do c.s = c.s + made(0) + 0 * other(0) end end)
return model
]])
refused("edit_curve()", "which curve?")
refused("edit_curve 'nothing'", "no curve and no file is called 'nothing'")
refused("edit_curve(5)", "'which' must be")
tell('load "' .. folder .. '/m.lua"')
refused("edit_curve()", 'edit_curve "made", edit_curve "other"')
refused("edit_curve(P.made, '0,1 1,1')", "is the value of the parameters made and other")
refused("edit_curve 'word'", "no curve and no file is called 'word'")
refused("edit_curve('mad', '0,1 1,1')", "did you mean 'made'")
refused("edit_curve('made', '1,1 0,1')", "x must not decrease")
refused("edit_curve 'made'", "needs the prompt, in a terminal")
check.equal(g.P.made, "0,1 1,2")
tell "model:advance(0.1)"
local before = g.tissue:mean "s"
tell("edit_curve('made', '0,5 1,2')", "made: 0,1 1,2 -> 0,5 1,2; the state at t = 0.1 is kept")
check.equal(g.P.made, "0,5 1,2")
tell "model:advance(0.2)"
check.near(g.tissue:mean "s" - before, 5, 1e-12, "the new curve takes effect")
tell("edit_curve(P.made, { { 0, 7 }, { 1, 2 } })", "made: 0,5 1,2 -> 0,7 1,2")
tell "reload()"
check.equal(g.P.made, "0,7 1,2")
tell "set { size = 2 }"
tell("edit_curve('other', tunica.curve '0,1 1,3 degree=1')", "other: 0,1 1,2 -> 0,1 1,3")
assert(g.P.made == "0,7 1,2" and g.P.size == 2, "what else was changed stays")
tell("edit_curve('other', '0,1 1,3')", "other is as it was")
tell("P.made = '0,4 1,4'")
tell("edit_curve('made', '0,2 1,2')", "made: 0,4 1,4 -> 0,2 1,2")
check.equal(g.P.made, "0,2 1,2")
tell("undo()", "edit_curve")
check.equal(g.P.made, "0,4 1,4")
check.equal(tell("c = edit_curve(tunica.curve '0,1 1,1', '0,1 2,3') return c"):text(), "0,1 2,3")
refused("edit_curve(tunica.contour 'dome', tunica.curve 'raised')", "expected a contour")
refused("edit_curve(tunica.apex {})", "'which' must be")
tell("edit_curve('" .. folder .. "/a.func', '0,1 1,2')", "written: " .. folder .. "/a.func")
check.equal(tunica.curve(folder .. "/a.func")(1), 2)
refused("edit_curve('" .. folder .. "/none/a.func', '0,1 1,2')", "none/a.func")
io.write = write -- luacheck: ignore
core.remove_all(folder)
