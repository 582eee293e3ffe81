-- SPDX-License-Identifier: MIT
--- What the editor of a curve shows: the picture, where the selected point is, what the curve is like or what is wrong with it, keys.

local core = require "tunica.core"
local picture = require "tunica.prompt.curve_picture"
local screen = require "tunica.prompt.screen"

local short_help = "arrows move, Tab next, a add, d delete, u undo, s to a file, Enter done, Ctrl-C leave, ? all keys"
local long_help = {
  "arrows         move the point", "Shift + arrows by a tenth of the step", "+ -            longer, shorter steps",
  "e              enter its x, y", "Tab n, p       next, previous point", "Home, End      first, last point",
  "a              add a point after it", "d, Delete      delete it", "u, r           undo, redo", "1 2 3          degree of the curve",
  "f              fit into the window", "s              write to a file", "Enter, w, q    done: takes the curve",
  "Ctrl-C         leave it as it was", "mouse: click selects or adds, press and", "release moves, right button deletes",
}

local function digits(x) return string.format("%.10g", x) end

local function status(self)
  local p = self.points[self.selected]
  local sx, sy = self:steps()
  local step = sx == sy and digits(sx) or digits(sx) .. ", " .. digits(sy)
  return string.format("point %d of %d: %s, %s; step %s", self.selected, #self.points, core.shortest(p[1]), core.shortest(p[2]), step)
end

local function lines_of(text, width, most)
  local lines = {}
  for line in (screen.wrap(screen.printable(text), width) .. "\n"):gmatch "(.-)\n" do lines[#lines + 1] = line end
  if #lines > most then lines[most] = screen.cut(lines[most] .. " " .. lines[most + 1], width) end
  for i = #lines, most + 1, -1 do lines[i] = nil end
  return lines
end

--- Rows below the picture: where the point is; how the curve is; a question or keys.
local function below_picture(self, width, height)
  local rows = {}
  local function add(text, style, most)
    for _, line in ipairs(lines_of(text, width, most)) do rows[#rows + 1] = { { screen.cut(line, width), style } } end
  end
  local room = math.max(1, math.floor((height - 8) / 4))
  add(status(self), nil, math.min(2, room))
  if self.message then add(self.message, "message", room)
  elseif self.wrong then add("refused: " .. self.wrong, "error", math.min(4, room + 1))
  else add(self.live, nil, math.min(2, room)) end
  if not self.question then
    add(short_help, "axis", math.min(3, room))
    return rows
  end
  local text = screen.printable(self.question.label .. self.question.text)
  while screen.length(text) > width - 1 do text = text:gsub("^[^\128-\191][\128-\191]*", "", 1) end
  rows[#rows + 1] = { { text } }
  return rows, screen.length(text)
end

--- The screen: rows as lists of runs { text, style or nil }, and column and row of the cursor (from 0), or nil.
return function(self, width, height)
  if width < 20 or height < 8 then return { { { ("window too small"):sub(1, width) } } } end
  local below, cursor = below_picture(self, width, height)
  local title = string.format("%s%s: %s%d point%s, degree %d", self.title, #self.past > 0 and " (changed)" or "",
    self.title == self.kind and "" or self.kind .. ", ", #self.points, #self.points == 1 and "" or "s", self.degree)
  local rows = { { { screen.cut(screen.printable(title), width), "title" } } }
  local graph
  graph, self.frame = picture.draw(self, self.box, width, height - 1 - #below)
  self.frame.top = 1
  if self.helping then
    for i = 1, #graph do graph[i] = { { screen.cut(long_help[i] or "", width) } } end
  end
  for _, row in ipairs(graph) do rows[#rows + 1] = row end
  for _, row in ipairs(below) do rows[#rows + 1] = row end
  return rows, cursor, cursor and #rows - 1
end
