-- SPDX-License-Identifier: MIT
--- The rules of a model bound to its tissue: traced, compiled, compared with what their functions give, and bound anew when what
-- they hold from outside has changed. `my` is what belongs to the model (model.lua).

local core = require "tunica.core"
local registry = require "tunica.registry"
local rules = require "tunica.rules"
local params = require "tunica.params"
local plain = require "tunica.plain"
local fail = registry.fail

local binding = {}

local function values_of(my) return my.params and params.values(my.params) or {} end

--- Plain values that rules hold from outside (numbers, text, tables of them, also through functions they call) and
-- parameters that are no numbers: if one changes, the rules must be traced again.
local function held_values(my)
  local functions, choices = {}, {}
  for i, r in ipairs(my.rules) do functions[i] = r.fn end
  for name, value in pairs(values_of(my)) do
    if type(value) ~= "number" then choices[name] = value end
  end
  return plain.encode { plain.upvalues(functions), choices }, plain.watch(functions), choices
end

--- Whether they are what they were when the rules were bound, for sure: asked before and after every event.
local function holds_the_same(my)
  if not my.watch or not my.watch() then return false end
  local values = values_of(my)
  for name, value in pairs(my.choices) do
    if values[name] ~= value then return false end
  end
  for name, value in pairs(values) do
    if type(value) ~= "number" and my.choices[name] == nil then return false end
  end
  return true
end

local function untraced_warning(my, r, reason)
  local text = string.format("%s: this %s rule is run by the interpreter, some hundred times slower: %s", r.where, r.what, reason)
  for _, said in ipairs(my.warnings) do
    if said == text then return end  -- when the rules were bound before
  end
  my.warnings[#my.warnings + 1] = text
  require("tunica.warnings").write(text)
end

--- Derived columns first, then what changes: a rate may be written before the columns it reads.
local function in_order(list)
  local ordered = {}
  for _, derive in ipairs { true, false } do
    for _, r in ipairs(list) do
      if (r.what == "derive") == derive then ordered[#ordered + 1] = r end
    end
  end
  return ordered
end

--- A name in `signed` that no rule changes would be without effect: most likely it is misspelt.
local function check_signed(my, machine)
  local names, known = core.machine_state(machine), {}
  for _, name in ipairs(names) do known[name] = true end
  for _, r in ipairs(my.rules) do
    if r.direct and r.waits then return end  -- it may be one of the columns that are not known yet
  end
  for _, name in ipairs(my.signed) do
    if not known[name] then
      registry.fail_at(my.where, "tunica.model: 'signed' names '%s', but no rate or flux changes a column of this name%s", name,
        core.did_you_mean(name, names))
    end
  end
end

--- Traces what can be traced; rules named in `direct` run as they are.
local function build(my)
  local set, index = core.rules(my.tissue), 0
  for _, r in ipairs(in_order(my.rules)) do
    local reason = r.direct or rules.trace(set, r)
    if reason then
      rules.add_direct(set, r, my.tissue)
      if not r.direct then
        r.direct = reason
        untraced_warning(my, r, reason)
      end
      r.index = nil
    else
      index = index + 1
      r.index = index
    end
  end
  local machine = core.machine(set, my.method, my.dt, my.tolerance, my.threads, my.signed)
  check_signed(my, machine)
  return set, machine
end

--- @param all  whether it is the first time for these rules: then more cells are looked at, and the compiled passes are compared
-- with the traced rules too, which depends on the rules alone
local function verify(my, set, machine, all)
  core.derive(machine, values_of(my), false)
  local time = core.machine_time(machine)
  for _, r in ipairs(my.rules) do
    local difference = r.index and rules.compare(set, r.index, r, my.tissue, values_of(my), time, all and 12 or 4)
    if difference then
      r.direct = difference
      untraced_warning(my, r, difference)
      return false
    end
  end
  if all then core.check_lowering(set, machine, values_of(my)) end
  return true
end

--- Adds what the machine has cost to what the model has. Returns the form of the sums too.
local function settle(my)
  if not my.machine then return my.spent end
  local cost, form = core.take_cost(my.machine)
  for name, value in pairs(cost) do my.spent[name] = (my.spent[name] or 0) + value end
  return my.spent, form
end

--- Binds the rules anew until those that are traced agree with direct evaluation.
local function bind(my)
  local old = my.machine
  settle(my)
  repeat
    my.set, my.machine = build(my)
    if old then
      core.machine_load(my.machine, core.machine_save(old))
      core.rules_changed(my.machine)
    end
  until verify(my, my.set, my.machine, true)
end

--- Runs `work` while rules may be called: they must not change the structure, nor run the model.
local function with_rules(my, work)
  if my.busy then fail("a model cannot be run, saved or looked into from inside its own rules") end
  my.busy = true
  local ok, message = pcall(core.with_lock, my.tissue, work, my)
  my.busy = false
  if not ok then error(message, 0) end
end

--- Whether a rule waits for the first wall (side) to set anything in, and there is one now.
local function can_know_more(my)
  for _, r in ipairs(my.rules) do
    if r.direct and rules.can_know(r, my.tissue) then return true end
  end
  return false
end

local function prepare(my)
  if my.busy then fail("a model cannot be run, saved or looked into from inside its own rules") end
  local more = can_know_more(my)
  if not my.stale and not more and holds_the_same(my) then return end
  local held, watch, choices = held_values(my)
  my.watch, my.choices = watch, choices
  if not my.stale and not more and held == my.held then return end
  if more or my.held and held ~= my.held then
    for _, r in ipairs(my.rules) do r.direct = nil end
  end
  my.stale = true
  with_rules(my, bind)
  my.held, my.stale, my.bound_anew = held, false, true
end

--- What a rule decides by may change with the state: after the 1st, 2nd, 4th, 8th ... and every 64th event traced rules are
-- compared with direct evaluation again.
local function verify_now_and_then(my)
  my.verified = (my.verified or 0) + 1
  local n = my.verified
  local power = n % 64 == 0
  for k = 0, 5 do power = power or n == 2 ^ k end
  if not power then return end
  local agree = true
  with_rules(my, function() agree = verify(my, my.set, my.machine, n == 1) end)
  if not agree then with_rules(my, bind) end
end

--- Calls what takes the machine on; what stops it is kept for the record.
local function with_machine(my, f, ...)
  local ok, result = pcall(f, my.machine, ...)
  if ok then return result end
  my.failure = core.failure(my.machine)
  error(result, 0)
end

--- Brings the derived columns up to date for those who look at them: events, conditions, reports, pictures.
local function refresh_derived(my)
  for _, r in ipairs(my.rules) do
    if r.what == "derive" then return with_machine(my, core.derive, values_of(my), true) end
  end
end

binding.values_of = values_of
binding.settle = settle
binding.with_rules = with_rules
binding.can_know_more = can_know_more
binding.prepare = prepare
binding.verify_now_and_then = verify_now_and_then
binding.with_machine = with_machine
binding.refresh_derived = refresh_derived

return binding
