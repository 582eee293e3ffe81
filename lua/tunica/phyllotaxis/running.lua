-- SPDX-License-Identifier: MIT
--- The course of a model of phyllotaxis: events, running, snapshots.

local core = require "tunica.core"
local registry = require "tunica.registry"
local course = require "tunica.course"
local op, fail = registry.op, registry.fail

return function(parts)

local inside, _, prepare, example = parts.inside, parts.methods, parts.prepare, parts.example

-- Events ------------------------------------------------------------------------------------------------------------------------

course.operations("phyllotaxis", inside, example, {
  doc = "It is asked at the start, after events and insertions, and between insertions, where the time is found at which it " ..
    "became true.",
  located = "false: it is asked only after insertions and search intervals, and its time is not found",
  example = "model:when(function(t) return #model.angles > 5 end, function(t) print(t) end)",
  report = "primordia = function() return #model.angles end" })

op { name = "phyllotaxis:after", changes = true,
  args = { { name = "count", type = "integer", min = 1, required = true,
    doc = "number of the primordium; those of the start count" },
    { name = "event", type = "function", required = true, doc = "function(t)" } },
  doc = "Something that happens once, when the model has so many primordia: a threshold is changed, say.",
  example = example .. "model:after(4, function(t) print(t) end) model:advance(1)",
  fn = function(model, count, fn) table.insert(inside[model].events, { kind = "after", time = count, fn = fn, fired = 0 }) end }

local function nothing() end

local function fire_counts(my, now)
  local fired = false
  for _, e in ipairs(my.events) do
    if e.kind == "after" and e.fired == 0 and core.inhibition_state(my.engine).count >= e.time then
      e.fn(now)
      e.fired, fired = 1, true
    end
  end
  return fired
end

--- True if any has become true.
local function test_conditions(my, now)
  local fired = false
  for _, c in ipairs(my.conditions) do
    local holds = c.test(now) and true or false
    local becomes = holds and not c.holds
    c.holds = holds
    if becomes then c.fn(now) end
    fired = fired or becomes
  end
  return fired
end

local function any_becomes(my, time)
  for _, c in ipairs(my.conditions) do
    if c.located and not c.holds and c.test(time) then return true end
  end
  return false
end

--- The earliest time from `low` to `high`, between which nothing is inserted, at which a condition becomes true; nil if none
-- does.
local function locate(my, low, high)
  local function holds_at(time)
    core.inhibition_show(my.engine, time)
    return any_becomes(my, time)
  end
  local near = 1e-9 * (high - low)
  local found
  local went, message = pcall(function()
    if not holds_at(high) then return end
    local first, last = low, high
    while last - first > near do
      local middle = first + (last - first) / 2
      if middle <= first or middle >= last then break end
      if holds_at(middle) then last = middle else first = middle end
    end
    found = last
  end)
  core.inhibition_show(my.engine, low)
  if not went then error(message, 0) end
  return found
end

-- Running -----------------------------------------------------------------------------------------------------------------------

--- Whether a threshold is not the same at times to come, near and far.
local function may_rise(below, now, scale)
  local value = core.call_rule(below, now)
  for k = -8, 52 do
    if core.call_rule(below, now + scale * 1.27 ^ k) ~= value then return true end
  end
  return false
end

--- Nothing has come for so long that nothing will: an error for a run that ends with a number of primordia.
local function check_patience(my, s)
  local scale = math.max(s.plastochron, 100 * s.time_scale)
  local since, patience = math.max(s.last_birth, 0), 200
  for _, rule in ipairs(my.rules) do
    if type(rule.below) == "function" and may_rise(rule.below, s.time, scale) then patience = 1e4 end
  end
  if my.most and s.count > 0 and s.time - since > patience * scale then
    local angle, value = core.inhibition_minimum(my.engine)
    fail("no place on the ring has been below the threshold since t = %.6g (now t = %.6g): the lowest field of the first " ..
      "inhibition is %.6g, at %.4g degrees; the run was to end with %d primordia and has %d",
      since, s.time, value, math.deg(angle), my.most, s.count)
  end
end

