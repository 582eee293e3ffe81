-- SPDX-License-Identifier: MIT
--- What `tunica chart` and `tunica stability` have in common: a model run again and again from its start under several
-- methods, in a folder that says of what, so that a study broken off goes on where it was.

local core = require "tunica.core"
local params = require "tunica.params"
local outputs = require "tunica.run.outputs"
local directory = require "tunica.run.directory"
local quantity = require "tunica.chart.quantity"

local study = {}

--- Exit codes, as src/shell/exit_codes.h has them.
study.exit = { ok = 0, usage = 2, numerical = 3, files = 4 }

-- Saying things ----------------------------------------------------------------------------------------------------

local function clear(self)
  if self.drawn then io.stderr:write("\r\27[K") end
  self.drawn = false
end

--- A line that renews itself, on a terminal only.
function study.progress(self, format, ...)
  if self.options.quiet or not self.options.terminal then return end
  io.stderr:write("\r\27[K", (string.format(format, ...):sub(1, 100)))
  io.stderr:flush()
  self.drawn = true
end

function study.note(self, format, ...)
  clear(self)
  if not self.options.quiet then io.stderr:write("tunica: ", string.format(format, ...), "\n") end
end

function study.complain(self, format, ...)
  clear(self)
  io.stderr:write("tunica: error: ", string.format(format, ...), "\n")
end

function study.print(self, text)
  clear(self)
  io.stdout:write(text)
  io.stdout:flush()
end

--- An error of the command line.
function study.refuse(format, ...)
  core.blame_command_line()
  error(string.format(format, ...), 0)
end

-- Methods ----------------------------------------------------------------------------------------------------------

--- Puts the methods asked for (all, if none are named) into self.methods, in the kernel's order. Errors: of the command line.
function study.choose_methods(self)
  local names, asked = {}, {}
  for i, way in ipairs(core.methods_of_solution()) do names[i] = way.name end
  for _, name in ipairs(self.options.methods) do
    local known = false
    for _, other in ipairs(names) do known = known or other == name end
    if not known then
      study.refuse("--methods: no method is called '%s'%s; there are: %s", name, core.did_you_mean(name, names), table.concat(names, ", "))
    end
    asked[name] = true
  end
  self.methods = {}
  for _, way in ipairs(core.methods_of_solution()) do
    if next(asked) == nil or asked[way.name] then table.insert(self.methods, way) end
  end
end

--- Why a method cannot do the model, or nil. Implicit methods need derivatives of the rules.
function study.obstacle(self, way)
  if not way.implicit then return nil end
  for _, rule in ipairs(self.model.about.rules) do
    if not rule.traced then
      return string.format("it needs derivatives of the rules, and the %s rule of %s cannot be traced (finite differences would stand in, but a chart of them says little)", rule.rule, rule.where)
    end
  end
end

-- The folder -------------------------------------------------------------------------------------------------------

--- What a study is of. Two of the same identity give the same rows, but for their times.
local function identity_of(self)
  local texts = {}
  for i, source in ipairs(core.sources()) do texts[i] = source.text end
  local P = params.is(self.model.params) and self.model.params or params.current()
  return { script = core.hash(table.concat(texts, "\0")), parameters = P and outputs.plain(params.values(P)) or {}, ["until"] = self.goal,
    quantity = self.quantity.name, seed = core.seed(), kind = self.kind }
end

--- What differs between two identities, in words; nil if nothing does.
local function difference(there, here)
  if there.kind ~= here.kind then return string.format("it is of tunica %s", tostring(there.kind)) end
  if there.script ~= here.script then return "the script has changed since" end
  for _, key in ipairs { "until", "quantity", "seed" } do
    if there[key] ~= here[key] then return string.format("--%s is %s now, and was %s there", key, tostring(here[key]), tostring(there[key])) end
  end
  local names = {}
  for _, set in ipairs { there.parameters, here.parameters } do
    for name in pairs(set) do names[name] = true end
  end
  for name in pairs(names) do
    if there.parameters[name] ~= here.parameters[name] then
      return string.format("parameter %s is %s now, and was %s there", name, tostring(here.parameters[name]), tostring(there.parameters[name]))
    end
  end
end

function study.write_record(self)
  core.write_atomic(self.folder .. "/" .. self.kind .. ".json", core.encode(self.record, true) .. "\n")
end

local function take_folder(self, path)
  local free, why = directory.lock(path)
  if not free then study.refuse("%s", why) end
  self.folder = path
end

