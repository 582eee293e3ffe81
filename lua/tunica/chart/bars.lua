-- SPDX-License-Identifier: MIT
--- The picture of `tunica stability`: the limits as bars, the theory as marks.

local picture = require "tunica.chart.picture"
local study = require "tunica.chart.study"

local bars = {}

local quoted, number = picture.quoted, picture.number

--- One panel's data: place, bounded, pattern, theory; names as tics.
local function collect(self, by)
  local lines, tics, least = {}, {}, math.huge
  for _, r in ipairs(self.results) do
    if r.by == by then
      local place = #lines
      local bounded, kept = r.bounded and r.bounded.value, r.pattern.value
      for _, value in ipairs { bounded or math.huge, kept or math.huge, r.theory or math.huge } do least = math.min(least, value) end
      lines[place + 1] = { place = place, bounded = bounded, kept = kept, theory = r.theory }
      tics[place + 1] = quoted(r.label) .. " " .. place
    end
  end
  return lines, tics, least
end

local function line_of(row)
  local function value(x) return x and number(x) or "NaN" end
  return table.concat({ row.place, value(row.bounded), value(row.kept), value(row.theory) }, " ")
end

local function panel(name, lines, tics, least, ylabel, fixed)
  local plot = fixed and string.format("$%s using ($1-0.19):2 with boxes fs solid 1 lc rgb '#a6cbe3' title 'stays bounded', " ..
    "$%s using ($1+0.19):3 with boxes fs solid 1 lc rgb '#1f6f9f' title 'keeps the pattern', " ..
    "$%s using ($1-0.19):4 with points pt 2 ps 1.4 lw 2 lc rgb '#d55e00' title '2/rho; rk4: 2.785/rho'", name, name, name)
    or string.format("$%s using 1:3 with boxes fs solid 1 lc rgb '#1f6f9f' notitle", name)
  return string.format("set boxwidth %g\nset xrange [-0.6:%g]\nset yrange [%s:*]\nset xtics (%s) rotate by -35 noenhanced\nset ylabel %s\nplot %s\n",
    fixed and 0.36 or 0.5, #lines - 0.4, number(10 ^ math.floor(math.log10(least) - 0.3)), table.concat(tics, ", "), quoted(ylabel), plot)
end

--- stability.png and stability.svg. Returns true, or nil and why not.
function bars.draw(self)
  local data, parts, places = "", {}, { { 0.08, 0.66 }, { 0.76, 0.98 } }
  local common = string.format([[
set multiplot
set termoption enhanced
set logscale y
set format y '10^{%%T}'
set grid ytics lc rgb '#dddddd' lw 0.7
set border 3 lc rgb '#888888'
set tics nomirror textcolor rgb '#333333'
set xtics scale 0
set tmargin at screen 0.82
set bmargin at screen 0.2
set key at screen 0.08, 0.86 left bottom horizontal maxrows 1 noenhanced samplen 2 width 2 reverse Left
set label 1 %s at screen 0.5, 0.955 center font ',15' noenhanced
]], quoted(string.format("%s: %s, t = %s", self.options.name, self.quantity.name, study.short(self.goal))))
  for i, by in ipairs { "dt", "tolerance" } do
    local lines, tics, least = collect(self, by)
    if #lines > 0 and least < math.huge then
      data = data .. picture.block(by, lines, line_of)
      parts[#parts + 1] = string.format("set lmargin at screen %g\nset rmargin at screen %g\n", places[i][1], places[i][2]) ..
        panel(by, lines, tics, least, by == "dt" and "largest dt" or "loosest tolerance", by == "dt") .. "unset label 1\n"
    end
  end
  if #parts == 0 then return nil, "no limit was found" end
  return picture.draw(self.folder, "stability", 1300, 560, data, common .. table.concat(parts) .. "unset multiplot")
end

return bars
