-- SPDX-License-Identifier: MIT
--- The picture of a chart of a score: a line for each setting; how its score differs from the finest, what a run costs, how many
-- failed.

local picture = require "tunica.chart.picture"
local study = require "tunica.chart.study"
local report = require "tunica.chart.score_report"
local core = require "tunica.core"

local score_picture = {}

local quoted, number = picture.quoted, picture.number
local grey = "#999999"

local function label(self, row)
  local text = string.format("%s %s %s", row.method, row.by == "dt" and "dt" or "tol", core.shortest(row.setting))
  for _, p in ipairs(row.listed) do text = string.format("%s  %s %s", text, p.name, p.text) end
  if self.reference and self.reference.row == row then text = text .. " (finest)" end
  return self.best == row and "* " .. text or text
end

--- Data: place (from below), difference, twice its error, seconds, share of failed runs; colour.
local function data_of(list)
  local lines, tics = {}, {}
  for i, row in ipairs(list) do
    local place = #list - i
    local look = picture.looks[row.method] or { grey }
    local has = row.pairs and row.pairs > 1
    lines[i] = { place, has and number(row.difference) or "NaN", has and number(2 * row.difference_error) or "NaN",
      row.seconds and number(row.seconds) or "NaN", #row.failures / #row.runs, "0x" .. look[1]:sub(2), row.keeps and 1 or 0 }
  end
  return picture.block("rows", lines, function(line) return table.concat(line, " ") end), tics
end

--- How most runs failed, in few words, beside the bars.
local function reasons(list)
  local parts = {}
  for i, row in ipairs(list) do
    local kinds = report.kinds(row)
    if kinds[1] then
      local how = kinds[2] and string.format(": %d %s", #kinds[1], kinds[1].how) or " " .. kinds[1].how
      local words = string.format("%d of %d%s", #row.failures, #row.runs, how)
      parts[#parts + 1] = string.format("set label %d %s at graph 0.03, first %d left front font ',10' noenhanced", 100 + i,
        quoted(words), #list - i)
    end
  end
  return table.concat(parts, "\n") .. "\n"
end

--- The axis of differences: all of them, and what matters.
local function range_of(self, list)
  local most = 1.4 * self.options.error
  for _, row in ipairs(list) do
    if row.pairs and row.pairs > 1 then most = math.max(most, 1.1 * (math.abs(row.difference) + 2 * row.difference_error)) end
  end
  return string.format("set xrange [-%s:%s]\n", number(most), number(most))
end

--- The axis of seconds: from 0 on, or by equal ratios if they differ much.
local function scale_of(list)
  local least, most = math.huge, 0
  for _, row in ipairs(list) do
    if row.seconds then least, most = math.min(least, row.seconds), math.max(most, row.seconds) end
  end
  if most > 12 * least then return "set xrange [*:*]\nset logscale x\nset format x '%g'\n" end
  local range = 1.15 * math.max(most, 1e-6)
  local apart = 10 ^ math.floor(math.log10(range / 2))  -- two to four numbers: there is no room for more
  apart = apart * (range > 8 * apart and 5 or range > 4 * apart and 2 or 1)
  return string.format("set xrange [0:%s]\nset xtics %s\nset format x '%%g'\n", number(range), number(apart))
end

local legend = "filled: keeps the score     dotted: the difference that matters     *: the cheapest"

local function title_of(self)
  local o = self.options
  return string.format("%s: %s at t = %s, %d seeds", o.name, o.score, study.short(self.goal), #o.seeds)
end

--- chart.png and chart.svg. Returns true, or nil and why not.
function score_picture.draw(self, list)
  if #list == 0 then return nil, "there are no runs" end
  local data, tics = data_of(list), {}
  for i, row in ipairs(list) do tics[i] = quoted(label(self, row)) .. " " .. (#list - i) end
  local error = number(self.options.error)
  local height = 170 + 27 * #list
  local function edges(left, right) return string.format("set lmargin at screen %g\nset rmargin at screen %g\n", left, right) end
  local commands = string.format([[
set multiplot
set grid xtics lc rgb '#dddddd' lw 0.7
set border 1 lc rgb '#888888'
set tics nomirror textcolor rgb '#333333'
set tmargin at screen %g
set bmargin at screen %g
set yrange [-0.7:%g]
set ytics scale 0
set label 1 %s at screen 0.02, %g left font ',15' noenhanced
]], 1 - 55 / height, 75 / height, #list - 0.3,
    quoted(title_of(self)),
    1 - 24 / height) ..
    string.format("set label 2 %s at screen 0.98, %g right font ',10' textcolor rgb '%s' noenhanced\n",
      quoted(legend), 1 - 24 / height, "#666666") ..
    edges(0.19, 0.53) .. "set ytics (" .. table.concat(tics, ", ") .. ") noenhanced\n" ..
    string.format("set arrow 1 from 0, graph 0 to 0, graph 1 nohead lc rgb '%s' lw 1.2\n", grey) ..
    string.format("set arrow 2 from -%s, graph 0 to -%s, graph 1 nohead dt 3 lc rgb '%s'\n", error, error, grey) ..
    string.format("set arrow 3 from %s, graph 0 to %s, graph 1 nohead dt 3 lc rgb '%s'\n", error, error, grey) ..
    range_of(self, list) ..
    "set xlabel 'difference from the finest, with twice its standard error' noenhanced\n" ..
    "plot $rows using 2:1:3:6 with xerrorbars pt 6 ps 1.1 lw 1.6 lc rgb variable notitle, " ..
    "$rows using ($7 > 0 ? $2 : NaN):1:6 with points pt 7 ps 1.1 lc rgb variable notitle\n" ..
    "unset label 1\nunset label 2\nunset arrow\nset ytics format ''\nset ytics ('' 0)\n" ..
    edges(0.57, 0.75) .. scale_of(list) .. "set xlabel 'CPU seconds a run' noenhanced\n" ..
    "plot $rows using 4:1:6 with points pt 6 ps 1.1 lw 1.6 lc rgb variable notitle, " ..
    "$rows using ($7 > 0 ? $4 : NaN):1:6 with points pt 7 ps 1.1 lc rgb variable notitle\n" ..
    "unset logscale\nset xrange [0:1]\nset xtics 0.5\n" .. edges(0.78, 0.98) .. reasons(list) ..
    "set xlabel 'share of runs that failed' noenhanced\n" ..
    "plot $rows using (0):1:(0):5:($1-0.35):($1+0.35) with boxxyerror fs solid 1 noborder lc rgb '#e3b5a4' notitle\n" ..
    "unset multiplot"
  return picture.draw(self.folder, "chart", 1400, height, data, commands)
end

return score_picture