--- Up to the next thing of interest. Returns a status that ends the run, or nil.
local function go_on(my, target)
  local before = core.inhibition_state(my.engine).time
  if #my.conditions > 0 then
    local known = core.inhibition_known(my.engine)
    if not known then return "interrupted" end
    -- In the whole interval, wherever a pause has cut it: so that pauses do not change the time that is found.
    local from = core.inhibition_state(my.engine).searched_from
    local found = known > before and locate(my, from, known)
    core.inhibition_show(my.engine, before)
    if found and found <= target then
      core.inhibition_show(my.engine, math.max(found, before))
      if test_conditions(my, math.max(found, before)) then
        parts.refresh(my)
        prepare(my)
        return
      end
      core.inhibition_show(my.engine, before)
    end
  end
  local status = core.inhibition_advance(my.engine, target)
  if status == "interrupted" then return status end
  local s = core.inhibition_state(my.engine)
  if status == "inserted" and fire_counts(my, s.time) then
    parts.refresh(my)
    prepare(my)
  end
  if status == "clear" then check_patience(my, s) end
  if #my.conditions > 0 and test_conditions(my, s.time) then
    parts.refresh(my)
    prepare(my)
  end
end

local function advance(model, o)
  local my = inside[model]
  prepare(my)
  my.failure = nil
  local deadline = o.seconds and core.now() + o.seconds
  local first, stepped = true, false
  while true do
    local now = model.time
    local fired = course.fire(my, now, 0, nothing)
    fired = fire_counts(my, now) or fired
    if fired or first then
      if fired then parts.refresh(my) end
      prepare(my)
      if test_conditions(my, now) then parts.refresh(my) end
      prepare(my)
    end
    first = false
    if now >= o.to or model.finished then return "done" end
    if o.pause and stepped and now >= o.pause then return "paused" end
    if core.cancelled() then return "interrupted" end
    local target = course.next_event(my, o.to)
    if o.pause and o.pause > now then target = math.min(target, o.pause) end
    local status = go_on(my, math.max(target, now))
    stepped = true
    if status then return status end
    if deadline and core.now() >= deadline and model.time < o.to then return "out of time" end
  end
end

op { name = "phyllotaxis:advance", kind = "named", runs = true,
  returns = "'done', 'paused', 'out of time' or 'interrupted'",
  doc = "Runs the model to a time, or to the number of primordia at which it stops, events included. How often it pauses " ..
    "changes no primordium.",
  args = { { name = "to", type = "number", position = 1, unit = "time",
    doc = "until when; may be left out if the model stops with a number of primordia" },
    { name = "pause", type = "number", infinite = true, unit = "time", doc = "stop then" },
    { name = "seconds", type = "number", min = 0, unit = "s", doc = "stop after so much time on the clock" } },
  example = example .. "model:advance { to = 1 } print(model.time)",
  fn = function(model, o)
    local my = inside[model]
    if my.advancing then fail "phyllotaxis:advance cannot be called while the model runs, in an event or a condition" end
    o.to = o.to or my.most and parts.endless
    if not o.to then
      fail "phyllotaxis:advance: 'to' is missing: until when? (Or stop = { primordia = n } in tunica.phyllotaxis)"
    end
    my.advancing = true
    local begun = core.now()
    local ok, status = pcall(advance, model, o)
    my.seconds = my.seconds + core.now() - begun
    my.advancing = false
    if not ok then error(status, 0) end
    if core.inhibition_state(my.engine).overflowed then
      parts.warn(my, "old primordia were left out because there were too many (most), though their inhibition still counts")
    end
    return status
  end }

-- What changes, as bytes -------------------------------------------------------------------------------------------------------

op { name = "phyllotaxis:snapshot", returns = "text", example = example .. "print(#model:snapshot())",
  doc = "Everything that changes during a run: primordia, time, events, parameters, and the plain values that functions of " ..
    "the model keep.",
  fn = function(model)
    local my = inside[model]
    prepare(my)
    return core.pack { inhibition = core.inhibition_save(my.engine), random = core.random_state(), script = course.save(my) }
  end }

op { name = "phyllotaxis:restore", changes = true,
  args = { { name = "snapshot", type = "string", required = true, doc = "what model:snapshot() gave" } },
  doc = "Goes back to a snapshot of the same script.",
  example = example .. "local s = model:snapshot() model:advance(1) model:restore(s) print(model.time)",
  fn = function(model, bytes)
    local my = inside[model]
    local parts = core.unpack(bytes)
    if not (parts.inhibition and parts.script and parts.random) then fail "this is no snapshot of a model of phyllotaxis" end
    local begun = my.started
    prepare(my)
    course.check(my, parts.script, begun)
    core.random_state(parts.random)
    course.restore(my, parts.script)
    prepare(my)  -- may bind the fields anew
    core.inhibition_load(my.engine, parts.inhibition)
  end }

end
