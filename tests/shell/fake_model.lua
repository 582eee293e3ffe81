-- A model with the interface of tunica.model that needs no tissue: tests of the program itself run it.
-- Parameters choose what goes wrong, and when.
local params = require "tunica.params"
local P = params.declare { n = 50, dt = 0.01, pause = 0, nan_at = -1, error_at = -1, loop_at = -1, label = "x", flag = true,
  stop = 10, bytes = 0 }

local model = { time = 0, steps = 0, name = "fake", stop = P.stop, report_every = 0.5, views = {}, params = P,
  about = { method = "euler", dt = P.dt, why = "fixed", warnings = {} } }
local x = {}
for i = 1, P.n do x[i] = math.random() end
model.tissue = { count = function() return P.n end }
local ballast = ("x"):rep(P.bytes)

local function wait(seconds)
  local core = require "tunica.core"
  local start = core.now()
  while core.now() - start < seconds do end
end

local function step()
  if P.nan_at >= 0 and model.time >= P.nan_at then
    model.failure = { kind = "nan", time = model.time, column = "auxin", cell = 3, message = "auxin of cell 3 is nan" }
    error("auxin of cell 3 is nan at t = " .. model.time, 0)
  end
  if P.error_at >= 0 and model.time >= P.error_at then error "a mistake in an event" end
  if P.loop_at >= 0 and model.time >= P.loop_at then
    while true do pcall(function() while true do end end) end
  end
  if P.pause > 0 then wait(P.pause) end
  for i = 1, P.n do x[i] = x[i] * (1 - P.dt) + 0.5 * P.dt * x[i] ^ 2 + 1e-3 * math.random() end
  model.steps = model.steps + 1
  model.time = model.steps * P.dt
end

function model:advance(t)
  local core = require "tunica.core"
  local start = core.now()
  while self.time < t.to - 1e-9 do
    if core.cancelled() then return "interrupted" end
    if t.seconds and core.now() - start >= t.seconds then return "out of time" end
    step()
    if t.pause and self.time >= t.pause then return "paused" end
  end
  self.time = t.to
  return "done"
end

function model:snapshot()
  return require("tunica.core").encode { time = self.time, steps = self.steps, x = x, ballast = ballast }
end

function model:restore(text)
  local state = require("tunica.core").decode(text)
  self.time, self.steps, x = state.time, state.steps, state.x
end

function model:hash() return require("tunica.core").hash(self:snapshot()) end

model.reports = {
  { name = "mean", fn = function()
    local sum = 0
    for i = 1, P.n do sum = sum + x[i] end
    return sum / P.n
  end },
  { name = "label", fn = function() return P.label end },
}

return model
