-- SPDX-License-Identifier: MIT
-- Contours, curves and apices as scripts see them.
local tunica = require "tunica"
local check = require "check"

-- Contours.
local line = tunica.contour { { 0, 0 }, { 3, -4 } }
local x, y, tx, ty = line:at(0.5)
check.near(x, 1.5, 1e-15)
check.near(y, -2, 1e-15)
check.near(tx, 0.6, 1e-15)
check.near(ty, -0.8, 1e-15)
local points, degree, ends = line:points()
check.equal(#points, 2)
check.equal(degree, 1)
check.equal(ends, "clamped")
check.near(select(1, line:scaled(2):at(1)), 6, 1e-15)
check.near(select(2, line:reversed():at(0)), -4, 1e-15)
check.equal(tostring(tunica.contour "dome"), "contour 'dome' of 10 points, degree 3")

-- By arc length, closed or not.
local square = tunica.contour { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 }, degree = 1, ends = "closed" }
check.near(square:length(), 8, 1e-14)
check.near(square:area(), 4, 1e-14)
check.near(square:reversed():area(), -4, 1e-14)
check.near(square:scaled(3):length(), 24, 1e-13)
for _, s in ipairs { 3, 11, -5 } do  -- it goes round
  local px, py = square:along(s)
  check.near(px, 2, 1e-13)
  check.near(py, 1, 1e-13)
  check.near(select(2, square:tangent(s)), 1, 1e-14)
end
local s, sx, sy = square:closest(3, 1.5)
check.near(s, 3.5, 1e-13)
check.near(sx, 2, 1e-14)
check.near(sy, 1.5, 1e-13)
check.near(line:length(), 5, 1e-14)
check.near(select(2, line:along(2.5)), -2, 1e-14)
check.near(select(2, line:along(line:length())), -4, 1e-14)
check.near(tunica.contour({ { 0, 0 }, { 1, 0 }, { 2, -4 } }):area(), -4 / 3, 1e-14)
check.fails(function() line:along(5.1) end, "'s' must be an arc length from 0 to the contour's length 5, came 5.1")
check.fails(function() line:tangent(-1) end, "arc length")
check.fails(function() line:along(1 / 0) end, "'s' must be a number")

-- Functions.
local f = tunica.curve { { 0, 0 }, { 1, 1 }, { 3, 0 }, degree = 1 }
check.near(f(2), 0.5, 1e-15)
check.equal(f(-1), 0)
check.near(f:integral(0, 3), 1.5, 1e-15)
check.near(f:derivative(2), -0.5, 1e-15)
check.equal(tunica.curve { { 0, 7 } }(3), 7)
check.near(tunica.curve "raised"(1.1015), 1, 1e-3)

-- The apex: angles in degrees.
local apex = tunica.apex { profile = "dome", growth = "raised" }
local ring = apex:arc_at_radius(1)
check.near(ring, 1.1015, 5e-5)
check.near(apex:speed(ring), 0.607, 5e-4)
local px, py, pz = apex:position(90, ring)
check.near(px, 0, 1e-15)
check.near(pz, 1, 1e-12)
local theta, a = apex:closest(px, py, pz)
check.near(theta, 90, 1e-12)
check.near(a, ring, 1e-10)
check.near(apex:after(apex:after(ring, 1.3), -1.3), ring, 1e-9)
check.near(select(2, apex:normal(0, 0)), 1, 0)
check.near(apex:profile(ring), 1, 1e-12)
local disk = tunica.apex { profile = "disk" }
check.near(disk:after(0.5, 2), 0.5 * math.exp(2), 1e-10)
check.near(disk:area(2), 4 * math.pi, 1e-10)
check.equal(select(3, tunica.apex { profile = "cylinder", growth = 0.5 }:measures()), 1)
check.near(tunica.apex { profile = { { 0, 0 }, { 1, 0 } }, growth = { { 0, 1 }, { 1, 3 } } }:speed(1), 2, 1e-14)

-- Files: names, paths relative to the script, what was written is read the same.
local path = os.tmpname()
tunica.curve { { 0, 0.1 }, { 0.3, 2 }, { 0.9, 1 }, { 1, 0.7 }, { 4, 1 } }:save(path)
check.near(tunica.curve(path)(0.9), tunica.curve { { 0, 0.1 }, { 0.3, 2 }, { 0.9, 1 }, { 1, 0.7 }, { 4, 1 } }(0.9), 0)
check.fails(function() local _ = tunica.contour(path) end, "holds functions, expected contours")
tunica.contour({ { 0, 0 }, { 1, 0 }, { 1, -1 }, { 3, -2 }, ends = "closed", name = "x" }):save(path)
local again = tunica.contour(path)
check.equal(select(3, again:points()), "closed")
check.equal(#again:points(), 4)
local file = assert(io.open(path, "w"))
file:write("funcgalleryver 1 1\nitems: 2\nfver 1 1\nname: one\npoints: 1\n0 1\nfver 1 1\nname: two\npoints: 1\n0 2\n")
file:close()
check.equal(tunica.curve(path, "two")(0), 2)
check.fails(function() local _ = tunica.curve(path) end, "holds 2 curves; name one of them: one, two")
check.fails(function() local _ = tunica.curve(path, "twq") end, "did you mean 'two'?")
file = assert(io.open(path, "w"))
file:write "fver 1 1\npoints: 2\n0 1\n1 x\n"
file:close()
check.fails(function() local _ = tunica.curve(path) end, path .. ":4: expected a number, came 'x'")
os.remove(path)

-- What is wrong is said.
check.fails(function() local _ = tunica.apex { profile = "dom" } end, "no contour and no file is called 'dom'", "did you mean 'dome'?")
check.fails(function() local _ = tunica.apex { growth = "rised" } end, "did you mean 'raised'?", "constant")
check.fails(function() local _ = tunica.contour { { 0, 0 }, { 1, 1 }, degre = 2 } end, "did you mean 'degree'?")
check.fails(function() local _ = tunica.contour { { 0, 0 }, { 1, 1 }, ends = "close" } end, "did you mean 'closed'?")
check.fails(function() local _ = tunica.contour { { 0, 0 }, { 1, 1, 1 } } end, "item 2")
check.fails(function() local _ = tunica.contour {} end, "points")
check.fails(function() local _ = tunica.curve { { 1, 0 }, { 0, 0 } } end, "point 2 (0, 0) lies left of point 1")
check.fails(function() local _ = tunica.apex { profile = { { 1, -1 }, { 0, 0 } } } end, "the other way round")
check.fails(function() local _ = tunica.apex { profile = { { 0, 0 }, { -1, -1 } } } end, "crosses the axis")
check.fails(function() local _ = apex:positon(1, 1) end, "an apex has no 'positon'", "did you mean 'position'?")
check.fails(function() apex.x = 1 end, "cannot be changed")
check.fails(function() local _ = apex:position(1, -1) end, "'a' must be a number from 0")
check.fails(function() local _ = apex:arc_at_radius(2) end, "reaches 1.4 at most")
check.fails(function() local _ = apex.position(line, 1, 1) end, "with a colon", "came a contour")
check.fails(function() local _ = f("x") end, "'x' must be a finite number")

-- A parameter may name a curve.
local P = tunica.params { profile = "cone", growth = "constant" }
check.near(tunica.apex { profile = P.profile, growth = P.growth }:arc_at_radius(1), 2, 1e-10)
