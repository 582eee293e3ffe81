-- SPDX-License-Identifier: MIT
--- Running and looking at the prompt: run, step, show, plot, column.

local core = require "tunica.core"
local registry = require "tunica.registry"
local progress = require "tunica.run.progress"
local outputs = require "tunica.run.outputs"
local screen = require "tunica.prompt.screen"
local session = require "tunica.prompt.session"
local values = require "tunica.prompt.values"

local running = {}
local commands = {}
running.commands = commands

local fail = registry.fail

--- Declares a command of the prompt: { args, options, signature, returns, doc, example, fn }. What comes is looked at by the
-- command itself, since a model may come first or not at all.
local function command(name, entry)
  entry.name = "prompt." .. name
  commands[name] = registry.op(entry)
end

local model_argument = { name = "model", type = "any", doc = "by default the model at hand" }

local slice = 0.05  -- seconds between looks at the clock

-- Which model ---------------------------------------------------------------------------------------------------------------

local function is_model(value)
  local kind = values.kind(value)
  return kind == "model" or kind == "phyllotaxis"
end

--- The model given, else the variable `model`, else the only one that a variable holds.
local function the_model(operation, given)
  require "tunica"
  if is_model(given) then return given end
  if given ~= nil then fail("%s: expected a model, came %s", operation, core.describe(given)) end
  local model = session.lookup "model"
  if is_model(model) then return model end
  local found, names = nil, {}
  for _, name in ipairs(session.made()) do
    local value = session.lookup(name)
    if is_model(value) and value ~= found then found, names[#names + 1] = value, name end
  end
  if #names == 1 then return found end
  if #names > 1 then fail("%s: which model? %s(%s)", operation, operation, table.concat(names, "), " .. operation .. "(")) end
  fail('%s: there is no model yet; load "patterning/sheet" brings one', operation)
end

-- What was seen on the way --------------------------------------------------------------------------------------------------

local histories = setmetatable({}, { __mode = "k" })
local most_points = 4000

--- The numbers that the model's reports gave during runs at the prompt: { time = list, names = list, [name] = list }.
function running.history(model)
  histories[model] = histories[model] or { time = {}, names = {}, series = {} }
  return histories[model]
end

local function record(model)
  local h, row = running.history(model), #running.history(model).time
  local now = model.time
  while row > 0 and h.time[row] >= now do  -- gone back by undo or restore
    for _, list in pairs(h.series) do list[row] = nil end
    h.time[row] = nil
    row = row - 1
  end
  if row >= most_points then return end
  h.time[row + 1] = now
  for _, each in ipairs(outputs.reports(model)) do
    if type(each.value) == "number" then
      if not h.series[each.name] then
        h.series[each.name] = {}
        h.names[#h.names + 1] = each.name
      end
      h.series[each.name][row + 1] = each.value
    end
  end
end

-- Running -------------------------------------------------------------------------------------------------------------------

local run_options = { "to", "until", "by", "seconds", "quiet" }

local function check_options(operation, given, options)
  for key, value in pairs(given) do
    local known = false
    for _, option in ipairs(options) do known = known or key == option end
    if not known then
      fail("%s: there is no option %s%s; the options are: %s", operation, core.describe(key):gsub("^the text ", ""),
        type(key) == "string" and core.did_you_mean(key, options) or "", table.concat(options, ", "))
    end
    local wanted = key == "quiet" and "boolean" or "number"
    if type(value) ~= wanted or value ~= value then
      local expected = wanted == "number" and "a number" or "true or false"
      fail("%s: '%s' must be %s, came %s", operation, key, expected, core.describe(value))
    end
  end
  return given
end

--- run(model, 50), run(50), run { to = 50 }, run(model, { by = 10 }), run(): the model and the options.
local function arguments(operation, a, b, options)
  local model, given = nil, a
  if is_model(a) or b ~= nil then model, given = a, b end
  model = the_model(operation, model)
  if type(given) == "number" then given = { given } end
  if given ~= nil and type(given) ~= "table" then
    fail("%s: expected a number or a table of options, came %s", operation, core.describe(given))
  end
  local o = {}
  for key, value in pairs(given or {}) do o[key == 1 and options[1] or key] = value end
  return model, check_options(operation, o, options)
end

local endless = 1e300

local function goal_of(model, o)
  local to = o.to or o["until"]
  if o.by then
    if to then fail "run: give 'to' or 'by', not both" end
    if o.by <= 0 then fail("run: 'by' must be more than 0, came %.14g", o.by) end
    to = model.time + o.by
  end
  local ends = values.kind(model) == "phyllotaxis" and model.most and endless
  to = to or type(model.stop) == "number" and model.stop or ends
  if not to then
    fail("run: until when? run(%s), run { by = 10 }, or stop = T in tunica.model { ... }", values.time(model.time + 10))
  end
  if to <= model.time then
    fail("run: the model is at t = %s already, and was to run to %s; run { by = 10 } goes on", values.time(model.time),
      values.time(to))
  end
  return to
end

--- What a report gave, in a few words.
local function report_text(value)
  local kind = type(value)
  if kind == "number" then return values.short(value) end
  if kind == "string" then return screen.printable(screen.cut(value, 60)) end
  if kind ~= "table" then return values.brief(value) end
  local count = 0
  for _ in next, value do count = count + 1 end
  return string.format("(a table of %d)", count)
end

local run_meta = { __metatable = "run" }

--- "now at t = 20: 2,000 steps, 650 cells, 1.3 s"
function run_meta.__tostring(r)
  local how = r.status == "done" and "now at" or "stopped at"
  local text = string.format("%s t = %s: %d step%s, %d %s, %.2g s", how, values.time(r.time), r.steps,
    r.steps == 1 and "" or "s", r.size, r.unit, r.seconds)
  local parts = {}
  for _, each in ipairs(r.reports) do
    parts[#parts + 1] = each.name .. " " .. report_text(each.value)
  end
  return #parts > 0 and text .. "\n  " .. table.concat(parts, ", ") or text
end

local function result(model, status, steps, started)
  local size, unit = outputs.size(model)
  return setmetatable({ model = model, status = status, time = model.time, steps = model.steps - steps, size = size, unit = unit,
    seconds = core.now() - started, reports = outputs.reports(model) }, run_meta)
end

--- When reports are looked at: at multiples of their interval, or a hundred times on the way.
local function interval_of(model, goal)
  if #(model.reports or {}) == 0 then return nil end
  if model.report_every then return model.report_every end
  return goal < endless and (goal - model.time) / 100 or nil
end

local function next_pause(model, every)
  return every and every * (math.floor(model.time / every + 1e-9) + 1) or nil
end

local function advance(model, goal, o, bar)
  local every, work, unit_size = interval_of(model, goal), 0, nil
  local deadline = o.seconds and core.now() + o.seconds
  record(model)
  while true do
    local before = model.steps
    local pause = next_pause(model, every)
    local status = model:advance { to = goal, pause = pause, seconds = slice }
    unit_size = { outputs.size(model) }
    work = work + (model.steps - before) * unit_size[1]
    if status == "interrupted" or core.cancelled() then return "interrupted" end
    if every and model.time >= pause - 1e-9 * every or status == "done" then record(model) end
    if status == "done" then return "done" end
    if deadline and core.now() >= deadline then return "out of time" end
    local desk = package.loaded["tunica.prompt.desk"]
    if desk and desk.on_slice then desk.on_slice() end
    progress.update(bar, model.time, unit_size[1], unit_size[2], work)
  end
end

command("run", { signature = "run([model, ] time), or run([model, ] { options })",
  doc = "Runs the model at hand, or a given one: run(50) to t = 50, run { by = 10 }, run { to = 50, seconds = 5 }, run() to its " ..
    "own end. Ctrl-C stops it between two steps; run() goes on.",
  args = { model_argument, { name = "time", type = "any", doc = "where it ends; or a table of options" } },
  options = { { name = "to", type = "number", unit = "time", doc = "where it ends; `until` is the same" },
    { name = "by", type = "number", above = 0, unit = "time", doc = "how much further it runs" },
    { name = "seconds", type = "number", doc = "most that it may take" },
    { name = "quiet", type = "boolean", default = false, doc = "no progress is shown" } },
  returns = "a table that prints as its description: model, status, time, steps, seconds, reports",
  example = [[load "patterning/ring" run(1)]], fn = function(a, b)
  local model, o = arguments("run", a, b, run_options)
  local goal = goal_of(model, o)
  session.settle_variables()
  local steps, started = model.steps, core.now()
  local most = values.kind(model) == "phyllotaxis" and model.most or nil
  local bar = progress.new(goal, most, screen.terminal, o.quiet or not screen.terminal)
  local ok, status = pcall(advance, model, goal, o, bar)
  progress.clear(bar)
  if not ok then error(status, 0) end
  return result(model, status, steps, started)
end })

--- One step; of phyllotaxis up to the next primordium.
local function one_step(model)
  if values.kind(model) == "model" then return model:advance { to = endless, pause = -endless } end
  local count = model.count
  repeat
    local status = model:advance { to = endless, pause = -endless, seconds = slice }
    if status == "interrupted" or status == "done" then return status end
  until model.count > count
end

command("step", { signature = "step([model, ] [count])",
  doc = "Takes one step of the method, or so many: step(10). Of phyllotaxis up to the next primordium.",
  args = { model_argument, { name = "count", type = "any", doc = "how many steps, 1 if not given" } },
  returns = "a table that prints as its description: model, status, time, steps, seconds, reports",
  example = [[load "patterning/ring" step(3)]], fn = function(a, b)
  local model, o = arguments("step", a, b, { "count" })
  local count = o.count or 1
  if count < 1 or count ~= math.floor(count) then fail("step: expected a whole number of steps from 1 on, came %.14g", count) end
  session.settle_variables()
  local steps, started, status = model.steps, core.now(), nil
  for _ = 1, count do
    status = one_step(model)
    if status == "interrupted" or core.cancelled() then break end
  end
  return result(model, status == "interrupted" and status or "done", steps, started)
end })

-- Looking -------------------------------------------------------------------------------------------------------------------

local function write_picture(png, around)
  local text = core.terminal_picture(png, around)
  if text then
    io.write(text)
    io.flush()
    return
  end
  local name = os.tmpname()
  os.remove(name)
  core.write_atomic(name .. ".png", png)
  print(screen.fold("no pictures are drawn here; it is in " .. name .. ".png"))
end

--- The view to draw: options given, else those of the model's view of that name or its first, with `given` laid over them.
local function view_of(model, given)
  local view = (model.views or {})[1]
  if type(given) == "string" then
    for _, each in ipairs(model.views or {}) do
      if each.name == given then return each end
    end
    given = { colour = given }
  end
  local out = {}
  for key, value in pairs(view or {}) do out[key] = value end
  for key, value in pairs(given or {}) do out[key] = value end
  if given and given.colour and given.colour ~= (view or {}).colour then out.range, out.legend = given.range, given.legend end
  return out
end

command("show", { signature = "show([model, ] [what])",
  doc = "Draws the model at hand in the terminal as its view says: show(), show 'column', " ..
    "show { colour = 'column', palette = 'magma' }, show(tissue, 'column').",
  args = { { name = "model", type = "any", doc = "a model or a tissue; by default the model at hand" },
    { name = "what", type = "any", doc = 'a view of the model or a column, by name; or options of a view: help "model:view"' } },
  example = [[load "patterning/ring" show()]], fn = function(a, b)
  require "tunica"
  if values.kind(a) == "tissue" then
    if type(b) == "string" then b = { colour = b } end
    return a:show(b or {})
  end
  local model, given = nil, a
  if is_model(a) or b ~= nil then model, given = a, b end
  if model == nil and not (type(session.lookup "model") == "table") and values.kind(session.lookup "tissue") == "tissue" then
    return commands.show(session.lookup "tissue", given)
  end
  model = the_model("show", model)
  if given ~= nil and type(given) ~= "string" and type(given) ~= "table" then
    fail("show: expected the name of a view or column, or a table of options, came %s", core.describe(given))
  end
  local png, _, _, around = require("tunica.view").draw(model, view_of(model, given))
  write_picture(png, around)
end })

local function the_tissue(operation, model)
  if values.kind(model) == "tissue" then return model end
  if model == nil and not is_model(session.lookup "model") and values.kind(session.lookup "tissue") == "tissue" then
    return session.lookup "tissue"
  end
  local found = the_model(operation, model)
  if values.kind(found) ~= "model" then
    fail("%s: a model of phyllotaxis has no cells; plot { y = model.angles } plots any list", operation)
  end
  return found.tissue
end

local function kind_of_column(tissue, name)
  local all = {}
  for _, kind in ipairs { "cell", "side", "wall", "junction" } do
    local known, names = pcall(core.columns, tissue, kind)
    for _, each in ipairs(known and names or {}) do
      if each == name then return kind end
      all[#all + 1] = each
    end
  end
  return nil, all
end

command("column", { signature = "column([tissue, ] name [, kind])",
  doc = [[Count, range, mean and a small histogram of a column: column "auxin", column("pin", "side").]],
  args = { { name = "tissue", type = "any", doc = "or a model; by default the tissue at hand" },
    { name = "name", type = "any", doc = "of the column" },
    { name = "kind", type = "any", doc = "'cell', 'side', 'wall' or 'junction'; by default the first that has it" } },
  returns = "a table that prints as its description: name, kind, count, min, max, mean, values (a list)",
  example = [[load "patterning/ring" print(column "auxin")]], fn = function(a, b, c)
  if type(a) == "string" then a, b, c = nil, a, b end
  local tissue = the_tissue("column", a)
  if type(b) ~= "string" then fail("column: expected the name of a column, came %s", core.describe(b)) end
  local kind, all = kind_of_column(tissue, b)
  if c == nil and not kind then fail("column: there is no column '%s'%s", b, core.did_you_mean(b, all)) end
  return values.column(tissue, b, c or kind)
end })

local function plot_lists(given)
  local series = given.series or { { x = given.x, y = given.y, title = given.title } }
  for _, each in ipairs(series) do
    if type(each) ~= "table" or type(each.y) ~= "table" then
      fail "plot: give { y = list }, { x =, y = } or { series = { { x =, y = } } }"
    end
  end
  return require("tunica.prompt.plot")(series, { title = given.title, lines = given.style == "lines" })
end

--- Cells in a row are plotted as they lie; of others the distribution is shown.
local function plot_column(tissue, name, kind)
  local column = values.column(tissue, name, kind)
  if kind ~= "cell" or tissue.has_geometry or column.count > 2000 then
    print(tostring(column))
    return
  end
  print(require("tunica.prompt.plot")({ { y = column.values } }, { title = name .. " by cell", lines = true }))
end

command("plot", { signature = "plot([model, ] name), or plot { y = list, options }",
  doc = "Plots in characters: plot 'peaks' a report over the time of runs at this prompt, plot 'auxin' a column, " ..
    "plot { y = list, x = list } any numbers.",
  args = { model_argument, { name = "what", type = "any", doc = "a report or a column, by name; by default the first report" } },
  options = { { name = "y", type = "list", of = "number", doc = "what is plotted; a plain list is the same" },
    { name = "x", type = "list", of = "number", doc = "over what; by default 1, 2, 3 ..." },
    { name = "series", type = "list", doc = "several: { { x =, y =, title = }, ... }" },
    { name = "title", type = "string", doc = "above the plot" },
    { name = "style", type = "string", choices = { "points", "lines" }, default = "points", doc = "whether points are joined" } },
  example = [[load "patterning/ring" run(1) plot "auxin"]], fn = function(a, b)
  local model, what = nil, a
  if is_model(a) or b ~= nil then model, what = a, b end
  if type(what) == "table" then
    if #what > 0 and what.y == nil then what = { y = what } end
    print(plot_lists(what))
    return
  end
  model = the_model("plot", model)
  local h = running.history(model)
  if what == nil then what = h.names[1] end
  if type(what) ~= "string" then
    fail("plot: of what? The name of a report or a column, or { y = list }%s",
      #h.names > 0 and "; reports: " .. table.concat(h.names, ", ") or "")
  end
  local names = {}
  for _, report in ipairs(model.reports or {}) do names[#names + 1] = report.name end
  for _, name in ipairs(names) do
    if name == what then
      local list = h.series[what]
      if not list and values.kind(model) == "model" and kind_of_column(model.tissue, what) then break end
      if not list or #h.time < 2 then fail("plot: '%s' is a report, of which nothing was recorded yet; run() first", what) end
      local x, y = {}, {}
      for i, t in ipairs(h.time) do
        if list[i] then x[#x + 1], y[#y + 1] = t, list[i] end
      end
      print(require("tunica.prompt.plot")({ { x = x, y = y } }, { title = what .. " over time", lines = true }))
      return
    end
  end
  local tissue = the_tissue("plot", model)
  local kind, all = kind_of_column(tissue, what)
  for _, name in ipairs(all or {}) do names[#names + 1] = name end
  if not kind then fail("plot: there is no report and no column '%s'%s", what, core.did_you_mean(what, names)) end
  plot_column(tissue, what, kind)
end })

commands.quit = registry.op { name = "prompt.quit", fn = function() session.leave() end, example = "print(quit)",
  doc = "Leaves the prompt; so does Ctrl-D on an empty line." }

return running
