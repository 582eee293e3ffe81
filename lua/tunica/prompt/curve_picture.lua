-- SPDX-License-Identifier: MIT
--- A curve with its control polygon, points and axes on a grid of characters. Knows nothing of keys and terminals.

local core = require "tunica.core"
local canvas = require "tunica.prompt.canvas"
local screen = require "tunica.prompt.screen"
local values = require "tunica.prompt.values"

local picture = {}

local ascii = { bar = "|", corner = "+", dash = "-", polygon = ".", point = "o", selected = "@" }
local unicode = { bar = "│", corner = "└", dash = "─", polygon = "·", point = "○", selected = "●" }

--- Points along the curve of a drawing { points =, degree =, ends = }, also of one that cannot be a function; or nil.
function picture.samples(drawing, count)
  local ok, contour = pcall(core.new_contour, drawing.points, drawing.degree, drawing.ends)
  if not ok then return nil end
  local list = {}
  for i = 0, count do
    local x, y = core.contour_place(contour, i / count)
    list[#list + 1] = { x, y }
  end
  return list
end

--- The 1, 2 or 5 times a power of ten that is nearest below a positive number.
function picture.step(x)
  local power = 10 ^ math.floor(math.log10(x))
  local first = x / power
  return (first >= 5 and 5 or first >= 2 and 2 or 1) * power
end

--- What has to be seen of a drawing: its points, with room around them; of a function also y = 0 if it is near.
function picture.box(drawing)
  local box = { math.huge, -math.huge, math.huge, -math.huge }
  for _, p in ipairs(drawing.points) do
    box[1], box[2] = math.min(box[1], p[1]), math.max(box[2], p[1])
    box[3], box[4] = math.min(box[3], p[2]), math.max(box[4], p[2])
  end
  for axis = 1, 3, 2 do
    local low, high = box[axis], box[axis + 1]
    if axis == 3 and drawing.kind == "curve" then
      local near = math.max(high - low, 0.7 * math.max(math.abs(low), math.abs(high)))
      if low > 0 and low <= near * 2 then low = 0 end
      if high < 0 and -high <= near * 2 then high = 0 end
    end
    local room = high > low and (high - low) * 0.08 or low == 0 and 1 or math.abs(low) * 0.5
    local at_zero = drawing.kind == "curve" and high > low
    box[axis] = at_zero and low == 0 and 0 or low - room
    box[axis + 1] = at_zero and high == 0 and 0 or high + room
    local step = picture.step((box[axis + 1] - box[axis]) / 20)  -- ends that are short to write
    box[axis], box[axis + 1] = math.floor(box[axis] / step) * step, math.ceil(box[axis + 1] / step) * step
  end
  return box
end

--- Where numbers stand in a grid of width by height characters: { box =, width =, height =, cell(x, y) -> column, row from 0
-- (not rounded), numbers(column, row) -> x, y }. A contour has the same scale in both directions: a character is twice as high
-- as wide.
local function frame_of(drawing, box, width, height)
  local x0, x1, y0, y1 = box[1], box[2], box[3], box[4]
  if drawing.kind == "contour" then
    local scale = math.max((x1 - x0) / width, (y1 - y0) / (2 * height))
    local mx, my = (x0 + x1) / 2, (y0 + y1) / 2
    x0, x1 = mx - scale * width / 2, mx + scale * width / 2
    y0, y1 = my - scale * height, my + scale * height
  end
  local frame = { box = { x0, x1, y0, y1 }, width = width, height = height }
  function frame.cell(x, y) return (x - x0) / (x1 - x0) * width - 0.5, (y1 - y) / (y1 - y0) * height - 0.5 end
  function frame.numbers(c, r) return x0 + (c + 0.5) / width * (x1 - x0), y1 - (r + 0.5) / height * (y1 - y0) end
  return frame
end

local function round(x) return math.floor(x + 0.5) end

--- The cell of a point, on the grid.
local function cell_of(frame, p)
  local c, r = frame.cell(p[1], p[2])
  return math.max(0, math.min(frame.width - 1, round(c))), math.max(0, math.min(frame.height - 1, round(r)))
end

local function put_polygon(grid, frame, drawing, mark)
  local n = #drawing.points
  for i = 1, drawing.ends == "closed" and n or n - 1 do
    local c0, r0 = cell_of(frame, drawing.points[i])
    local c1, r1 = cell_of(frame, drawing.points[i % n + 1])
    local steps = math.max(math.abs(c1 - c0), 2 * math.abs(r1 - r0), 1)
    for k = 0, steps, 2 do grid[round(r0 + (r1 - r0) * k / steps)][round(c0 + (c1 - c0) * k / steps)] = { mark, "polygon" } end
  end
end

local function put_curve(grid, frame, drawing)
  local samples = picture.samples(drawing, math.max(200, 8 * frame.width))
  if not samples then return end
  local dots = canvas.new(frame.width, frame.height)
  local per_column, per_row = dots.across / frame.width, dots.down / frame.height
  local before
  for _, p in ipairs(samples) do
    local c, r = frame.cell(p[1], p[2])
    local at = { round((c + 0.5) * per_column - 0.5), round((r + 0.5) * per_row - 0.5) }
    if before then canvas.line(dots, before[1], before[2], at[1], at[2]) end
    before = at
  end
  for r = 0, frame.height - 1 do
    for c = 0, frame.width - 1 do
      local mark = dots.at(c, r)
      if mark then grid[r][c] = { mark, "curve" } end
    end
  end
end

--- A row of marks { text, style } as runs of one style.
local function runs_of(marks, width)
  local runs = {}
  for c = 0, width - 1 do
    local text, style = " ", nil
    if marks[c] then text, style = marks[c][1], marks[c][2] end
    local last = runs[#runs]
    if last and last[2] == style then last[1] = last[1] .. text else runs[#runs + 1] = { text, style } end
  end
  return runs
end

--- Text and numbers for an axis: short, since there is little room.
local function label(x) return values.short(tonumber(string.format("%.3g", x))) end

local function axis_row(frame, margin, marks)
  local width = frame.width
  local numbers = { label(frame.box[1]), label((frame.box[1] + frame.box[2]) / 2), label(frame.box[2]) }
  local text = numbers[1]
  local middle = math.floor(width / 2 - #numbers[2] / 2)
  if middle > #text and middle + #numbers[2] + #numbers[3] < width then
    text = text .. string.rep(" ", middle - #text) .. numbers[2]
  end
  text = text .. string.rep(" ", math.max(1, width - #text - #numbers[3])) .. numbers[3]
  return { { string.rep(" ", margin) .. marks.corner .. string.rep(marks.dash, width), "axis" } },
    { { screen.cut(string.rep(" ", margin + 1) .. text, margin + 1 + width) } }
end

--- The picture of a drawing { kind = "curve" or "contour", points =, degree =, ends =, selected = index or nil } with the numbers in
-- `box` in sight, `width` by `height` characters with its axes: a list of rows, each a list of runs { text, style or nil }, and the
-- frame (see above) with the fields left and top, where its cell 0, 0 is.
function picture.draw(drawing, box, width, height)
  local marks = screen.unicode and unicode or ascii
  local labels = { label(box[4]), label((box[3] + box[4]) / 2), label(box[3]) }
  local rows_of_graph = height - 2
  for _ = 1, 2 do  -- the labels say how much room is left, and that what they say
    local margin = math.max(#labels[1], #labels[2], #labels[3])
    local b = frame_of(drawing, box, math.max(1, width - margin - 1), rows_of_graph).box
    labels = { label(b[4]), label((b[3] + b[4]) / 2), label(b[3]) }
  end
  local margin = math.max(#labels[1], #labels[2], #labels[3])
  local frame = frame_of(drawing, box, math.max(1, width - margin - 1), rows_of_graph)
  frame.left, frame.top = margin + 1, 0
  local grid = {}
  for r = 0, frame.height - 1 do grid[r] = {} end
  put_polygon(grid, frame, drawing, marks.polygon)
  put_curve(grid, frame, drawing)
  for i, p in ipairs(drawing.points) do
    local c, r = cell_of(frame, p)
    if i ~= drawing.selected then grid[r][c] = { marks.point, "point" } end
  end
  local chosen = drawing.points[drawing.selected]
  if chosen then
    local c, r = cell_of(frame, chosen)
    grid[r][c] = { marks.selected, "selected" }
  end
  local rows, middle = {}, math.floor((frame.height - 1) / 2)
  for r = 0, frame.height - 1 do
    local text = r == 0 and labels[1] or r == frame.height - 1 and labels[3] or r == middle and labels[2] or ""
    local row = runs_of(grid[r], frame.width)
    table.insert(row, 1, { string.rep(" ", margin - #text) .. text .. marks.bar, "axis" })
    rows[#rows + 1] = row
  end
  rows[#rows + 1], rows[#rows + 2] = axis_row(frame, margin, marks)
  return rows, frame
end

--- Rows as plain text.
function picture.text(rows)
  local lines = {}
  for i, row in ipairs(rows) do
    local line = {}
    for k, run in ipairs(row) do line[k] = run[1] end
    lines[i] = table.concat(line):gsub("%s+$", "")
  end
  return table.concat(lines, "\n")
end

return picture
