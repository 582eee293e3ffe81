-- SPDX-License-Identifier: MIT
-- What rules may not do, traced or run as they are: each is an error on the line that does it, and changes nothing.
local tunica = require "tunica"
local check = require "check"

local P = tunica.params { rate = 1 }

local function sheet()
  local tissue = tunica.hexagons { 3, 3 }
  tissue:cell { auxin = function(c) return c.id end, zone = 1, e = 0 }
  tissue:side { pin = 1 }
  tissue:wall { load = 1 }
  return tissue
end

-- A comparison that cannot be traced: the rule is run as it is.
local function direct(c) return c.zone == 1 end

--- Runs a model with one rule, which must fail with the texts on the line after the rule's first, and change nothing.
local function fails(tissue, what, kind, rule, ...)
  local model = tunica.model { tissue = tissue, dt = 0.1, params = P }
  if kind == "flux" then model:flux("auxin", rule) else model[what](model, kind, rule) end
  local hash = tissue:hash()
  local ok, message = pcall(model.advance, model, { to = 1 })
  assert(not ok, "an error was expected: " .. table.concat({ ... }, ", "))
  for _, text in ipairs { ... } do assert(message:find(text, 1, true), "expected '" .. text .. "' in: " .. message) end
  local _, places = message:gsub("rule_faults_test%.lua:%d+: ", "")
  check.equal(places, 1, "places in '" .. message .. "'")
  local info = debug.getinfo(rule, "S")
  local line = tonumber(message:match "^[^:]*rule_faults_test%.lua:(%d+): ")
  assert(line and line >= info.linedefined and line <= info.lastlinedefined, "another line in: " .. message)
  assert(model.time == 0, "time has moved")
  check.equal(tissue:hash(), hash, "tissue after: " .. message)
end

for _, as_it_is in ipairs { false, true } do
  local tissue = sheet()
  local first = tissue:find(1)
  local go = as_it_is and direct or function() return true end
  -- columns of anything but what the rule is given to set
  fails(tissue, "rate", "cell", function(c, d)
    d.auxin = 1
    if go(c) then c.auxin = 3 end
  end, "'auxin' ")
  fails(tissue, "rate", "cell", function(c, d)
    d.auxin = c:sum(function(n)
      if go(c) then n.auxin = 1 end
      return n.auxin
    end)
  end, "'auxin' ")
  fails(tissue, "derive", "cell", function(c)
    c.e = c:sum(function(n)
      if go(c) then n.e = 1 end
      return n.auxin
    end)
  end, "'e' ")
  fails(tissue, "derive", "cell", function(c)
    c.e = c:sum(function(n, w, s)
      if go(c) then s.pin = 1 end
      return n.auxin
    end)
  end, "'pin' ")
  fails(tissue, "derive", "side", function(s)
    s.pin = 1
    if go(s.cell) then s.cell.auxin = 1 end
  end, "'auxin' ")
  fails(tissue, "derive", "side", function(s)
    s.pin = 1
    if go(s.cell) then s.opposite.pin = 1 end
  end, "'pin' ")
  fails(tissue, "derive", "wall", function(w, a, b)
    w.load = 1
    if go(a) then b.auxin = 1 end
  end, "'auxin' ")
  fails(tissue, "flux", "flux", function(w, a, b)
    if go(a) then w.load = 1 end
    return a.auxin - b.auxin
  end, "'load' ")
  fails(tissue, "rate", "cell", function(c, d)
    d.auxin = 1
    if go(c) then first.auxin = 7 end
  end, "'auxin' ")
  -- even where the error is caught
  local ok, hash = nil, tissue:hash()
  local model = tunica.model { tissue = tissue, dt = 0.1 }
  model:derive(function(c)
    c.e = 1
    ok = go(c) and pcall(function() first.auxin = 7 end)
  end)
  pcall(model.advance, model, { to = 0 })
  assert(ok == false and first.auxin == 1)
  for c in tissue:cells() do c.e = 0 end
  check.equal(tissue:hash(), hash)
  -- names that mean something else
  for _, name in ipairs { "id", "valence", "sum", "area", "neighbours", "alive" } do
    fails(tissue, "derive", "cell", function(c)
      if go(c) then c[name] = 1 end
    end, "'" .. name .. "'", "cell")
    fails(tissue, "rate", "cell", function(c, d)
      if go(c) then d[name] = 1 end
    end, "'" .. name .. "'", "cell")
  end
  fails(tissue, "derive", "side", function(s)
    if go(s.cell) then s.wall = 1 end
  end, "'wall'", "side")
  fails(tissue, "derive", "wall", function(w, a)
    if go(a) then w.length = 1 end
  end, "'length'", "wall")
  -- operations that change something, parameters
  fails(tissue, "rate", "cell", function(c, d)
    d.auxin = 1
    if go(c) then tissue:cell { fresh = 1 } end
  end, "tissue:cell")
  fails(tissue, "rate", "cell", function(c, d)
    d.auxin = 1
    if go(c) then P.rate = 3 end
  end, "'rate'")
  model = tunica.model { tissue = tissue, dt = 0.1 }
  fails(tissue, "rate", "cell", function(c, d)
    d.auxin = 1
    if go(c) then model:every(1, print) end
  end, "model:every")
  -- no numbers
  fails(tissue, "rate", "cell", function(c, d)
    if go(c) then d.auxin = "much" end
  end, "'much'", "number")
  for _, value in ipairs { "much", false } do
    check.fails(function()
      model = tunica.model { tissue = tissue, dt = 0.1 }
      model:flux("auxin", function(w, a, b) return go(a) and (value or nil) end)
      model:advance { to = 1 }
    end, "the flux of 'auxin'", value and "'much'" or "nil")
  end
  fails(tissue, "rate", "cell", function(c, d)
    d.auxin = c:sum(function(n) return go(c) and "much" or 1 end)
  end, "number", "'much'")
  fails(tissue, "rate", "cell", function(c, d)
    d.auxin = c:sum(function(n) go(c) end)
  end, "number", "nil")
