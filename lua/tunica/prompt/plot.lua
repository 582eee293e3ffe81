-- SPDX-License-Identifier: MIT
--- Numbers against numbers in characters: dots of Braille (two by four in a character), or stars where there is no Unicode.

local canvas = require "tunica.prompt.canvas"
local screen = require "tunica.prompt.screen"
local values = require "tunica.prompt.values"

local function is_finite(x) return type(x) == "number" and x == x and math.abs(x) < math.huge end

local function range_of(series, axis)
  local low, high
  for _, each in ipairs(series) do
    for i, y in ipairs(each.y) do
      local v = axis == "y" and y or each.x and each.x[i] or i
      if is_finite(v) then low, high = math.min(low or v, v), math.max(high or v, v) end
    end
  end
  if not low then return nil end
  if low == high then
    local room = low == 0 and 1 or math.abs(low) * 0.5
    return low - room, high + room
  end
  return low, high
end

local function draw(to, each, place, lines)
  local before
  for i, y in ipairs(each.y) do
    local x = each.x and each.x[i] or i
    if is_finite(x) and is_finite(y) then
      local px, py = place(x, y)
      if lines and before then canvas.line(to, before[1], before[2], px, py) else to.set(px, py) end
      before = { px, py }
    else
      before = nil
    end
  end
end

--- The plot as text. `series`: list of { x = list or nil, y = list }; `options`: { title =, lines = true }.
return function(series, options)
  local low, high = range_of(series, "y")
  if not low then return "nothing to plot: there are no finite numbers" end
  local left, right = range_of(series, "x")
  local labels = { values.short(high), values.short(low) }
  local margin = math.max(#labels[1], #labels[2])
  local width, height = math.max(10, math.min(100, screen.width()) - margin - 3), 12
  local to = canvas.new(width, height)
  local function place(x, y)
    local across, down = (x - left) / (right - left) * (to.across - 1), (high - y) / (high - low) * (to.down - 1)
    return math.floor(across + 0.5), math.floor(down + 0.5)
  end
  for _, each in ipairs(series) do draw(to, each, place, options.lines) end
  local out, bar = {}, screen.unicode and "│" or "|"
  if options.title then out[1] = string.rep(" ", margin + 2) .. screen.cut(options.title, width) end
  for r = 0, height - 1 do
    local label = r == 0 and labels[1] or r == height - 1 and labels[2] or ""
    out[#out + 1] = (string.rep(" ", margin - #label) .. label .. " " .. bar .. to.row(r)):gsub("%s+$", "")
  end
  local from, upto = values.short(left), values.short(right)
  out[#out + 1] = string.rep(" ", margin + 2) .. from .. string.rep(" ", math.max(1, width - #from - #upto)) .. upto
  return table.concat(out, "\n")
end
