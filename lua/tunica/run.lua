-- SPDX-License-Identifier: MIT
--- A batch run: a model taken to its end, with its directory, outputs and checkpoints. The program calls begin, loop
-- and close in this order; close comes also after an error or an interruption has unwound loop.

local core = require "tunica.core"
local params = require "tunica.params"
local directory = require "tunica.run.directory"
local git = require "tunica.run.git"
local outputs = require "tunica.run.outputs"
local progress = require "tunica.run.progress"
local record = require "tunica.run.record"

local run = {}

local slice = 0.1  -- seconds between looks at the clock; checkpoints and progress need no finer grain

local exit = { ok = 0, script = 1, usage = 2, numerical = 3, files = 4 }

--- Whether a script's result is a model.
function run.is_model(value)
  if type(value) ~= "table" then return false end
  local ok, advance = pcall(function() return value.advance end)
  return ok and type(advance) == "function"
end

local function note(self, format, ...)
  if self.options.quiet then return end
  if self.progress then progress.clear(self.progress) end
  io.stderr:write("tunica: ", string.format(format, ...), "\n")
end

local function complain(self, format, ...)
  if self.progress then progress.clear(self.progress) end
  io.stderr:write("tunica: error: ", string.format(format, ...), "\n")
end

--- Calls `write`; an error from it is the file system's, not the script's.
local function with_files(self, write, ...)
  local ok, message = pcall(write, ...)
  if ok then return message end
  self.files_failed = message
  error(message, 0)
end

-- State ------------------------------------------------------------------------------------------------------------

--- How the model is solved, if it can say so: an event may have changed it (model:solve_with).
local function solution_of(model)
  local ok, solution = pcall(function() return model:solution() end)
  return ok and solution or nil
end

--- Everything needed to continue from here. Cheap in lines of the series: only their number.
local function take_state(self)
  return {
    model = self.model:snapshot(),
    random = core.random_state(),
    series = self.series and self.series:mark(),
    time = self.model.time,
    about = { counts = outputs.counts(self.outputs), work = self.work, wall = self.wall + core.now() - self.started,
      time = self.model.time, steps = self.model.steps, solution = solution_of(self.model) },
  }
end

local function sections_of(self, state)
  state.about.series = state.series
  return { model = state.model, random = state.random, about = core.encode(state.about),
    series = self.series and self.series:text(state.series) or "" }
end

local function write_checkpoint(self, state)
  return with_files(self, directory.write_checkpoint, self.folder, sections_of(self, state))
end

local function restore_state(self, sections)
  local about = core.decode(sections.about)
  local now = solution_of(self.model)
  if now and about.solution and core.encode(now) ~= core.encode(about.solution) then self.model:solve_with(about.solution) end
  self.model:restore(sections.model)
  core.random_state(sections.random)
  outputs.set_counts(self.outputs, about.counts)
  if self.series and about.series then self.series:restore(about.series, sections.series) end
  self.work, self.wall = about.work, about.wall
end

--- A copy in memory, as often as a fiftieth of the time allows: what is kept if an event is broken off in the middle, or
-- cannot be broken off at all.
local function shadow(self)
  local now = core.now()
  if now < self.next_shadow then return end
  self.shadow = take_state(self)
  core.rescue { path = self.folder .. "/checkpoint.bin", sections = sections_of(self, self.shadow),
    note = string.format("The state at t = %.10g is kept; to continue: tunica resume %s", self.shadow.time, self.folder) }
  self.next_shadow = core.now() + math.max(0.2, 50 * (core.now() - now))
  if now >= self.next_checkpoint then
    write_checkpoint(self, self.shadow)
    self.next_checkpoint = core.now() + self.options.checkpoint
  end
end

-- Outputs ----------------------------------------------------------------------------------------------------------

