-- SPDX-License-Identifier: MIT
--- The course of a model of any kind: events, conditions, reports, and what a checkpoint holds of the script. `my` is what
-- belongs to a model: events, conditions, reports, rules, params.

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local plain = require "tunica.plain"
local op, fail = registry.op, registry.fail

local course = {}

function course.values_of(my) return my.params and params.values(my.params) or {} end

-- Events ----------------------------------------------------------------------------------------------------------------

-- So many events in one step are a mistake in a unit; far shorter intervals would fire for ever and not move the time.
local most_in_a_step = 1000

function course.event(kind, time, fn) return { kind = kind, time = time, fn = fn, fired = 0 } end

--- When an event is due next, or nil.
local function due(e)
  if e.kind == "every" then return e.time * (e.fired + 1) end
  return e.kind == "at" and e.fired == 0 and e.time or nil
end

--- How often an event would have happened until now, if it had been there all the time.
function course.fired_until(e, now)
  if e.kind == "every" then return math.floor(now / e.time + 1e-9) end
  return e.kind == "at" and e.time < now and 1 or 0
end

--- The time of the next event, or `limit` if that is earlier.
function course.next_event(my, limit)
  local earliest = limit
  for _, e in ipairs(my.events) do
    local time = due(e)
    if time and time < earliest then earliest = time end
  end
  return earliest
end

--- Fires what is due now (times nearer than `slack` are the same). True if anything was; `refresh(my)` is called before.
function course.fire(my, now, slack, refresh)
  local refreshed = false
  for _, e in ipairs(my.events) do
    local time = due(e)
    if time and time <= now + slack then
      if not refreshed then refresh(my) end
      refreshed = true
      e.fn(time)
      e.fired = e.fired + 1  -- an event that fails has not happened
    end
  end
  return refreshed
end

-- Operations that every kind of model has ---------------------------------------------------------------------------------

