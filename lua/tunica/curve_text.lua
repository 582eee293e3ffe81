-- SPDX-License-Identifier: MIT
--- Curves as text, for parameters and the command line: "0,0.3 0.5,1 2,1", with "degree=1" or "ends=closed" behind the points.

local core = require "tunica.core"
local registry = require "tunica.registry"
local fail = registry.fail

local curve_text = {}

local function point_of(word)
  local x, y = word:match "^([^,]*),([^,]*)$"
  x, y = tonumber(x), tonumber(y)
  return x and y and { x, y }
end

--- Whether a text is meant as points, not as the name of a curve or file: it begins with a pair of numbers.
function curve_text.is(text)
  local first = text:match "^%s*(%S+)"
  return first ~= nil and point_of(first) ~= nil
end

--- The points in a text, with the fields degree and ends as far as they are given. `what`: for errors.
function curve_text.read(text, what)
  local points = {}
  for word in text:gmatch "%S+" do
    local name, value = word:match "^(%a+)=(.*)$"
    local point = point_of(word)
    if point then
      points[#points + 1] = point
    elseif name == "degree" and tonumber(value) then
      points.degree = tonumber(value)
    elseif name == "ends" then
      points.ends = value
    else
      fail("%s: in points as text expected x,y or degree=3 or ends=closed, came '%s'", what, word:sub(1, 60))
    end
  end
  return points
end

--- The degree that a curve has if none is given.
function curve_text.usual_degree(points) return math.max(1, math.min(3, #points - 1)) end

--- The text of points, which reads back as the same numbers.
function curve_text.write(points, degree, ends)
  local words = {}
  for i, p in ipairs(points) do words[i] = core.shortest(p[1]) .. "," .. core.shortest(p[2]) end
  if degree and #points > 1 and degree ~= curve_text.usual_degree(points) then words[#words + 1] = "degree=" .. degree end
  if ends and ends ~= "clamped" then words[#words + 1] = "ends=" .. ends end
  return table.concat(words, " ")
end

return curve_text
