-- SPDX-License-Identifier: MIT
--- What a run says of itself: run.json, and the result on standard output.

local core = require "tunica.core"
local params = require "tunica.params"
local said = require "tunica.warnings"
local outputs = require "tunica.run.outputs"

local record = {}

local function parameters_of(model)
  local P = params.is(model.params) and model.params or params.current()
  if not P then return nil end
  return { values = outputs.plain(params.values(P)), overridden = core.as_list(params.overridden(P)) }
end

--- All that is known of the run, as run.json holds it. What depends on the clock stands under `timing`.
function record.of(self)
  local options, model = self.options, self.model
  local about = outputs.plain(model.about or {})
  local warnings = core.as_list {}
  for _, list in ipairs { said.list, about.warnings or {}, self.warnings } do
    for _, text in ipairs(list) do warnings[#warnings + 1] = text end
  end
  local cost = about.cost
  about.warnings, about.cost = nil, nil
  return {
    name = self.name, status = self.status, script = self.script, git = self.git, arguments = core.as_list(options.arguments),
    code = core.as_list(options.code),
    parameters = parameters_of(model), seed = core.seed(), versions = core.decode(options.versions), method = about,
    options = { until_time = not self.most and self.goal or self.options.until_time, frames = options.frames, movie = options.movie }, warnings = warnings,
    failures = self.failures, result = self.result,
    timing = { started = self.date, ended = self.ended, wall_seconds = self.wall_total, resumed = self.resumed, kernel = cost,
      nanoseconds_per_cell_step = self.wall_total and self.work > 0 and 1e9 * self.wall_total / self.work or nil },
  }
end

--- Writes run.json, into `folder` or the run's own.
function record.write(self, folder)
  core.write_atomic((folder or self.folder) .. "/run.json", core.encode(record.of(self), true) .. "\n")
end

local function print_text(self)
  local model, lines = self.model, {}
  local function add(name, value) lines[#lines + 1] = { name, outputs.text(value) } end
  add("status", self.status)
  add("time", model.time)
  add("steps", model.steps)
  local size, unit = outputs.size(model)
  if not outputs.has(self.report or {}, unit) then add(unit, size) end
  for _, entry in ipairs(self.report or {}) do
    for _, pair in ipairs(outputs.flatten(entry.name, entry.value, {})) do add(pair[1], pair[2]) end
  end
  if self.result.hash then add("hash", self.result.hash) end
  if self.agrees ~= nil then add("same hash as before", self.agrees and "yes" or "no") end
  add("directory", self.folder)
  local width = 0
  for _, line in ipairs(lines) do width = math.max(width, #line[1]) end
  for _, line in ipairs(lines) do io.stdout:write(line[1], (" "):rep(width - #line[1] + 2), line[2], "\n") end
end

--- The result on standard output: lines of name and value, or run.json as one object.
function record.print(self)
  if not self.options.json then
    if not self.message then print_text(self) end
    return
  end
  local object = record.of(self)
  object.directory, object.message, object.same_hash = self.folder, self.message, self.agrees
  io.stdout:write(core.encode(object, true), "\n")
end

return record
