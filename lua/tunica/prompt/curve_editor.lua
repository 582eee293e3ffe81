-- SPDX-License-Identifier: MIT
--- The editor of a curve, without a terminal: keys go in, rows of text come out (curve_screen.lua). What drives it is edit_curve.lua.

local core = require "tunica.core"
local curve_text = require "tunica.curve_text"
local picture = require "tunica.prompt.curve_picture"
local screen = require "tunica.prompt.screen"
local curve_screen = require "tunica.prompt.curve_screen"
local values = require "tunica.prompt.values"

local editor = {}
editor.__index = editor

local most_points = 1000  -- that an editor of points is of use for
local most_undo = 500

local function clean(x) return tonumber(string.format("%.10g", x)) end

local function copy_of(points)
  local copy = {}
  for i, p in ipairs(points) do copy[i] = { p[1], p[2] } end
  return copy
end

--- An editor of { kind = "curve" or "contour", points =, degree =, ends = (contours), title = text, profile = whether a contour has
-- to serve an apex, save = function(path, shape) or nil, file = the name offered for it }.
function editor.new(o)
  local self = setmetatable({ kind = o.kind, points = copy_of(o.points), ends = o.ends or "clamped", title = o.title or o.kind,
    profile = o.profile, save = o.save, file = o.file or "", selected = 1, factor = 1, past = {}, future = {} }, editor)
  -- A degree that only the number of points has lowered is the usual one again when there are more.
  self.wanted_degree = o.degree and o.degree ~= curve_text.usual_degree(o.points) and o.degree or 3
  if #o.points > most_points then
    return nil, string.format("a curve of %d points is too much for an editor of points (at most %d)", #o.points, most_points)
  end
  self.box = picture.box(self)
  self:look()
  return self
end

-- What the curve is now -------------------------------------------------------------------------------------------------

local function reason(message) return (tostring(message):gsub("^[^%s:]+:%d+: ", "")) end

--- The curve as a value, or nil and why it would be refused.
function editor:make()
  local ok, shape
  if self.kind == "curve" then
    ok, shape = pcall(core.new_curve, self.points, self.degree)
  else
    ok, shape = pcall(core.new_contour, self.points, self.degree, self.ends)
    if ok and self.profile then
      local fits, why = pcall(core.new_apex, shape, 1)
      if not fits then return nil, reason(why) end
    end
  end
  if ok then return shape end
  return nil, reason(shape)
end

--- Where a function is greatest or least, as far as samples show it.
local function extremes(shape, points)
  local from, to = points[1][1], points[#points][1]
  local low, high
  for i = 0, 400 do
    local x = i == 400 and to or from + (to - from) * i / 400
    local y = shape(x)
    if not low or y < low[2] then low = { x, y } end
    if not high or y > high[2] then high = { x, y } end
  end
  return low, high
end

local function live(self)
  local n = values.short
  if self.kind == "contour" then return "length " .. n(core.contour_length(self.shape)) end
  local low, high = extremes(self.shape, self.points)
  local first, last = self.points[1][1], self.points[#self.points][1]
  local text = string.format("f(%s) = %s, f(%s) = %s, most %s at %s", n(first), n(self.shape(first)), n(last), n(self.shape(last)),
    n(high[2]), n(high[1]))
  if low[2] < 0 then text = text .. ", least " .. n(low[2]) .. " at " .. n(low[1]) end
  return text
end

--- After every change: degree, shape, what is wrong, what is in sight.
function editor:look()
  self.degree = math.max(1, math.min(self.wanted_degree, #self.points - 1))
  if self.ends == "closed" then self.degree = self.wanted_degree end
  self.shape, self.wrong = self:make()
  self.live = self.shape and live(self) or ""
  for _, p in ipairs(self.points) do
    local b = self.box
    if p[1] < b[1] or p[1] > b[2] or p[2] < b[3] or p[2] > b[4] then
      self.box = picture.box(self)
      break
    end
  end
end

function editor:text() return curve_text.write(self.points, self.degree, self.kind == "contour" and self.ends or nil) end

-- Changes -------------------------------------------------------------------------------------------------------------------

local function state_of(self)
  return { points = copy_of(self.points), selected = self.selected, degree = self.wanted_degree }
end

local function go_to(self, state)
  self.points, self.selected, self.wanted_degree = copy_of(state.points), state.selected, state.degree
  self:look()
end

--- Keeps the state for undo; moves of one point in a row are one change.
local function keep(self, what)
  if what ~= "add" and what == self.last_change then return end
  self.past[#self.past + 1], self.future, self.last_change = state_of(self), {}, what
  if #self.past > most_undo then table.remove(self.past, 1) end
end

local function step_back(self, from, to, nothing)
  local state = table.remove(from)
  self.last_change = nil
  if not state then
    self.message = nothing
    return
  end
  to[#to + 1] = state_of(self)
  go_to(self, state)
end

--- Puts point i to x, y; those of a function stay in order.
local function put(self, i, x, y)
  local before, after = self.points[i - 1], self.points[i + 1]
  if self.kind == "curve" then
    if before then x = math.max(x, before[1]) end
    if after then x = math.min(x, after[1]) end
  end
  if math.abs(x) > 1e15 or math.abs(y) > 1e15 then return end
  keep(self, "move " .. i)
  self.points[i] = { x, y }
  self:look()
end

--- How far an arrow moves: about a fiftieth of what is seen.
function editor:steps()
  local b = self.box
  local sx, sy = picture.step((b[2] - b[1]) / 50), picture.step((b[4] - b[3]) / 50)
  if self.kind == "contour" then sx = math.max(sx, sy); sy = sx end
  return sx * self.factor, sy * self.factor
end

local function move(self, right, up, finer)
  local sx, sy = self:steps()
  local p = self.points[self.selected]
  put(self, self.selected, clean(p[1] + right * sx / finer), clean(p[2] + up * sy / finer))
end

local function insert(self, after, x, y)
  if #self.points >= most_points then
    self.message = "there are " .. most_points .. " points already"
    return
  end
  keep(self, "add")
  table.insert(self.points, after + 1, { clean(x), clean(y) })
  self.selected = after + 1
  self:look()
end

--- A point halfway to the next; after the last one as far on as the one before.
local function add(self)
  local i, n = self.selected, #self.points
  local p, q = self.points[i], self.points[i + 1] or self.ends == "closed" and self.points[1]
  if q then return insert(self, i, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2) end
  local before, sx = self.points[n - 1], (self:steps())
  local dx, dy = before and p[1] - before[1] or 0, before and p[2] - before[2] or 0
  if self.kind == "curve" then dx, dy = dx > 0 and dx or 5 * sx, 0 end
  if dx == 0 and dy == 0 then dx = 5 * sx end
  insert(self, n, p[1] + dx, p[2] + dy)
end

local function delete(self, i)
  local least = self.kind == "curve" and 1 or self.ends == "closed" and 3 or 2
  if #self.points <= least then
    self.message = string.format("a %s needs %d point%s", self.kind, least, least == 1 and "" or "s")
    return
  end
  keep(self, "add")
  table.remove(self.points, i)
  self.selected = math.min(i, #self.points)
  self:look()
end

local function select(self, by)
  self.selected = (self.selected - 1 + by) % #self.points + 1
  self.last_change = nil
end

-- Questions -------------------------------------------------------------------------------------------------------------

--- Asks for a line of text below the picture; `done(text)` takes it.
local function ask(self, label, text, done) self.question = { label = label, text = text, done = done } end

local function answer(self, key)
  local q = self.question
  if key == "enter" then
    self.question = nil
    q.done(q.text)
  elseif key == "ctrl-c" or key == "escape" then
    self.question = nil
  elseif key == "backspace" then
    q.text = q.text:sub(1, (q.text:find "[^\128-\191][\128-\191]*$" or 1) - 1)
  elseif key == "ctrl-u" then
    q.text = ""
  elseif key:byte() >= 32 and screen.length(key) == 1 and #q.text < 1000 then
    q.text = q.text .. key
  end
end

local function ask_for_place(self)
  local p = self.points[self.selected]
  ask(self, "x, y: ", core.shortest(p[1]) .. ", " .. core.shortest(p[2]), function(text)
    local x, y = text:match "^%s*([^,%s]+)[,%s]+(%S+)%s*$"
    x, y = tonumber(x), tonumber(y)
    if not x or not y or x ~= x or y ~= y then
      self.message = "expected two numbers, as in 0.5, 1"
      return
    end
    self.last_change = nil
    put(self, self.selected, x, y)
    if self.points[self.selected][1] ~= x then self.message = "x stays between the points before and after it" end
  end)
end

local function write(self, path)
  local ok, why = pcall(self.save, path, self.shape)
  if ok then self.written, self.file = self:text(), path end
  self.message = ok and "written: " .. path or "not written: " .. reason(why)
end

local function ask_for_file(self)
  if not self.save then
    self.message = "there is nothing to write it with here"
    return
  end
  if not self.shape then return end
  ask(self, "write to: ", self.file, function(path)
    path = path:match "^%s*(.-)%s*$"
    if path == "" then return end
    if not path:match "%.%a+$" then path = path .. (self.kind == "curve" and ".func" or ".con") end
    if core.kind_of(path) ~= "file" then return write(self, path) end
    ask(self, path .. " is there; write over it? y or n: ", "", function(word)
      if word:match "^[yY]" then write(self, path) else self.message = "not written" end
    end)
  end)
end

-- Keys ----------------------------------------------------------------------------------------------------------------------

local keys = {}

local function on(names, fn)
  for name in names:gmatch "%S+" do keys[name] = fn end
end

on("left", function(self) move(self, -1, 0, 1) end)
on("right", function(self) move(self, 1, 0, 1) end)
on("up", function(self) move(self, 0, 1, 1) end)
on("down", function(self) move(self, 0, -1, 1) end)
on("shift-left", function(self) move(self, -1, 0, 10) end)
on("shift-right", function(self) move(self, 1, 0, 10) end)
on("shift-up", function(self) move(self, 0, 1, 10) end)
on("shift-down", function(self) move(self, 0, -1, 10) end)
on("+", function(self) self.factor = math.min(self.factor * 10, 100) end)
on("-", function(self) self.factor = math.max(self.factor / 10, 1e-4) end)
on("tab n", function(self) select(self, 1) end)
on("backtab p", function(self) select(self, -1) end)
on("home", function(self) self.selected, self.last_change = 1, nil end)
on("end", function(self) self.selected, self.last_change = #self.points, nil end)
on("a insert", add)
on("d delete", function(self) delete(self, self.selected) end)
on("u", function(self) step_back(self, self.past, self.future, "nothing to undo") end)
on("r", function(self) step_back(self, self.future, self.past, "nothing to redo") end)
on("e", ask_for_place)
on("f", function(self) self.box = picture.box(self) end)
on("s", ask_for_file)
on("?", function(self) self.helping = true end)
on("enter w q", function(self)
  if not self.shape then return end
  local ok, why = true, nil
  if self.accept then ok, why = pcall(self.accept, self.shape) end
  if ok then self.outcome = "accept" else self.message = "not taken: " .. reason(why) end
end)
on("ctrl-c", function(self) self.outcome = "leave" end)
on("1 2 3", function(self, key)
  keep(self, "add")
  self.wanted_degree = tonumber(key)
  self:look()
end)

-- Mouse -----------------------------------------------------------------------------------------------------------------

--- The point that a click means: within two columns and one row; or nil.
local function point_at(self, c, r)
  local best, least
  for i, p in ipairs(self.points) do
    local pc, pr = self.frame.cell(p[1], p[2])
    local distance = math.max(math.abs(pc - c) / 2, math.abs(pr - r))
    if distance <= 1.001 and (not least or distance < least) then best, least = i, distance end
  end
  return best
end

--- After which point a new one at a place belongs: by x, or where the polygon is nearest (seen in characters).
local function place_for(self, x, y)
  local n = #self.points
  if self.kind == "curve" then
    local i = 0
    while i < n and self.points[i + 1][1] <= x do i = i + 1 end
    return i
  end
  local best, least = n, math.huge
  for i = self.ends == "closed" and 1 or 0, n do
    local p, q = self.points[math.max(i, 1)], self.points[i % n + 1]
    if i == n and self.ends ~= "closed" then q = p end
    local dx, dy = q[1] - p[1], q[2] - p[2]
    local along = dx * dx + dy * dy
    local t = along > 0 and math.max(0, math.min(1, ((x - p[1]) * dx + (y - p[2]) * dy) / along)) or 0
    local distance = (p[1] + t * dx - x) ^ 2 + (p[2] + t * dy - y) ^ 2
    local at_end = i == 0 or i == n and self.ends ~= "closed"
    if distance < least or at_end and distance <= least then best, least = i, distance end
  end
  return best
end

--- The numbers that a cell stands for, with as few digits as tell it from others.
local function numbers_at(self, c, r)
  local x, y = self.frame.numbers(c, r)
  local x1, y1 = self.frame.numbers(c + 1, r - 1)
  local qx, qy = 10 ^ math.floor(math.log10((x1 - x) / 2)), 10 ^ math.floor(math.log10((y1 - y) / 2))
  return clean(math.floor(x / qx + 0.5) * qx), clean(math.floor(y / qy + 0.5) * qy)
end

local function mouse(self, key, column, row)
  local c, r = column - self.frame.left, row - self.frame.top
  local inside = c >= 0 and r >= 0 and c < self.frame.width and r < self.frame.height
  if key == "mouse-release" then
    local from = self.pressed
    self.pressed = nil
    if from and inside and (from[1] ~= c or from[2] ~= r) then put(self, self.selected, numbers_at(self, c, r)) end
    return
  end
  if not inside then return end
  local i = point_at(self, c, r)
  if key == "mouse-other" then
    if i then delete(self, i) end
    return
  end
  self.last_change = nil
  if i then
    self.selected = i
  else
    local x, y = numbers_at(self, c, r)
    insert(self, place_for(self, x, y), x, y)
  end
  self.pressed = { c, r }
end

--- Takes a key: a character, or "left", "shift-left", "tab", "enter", "ctrl-c" ...; or "mouse-press" (the left button), "mouse-release",
-- "mouse-other" at a column and row of the screen, from 0. When it is over, self.outcome is "accept" or "leave".
function editor:press(key, column, row)
  self.message = nil
  if self.question then return answer(self, key) end
  if self.helping then
    self.helping = false
    return
  end
  if key:match "^mouse" then
    if self.frame then mouse(self, key, column, row) end
  elseif keys[key] then
    keys[key](self, key)
  end
end

--- The screen: see curve_screen.lua.
editor.draw = curve_screen

return editor
