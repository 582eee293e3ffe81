-- SPDX-License-Identifier: MIT
--- What a model has become, carried over to the model that the changed script gives: tissue or primordia, time, what was
-- changed by hand, and the values that its functions keep. Rules, and all that was not touched since loading, are the new
-- script's.

local core = require "tunica.core"
local registry = require "tunica.registry"
local binding = require "tunica.binding"
local course = require "tunica.course"
local params = require "tunica.params"
local plain = require "tunica.plain"
local ring_models = require "tunica.phyllotaxis"
local desk = require "tunica.prompt.desk"

local carry = {}

local function words(value)
  if type(value) == "string" then return "'" .. value .. "'" end
  return type(value) == "number" and core.shortest(value) or tostring(value)
end

local function carry_tissue(old, new, notes)
  if old.machine then binding.prepare(new) end  -- so that columns that rules derive are there
  new.machine, new.stale = nil, true  -- its columns are about to move
  local added, undeclared = core.tissue_carry(new.tissue, old.tissue)
  if #added > 0 then notes[#notes + 1] = "new: " .. table.concat(added, ", ") end
  for _, name in ipairs(undeclared) do
    notes[#notes + 1] = name .. " is not declared any more; it stays until the model is loaded again"
  end
end

--- Parameters changed since loading (by hand, by an event) stay so.
local function carry_parameters(old, new, begun, notes)
  if not old.params then return end
  local values = params.values(old.params)
  local before = begun.script.params
  for name, value in pairs(values) do
    if value ~= before[name] then
      local declared = new.params and params.declared(new.params)[name]
      local kept, why = pcall(function() new.params[name] = value end)
      if not declared then
        notes[#notes + 1] = string.format("not kept: P.%s = %s; there is no such parameter now", name, words(value))
      elseif not kept then
        notes[#notes + 1] = string.format("not kept: P.%s = %s; %s", name, words(value),
          (tostring(why):gsub("^.-parameter '[^']*': ", "")))
      else
        notes[#notes + 1] = string.format("P.%s stays %s (changed since loading; the file says %s)", name, words(value),
          words(declared.default))
      end
    end
  end
end

--- Keys "12:name" of plain.upvalues by name, each a list in their order.
local function keys_by_name(upvalues)
  local lists, all = {}, {}
  for _, list in ipairs { upvalues.values, upvalues.missing } do
    for key in pairs(list) do all[#all + 1] = key end
  end
  table.sort(all, function(a, b) return tonumber(a:match "^%d+") < tonumber(b:match "^%d+") end)
  for _, key in ipairs(all) do
    local name = key:match ":(.*)$"
    lists[name] = lists[name] or {}
    table.insert(lists[name], key)
  end
  return lists
end

local function same(a, b) return a == b or a ~= nil and b ~= nil and plain.encode(a) == plain.encode(b) end

--- Values that functions of the script keep: those that have changed since loading go to the variable of the same name.
local function carry_values(now, begun, new, notes)
  local functions = course.functions_of(new)
  local old_keys, new_keys = keys_by_name(now.upvalues), keys_by_name(plain.upvalues(functions))
  local saved = { values = {}, missing = {} }
  for name, keys in pairs(old_keys) do
    for i, key in ipairs(keys) do
      local value = now.upvalues.values[key]
      if not same(value, begun.script.upvalues.values[key]) then
        local target = new_keys[name] and #new_keys[name] == #keys and new_keys[name][i]
        if not target then
          notes[#notes + 1] = string.format("not kept: the value of '%s', which no function of the script uses in the same way " ..
            "now", name)
        elseif value == nil then
          saved.missing[target] = true
        else
          saved.values[target] = value
        end
      end
    end
  end
  plain.set_upvalues(functions, saved)
  if new.tissue then plain.refill(new.tissue.data, now.data or {}) end
end

--- Globals that the script made: those that changed while it ran.
local function carry_globals(now, begun)
  for name, value in pairs(now.globals) do
    if not same(value, begun.script.globals[name]) then rawset(_G, name, value) end
  end
end

local function carry_events(old, new, now, notes)
  local alike = #old.events == #new.events
  for i, e in ipairs(new.events) do
    local before = old.events[i]
    if before and before.kind == e.kind and before.time == e.time then
      e.fired = before.fired
    else
      e.fired, alike = course.fired_until(e, now), false
    end
  end
  if not alike then notes[#notes + 1] = "events that are not as before count from the present time" end
  if #old.conditions == #new.conditions then
    for i, c in ipairs(new.conditions) do c.holds = old.conditions[i].holds end
  elseif #new.conditions > 0 then
    notes[#notes + 1] = "the conditions of model:when are not as many as before; they begin anew"
  end
end

local function carry_course(old, new, changed)
  if new.engine then
    ring_models.prepare(new)
    if old.started then core.inhibition_load(new.engine, core.inhibition_save(old.engine)) end
    return
  end
  if not old.machine then
    new.saved_time = old.saved_time
    return
  end
  binding.prepare(new)
  core.machine_load(new.machine, core.machine_save(old.machine))
  if changed then core.rules_changed(new.machine) end
  binding.prepare(new)
  binding.refresh_derived(new)
end

local function carry_solution(old_model, new_model, begun, notes)
  local now, before = old_model:solution(), begun.solution
  if same(now, before) then return end
  new_model:solve_with(now)
  notes[#notes + 1] = string.format("the method stays %s (model:solve_with)", now.method)
end

--- Carries the state of `old` over to `new`. `changed`: whether the script's text has. Returns what is worth saying, as a list
-- of lines. Errors leave `old` as it was.
function carry.over(old_model, new_model, changed)
  local old, new, begun = desk.inside(old_model), desk.inside(new_model), desk.begun(old_model)
  if (old.engine == nil) ~= (new.engine == nil) then
    registry.fail "the script makes another kind of model now; load it anew"
  end
  local notes, time, at_present = {}, old_model.time, course.save(old)
  local added = desk.added(old_model)
  if added then notes[#notes + 1] = "not kept, for the script does not make them: " .. added end
  if old.tissue then carry_tissue(old, new, notes) end
  carry_parameters(old, new, begun, notes)
  local now = plain.decode(at_present, new.tissue)
  carry_values(now, begun, new, notes)
  carry_events(old, new, time, notes)
  if old.tissue then carry_solution(old_model, new_model, begun, notes) end
  carry_course(old, new, changed)
  carry_globals(now, begun)
  return notes
end

return carry
