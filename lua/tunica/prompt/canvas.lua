-- SPDX-License-Identifier: MIT
--- Dots in a grid of characters: Braille (two by four in a character), or stars where there is no Unicode.

local screen = require "tunica.prompt.screen"

local canvas = {}

local bits = { { 1, 2, 4, 64 }, { 8, 16, 32, 128 } }  -- of a Braille character, by column and row

--- The three bytes of a character from U+0800 on.
local function utf8_of(code)
  return string.char(224 + math.floor(code / 4096), 128 + math.floor(code / 64) % 64, 128 + code % 64)
end

--- A grid of `width` by `height` characters: across and down (its size in dots), set(x, y) a dot counted from the upper left
-- 0, 0; those outside are left out; at(column, row) the character or nil, row(r) a whole row.
function canvas.new(width, height)
  local across, down = screen.unicode and 2 or 1, screen.unicode and 4 or 1
  local cells = {}
  local self = { across = across * width, down = down * height }
  function self.set(px, py)
    if px < 0 or py < 0 or px >= self.across or py >= self.down then return end
    local at = math.floor(py / down) * width + math.floor(px / across)
    local bit_value = screen.unicode and bits[px % across + 1][py % down + 1] or 1
    cells[at] = bit.bor(cells[at] or 0, bit_value)
  end
  function self.at(c, r)
    local set = cells[r * width + c]
    return set and (screen.unicode and utf8_of(0x2800 + set) or "*")
  end
  function self.row(r)
    local out = {}
    for c = 0, width - 1 do out[#out + 1] = self.at(c, r) or " " end
    return table.concat(out)
  end
  return self
end

--- A straight line of dots between two of them.
function canvas.line(to, x0, y0, x1, y1)
  local steps = math.max(math.abs(x1 - x0), math.abs(y1 - y0), 1)
  for i = 0, steps do to.set(math.floor(x0 + (x1 - x0) * i / steps + 0.5), math.floor(y0 + (y1 - y0) * i / steps + 0.5)) end
end

return canvas
