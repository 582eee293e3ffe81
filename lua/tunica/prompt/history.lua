-- SPDX-License-Identifier: MIT
--- States to go back to. A state is kept before what changes the model at hand: a run, a step, an operation, a parameter. It
-- holds the model's snapshot with its rules and events, and which model it was. All together they take
-- at most `history.bytes`; the oldest go first.

local core = require "tunica.core"
local registry = require "tunica.registry"
local course = require "tunica.course"
local desk = require "tunica.prompt.desk"

local history = {
  bytes = 256 * 2 ^ 20,  -- most that the snapshots take together; the last is kept however large it is
  count = 200,           -- most states
}

-- Before every line a snapshot is made that takes less than so many seconds, and of a tissue of fewer cells; of others only
-- before lines, operations and runs that may change something.
local cheap, small = 0.01, 5000

local points, undone, total = {}, {}, 0
local armed, cost = nil, 0

--- A snapshot starts a model: one that is still being typed, and may get another start, is left alone.
local function can_begin(model, my)
  return my.started or my.machine or desk.begun(model) and (my.tissue or #my.starts > 0)
end

--- The state now, or nil if there is none that could be kept.
local function take(what, force)
  local model = desk.model()
  if not model then return { what = what, bytes = 0 } end
  local my = desk.inside(model)
  if not force and not can_begin(model, my) then return nil end
  local began = core.now()
  local ok, snapshot = pcall(model.snapshot, model)
  if not ok then return nil end
  cost = core.now() - began
  local g = desk.globals
  return { what = what, model = model, added = course.added(my), snapshot = snapshot,
    source = desk.source, time = model.time, bytes = #snapshot, tissue = rawget(g, "tissue"), P = rawget(g, "P") }
end

--- The state at hand for others, not kept here. `begins`: one that was taken before this line serves again.
local at_line
function history.present(begins) return begins and at_line or take("now") end

local function same(a, b) return a.model == b.model and a.snapshot == b.snapshot end

local function push(point)
  points[#points + 1], total = point, total + point.bytes
  while #points > 1 and (total > history.bytes or #points > history.count) do
    total = total - points[1].bytes
    table.remove(points, 1)
  end
end

--- Keeps the state at hand, unless the last one kept is the same. `force`: also of a model that has not begun.
function history.keep(what, force)
  armed, at_line = nil, nil
  local point = take(what, force)
  if not point then return end
  local last = points[#points]
  if last and same(last, point) then
    last.what = what
  else
    push(point)
  end
end

local function go_to(point)
  at_line = nil
  local g = desk.globals
  g.model, g.tissue, g.P, desk.source = point.model, point.tissue, point.P, point.source
  if not point.model then return end
  course.put(desk.inside(point.model), point.added)
  point.model:restore(point.snapshot)
end

--- The same; if it fails, all is as it was. `present`: the state at hand, if it could be taken.
local function try(point, present, failed)
  local g = desk.globals
  local model, was = desk.model(), { rawget(g, "model"), rawget(g, "tissue"), rawget(g, "P"), desk.source }
  local added, other = model and course.added(desk.inside(model)), point.model and course.added(desk.inside(point.model))
  local ok, why = pcall(go_to, point)
  if ok then return end
  g.model, g.tissue, g.P, desk.source = was[1], was[2], was[3], was[4]
  if other then course.put(desk.inside(point.model), other) end
  if model then course.put(desk.inside(model), added) end
  if present and present.model then pcall(go_to, present) end
  registry.fail(failed, point.what, (tostring(why):gsub("^%S-:%d+: ", "")))
end

--- Goes back by one state that differs from the present one; false if there is none.
function history.undo()
  local present = take("what was undone", true)
  while #points > 0 do
    local point = table.remove(points)
    total = total - point.bytes
    if not present or not same(point, present) then
      try(point, present, "undo: the state before '%s' cannot be had again (the next undo() goes further back): %s")
      if present then
        present.undone, present.base = point.what, point
        undone[#undone + 1] = present
      end
      return point
    end
  end
end

--- Takes back the last undo, as long as nothing has been changed since.
function history.redo()
  local point = undone[#undone]
  local present = point and take(point.undone, true)
  if not present or not same(present, point.base) then return nil end
  table.remove(undone)
  try(point, present, "redo: '%s' cannot be done again: %s")
  push(present)
  point.what = point.undone
  return point
end

function history.size() return #points, total end

local function belongs(self)
  local model = desk.model()
  if not model then return false end
  if rawequal(self, model) then return true end
  local tissue = desk.inside(model).tissue
  if not tissue then return false end
  if rawequal(self, tissue) then return true end
  local ok, of = pcall(core.tissue_of, self)
  return ok and rawequal(of, tissue)
end

registry.before_change = function(self)
  if armed and belongs(self) then history.keep(armed) end
end

local function is_cheap()
  local tissue = desk.inside(desk.model()).tissue
  return cost < cheap and not (tissue and tissue:count() >= small)
end

--- True of a line that may set a field (c.auxin = 1, P.D = 2), which no operation tells of.
local function sets_a_field(text) return text:find "[%.%]]%s*[%a_]*[%w_]*%s*=[^=]" ~= nil end

desk.on_line(function(text)
  local short = text:gsub("%s+", " "):sub(1, 60)
  armed, at_line = short, nil
  if text:match "^%s*undo%s*[%({]" or text:match "^%s*redo%s*[%({]" then
    armed = nil
  elseif desk.model() and (is_cheap() or sets_a_field(text)) then
    local point = take(short)
    local last = points[#points]
    if point and not (last and same(last, point)) then
      push(point)
    elseif point then
      last.what = short
    end
    at_line = point
    if point then armed = nil end
  end
end)

return history