end

-- What a rule kept of its symbols is of no use to another call, of this model or another.
do
  local kept
  for round = 1, 3 do
    local tissue = sheet()
    local model = tunica.model { tissue = tissue, dt = 0.1 }
    model:rate(function(c, d, t)
      local before, x = kept, t
      for _ = 1, round < 2 and 200 or 1 do x = x + tunica.tanh(x) end
      if type(x) == "userdata" and not before then kept = { t = t, x = x, c = c, d = d } end
      d.auxin = before and before[({ "t", "x", "c", "d" })[round]] or 1
    end)
    local ok, message = pcall(model.advance, model, { to = 0.1 })
    assert(ok and round == 1 or message:find("symbol", 1, true), message)
  end
  check.fails(function() return kept.x + 1 end, "symbol")
  check.fails(function() return kept.c.auxin end, "symbol")
  check.fails(function() kept.d.auxin = 1 end, "symbol")
end

-- Own columns may be set anywhere in the rule.
do
  local tissue = sheet()
  local model = tunica.model { tissue = tissue, dt = 0.1 }
  model:derive(function(c)
    c.e = 1
    c.e = c.e + c.auxin
  end)
  model:rate(function(c, d)
    c:sum(function(n)
      d.auxin = 1
      return 0
    end)
  end)
  model:advance { to = 0.1 }
  for c in tissue:cells() do
    check.near(c.auxin, c.id + 0.1, 1e-12)
    check.near(c.e, 1 + c.auxin, 1e-12)
  end
end

-- A rule run as it is that found no wall at first: its columns are found out when there is one.
do
  local tissue = tunica.polygon { 6 }
  tissue:cell { auxin = 1 }
  tissue:wall { load = 1 }
  tissue:side { pin = 1 }
  local model = tunica.model { tissue = tissue, dt = 0.1, signed = { "load" } }
  model:rate("wall", function(w, d, a, b) d.load = direct { zone = 1 } and 2 or 3 end)
  model:derive("side", function(s) s.level = direct { zone = 1 } and s.cell.auxin + 1 or 3 end)
  model:at(1, function() tissue:find(1):divide {} end)
  model:when(function(t) return t > 1.45 end, function() tissue:divide { above = 0.4 } end)
  model:advance { to = 2 }
  assert(#tissue > 2)
  local inner = 0
  for w in tissue:walls() do
    if select(2, w:cells()) then inner = math.max(inner, w.load) end
  end
  check.near(inner, 3, 1e-9, "load of the oldest inner wall")
  for s in tissue:sides() do check.equal(s.level, s.opposite and 2 or 0, "level") end
  check.equal(#model.about.warnings, 2)
  check.fails(function()
    local misspelt = tunica.model { tissue = tissue, dt = 0.1, signed = { "loaf" } }
    misspelt:rate("wall", function(w, d, a, b) d.load = direct { zone = 1 } and 2 or 3 end)
    misspelt:advance { to = 1 }
  end, "'loaf'", "did you mean 'load'")
end

-- One place before the message, whoever found the mistake: of what is wrong, in the script.
do
  local function one_place(set_up, ...)
    local tissue = sheet()
    local model = tunica.model { tissue = tissue, dt = 0.1 }
    set_up(model, tissue)
    local ok, message = pcall(model.advance, model, { to = 1 })
    assert(not ok, "an error was expected")
    local info = debug.getinfo(set_up, "S")
    local line, rest = message:match "^[^:]*rule_faults_test%.lua:(%d+): (.*)$"
    line = tonumber(line)
    assert(line and line >= info.linedefined and line <= info.lastlinedefined, message)
    assert(not rest:find "lua:%d", message)
    for _, text in ipairs { ... } do assert(rest:find(text, 1, true), message) end
  end
  one_place(function(m) m:at(0.1, function() error "in the event" end) end, "in the event")
  one_place(function(m, t) m:at(0.1, function() t:divide { where = function() error "inside" end } end) end, "inside")
  one_place(function(m, t) m:at(0.1, function() t:find(1).axin = 1 end) end, "axin")
  one_place(function(m) m:when(function() error "asked" end, print) end, "asked")
  one_place(function(m) m:rate(function(c, d) d.auxin = direct(c) and error "late" end) end, "late")
  one_place(function(m) m:rate(function(c, d) d.axin = 1 end) end, "axin")
  one_place(function(m) m:rate(function(c, d) d.auxin = tunica.hill(c.auxin, {}) end) end, "hill")
  one_place(function(m) m:flux("axin", function(w, a, b) return a.auxin - b.auxin end) end, "axin")
  one_place(function(m) m:flux("auxin", function(w, a, b) return a.auxin end) end, "opposite sign")
  one_place(function(m) m:derive(function(c) c.e = 2 * tunica.exp(c.e) end) end, "refers to itself")
  one_place(function(m) m:rate(function(c, d) if c.id < 2 then d.auxin = 1 else d.e = 1 end end) end, "the same columns")
  one_place(function(m)
    m:derive(function(c) c.e = 1 end)
    m:rate(function(c, d) d.e = 1 end)
  end, "derived")
end
