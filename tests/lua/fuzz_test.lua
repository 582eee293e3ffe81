-- SPDX-License-Identifier: MIT
-- No script crashes the program: every operation of the registry with awkward values in every place, and long random
-- sequences of changes. Each call is a Lua error with a message, or leaves a valid tissue.
-- TUNICA_FUZZ (0..1, default 0.1) is the share of the full size that is run.
local tunica = require "tunica"
local registry = require "tunica.registry"
local core = require "tunica.core"
local check = require "check"

local share = tonumber(os.getenv "TUNICA_FUZZ" or "") or 0.1

-- A small random number generator of its own: the sequences do not depend on the run's seed.
local state = 12345
local function random(n)
  state = (state * 16807) % 2147483647
  return state % n + 1
end

-- Wrong arguments --------------------------------------------------------------------------------------------------

local function fresh()
  local tissue = tunica.hexagons { 3, 3, seed = 1 }
  tissue:cell { auxin = 1, pin = { 1, divide = "split" } }
  return tissue
end

local foreign = tunica.hexagons { 2, 2 }
local gone = fresh()
local stale = gone:find(5)
stale:divide()

local shapes = { contour = tunica.contour "dome", curve = tunica.curve "raised", apex = tunica.apex { growth = "raised" } }

local kept -- by a rule, from the call before

--- Name and maker of each awkward value; what belongs to the tissue at hand is made from it.
local awkward = {
  { "nil", function() return nil end },
  { "true", function() return true end },
  { "-1", function() return -1 end },
  { "0", function() return 0 end },
  { "0.5", function() return 0.5 end },
  { "nan", function() return 0 / 0 end },
  { "inf", function() return math.huge end },
  { "2^53", function() return 2 ^ 53 end },
  { "empty text", function() return "" end },
  { "long text", function() return ("x"):rep(100000) end },
  { "empty table", function() return {} end },
  { "nested table", function() return { { { {} } }, "x", { 0 / 0 } } end },
  { "stale cell", function() return stale end },
  { "foreign cell", function() return foreign:find(1) end },
  { "cell", function(t) return t:find(1) end },
  { "wall", function(t) return t:find(2, "wall") end },
  { "tissue", function(t) return t end },
  { "contour", function() return shapes.contour end },
  { "curve", function() return shapes.curve end },
  { "apex", function() return shapes.apex end },
  { "failing function", function() return function() error("as it must") end end },
  { "changing function", function(t) return function() t:find(1):remove() return 1, 1, 1, 1 end end },
  { "silent function", function() return function() end end },
  { "keeping function", function()
    return function(x, d)
      local before = kept
      kept = { x, type(x) == "userdata" and x.auxin, d }
      for _, value in ipairs(before or {}) do
        if random(3) < 2 then pcall(function() value.auxin = 1 end) end
        if random(3) < 2 then pcall(function() return value:sum(function(n) return n.auxin + kept[2] end) end) end
        if random(3) < 2 then d.auxin = value end
      end
      d.auxin = before and random(2) < 2 and before[2] or 1
      return before and before[2]
    end
  end },
}

local is_tissue_model, is_phyllotaxis = require("tunica.model").is_model, require("tunica.phyllotaxis").is_phyllotaxis
local function is_model(value) return is_tissue_model(value) or is_phyllotaxis(value) end
local calls, errors = 0, 0