local function view_name(views, i)
  return views[i].name or (#views > 1 and tostring(i) or nil)
end

--- An error of the view's functions is the script's, one of writing the picture is not.
local function draw(self, view, path)
  local png = require("tunica.view").draw(self.model, view)
  with_files(self, core.write_atomic, path, png)
end

--- A picture that cannot be drawn (no OSMesa) costs the pictures, not the run.
local function pictures_work(self)
  local ok, why = require("tunica.view").available()
  if not ok then
    self.warnings[#self.warnings + 1] = "no pictures: " .. tostring(why)
    note(self, "warning: no pictures: %s", tostring(why))
  end
  return ok
end

local function add_frames(self)
  local views = self.model.views or {}
  for i, view in ipairs(views) do
    if view.every then
      local name = view_name(views, i)
      local folder = self.folder .. "/frames" .. (name and "/" .. name or "")
      local output = { every = view.every, count = 0, written = 0 }
      output.write = function()
        with_files(self, core.mkdir, folder)
        draw(self, view, string.format("%s/%04d.png", folder, output.written))
        output.written = output.written + 1
      end
      self.outputs[#self.outputs + 1] = output
      self.frame_folders[#self.frame_folders + 1] = { folder = folder, name = name, output = output }
    end
  end
end

local function add_row(self)
  local size, unit = outputs.size(self.model)
  self.series:add(self.model.time, size, unit, outputs.reports(self.model))
end

local function series_header(self)
  local changed = {}
  for i, argument in ipairs(self.options.arguments) do changed[i] = argument end
  return string.format("# tunica %s, %s, seed %s%s", core.decode(self.options.versions).tunica, self.name,
    core.shortest(core.seed()), #changed > 0 and ", " .. table.concat(changed, " "):gsub("[\r\n]", " ") or "")
end

local function prepare_outputs(self)
  self.outputs, self.frame_folders = {}, {}
  if #(self.model.reports or {}) > 0 then
    self.series = outputs.series(self.folder, series_header(self))
    self.outputs[1] = { every = self.model.report_every, count = 0, write = function() add_row(self) end }
  end
  if not self.options.frames or #(self.model.views or {}) == 0 then return end
  require("tunica.view").check(self.model)
  if pictures_work(self) then
    self.draws = true
    add_frames(self)
  end
end

-- Beginning --------------------------------------------------------------------------------------------------------

--- What resume and rerun take from the record of the run before, unless told otherwise.
local function take_over(self, folder)
  local old = core.decode(core.read_file(folder .. "/run.json"))
  local options = self.options
  options.until_time = options.until_time or old.options.until_time
  if options.frames == nil then options.frames = old.options.frames end
  options.movie = options.movie or old.options.movie
  self.old, self.git = old, old.git
end

--- A field that a model may lack.
local function optional(model, name)
  local ok, value = pcall(function() return model[name] end)
  return ok and value or nil
end

local function refuse(self, code, format, ...)
  complain(self, format, ...)
  return nil, code
end

local function new_directory(self)
  local options = self.options
  return directory.make(options.out, self.name, function(folder)
    directory.lock(folder)
    local saved = directory.save_sources(folder, options.script)
    local main = saved.main
    self.script = { path = self.old and self.old.script.path or main.path, copy = main.copy, hash = main.hash,
      modules = saved.modules, files = saved.files }
    record.write(self, folder)
  end)
end

local function continue_from_checkpoint(self)
  local sections, complaints, path = directory.read_checkpoint(self.folder)
  for _, text in ipairs(complaints) do note(self, "warning: damaged checkpoint passed over: %s", text) end
  if sections then
    restore_state(self, sections)
    note(self, "continuing from %s at t = %.10g", path, self.model.time)
    return true
  end
  if #complaints > 0 then return false end
  note(self, "the run was stopped before its first checkpoint; it starts from the beginning")
  return true
end

--- begin(model, options) -> the run; or nil and an exit code, once the reason has been said.
function run.begin(model, options)
  local self = { model = model, options = options, name = options.name, status = "running", failures = core.as_list {}, warnings = {},
    work = 0, wall = 0, started = core.now(), date = core.date(), next_shadow = 0, result = {} }
  if options.resume then
    local went, free, why = pcall(directory.lock, options.resume)
    if not went then return refuse(self, exit.files, "%s", tostring(free)) end
    if not free then return refuse(self, exit.usage, "%s", why) end
  end
  local recorded = options.resume or options.rerun
  if recorded then take_over(self, recorded) end
  if options.frames == nil then options.frames = true end
  if not recorded then self.git = git.revision(options.script) end
  self.goal = options.until_time or optional(model, "stop")
  self.most = optional(model, "most")  -- so many primordia end the run, if it has not reached its goal before
  if type(self.goal) ~= "number" then
    return refuse(self, exit.usage, "when does the run end? Say --until T, or stop = T in tunica.model { ... }")
  end
  if next(core.overrides()) and not params.current() then
    return refuse(self, exit.usage, "the model declares no parameters (tunica.params); there is nothing to change by '%s'",
      (options.arguments[1] or ""))
  end
  local _ = model.about  -- binds the rules: what is wrong with them is said before anything is written
  if options.resume then
    self.folder, self.script, self.resumed = options.resume, self.old.script, (self.old.timing.resumed or 0) + 1
    self.date = self.old.timing.started
  else
    local refusal = options.out and directory.refusal(options.out)
    if refusal then return refuse(self, exit.usage, "%s", refusal) end
    local made, folder = pcall(new_directory, self)
    if not made then return refuse(self, exit.files, "%s", tostring(folder)) end
    self.folder = folder
  end
  prepare_outputs(self)
  if options.resume and not continue_from_checkpoint(self) then
    return refuse(self, exit.files, "no checkpoint in '%s' can be read; tunica rerun %s repeats the run from the start",
      self.folder, self.folder)
  end
  self.progress = progress.new(self.goal, self.most, options.terminal, options.quiet)
  self.next_checkpoint = core.now() + options.checkpoint
  return self, exit.ok
end

-- Running ----------------------------------------------------------------------------------------------------------

--- Takes the model to the end of the run. Returns "done" or "interrupted"; the state is then that of a step's end.
function run.loop(self)
  local model, arrived = self.model, false
  while true do
    if core.cancelled() then return "interrupted" end
    outputs.emit(self.outputs, model.time)
    if self.series then with_files(self, self.series.flush, self.series, false) end
    shadow(self)
    if arrived or model.time >= self.goal or self.most and model.finished then return "done" end
    local steps = model.steps
    self.advancing = true
    local status = model:advance { to = self.goal, pause = outputs.next_time(self.outputs), seconds = slice }
    self.advancing = false
    local size, unit = outputs.size(model)
    self.work = self.work + (model.steps - steps) * size
    if status == "interrupted" then return status end
    arrived = status == "done"  -- the time may then be less than the goal by a rounding error
    progress.update(self.progress, model.time, size, unit, self.work)
  end
end

-- Ending -----------------------------------------------------------------------------------------------------------

local function final_pictures(self)
  if not self.draws then return end
  local views = self.model.views
  for i, view in ipairs(views) do
    local name = view_name(views, i)
    draw(self, view, string.format("%s/picture%s.png", self.folder, name and "-" .. name or ""))
  end
end

--- One movie of a view's frames. What prevents it is a warning: the run itself is done.
local function make_movie(self, frames)
  local files = {}
  for i = 1, frames.output.written do files[i] = string.format("%s/%04d.png", frames.folder, i - 1) end
  local path = string.format("%s/movie%s.mp4", self.folder, frames.name and "-" .. frames.name or "")
  local ok, why = pcall(require("tunica.view").movie, path, files)
  if ok then return end
  self.warnings[#self.warnings + 1] = "no movie: " .. tostring(why)
  note(self, "warning: %s", self.warnings[#self.warnings])
end

--- Comes last, when everything else is written: it may take long and may be broken off.
local function make_movies(self)
  for _, frames in ipairs(self.frame_folders or {}) do make_movie(self, frames) end
  if #self.warnings > 0 then record.write(self) end
end

local function finish(self)
  local model = self.model
  if self.series and self.series.last ~= model.time then add_row(self) end
  final_pictures(self)
  local report = outputs.reports(model)
  self.report = report
  local size, unit = outputs.size(model)
  self.last = take_state(self)
  -- As model:hash().
  self.result = { time = model.time, steps = model.steps, [unit] = size, hash = core.hash(self.last.model), report = {} }
  for _, entry in ipairs(report) do self.result.report[entry.name] = entry.value end
end

--- Tables that a model keeps (primordia.csv), as they are now.
local function write_tables(self)
  for name, text in pairs(optional(self.model, "tables") or {}) do
    with_files(self, core.write_atomic, self.folder .. "/" .. name .. ".csv", series_header(self) .. "\n" .. text)
  end
end

--- After an interruption or an error: writes what is whole, and says where. Returns where the checkpoint is, or nil.
local function keep(self)
  local state = self.status == "done" and self.last
  if not state and (not self.advancing or self.model.failure) then
    local ok, fresh = pcall(take_state, self)
    state = ok and fresh or nil
  end
  state = state or self.shadow
  if not state then return nil end
  if self.series then pcall(self.series.flush, self.series, true) end
  if not self.advancing then pcall(write_tables, self) end
  local ok, path = pcall(write_checkpoint, self, state)
  if ok then return path, state.about.time end
  complain(self, "the checkpoint could not be written: %s", tostring(path))
  if core.kind_of(self.folder .. "/checkpoint.bin") then
    note(self, "the checkpoint before stands: %s/checkpoint.bin", self.folder)
  end
  return nil
end

local function compare(self)
  if not self.options.rerun then return end
  local before = self.old.result.hash
  if not before then
    note(self, "'%s' was not run to its end: there is nothing to compare with", self.options.rerun)
    return
  end
  self.agrees = before == self.result.hash
  note(self, self.agrees and "the result is the same as in %s (hash %s)" or "the result differs from %s (hash %s there)",
    self.options.rerun, before)
end

local function after_failure(self, message)
  local failure = self.model.failure
  self.status, self.message = "failed", message
  self.failures[#self.failures + 1] = failure and outputs.plain(failure) or
    { kind = self.files_failed and "files" or "script", message = message, time = self.model.time }
  complain(self, "%s", message)
  return self.files_failed and exit.files or failure and exit.numerical or exit.script
end

local function after_interruption(self)
  self.status, self.message = "interrupted", "interrupted"
end

--- close(run, message, code) -> exit code. `message`: the error that ended loop, or nil; `code`: of the signal, or 0.
function run.close(self, message, code)
  if message then
    code = after_failure(self, message)
  elseif code ~= 0 then
    after_interruption(self)
  else
    self.status = "done"
    local ok, why = pcall(finish, self)
    if not ok then
      code = after_failure(self, tostring(why))
      self.advancing = false
    end
  end
  local checkpoint, time = keep(self)
  core.rescue()
  self.wall_total, self.ended = self.wall + core.now() - self.started, core.date()
  if code == 0 then compare(self) end
  pcall(directory.save_sources, self.folder, self.options.script)
  local ok, why = pcall(record.write, self)
  if not ok then
    complain(self, "%s", why)
    code = code == 0 and exit.files or code
  end
  if code == 0 and self.options.movie then make_movies(self) end
  if code ~= 0 and checkpoint then
    note(self, "%s at t = %.10g; checkpoint: %s", self.status, time, checkpoint)
    if self.status == "interrupted" then note(self, "to continue: tunica resume %s", self.folder) end
  end
  record.print(self)
  return code == 0 and self.agrees == false and exit.script or code
end

return run
