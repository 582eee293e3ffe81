-- SPDX-License-Identifier: MIT
--- One run of a sweep, in a process of its own: the model from its start to its end, as `tunica MODEL` takes it there, but
-- without files, pictures and checkpoints. What comes back are plain values.

local core = require "tunica.core"
local params = require "tunica.params"
local outputs = require "tunica.run.outputs"
local batch = require "tunica.run"

local run = {}

--- A field that a model may lack.
local function optional(model, name)
  local ok, value = pcall(function() return model[name] end)
  return ok and value or nil
end

local function refuse(format, ...)
  core.blame_command_line()
  error(string.format(format, ...), 0)
end

--- What a script returned: "model", "values" (a table of plain values is its report), or nil.
local function kind_of(result)
  if batch.is_model(result) then return "model" end
  if type(result) ~= "table" or params.is(result) then return nil end
  for name in pairs(result) do
    if type(name) ~= "string" then return nil end
  end
  return next(result) and "values" or nil
end

--- What a sweep must know of a model before its first run; of a model with rates also how it is solved. Errors: no model, no
-- report, no end.
function run.describe(result, until_time)
  local kind = kind_of(result)
  if not kind then refuse "the script returned no model; a sweep needs one (or a table of named values)" end
  local P = params.current()
  if not P then refuse "the model declares no parameters (tunica.params); there is nothing to vary" end
  local about = { kind = kind, parameters = core.as_list {}, reports = core.as_list {} }
  local declared, values = params.declared(P), params.values(P)
  for name, spec in pairs(declared) do
    local value = values[name]
    table.insert(about.parameters, { name = name, type = spec.type, min = spec.min, max = spec.max,
      value = type(value) == "number" and core.shortest(value) or tostring(value) })
  end
  if kind == "model" then
    for _, report in ipairs(result.reports or {}) do table.insert(about.reports, report.name) end
    if #about.reports == 0 then
      refuse "the model has no report (model:report { ... }); a sweep would have nothing to keep"
    end
    about.stop = until_time or optional(result, "stop")
    if type(about.stop) ~= "number" then
      refuse "when do the runs end? Say --until T, or stop = T in tunica.model { ... }"
    end
    local _, unit = outputs.size(result)
    about.unit = unit
    about.solution = optional(result, "solution") and result:solution()
  else
    for name in pairs(result) do table.insert(about.reports, name) end
  end
  local texts = {}
  for i, source in ipairs(core.sources()) do texts[i] = source.text end
  about.script = core.hash(table.concat(texts, "\0"))
  return core.encode(about)
end

--- The files that a run has read, as JSON: path -> hash. Some are read for some samples only.
function run.files()
  local files = {}
  for _, source in ipairs(core.sources()) do files[source.path] = core.hash(source.text) end
  return next(files) and core.encode(files) or "{}"
end

-- Series -----------------------------------------------------------------------------------------------------------

--- Notes the numbers of a report in the statistics of the series so far.
local function note_numbers(series, reports)
  for _, report in ipairs(reports) do
    for _, pair in ipairs(outputs.flatten(report.name, report.value, {})) do
      local name, value = pair[1], pair[2]
      if type(value) == "number" then
        local s = series[name] or { min = value, max = value, sum = 0, count = 0 }
        s.min, s.max = math.min(s.min, value), math.max(s.max, value)
        s.sum, s.count = s.sum + value, s.count + 1
        series[name] = s
      end
    end
  end
end

local function summary(series)
  local result = {}
  for name, s in pairs(series) do result[name] = { min = s.min, max = s.max, mean = s.sum / s.count, count = s.count } end
  return result
end

-- Running ----------------------------------------------------------------------------------------------------------

--- Takes the model to its end; the reports of the series come when a batch run would take them. With a solution the run is solved
-- by it, and notes its course (tunica.chart.look).
local function run_model(model, until_time, solution)
  local goal, most = until_time or optional(model, "stop"), optional(model, "most")
  local list, series, last = {}, {}, nil
  local function row()
    note_numbers(series, outputs.reports(model))
    last = model.time
  end
  list[1] = { every = model.report_every, count = 0, write = row }
  list[2] = solution and require("tunica.chart.look").begin(model, solution, goal)
  local _, arrived = model.about, false  -- the former binds the rules
  while true do
    outputs.emit(list, model.time)
    if arrived or model.time >= goal or most and model.finished then break end
    -- The time may be less than the goal by a rounding error when all steps are done.
    arrived = model:advance { to = goal, pause = outputs.next_time(list) } == "done"
  end
  if last ~= model.time then row() end
  local course = list[2] and require("tunica.chart.look").finish(list[2])
  local reports = outputs.reports(model)  -- before the hash, as in a batch run: they may change what functions keep
  local size, unit = outputs.size(model)
  local result = { time = model.time, steps = model.steps, [unit] = size, hash = model:hash(), report = {},
    course = course or nil, series = model.report_every and summary(series) or nil }
  for _, entry in ipairs(reports) do result.report[entry.name] = entry.value end
  return result
end

--- The parameters as the script has left them: a variant, or the script itself, may have changed others than the sweep.
local function parameters_now()
  local list = {}
  local P = params.current()
  for name, value in pairs(P and params.values(P) or {}) do list[name] = value end
  return next(list) and list or nil
end

--- The result of one run as JSON; nil and a message after a numerical failure. `solution`: { method =, dt =, tolerance = } as
-- texts, or nil for the model's own.
function run.run(result, until_time, solution)
  local parameters = parameters_now()
  if kind_of(result) == "values" then return core.encode { report = outputs.plain(result), parameters = parameters } end
  local ok, values = pcall(run_model, result, until_time, solution)
  if ok then
    values.parameters = parameters
    return core.encode(values)
  end
  if not optional(result, "failure") then error(values, 0) end
  return nil, tostring(values)
end

return run