--- Goes on in the folder of an earlier study of the same, or makes a new one.
local function open_folder(self)
  local out, identity = self.options.out, identity_of(self)
  local file = out and out .. "/" .. self.kind .. ".json"
  self.record = { identity = identity, name = self.options.name, versions = core.decode(self.options.versions),
    arguments = core.as_list(self.options.arguments) }
  if file and core.kind_of(file) then
    local ok, old = pcall(function() return core.decode(core.read_file(file)) end)
    if not ok or type(old) ~= "table" or type(old.identity) ~= "table" then study.refuse("'%s' is damaged", file) end
    local what = difference(old.identity, identity)
    if what then study.refuse("'%s' holds another %s: %s; choose another --out", out, self.kind, what) end
    take_folder(self, out)
    self.old = old
    self.record.reference = old.reference
  else
    local refusal = out and directory.refusal(out)
    if refusal then study.refuse("%s", refusal) end
    self.folder = directory.make(out, self.options.name .. "-" .. self.kind, function(folder)
      directory.lock(folder)
      core.write_atomic(folder .. "/" .. self.kind .. ".json", core.encode(self.record, true) .. "\n")
    end)
  end
end

--- begin(model, options, kind, default quantity) -> the study. Errors: of the command line.
function study.begin(model, options, kind, default)
  local self = { model = model, options = options, kind = kind, code = study.exit.ok }
  if next(core.overrides()) and not params.current() then
    study.refuse("the model declares no parameters (tunica.params); there is nothing to change by '%s'", options.arguments[1] or "")
  end
  study.choose_methods(self)
  self.goal = options.until_time or model.stop
  if type(self.goal) ~= "number" then
    study.refuse("at which time are the runs to be compared? Say --until T, or stop = T in tunica.model { ... }")
  end
  if not (self.goal > model.time) then study.refuse("--until %g is not after the model's start at %g", self.goal, model.time) end
  local _ = model.about  -- binds the rules: what is wrong with them is said before anything is written
  self.quantity = quantity.choose(model, options.quantity, default, study.refuse)
  self.was = model:solution()
  self.start = model:snapshot()
  open_folder(self)
  return self
end

-- Runs -------------------------------------------------------------------------------------------------------------

--- The largest step to begin with: the model's own, or a round one; times powers of two.
function study.base_step(self)
  return self.was.dt or 10 ^ math.floor(math.log10(self.goal / 100))
end

--- Runs the model from its start to the end under a solution, for at most so many seconds. Returns nil after an
-- interruption; else { cost =, status = "done" | "out of time" | "failed", failure = kind, detail =, wall = }. The state is
-- then the model's.
function study.try(self, solution, seconds)
  local model = self.model
  model:solve_with(solution)
  model:restore(self.start)
  local begun = core.now()
  local ok, status = pcall(model.advance, model, { to = self.goal, seconds = seconds })
  if core.cancelled() or status == "interrupted" then return nil end
  local run = { cost = model.cost, wall = core.now() - begun, status = ok and status or "failed" }
  if not ok then
    local failure = model.failure
    run.failure, run.detail = failure and failure.kind or "error", tostring(status):match "^[^\n]*"
    run.time = failure and failure.time
  elseif status ~= "done" then
    run.failure, run.detail = status, string.format("%.3g s were not enough", seconds or 0)
  elseif model:solution().method ~= solution.method then
    error(string.format("the model changes its method itself (to %s): methods cannot be compared", model:solution().method), 0)
  end
  return run
end

--- A number for tables: three digits.
function study.short(value)
  if value == nil then return "-" end
  if value == 0 then return "0" end
  local size = math.abs(value)
  if size >= 0.001 and size < 1e5 then
    local text = string.format("%." .. math.max(0, 2 - math.floor(math.log10(size))) .. "f", value)
    return text:find("%.") and (text:gsub("0+$", ""):gsub("%.$", "")) or text
  end
  local digits, power = string.format("%.2e", value):match "^(.-)e(.*)$"
  return digits:gsub("%.?0+$", "") .. "e" .. tonumber(power)
end

--- Rows of text in columns; `right` marks those set to the right.
function study.columns(rows, right)
  local widths, lines = {}, {}
  for _, row in ipairs(rows) do
    for i, text in ipairs(row) do widths[i] = math.max(widths[i] or 0, #text) end
  end
  for n, row in ipairs(rows) do
    local cells = {}
    for i, text in ipairs(row) do cells[i] = right[i] and (" "):rep(widths[i] - #text) .. text or text .. (" "):rep(widths[i] - #text) end
    lines[n] = table.concat(cells, "  "):gsub("%s+$", "")
  end
  return table.concat(lines, "\n") .. "\n"
end

--- The end of a study, whatever brought it about: `conclude(self)`, if there is anything to show, then the exit code.
function study.close(self, message, code, conclude)
  local interrupted = code ~= 0 and not message
  if message then study.complain(self, "%s", message) end
  if conclude then
    local ok, why = pcall(conclude, self)
    if not ok then study.complain(self, "%s", tostring(why)) end
    if not ok and code == 0 then code = study.exit.files end
  end
  if interrupted then study.note(self, "interrupted; to continue: the same command with --out %s", self.folder) end
  return message and self.code ~= 0 and self.code or message and math.max(code, 1) or code
end

return study
