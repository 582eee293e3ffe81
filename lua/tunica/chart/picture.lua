-- SPDX-License-Identifier: MIT
--- Pictures of charts, by gnuplot.

local core = require "tunica.core"
local rows = require "tunica.chart.rows"
local study = require "tunica.chart.study"

local picture = {}

-- One colour and mark for each method, the same in every chart. Colours that stay apart for the colour-blind (after Okabe
-- and Ito 2008); methods of one family share a colour's neighbourhood, and marks tell them apart.
local looks = {
  euler = { "#000000", 7 }, sts = { "#606060", 2 }, heun = { "#56b4e9", 5 }, rk4 = { "#0072b2", 9 },
  bs32 = { "#e69f00", 11 }, dp54 = { "#d55e00", 13 },
  rkc2 = { "#009e73", 7 }, ["rkc2 fixed"] = { "#009e73", 6 }, backward_euler = { "#999999", 4 }, crank_nicolson = { "#8a5a83", 8 },
  bicg = { "#cc79a7", 10 }, bdf = { "#b8a000", 12 }, auto = { "#c8102e", 3 },
}
local other = { "#444444", 1 }

local function quoted(text) return "'" .. text:gsub("'", "''") .. "'" end
local function number(x) return string.format("%.9g", x) end

--- Methods of the table with their rows that have an error, finest last; in the order of the rows.
local function series_of(list)
  local by_label, order = {}, {}
  for _, row in ipairs(rows.sorted(list)) do
    if rows.error_of(row) then
      local label = rows.label(row.method, row.by)
      if not by_label[label] then
        by_label[label] = { label = label }
        order[#order + 1] = by_label[label]
      end
      table.insert(by_label[label], row)
    end
  end
  return order
end

local function block(name, list, line)
  local lines = { "$" .. name .. " << EOD" }
  for _, row in ipairs(list) do lines[#lines + 1] = line(row) end
  lines[#lines + 1] = "EOD"
  return table.concat(lines, "\n") .. "\n"
end

local both = { "png", "svg" }

local function terminals(folder, name, width, height, commands, kinds)
  local script = {}
  for _, kind in ipairs(kinds) do
    local terminal = kind == "png" and string.format("pngcairo size %d,%d font 'DejaVu Sans,13' linewidth 1.3", width, height)
      or string.format("svg size %d,%d font 'DejaVu Sans,13' linewidth 1.3 background 'white'", width, height)
    script[#script + 1] = string.format("reset\nset encoding utf8\nset terminal %s noenhanced\nset output %s\n%s\nunset output\n", terminal,
      quoted(folder .. "/" .. name .. ".part." .. kind), commands)
  end
  return table.concat(script)
end

--- Draws and puts the files in place, of the kinds given or both. Returns true, or nil and why not.
local function draw(folder, name, width, height, data, commands, kinds)
  kinds = kinds or both
  local ok, why = pcall(core.gnuplot, data .. terminals(folder, name, width, height, commands, kinds))
  for _, kind in ipairs(kinds) do
    local part = folder .. "/" .. name .. ".part." .. kind
    if ok then core.rename(part, folder .. "/" .. name .. "." .. kind) else core.remove_all(part) end
  end
  if ok then return true end
  return nil, (tostring(why):gsub("^.-: gnuplot", "gnuplot"))
end

local function style(label)
  local look = looks[label] or other
  return string.format("lc rgb '%s' pt %d", look[1], look[2])
end

--- A panel: thin lines with marks for each method, thicker where it is on the front.
local function panel(series, column, xlabel, keys)
  local parts = {}
  parts[1] = string.format("$front%d using %d:1 with lines lc rgb '#e4e4dc' lw 11 notitle", column, column)
  for i, s in ipairs(series) do
    parts[#parts + 1] = string.format("$series%d using %d:1 with linespoints %s ps 0.95 lw 1.3 %s", i, column, style(s.label),
      keys and "title " .. quoted(s.label) or "notitle")
    parts[#parts + 1] = string.format("$series%d using %d:($%d > 0 ? $1 : NaN) with points %s ps 1.75 lw 2.2 notitle", i, column, column + 2, style(s.label))
  end
  return string.format("set xlabel %s\nplot %s\n", quoted(xlabel), table.concat(parts, ", \\\n  "))
end

--- The rows that no other beats by a cost, from dear to cheap.
local function front_by(list, cost, floor)
  local sorted, front, least = {}, {}, math.huge
  for _, row in ipairs(list) do
    if rows.error_of(row) then sorted[#sorted + 1] = row end
  end
  table.sort(sorted, function(a, b) return a[cost] < b[cost] end)
  for _, row in ipairs(sorted) do
    local error = math.max(row.error, floor)
    if error < least then front[#front + 1], least = row, error end
  end
  return front
end

--- chart.png and chart.svg of a chart: error against CPU seconds, and against evaluations. Returns true, or nil and why not.
function picture.chart(self)
  local series, floor = series_of(self.rows), self.reference.floor
  if #series == 0 then return nil, "no run came to its end" end
  local by_seconds, by_evaluations = front_by(self.rows, "seconds", floor), front_by(self.rows, "evaluations", floor)
  local front = {}
  for _, row in ipairs(by_evaluations) do front[row] = 1 end
  local function line(row)
    return table.concat({ number(math.max(row.error, floor)), number(math.max(row.seconds, 1e-7)), number(row.evaluations), row.front and 1 or 0,
      front[row] or 0 }, " ")
  end
  local data = block("front2", by_seconds, line) .. block("front3", by_evaluations, line)
  for i, s in ipairs(series) do data = data .. block("series" .. i, s, line) end
  local common = string.format([[
set multiplot
set logscale xy
set format xy '10^{%%T}'
set termoption enhanced
set grid lc rgb '#dddddd' lw 0.7
set border 3 lc rgb '#888888'
set tics nomirror textcolor rgb '#333333'
set tmargin at screen 0.90
set bmargin at screen 0.11
set arrow 1 from graph 0, first %s to graph 1, first %s nohead dt 2 lc rgb '#999999'
set arrow 2 from graph 0, first %s to graph 1, first %s nohead dt 3 lc rgb '#999999'
set yrange [%s:*]
set label 2 'error asked for' at graph 0.995, first %s right offset 0,0.5 font ',10' textcolor rgb '#888888'
set label 3 'the references differ' at graph 0.01, first %s left offset 0,0.5 font ',10' textcolor rgb '#888888'
set label 1 %s at screen 0.4625, 0.955 center font ',15' noenhanced
]], number(floor), number(floor), number(self.options.error), number(self.options.error), number(floor / 3),
    number(self.options.error), number(floor), quoted(string.format("%s, t = %s", self.options.name, study.short(self.goal))))
  local ylabel = self.quantity.name == "state" and "error of the state, relative" or "error of " .. self.quantity.name .. ", relative"
  local commands = common
    .. "set lmargin at screen 0.075\nset rmargin at screen 0.445\nset ylabel " .. quoted(ylabel) .. " noenhanced\n"
    .. "set key at screen 0.995, 0.9 right top vertical maxcols 1 noenhanced samplen 2 spacing 1.3 reverse Left\n"
    .. panel(series, 2, "CPU seconds", true)
    .. "unset label 1\nunset ylabel\nset format y ''\nset lmargin at screen 0.48\nset rmargin at screen 0.85\nunset key\n"
    .. panel(series, 3, "evaluations of the rates", false)
    .. "unset multiplot"
  return draw(self.folder, "chart", 1400, 680, data, commands)
end

picture.draw, picture.looks, picture.quoted, picture.block, picture.number = draw, looks, quoted, block, number

return picture
