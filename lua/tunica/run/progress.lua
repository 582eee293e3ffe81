-- SPDX-License-Identifier: MIT
--- How far a run is: one line that renews itself on a terminal; else a line every tenth of the way or half minute.

local core = require "tunica.core"

local progress = {}

local function clock(seconds)
  if seconds >= 360000 then return ">99h" end
  local s = math.floor(seconds + 0.5)
  if s >= 3600 then return string.format("%d:%02d:%02d", s / 3600, s / 60 % 60, s % 60) end
  return string.format("%d:%02d", s / 60, s % 60)
end

--- 1234567 -> "1.2M"
local function short(number)
  for _, unit in ipairs { { 1e9, "G" }, { 1e6, "M" }, { 1e3, "k" } } do
    if number >= unit[1] then return string.format("%.1f%s", number / unit[1], unit[2]) end
  end
  return string.format("%.0f", number)
end

--- `goal`: end of model time; `most`: the size at which the run ends, if it has one. Rates are of the last seconds, not since the start: tissues grow.
function progress.new(goal, most, terminal, quiet)
  local now = core.now()
  return { goal = goal, most = most, terminal = terminal, quiet = quiet, shown = now, since = { now, nil, 0 }, tenth = nil }
end

--- The part of the way that is done, by time or by size.
local function share(self, time, size)
  local by_time = self.goal > 0 and time / self.goal or 1
  return self.most and math.max(by_time, size / self.most) or by_time
end

local function line(self, time, size, unit, now)
  local wall, advanced = now - self.since[1], time - self.since[2]
  local work = self.work - self.since[3]
  local done = math.floor(100 * share(self, time, size))
  if self.most then return string.format("t = %.6g, %d of %d %s (%d %%)", time, size, self.most, unit, done) end
  local text = string.format("t = %.6g of %.6g (%d %%), %d %s", time, self.goal, done, size, unit)
  if wall > 0 and advanced > 0 and unit == "cells" then
    text = text .. string.format(", %s cell steps/s, %s to go", short(work / wall), clock((self.goal - time) / advanced * wall))
  end
  return text
end

--- Called often; shows something now and then. `work`: cell steps done so far.
function progress.update(self, time, size, unit, work)
  if self.quiet then return end
  self.work = work
  local now = core.now()
  self.since[2] = self.since[2] or time
  local tenth = math.floor(10 * share(self, time, size))
  self.tenth = self.tenth or tenth
  local due
  if self.terminal then
    due = now - self.shown >= 0.25
  else
    due = now - self.shown >= 30 or (tenth > self.tenth and now - self.shown >= 1)
  end
  if not due then return end
  -- On a terminal without its wrapping of long lines: of two lines only one would be taken off.
  io.stderr:write(self.terminal and "\r\27[K\27[?7l" or "", line(self, time, size, unit, now), self.terminal and "\27[?7h" or "\n")
  io.stderr:flush()
  self.shown, self.tenth, self.drawn = now, tenth, true
  if now - self.since[1] > 5 then self.since = { now, time, work } end
end

--- Takes the line off a terminal, so that what follows stands alone.
function progress.clear(self)
  if self.terminal and self.drawn then io.stderr:write("\r\27[K") end
  self.drawn = false
end

return progress