--- One call: a Lua error with a text, or a valid tissue.
local function try(what, tissue, f, ...)
  local ok, message = pcall(f, ...)
  calls = calls + 1
  if not ok then
    errors = errors + 1
    assert(type(message) == "string" and #message > 5, what .. ": an error without a message")
    assert(#message < 2000 or what:match "^core", what .. ": a message of " .. #message .. " characters")
  end
  local valid, problems = tissue:validate()
  assert(valid, what .. ": " .. table.concat(problems or {}, "\n"))
  if core.kind(message) == "tissue" then check.valid(message) end
  return message
end

--- The same for an operation of a model, whose rules and events come to light when it runs.
local function try_model(what, tissue, f, model, ...)
  try(what, tissue, f, model, ...)
  if is_model(model) then try(what .. ", then advanced", tissue, model.advance, model, { to = 0.3 }) end
end

--- What may be needed to reach the code behind the checks: a right value for each required argument.
local function right(spec, tissue)
  local kind = spec.type:match "^[^|]+"
  if spec.default ~= nil then return spec.default end
  if kind == "integer" then return 3 end
  if kind == "number" then return 1 end
  if kind == "string" then return spec.choices and spec.choices[1] or "x" end
  if kind == "function" then return function() return 1, 1, 1, 1 end end
  if kind == "list" then return {} end
  if kind == "column" then return "auxin" end
  if kind == "vector" then return { 1, 0 } end
  if kind == "boolean" then return true end
  return tissue:find(2, core.methods[kind] and kind ~= "tissue" and kind or "cell")
end

--- A small model, that what is called may be followed by a run. An event ends those that would go on for ever.
local function model_of(tissue)
  local model = tunica.model { tissue = tissue, dt = 0.1 }
  model:rate(function(c, d) d.auxin = c:sum(function(n) return n.auxin - c.auxin end) end)
  model:derive(function(c) c.twice = 2 * c.auxin end)
  model:at(0.5, function() error "far enough" end)
  return model
end

local function phyllotaxis()
  local model = tunica.phyllotaxis { path = function(age) return 1, -age end, samples = 24 }
  model:inhibition { field = function(d, age) return math.exp(-age) / d end, below = 2 }
  model:at(0.5, function() error "far enough" end)
  return model
end

local function subject(entry, tissue)
  if entry.owner == "tunica" then return nil end
  if shapes[entry.owner] then return shapes[entry.owner] end
  if entry.owner == "model" then return model_of(tissue) end
  if entry.owner == "phyllotaxis" then return phyllotaxis() end
  if entry.owner == "tissue" then return tissue end
  return tissue:find(1, entry.owner)
end

--- Calls entry with values[i] for its i-th argument (a maker), and right ones elsewhere.
local function call_with(entry, values, what)
  local tissue, names = fresh(), {}
  local given, count = {}, #entry.args
  for i, spec in ipairs(entry.args) do
    if values[i] then given[i] = values[i](tissue) elseif spec.required then given[i] = right(spec, tissue) end
    names[i] = spec.name
  end
  if entry.kind == "named" then
    local options = {}
    for i = 1, count do options[names[i]] = given[i] end
    if values.rest then options[entry.rest and "fresh_name" or "unknown"] = values.rest(tissue) end
    given, count = { options }, 1
  end
  if entry.owner == "tunica" then
    local made = try(what, tissue, entry.call, unpack(given, 1, count))
    if is_model(made) then try(what .. ", then advanced", tissue, made.advance, made, { to = 0.3 }) end
  else
    ((entry.owner == "model" or entry.owner == "phyllotaxis") and try_model or try)(what, tissue, entry.call, subject(entry, tissue), unpack(given, 1, count))
  end
end

local owners = { tunica = true, tissue = true, cell = true, wall = true, side = true, junction = true, model = true, phyllotaxis = true }
for owner in pairs(shapes) do owners[owner] = true end
local foreign_names = { ["tunica.params"] = true, -- one per script
  ["contour:save"] = true, ["curve:save"] = true } -- would write files
local slow = { ["tissue:picture"] = true, ["tissue:show"] = true, ["phyllotaxis:picture"] = true,
  ["phyllotaxis:plot"] = true } -- each call draws
local function ours(entry)
  return owners[entry.owner] and not foreign_names[entry.name] and entry.kind ~= "property" and
    not (slow[entry.name] and share < 1)
end

local function fuzz_entry(entry)
  for _, one in ipairs(awkward) do
    -- in the place of the subject, without a subject, as only argument, as one argument too many
    local tissue = fresh()
    try(entry.name .. " of " .. one[1], tissue, entry.call, one[2](tissue))
    ;((entry.owner == "model" or entry.owner == "phyllotaxis") and try_model or try)(entry.name .. " with " .. one[1], tissue, entry.call,
      subject(entry, tissue) or 1, one[2](tissue))
    try(entry.name .. " with many", tissue, entry.call, subject(entry, tissue) or 1, 1, 1, 1, 1, 1, 1, one[2](tissue))
    for i, spec in ipairs(entry.args) do
      call_with(entry, { [i] = one[2] }, entry.name .. " with " .. spec.name .. " = " .. one[1])
    end
    call_with(entry, { rest = one[2] }, entry.name .. " with an unknown " .. one[1])
  end
end

local function fuzz_pairs(entry)
  for _, one in ipairs(awkward) do
    for _, two in ipairs(awkward) do
      call_with(entry, { one[2], two[2] }, string.format("%s with %s, %s", entry.name, one[1], two[1]))
    end
  end
end

local entries = {}
for _, entry in ipairs(registry.all()) do
  if ours(entry) then entries[#entries + 1] = entry end
end
for at, entry in ipairs(entries) do
  fuzz_entry(entry)
  if #entry.args >= 2 and (share >= 1 or at % 8 == 0) then fuzz_pairs(entry) end
end

-- Reading and writing every property, and fields that are not there.
for _, kind in ipairs { "cell", "wall", "side", "junction" } do
  local tissue = fresh()
  local handle = tissue:find(1, kind)
  for _, one in ipairs(awkward) do
    local value = one[2](tissue)
    try(kind .. " indexed", tissue, function() return handle[value] end)
    try(kind .. " assigned", tissue, function() handle[value] = 1 end)
    try(kind .. " compared", tissue, function() return handle == value, handle < value end)
    try(kind .. " added", tissue, function() return handle + value end)
    try(kind .. " joined", tissue, function() return handle .. value end)
    try(kind .. " called", tissue, function() return handle(value) end)
    try("tissue indexed", tissue, function() return tissue[value] end)
    try("tissue assigned", tissue, function() tissue[value] = value end)
    try("auxin assigned", tissue, function() tissue:find(1).auxin = value end)
    for name in pairs(core.properties[kind]) do
      try(kind .. "." .. name .. " assigned", tissue, function() handle[name] = value end)
      try(kind .. "." .. name .. " of " .. one[1], tissue, core.properties[kind][name], value)
    end
  end
end

local awkward_below = {
  { "rules", function(t) return core.rules(t) end },
  { "machine", function(t) return core.machine(core.rules(t), "euler", 0.1, nil, 1, {}) end },
}
for i, one in ipairs(awkward) do awkward_below[i + 2] = one end

-- The functions below the registry, which a script can reach by require: they check again.
local of_files = { write_atomic = true, mkdir = true, rename = true, remove_all = true, random_state = true, seed = true,
  overrides = true, lock_file = true }
for name, f in pairs(core) do
  if type(f) == "function" and not of_files[name] then
    for _, one in ipairs(awkward_below) do
      local tissue = fresh()
      try("core." .. name, tissue, f, one[2](tissue))
      try("core." .. name, tissue, f, tissue, one[2](tissue), one[2](tissue), one[2](tissue))
      try("core." .. name, tissue, f, tissue:find(1), one[2](tissue), one[2](tissue), one[2](tissue))
      try("core." .. name, tissue, f, tissue, "cell", one[2](tissue), one[2](tissue), one[2](tissue))
      local rules = core.rules(tissue)
      try("core." .. name, tissue, f, rules, "rate", "cell", one[2](tissue), "here", one[2](tissue))
      try("core." .. name, tissue, f, rules, "derive", "side", one[2](tissue), "here", { "auxin" })
      try("core." .. name, tissue, f, rules, {}, 0, 1, one[2](tissue))
      local machine = core.machine(rules, "heun", 0.1, nil, 1, {})
      try("core." .. name, tissue, f, machine, {}, one[2](tissue), one[2](tissue), 0.01)
    end
  end
end

-- Random sequences -------------------------------------------------------------------------------------------------

local function some(tissue, kind)
  local n = tissue:count(kind)
  if n == 0 then return nil end
  local skip, iterator = random(math.min(n, 60)), tissue[kind .. "s"](tissue)
  local e
  for _ = 1, skip do e = iterator() end
  return e
end

local old = {} -- handles kept from earlier: most are stale
local function kept_or_new(tissue)
  if #old > 0 and random(10) == 1 then return old[random(#old)] end
  local c = some(tissue, "cell")
  if c then old[random(30)] = c end
  return c
end

local rules = { "errera", "closest_wall", "along" }
local sheet_actions = {
  function(t) return kept_or_new(t):divide { rule = rules[random(3)], direction = { random(9) - 5, random(9) - 5 } } end,
  function(t) return kept_or_new(t):divide { gap = random(10) / 20, pinch = random(9) / 20 } end,
  function(t)
    local c = kept_or_new(t)
    return c:divide { rule = function() return c.x + random(5) - 3, c.y + random(5) - 3, c.x + random(5) - 3, c.y end }
  end,
  function(t) return kept_or_new(t):remove() end,
  function(t) return t:grow { rate = (random(21) - 11) / 100, centre = { random(5), random(5) } } end,
  function(t) return t:grow { rates = { random(10) / 100, -random(10) / 100 }, direction = { random(9) - 5, random(9) - 5 } } end,
  function(t) return t:grow { velocity = function(x, y) return y * random(3) / 50, -x / 50 end } end,
  function(t) return t:deform(function(x, y, z) return x + random(100) / 300, y - random(100) / 300, z end) end,
  function(t) return t:divide { above = (random(20) + 10) / 20, variation = random(9) / 10, max_cells = 60 } end,
  function(t) return t:renumber() end,
  function(t) return t:cell { ["c" .. random(20)] = { random(9), divide = "split" } } end,
  function(t) return t:side { ["s" .. random(20)] = { random(9), divide = "copy" } } end,
  function(t) return t:wall { ["w" .. random(20)] = { random(9), divide = function(m, s) return m * s, m end } } end,
}
local graph_actions = {
  function(t) return t:add_cell() end,
  function(t) return kept_or_new(t):join { some(t, "cell"), after = random(2) == 1 and some(t, "cell") or nil } end,
  function(t) return kept_or_new(t):join { some(t, "cell") } end,
  function(t)
    local c = kept_or_new(t)
    return c:separate(c:neighbours()() or c)
  end,
  function(t) return kept_or_new(t):set_neighbours { some(t, "cell"), some(t, "cell"), some(t, "cell") } end,
  function(t) return kept_or_new(t):remove() end,
  function(t) return t:insert_row(random(4) - 1) end,
  function(t) return t:remove_row() end,
  function(t) return t:renumber() end,
  function(t) return t:cell { ["c" .. random(20)] = random(9) } end,
}
local starts = {
  { sheet_actions, function() return tunica.hexagons { 4, 4, seed = random(99) } end },
  { sheet_actions, function() return tunica.squares { 4, 3, seed = random(99) } end },
  { sheet_actions, function() return tunica.polygon { random(9) + 2 } end },
  { sheet_actions, function() return tunica.sheet { cells = 12, seed = random(99) } end },
  { graph_actions, function() return tunica.grid { 4, 4, wrap = "both" } end },
  { graph_actions, function() return tunica.cylinder { around = 5, rows = 3 } end },
  { graph_actions, function() return tunica.line { 6 } end },
}

local done, refused = 0, 0
for sequence = 1, math.max(1, math.ceil(200 * share)) do
  local start = starts[(sequence - 1) % #starts + 1]
  local tissue, actions = start[2](), start[1]
  old = {}
  for step = 1, 500 do
    local action = random(#actions)
    local ok, message = pcall(actions[action], tissue)
    if ok then done = done + 1 else refused = refused + 1 end
    assert(ok or type(message) == "string", "an error without a message")
    local valid, problems = tissue:validate()
    if not valid then
      error(string.format("sequence %d, step %d, action %d: %s", sequence, step, action, table.concat(problems, "\n")))
    end
    if #tissue > 150 then
      for c in tissue:cells() do
        if c.id % 2 == 0 and #tissue > 1 then c:remove() end
      end
      check.valid(tissue)
    end
  end
end

assert(calls >= 10000, "only " .. calls .. " calls with wrong arguments")
assert(errors > calls / 2)
assert(done > refused / 4)
io.write(string.format("%d calls with wrong arguments, %d refused; %d changes done, %d refused\n", calls, errors, done, refused))