--- Declares every, at, when, report and hash for an owner. `example`: what makes a `model`; `when`: a condition and its
-- event as an example, and what is said of its steps.
function course.operations(owner, inside, example, when)
  op { name = owner .. ":every", changes = true, fn = function(model, interval, fn)
      local dt = inside[model].dt
      if not dt and interval < 1e-9 * math.max(1, model.time) then
        fail("%s:every: the interval %.6g is so short that time would not move on", owner, interval)
      end
      if dt and interval < dt / most_in_a_step then
        fail("%s:every: the interval %.6g is far below the model's step dt = %.6g: more than %d events in a step", owner,
          interval, dt, most_in_a_step)
      end
      local e = course.event("every", interval, fn)
      e.fired = math.floor(model.time / interval + 1e-9)  -- those before now are past
      table.insert(inside[model].events, e)
    end,
    args = { { name = "interval", type = "number", above = 0, required = true, unit = "time", doc = "first after one interval" },
      { name = "event", type = "function", required = true, doc = "function(t)" } },
    doc = "Something that happens at regular times: growth, division.",
    example = example .. "model:every(1, function(t) print(t) end)" }
  op { name = owner .. ":at", changes = true,
    fn = function(model, time, fn) table.insert(inside[model].events, course.event("at", time, fn)) end,
    args = { { name = "time", type = "number", min = 0, required = true, unit = "time", doc = "when" },
      { name = "event", type = "function", required = true, doc = "function(t)" } },
    doc = "Something that happens once.", example = example .. "model:at(2, function() print 'now' end)" }
  op { name = owner .. ":when", changes = true,
    args = { { name = "condition", type = "function", required = true,
      doc = "function(t): true or false; it must change nothing" },
      { name = "event", type = "function", required = true, doc = "function(t)" },
      { name = "located", type = "boolean", default = true, doc = when.located } },
    doc = "Something that happens each time a condition becomes true. " .. when.doc, example = example .. when.example,
    fn = function(model, condition, fn, located)
      table.insert(inside[model].conditions, { test = condition, fn = fn, holds = false, located = located })
    end }
  op { name = owner .. ":report", changes = true, kind = "named", rest = { type = "function" },
    args = { { name = "every", type = "number", above = 0, unit = "time",
      doc = "interval of the time series; without it there is none" } },
    doc = "What the model says at its end, by name: functions that return a number, text or a table. With `every` also as a " ..
      "time series.",
    example = example .. "model:report { every = 1, " .. when.report .. " }",
    fn = function(model, o)
      local my = inside[model]
      my.report_every = o.every or my.report_every
      for name, fn in pairs(o) do
        if name ~= "every" then my.reports[#my.reports + 1] = { name = name, fn = fn } end
      end
    end }
  op { name = owner .. ":hash", returns = "16 hexadecimal digits",
    doc = "A fingerprint of everything that changes; equal states have equal ones.",
    example = example .. "print(model:hash())", fn = function(model) return core.hash(model:snapshot()) end }
end

-- What changes of the script ------------------------------------------------------------------------------------------------

local function functions_of(my)
  local list = {}
  for _, e in ipairs(my.events) do list[#list + 1] = e.fn end
  for _, c in ipairs(my.conditions) do
    list[#list + 1] = c.test
    list[#list + 1] = c.fn
  end
  for _, r in ipairs(my.reports) do list[#list + 1] = r.fn end
  for _, r in ipairs(my.rules) do list[#list + 1] = r.fn end
  return list
end

course.functions_of = functions_of

-- What a script (or someone at the prompt) adds to a model, in the order of adding; each with its name for messages.
local lists = { { "rules", "rules" }, { "events", "events" }, { "conditions", "conditions (when)" }, { "reports", "reports" } }

--- What has been added until now: { rules =, events =, conditions =, reports = }, copies of the lists.
function course.added(my)
  local copy = {}
  for _, list in ipairs(lists) do copy[list[1]] = { unpack(my[list[1]]) } end
  return copy
end

local function set_list(my, name, items)
  local list = my[name]
  local same = #list == #items
  for i, item in ipairs(items) do same = same and rawequal(list[i], item) end
  if same then return end
  for i = #list, 1, -1 do list[i] = nil end
  for i, item in ipairs(items) do list[i] = item end
  if name == "rules" then my.unbound = true end
end

--- Makes what course.added() gave the model's own again. Its rules are bound when a snapshot of that time is restored, which must
-- follow. Inhibitions of a model of phyllotaxis stay: its engine cannot lose them.
function course.put(my, added)
  for _, list in ipairs(lists) do
    if not (list[1] == "rules" and my.engine) then set_list(my, list[1], added[list[1]]) end
  end
end

--- How many there are in what course.save() gave, decoded; nil where it does not say.
local function counts_of(script)
  return { rules = script.rules, events = #script.fired, conditions = #script.holds, reports = script.reports }
end
course.counts_of = counts_of

--- What was added after course.save() gave `script`, as text by kind ("2 rules (rate, x.lua:3; ...)"); nil if nothing was.
function course.later(my, script)
  local counts, found = counts_of(script), {}
  for _, list in ipairs(lists) do
    local name, words = list[1], {}
    for i = (counts[name] or #my[name]) + 1, #my[name] do
      local item = my[name][i]
      words[#words + 1] = name == "rules" and string.format("%s, %s", item.what, item.where)
        or name == "events" and string.format(item.kind == "after" and "%s %d primordia" or "%s %.6g", item.kind, item.time)
        or name == "reports" and item.name or nil
    end
    local count = #my[name] - (counts[name] or #my[name])
    if count > 0 then
      found[#found + 1] = string.format("%d %s%s", count, count == 1 and list[2]:gsub("s%f[%A]", "", 1) or list[2],
        #words > 0 and " (" .. table.concat(words, "; ", 1, math.min(#words, 4)) .. (#words > 4 and "; ..." or "") .. ")" or "")
    end
  end
  return #found > 0 and table.concat(found, ", ") or nil
end

--- Events, conditions, parameters and the plain values that functions keep, as text.
function course.save(my)
  local fired, holds = {}, {}
  for i, e in ipairs(my.events) do fired[i] = e.fired end
  for i, c in ipairs(my.conditions) do holds[i] = c.holds end
  return plain.encode { fired = fired, holds = holds, rules = #my.rules, reports = #my.reports,
    params = course.values_of(my), data = my.tissue and my.tissue.data,
    upvalues = plain.upvalues(functions_of(my)), globals = plain.globals() }
end

--- Fails unless the text is of this model. What a model that has begun was given since goes; another must have as many rules,
-- events, conditions and reports.
function course.check(my, text, begun)
  local script = plain.decode(text, my.tissue)
  if type(script) ~= "table" then fail "the snapshot is damaged: it tells of no events" end
  local counts, kept = counts_of(script), course.added(my)
  for _, list in ipairs(lists) do
    local name, words = list[1], my.engine and list[1] == "rules" and "inhibitions" or list[2]
    local there, now = counts[name] or #my[name], #my[name]
    if there > now then
      fail("the snapshot has %d %s, the model %d: it is of another script, or of this model when more had been added to it", there,
        words, now)
    elseif there < now and not begun then
      fail("the snapshot is of another script: it has %d %s, the model %d", there, words, now)
    elseif there < now and words == "inhibitions" then
      fail("the snapshot has %d %s, the model %d, and cannot lose them; load it anew", there, words, now)
    end
    for i = now, there + 1, -1 do kept[name][i] = nil end
  end
  course.put(my, kept)
end

--- Goes back to what save() gave.
function course.restore(my, text)
  local script = plain.decode(text, my.tissue)
  for i, e in ipairs(my.events) do e.fired = script.fired[i] end
  for i, c in ipairs(my.conditions) do c.holds = script.holds[i] end
  if my.params then params.go_back(my.params, script.params) end
  if my.tissue then plain.refill(my.tissue.data, script.data) end
  plain.set_upvalues(functions_of(my), script.upvalues)
  plain.set_globals(script.globals)
end

return course
