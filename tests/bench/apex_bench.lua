-- SPDX-License-Identifier: MIT
-- The cellular shoot apex (scripts/phyllotaxis/parts/shoot.lua): what a step of growth costs, by its parts, beside one evaluation of
-- the equations in the same run; how far the cells are from where they should be; and what whole runs cost, beside their error.
local here = debug.getinfo(1, "S").source:match "^@(.*)/" or "."
package.path = here .. "/../../scripts/phyllotaxis/?.lua;" .. package.path
local tunica = require "tunica"
local shoot = require "parts.shoot"
local P = tunica.params(shoot.with({}))

local function seconds(f)
  local begun = os.clock()
  f()
  return os.clock() - begun
end

--- The largest distance of a junction from where the exact flow takes it in a step, relative to the size of the apex.
local function error_of_growth(my, step)
  local before, most = {}, 0
  for j in my.tissue:junctions() do
    local theta, a = my.apex:closest(j.x, j.y, j.z)
    before[j.id] = { theta, my.apex:after(a, step) }
  end
  my.tissue:grow { on = my.surface, time = step }
  for j in my.tissue:junctions() do
    local x, y, z = my.apex:position(before[j.id][1], before[j.id][2])
    most = math.max(most, math.sqrt((j.x - x) ^ 2 + (j.y - y) ^ 2 + (j.z - z) ^ 2))
  end
  return most / my.border
end

print "A step of growth of the apex, ms of CPU (means of 200 steps, least of 5 such); error: the largest distance from the exact flow,"
print "relative to the size; evaluation: one of the equations of the model, of the same cells, in ms."
print ""
print "  step  cells  divisions     grow   divide   remove  together  evaluation  together / evaluation    error"
for _, step in ipairs { 0.05, 0.1, 0.2, 0.4 } do
  local my = shoot.apex(P)
  local tissue, divisions, least = my.tissue, 0, nil
  for _ = 1, 5 do
    local spent = { 0, 0, 0 }
    divisions = 0
    for _ = 1, 200 do
      spent[1] = spent[1] + seconds(function() tissue:grow { on = my.surface, time = step } end)
      spent[2] = spent[2] + seconds(function()
        divisions = divisions + tissue:divide { above = P.max_area, variation = P.variation, on = my.surface,
          gap = P.gap * math.sqrt(P.max_area), pinch = P.pinch }
      end)
      spent[3] = spent[3] + seconds(function() tissue:remove { on = my.apex, beyond = my.border } end)
    end
    local sum = spent[1] + spent[2] + spent[3]
    if not least or sum < least.sum then least = { sum = sum, spent = spent } end
  end
  local far = error_of_growth(my, step)
  local model = shoot.model(my)
  model:solve_with { method = "euler", dt = 0.004 }  -- a step of it is one evaluation
  model:advance(0.004)
  local count = 40  -- within one step of growth
  local evaluation = math.huge
  for k = 1, 5 do
    local from = model.time
    evaluation = math.min(evaluation, seconds(function() model:advance(from + count * 0.004 / 5) end) / (count / 5))
  end
  local ms = 1e3 / 200
  print(string.format("%6g %6d %10.1f %8.3f %8.3f %8.3f %9.3f %11.4f %23.1f %8.1e", step, #tissue, divisions / 200, least.spent[1] * ms,
    least.spent[2] * ms, least.spent[3] * ms, least.sum * ms, evaluation * 1e3, least.sum / 200 / evaluation, far))
end

--- Auxin by identity after a run, and what it cost.
local function run(dt, time)
  math.randomseed(1)
  local my = shoot.apex(P)
  local model = shoot.model(my)
  if dt then model:solve_with { dt = dt } end
  local spent = seconds(function() model:advance(time) end)
  local auxin = {}
  for c in my.tissue:cells() do auxin[c.id] = c.auxin end
  return auxin, spent, #my.primordia - P.initial
end

print ""
print "Runs of transport_apex (ten primordia at the start), s of CPU without program start, mesh and pictures; error: of auxin at t = 1"
print "against steps an eighth as long, largest over cells relative to the largest auxin."
local fine, rough = run(P.dt / 8, 1), run(P.dt, 1)
local most, off = 0, 0
for id, value in pairs(fine) do
  most = math.max(most, value)
  off = rough[id] and math.max(off, math.abs(rough[id] - value)) or math.huge
end
for _, time in ipairs { 21.6, 45 } do
  local least, started = math.huge, 0
  for _ = 1, 5 do
    local _, spent, count = run(nil, time)
    least, started = math.min(least, spent), count
  end
  print(string.format("to t = %4g: %6.3f s, %d new primordia; error %.1e", time, least, started, off / most))
end
