-- SPDX-License-Identifier: MIT
--- A model: a tissue, its rules, its events, and what is to be seen of it.

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local course = require "tunica.course"
local conditions = require "tunica.conditions"
local binding = require "tunica.binding"
local values_of, settle, with_rules, can_know_more = binding.values_of, binding.settle, binding.with_rules, binding.can_know_more
local prepare, verify_now_and_then = binding.prepare, binding.verify_now_and_then
local with_machine, refresh_derived = binding.with_machine, binding.refresh_derived
local op, fail = registry.op, registry.fail

-- What belongs to each model; weak, so that the model itself shows only what is meant to be seen.
local inside = setmetatable({}, { __mode = "k" })
local methods = {}

local function is_model(value) return type(value) == "table" and inside[value] ~= nil end
registry.type("model", "a model", is_model, methods)

local public = { tissue = true, params = true, name = true, views = true, reports = true, report_every = true, failure = true, stop = true, about = true }

local meta = { __metatable = "model" }

function meta.__index(model, key)
  if methods[key] then return methods[key] end
  if registry.tracing and (key == "time" or key == "steps") then
    fail("model.%s in a rule cannot be traced; a rule gets the time as its last argument", key)
  end
  local my = inside[model]
  if key == "time" then return my.machine and (core.machine_time(my.machine)) or my.saved_time end
  if key == "steps" then return my.machine and select(2, core.machine_time(my.machine)) or 0 end
  if key == "about" then return methods.describe(model) end
  if key == "cost" then return methods.cost_of(model) end
  if public[key] then return my[key] end
  local names = { "time", "steps", "cost" }
  for name in pairs(public) do names[#names + 1] = name end
  for name in pairs(methods) do names[#names + 1] = name end
  fail("a model has no '%s'%s", tostring(key), type(key) == "string" and core.did_you_mean(key, names) or "")
end

function meta.__newindex(model, key, value)
  if key == "name" and type(value) == "string" then inside[model].name = value return end
  fail("'%s' of a model cannot be set; use its operations (model:rate, model:every, ...)", tostring(key))
end

function meta.__tostring(model)
  local my = inside[model]
  return string.format("model %s: %d cells, %d rules, time %.6g", my.name or "", my.tissue:count(), #my.rules, model.time)
end

local ways, names_of_methods, titles = {}, {}, {}
for i, way in ipairs(core.methods_of_solution()) do
  ways[way.name], names_of_methods[i] = way, way.name
  titles[i] = string.format("%s: %s, order %d%s", way.name, way.title, way.order, way.adaptive and ", adaptive" or "")
end
local method_doc = "method of integration (" .. table.concat(titles, "; ") .. ")"
local dt_doc = "step; of adaptive methods the longest, and may be left out. rkc2 with dt and no tolerance takes fixed steps"
local tolerance_doc = "adaptive methods: error allowed in one step, relative to each value and its column's root mean square"
local default_tolerance = 1e-6

local header = [[local tunica = require "tunica"
local tissue = tunica.ring { 50 }
tissue:cell { auxin = function(c) return 1 + c:uniform(-.02, .02) end }
local model = tunica.model { tissue = tissue, dt = .01 }
]]
local diffusion = header .. [[model:rate(function(c, d) d.auxin = c:sum(function(n) return n.auxin - c.auxin end) end)
]]

--- Whether the tolerance decides the steps.
local function adaptive(o)
  local way = ways[o.method]
  return way.adaptive and not (way.either and o.dt and not o.tolerance)
end

--- Methods with fixed steps need one.
local function check_solution(operation, o)
  if o.dt == nil and not ways[o.method].adaptive then
    fail("%s: 'dt' is missing: the method %s takes fixed steps; 'dt' must be a number greater than 0", operation, o.method)
  end
end

op { name = "tunica.model", kind = "named", returns = "a model",
  doc = "A model of a tissue: to be given rules (derive, rate, flux), events (every, at, when), views and a report.",
  args = {
    { name = "tissue", type = "tissue", required = true, doc = "the tissue" },
    { name = "params", type = "any", doc = "the table that tunica.params gave" },
    { name = "dt", type = "number", above = 0, unit = "time", doc = dt_doc },
    { name = "method", type = "string", choices = names_of_methods, doc = method_doc .. "; if not given, euler where dt is given, else auto" },
    { name = "tolerance", type = "number", above = 0, max = 1, doc = tolerance_doc .. "; 1e-6 if not given" },
    { name = "threads", type = "integer", min = 1, max = 64, default = 1, doc = "threads for tissues of 5,000 cells and more; the result does not depend on it" },
    { name = "stop", type = "number", min = 0, unit = "time", doc = "when a batch run ends, unless --until says so" },
    { name = "signed", type = "list", of = "string", default = {}, doc = "columns that may become negative" },
  },
  example = header .. "print(model)",
  fn = function(o)
    if o.params ~= nil and not params.is(o.params) then
      fail("tunica.model: 'params' must be what tunica.params gave, came %s", core.describe(o.params))
    end
    o.method = o.method or (o.dt and "euler" or "auto")
    check_solution("tunica.model", o)
    local model = setmetatable({}, meta)
    inside[model] = { tissue = o.tissue, params = o.params or params.current(), dt = o.dt, method = o.method, tolerance = o.tolerance, threads = o.threads,
      adaptive = adaptive(o), step = o.dt, spent = {}, where = registry.where(),
      signed = o.signed, stop = o.stop, rules = {}, events = {}, conditions = {}, views = {}, reports = {}, saved_time = 0, stale = true, warnings = {} }
    return model
  end }

-- Rules ----------------------------------------------------------------------------------------------------------------

local kinds = { "cell", "side", "wall" }

local function add_rule(what)
  return function(model, kind_or_fn, fn)
    local kind = "cell"
    if type(kind_or_fn) == "string" then
      kind = kind_or_fn
    else
      if fn ~= nil then fail("model:%s takes one rule at a time, came two functions; call it once for each", what) end
      fn = kind_or_fn
    end
    if type(fn) ~= "function" then fail("model:%s: a rule must be a function, came %s", what, core.describe(fn)) end
    local my = inside[model]
    my.rules[#my.rules + 1] = { what = what, kind = kind, fn = fn, where = registry.where() }
    my.stale = true
  end
end

local element = { name = "element", type = "string|function", choices = kinds, required = true,
  doc = "the rule for cells; or 'cell', 'side' or 'wall', and then the rule" }
local rule = { name = "rule", type = "function", doc = "the rule, if an element was named" }

op { name = "model:derive", changes = true, args = { element, rule }, fn = add_rule "derive",
  doc = "Columns that follow from others at every moment: function(c, t) c.x = ... end; for sides function(s, t), for walls function(w, a, b, t).",
  example = diffusion .. "model:derive(function(c) c.twice = 2 * c.auxin end)" }
op { name = "model:rate", changes = true, args = { element, rule }, fn = add_rule "rate", source = "thesis 9.1",
  doc = "Rates of change: function(c, d, t) d.x = ... end; for sides function(s, d, t), for walls function(w, d, a, b, t). Rates of several rules are added.",
  example = diffusion }
op { name = "model:flux", changes = true, returns = nil, source = "thesis 5.9",
  args = { { name = "column", type = "string", required = true, doc = "the concentration that is carried" },
    { name = "flux", type = "function", required = true, doc = "function(w, a, b, t): amount per time through wall w from cell a to cell b" } },
  doc = "Transport through walls: what leaves a arrives in b. The concentration changes by the amount divided by the cell's area (by the amount itself in a tissue without geometry).",
  example = header .. [[model:flux("auxin", function(w, a, b) return a.auxin - b.auxin end)]],
  fn = function(model, column, fn)
    local my = inside[model]
    my.rules[#my.rules + 1] = { what = "flux", kind = "wall", column = column, fn = fn, where = registry.where() }
    my.stale = true
  end }

-- Events ----------------------------------------------------------------------------------------------------------------

course.operations("model", inside, diffusion, {
  doc = "It is asked at the start, after events, and after each step; when it has become true in a step, the step is taken anew to end where it did.",
  located = "false: it happens at the end of the step, and changes no step; for what only watches",
  example = "model:when(function() return tissue:max 'auxin' < 1.01 end, function(t) print(t) end)",
  report = "most = function() return tissue:max 'auxin' end" })

-- Views --------------------------------------------------------------------------------------------------------------------

--- For view.lua, which knows what a view may hold.
function methods.add_view(model, view) table.insert(inside[model].views, view) end

-- Running ------------------------------------------------------------------------------------------------------------------

--- Times nearer than this are the same.
local function slack_of(my) return (select(3, core.machine_time(my.machine))) end

local function step_towards(my, target, pause, deadline)
  if #my.conditions > 0 then pause = -1e300 end
  return with_machine(my, core.advance, values_of(my), target, pause, deadline and math.max(0, deadline - core.now()))
end

--- Shows the state at `pause` if it lies within the last step (adaptive methods), after `from`.
local function pause_inside(my, pause, from)
  if not pause or not my.adaptive then return false end
  local first, last = core.last_step(my.machine)
  if not first or not (pause > math.max(first, from) and pause < last - slack_of(my)) then return false end
  core.show(my.machine, pause)
  return true
end

--- One step and more, until something may have to happen. Returns a status that ends the run, or nil.
local function go_on(my, model, o, deadline)
  local asked, before = #my.conditions > 0, model.time
  local target = math.max(course.next_event(my, o.to), before)
  if asked and select(4, core.machine_time(my.machine)) then  -- shown within a step whose end was not looked at
    core.look(my.machine, values_of(my))
    local _, last = core.last_step(my.machine)
    if last and last <= target + slack_of(my) then
      if pause_inside(my, o.pause, before) then return "paused" end
      core.show(my.machine, last)
      conditions.test(my, last, refresh_derived)
      return
    end
  end
  local status = step_towards(my, target, o.pause, deadline)
  if status == "interrupted" then return status end
  if asked then
    if conditions.locate(my, refresh_derived, with_machine) == "interrupted" then return "interrupted" end
    if pause_inside(my, o.pause, before) then return "paused" end
    conditions.test(my, model.time, refresh_derived)
  end
  if status == "out of time" or status == "paused" and not asked and my.adaptive then return status end
end

--- See the operation below.
local function advance(model, o)
  local my = inside[model]
  prepare(my)
  my.failure = nil
  if my.bound_anew then refresh_derived(my) end  -- binding does not judge the values
  my.bound_anew = false
  local deadline = o.seconds and core.now() + o.seconds
  local stepped = false
  while true do
    local now, slack = model.time, slack_of(my)
    local fired = course.fire(my, now, slack, refresh_derived)
    prepare(my)
    if fired then verify_now_and_then(my) end
    if #my.conditions > 0 and (fired or model.steps == 0) then
      conditions.test(my, now, refresh_derived)
      prepare(my)
    end
    if now >= o.to - slack then break end
    if o.pause and stepped and now >= o.pause - slack then return "paused" end
    if core.cancelled() then return "interrupted" end
    local status = go_on(my, model, o, deadline)
    stepped = true
    if can_know_more(my) then prepare(my) end
    if status then return status end
    if deadline and core.now() >= deadline and model.time < o.to - slack then
      return "out of time"
    end
  end
  refresh_derived(my)
  return "done"
end

op { name = "model:advance", kind = "named", runs = true, returns = "'done', 'paused', 'out of time' or 'interrupted'",
  doc = "Runs the model to a time, events included. How often it pauses changes no step.",
  args = { { name = "to", type = "number", required = true, position = 1, unit = "time", doc = "until when" },
    { name = "pause", type = "number", infinite = true, unit = "time", doc = "stop then (with fixed steps: after the first that ends then or later)" },
    { name = "seconds", type = "number", min = 0, unit = "s", doc = "stop after so much time on the clock" } },
  example = diffusion .. "model:advance { to = 1 } print(model.time)",
  fn = function(model, o)
    local my = inside[model]
    if my.advancing then fail("model:advance cannot be called while the model runs, in an event or a condition") end
    my.advancing = true
    local ok, status = pcall(advance, model, o)
    my.advancing = false
    if not ok then error(status, 0) end
    if status ~= "done" then refresh_derived(my) end
    return status
  end }

-- What changes, as bytes -------------------------------------------------------------------------------------------------

op { name = "model:snapshot", returns = "text", example = diffusion .. "print(#model:snapshot())",
  doc = "Everything that changes during a run: the tissue, the time, the events, parameters, and the plain values (numbers, text, tables of them) that functions of the model keep.",
  fn = function(model)
    local my = inside[model]
    prepare(my)
    return core.pack { tissue = core.tissue_save(my.tissue), machine = core.machine_save(my.machine), random = core.random_state(),
      script = course.save(my) }
  end }

op { name = "model:restore", changes = true, args = { { name = "snapshot", type = "string", required = true, doc = "what model:snapshot() gave" } },
  doc = "Goes back to a snapshot of the same script. Rules, events and reports that the model was given since go. The method stays the one in use (model:solve_with).", example = diffusion .. "local s = model:snapshot() model:advance(1) model:restore(s) print(model.time)",
  fn = function(model, bytes)
    local my = inside[model]
    local parts = core.unpack(bytes)
    if not (parts.tissue and parts.machine and parts.script and parts.random) then fail("this is no snapshot of a model") end
    local begun = my.machine ~= nil
    if not my.unbound then prepare(my) end
    course.check(my, parts.script, begun)
    if my.unbound then  -- rules have gone, or come again: they are bound to the tissue of the snapshot
      if my.busy then fail("a model cannot be restored from inside its own rules") end
      settle(my)
      my.machine, my.set, my.stale, my.unbound = nil, nil, true, nil
    end
    core.tissue_load(my.tissue, parts.tissue)
    core.random_state(parts.random)
    course.restore(my, parts.script)  -- handles are of the tissue that is now there
    settle(my)
    my.spent = {}
    if not my.machine then prepare(my) end
    core.machine_load(my.machine, parts.machine)
    prepare(my)  -- may bind the rules anew
    core.machine_load(my.machine, parts.machine)
    refresh_derived(my)
  end }

-- How it is solved ---------------------------------------------------------------------------------------------------------

op { name = "model:solve_with", kind = "named", runs = true,
  doc = "Changes how the model is solved from now on; state and time stay. A new method begins with its own dt (fixed steps: the old one, unless given) and tolerance.",
  args = { { name = "method", type = "string", choices = names_of_methods, doc = method_doc },
    { name = "dt", type = "number", above = 0, unit = "time", doc = dt_doc },
    { name = "tolerance", type = "number", above = 0, max = 1, doc = tolerance_doc } },
  example = diffusion .. "model:advance(1) model:solve_with { method = 'rkc2', tolerance = 1e-5 } model:advance(2) print(model.cost.evaluations)",
  fn = function(model, o)
    local my = inside[model]
    if my.busy then fail("model:solve_with cannot be called in a rule") end
    local method = o.method or my.method
    local solution = { method = method, dt = o.dt, tolerance = o.tolerance }
    if not o.method then solution.dt = o.dt or my.dt
    elseif not ways[method].adaptive then solution.dt = o.dt or my.step end
    if not o.method then solution.tolerance = o.tolerance or my.tolerance end
    check_solution("model:solve_with", solution)
    if my.machine then
      settle(my)
      core.machine_method(my.machine, solution.method, solution.dt, solution.tolerance)
    end
    my.method, my.dt, my.tolerance, my.adaptive = method, solution.dt, solution.tolerance, adaptive(solution)
    my.step = my.dt or my.step
    my.spent = {}
  end }

--- The settings of the method: for a record from which a run is to go on.
function methods.solution(model)
  local my = inside[model]
  return { method = my.method, dt = my.dt, tolerance = my.tolerance }
end

--- For charts of methods: the columns that rates change, as a list of { name =, kind = }.
function methods.state_columns(model)
  local my, list = inside[model], {}
  prepare(my)
  local names, kinds_of = core.machine_state(my.machine)
  for i, name in ipairs(names) do list[i] = { name = name, kind = kinds_of[i] } end
  return list
end

--- The spectral radius of the rates' derivative at the present state, to about 1e-4 where the power method converges.
function methods.spectral_radius(model)
  local my = inside[model]
  prepare(my)
  return (core.machine_spectral_radius(my.machine, values_of(my), 1e-6, 2000))
end

--- What the model has cost since it was made, restored or given a method.
function methods.cost_of(model)
  local copy = { seconds = 0, steps = 0, rejected = 0, evaluations = 0, jacobians = 0, factorizations = 0, newton_iterations = 0,
    linear_iterations = 0, cell_steps = 0 }
  for name, value in pairs(settle(inside[model])) do copy[name] = value end
  return copy
end

op { name = "model:steady", kind = "named", runs = true, source = "thesis 9.5",
  returns = "a table: how (elimination, sparse factors, newton), iterations, residual, growth (largest real part found among the eigenvalues of the Jacobian), stable",
  doc = "Goes to a state in which nothing changes by the rates as they are at the present time; time stays, events do not happen. Linear rules are solved directly, others by Newton's method from the present state. If there is none, or it is not determined, nothing changes.",
  args = { { name = "tolerance", type = "number", above = 0, default = 1e-10, doc = "of what is left of the rates, relative to their terms" },
    { name = "stability", type = "boolean", default = true, doc = "whether to look if small disturbances decay" } },
  example = header .. [[model:rate(function(c, d) d.auxin = 1 - c.auxin + c:sum(function(n) return n.auxin - c.auxin end) end) print(model:steady().stable)]],
  fn = function(model, o)
    local my = inside[model]
    prepare(my)
    local found
    with_rules(my, function() found = core.steady(my.machine, values_of(my), o.tolerance, o.stability) end)
    refresh_derived(my)
    return found
  end }

--- For run.json: method and why, rules, warnings, cost.
function methods.describe(model)
  local my = inside[model]
  prepare(my)
  local listed = {}
  for i, r in ipairs(my.rules) do
    listed[i] = { rule = r.what, element = r.kind, where = r.where, traced = not r.direct, reason = r.direct or nil }
  end
  local _, form = settle(my)
  local counts = methods.cost_of(model)
  local seconds, cell_steps = counts.seconds, counts.cell_steps
  counts.seconds = nil
  local way = ways[my.method]
  local chosen, why = core.machine_choice(my.machine)
  return { method = my.method, dt = my.dt, tolerance = my.adaptive and (my.tolerance or default_tolerance) or nil, title = way.title,
    order = way.order, chosen = chosen, why = why or "named by the model", threads = my.threads, rules = listed, warnings = my.warnings, sums = form, counts = counts,
    cost = { seconds = seconds, cell_steps = cell_steps, ns_per_cell_step = cell_steps > 0 and seconds / cell_steps * 1e9 or nil } }
end

return { is_model = is_model, inside = inside }
