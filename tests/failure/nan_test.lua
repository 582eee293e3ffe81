-- SPDX-License-Identifier: MIT
-- A number that goes wrong stops the run in the step in which it appears, with column, cell and time; the state is the one
-- before that step.
local tunica = require "tunica"

local function model_with(rule, more)
  local tissue = tunica.ring { 20 }
  tissue:cell { auxin = 1 }
  local o = { tissue = tissue, dt = 0.1 }
  for k, v in pairs(more or {}) do o[k] = v end
  local model = tunica.model(o)
  model:rate(rule)
  return model, tissue
end

local function must_fail(model, ...)
  local ok, message = pcall(model.advance, model, { to = 10 })
  assert(not ok, "the run should have been stopped")
  for _, text in ipairs { ... } do assert(message:find(text, 1, true), "expected '" .. text .. "' in: " .. message) end
  return message
end

for _, method in ipairs { "euler", "heun", "rk4" } do
  -- 1 / (5 - t) grows without bound at t = 5; sqrt of a negative number is not a number
  local model, tissue = model_with(function(c, d, t) d.auxin = math.sqrt(4.95 - t) end, { method = method })
  must_fail(model, "auxin became", "nan in cell 1", method == "euler" and "time 5.1" or "time 5 ")
  assert(model.failure.kind == "not finite" and model.failure.column == "auxin" and model.failure.id == 1)
  for c in tissue:cells() do assert(c.auxin == c.auxin and c.auxin > 1, "the last good state is kept") end

  -- a negative concentration, unless it is meant
  local sinking = function(c, d) d.auxin = -1 end
  must_fail(model_with(sinking, { method = method }), "auxin became -", "cannot be")
  local free, t = model_with(sinking, { method = method, signed = { "auxin" } })
  assert(free:advance { to = 3 } == "done" and math.abs(t:sum "auxin" - 20 * -2) < 1e-9)
end

-- adaptive methods try shorter steps, and say so when none is short enough
for _, method in ipairs { "bs32", "dp54", "rkc2" } do
  local adaptive = { method = method, tolerance = 1e-6 }
  local model, tissue = model_with(function(c, d, t) d.auxin = math.sqrt(4.95 - t) end, adaptive)
  must_fail(model, "auxin (now", "time 4.9", "no step is short enough", "not finite")
  assert(model.failure.kind == "step size" and model.failure.column == "auxin")
  for c in tissue:cells() do assert(c.auxin == c.auxin and c.auxin > 1, "the last good state is kept") end
  assert(model.time > 4.9 and model.time <= 4.95)
  local sinking = function(c, d) d.auxin = -1 end
  must_fail(model_with(sinking, adaptive), "it is then negative", "signed", "time 1")
  local free, t = model_with(sinking, { method = method, tolerance = 1e-6, signed = { "auxin" } })
  assert(free:advance { to = 3 } == "done" and math.abs(t:sum "auxin" - 20 * -2) < 1e-9)
  -- a solution that runs away: 1 / (1 - t)
  model = model_with(function(c, d) d.auxin = c.auxin ^ 2 end, adaptive)
  must_fail(model, "auxin", "no step is short enough")
  assert(math.abs(model.time - 1) < 1e-3, model.time)
end

-- a value that was wrong before the step
local model, tissue = model_with(function(c, d) d.auxin = 0 end)
assert(not pcall(function() tissue:find(3).auxin = 0 / 0 end), "a column takes no NaN from a script")

-- one cell only, named by its identity
local model = model_with(function(c, d) d.auxin = 1 / (c.column - 7) end)
assert(must_fail(model, "cell 8"):find "inf")

-- forward Euler beyond its limit: the change turns round at every step and grows
local model, tissue = model_with(function(c, d) d.auxin = 30 * (2 - c.auxin) end, { signed = { "auxin" } })
must_fail(model, "auxin", "above this method's limit of about 0.0667")

-- in a derived column that no rate reads: when the columns are brought up to date, with name, cell and time
local function derived(rule, ...)
  local model, tissue = model_with(function(c, d) d.auxin = 1 end)
  tissue:cell { ratio = 0 }
  model:derive(rule)
  model:at(5, function() end)
  must_fail(model, "ratio became", "in cell 8", "it is derived", ...)
  local f = model.failure
  assert(f.kind == "not finite" and f.column == "ratio" and f.element == "cell" and f.id == 8)
  return model, tissue
end
derived(function(c) c.ratio = 1 / (c.column - 7) end, "inf", "time 0 ")
derived(function(c) c.ratio = c.auxin / (c.column - 7 == 0 and 0 or 1) end, "inf", "time 0 ")  -- run as it is
local model, tissue = derived(function(c, t) c.ratio = math.sqrt(c.column - 7 + 100 * (4.5 - t) * tunica.equal(c.column, 7) + 8) end,
  "nan", "time 5 ")
for c in tissue:cells() do assert(math.abs(c.auxin - 6) < 1e-9, "the state is that of the time") end
