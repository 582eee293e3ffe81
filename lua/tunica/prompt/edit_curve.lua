-- SPDX-License-Identifier: MIT
--- edit_curve: which curve is meant, the editor on the terminal, and where the result goes.

local core = require "tunica.core"
local registry = require "tunica.registry"
local params = require "tunica.params"
local shapes = require "tunica.shapes"
local curve_text = require "tunica.curve_text"
local curve_editor = require "tunica.prompt.curve_editor"
local desk = require "tunica.prompt.desk"
local history = require "tunica.prompt.history"
local screen = require "tunica.prompt.screen"
local op, fail = registry.op, registry.fail

-- Which curve ---------------------------------------------------------------------------------------------------------------

--- The parameters of the model at hand that hold curves: name -> text.
local function curve_parameters()
  local model, found = desk.model(), {}
  local first = model and desk.begun(model) and desk.begun(model).script.params or {}
  for name, value in pairs(model and model.params and params.values(model.params) or {}) do
    if type(value) == "string" then
      shapes.uses[value] = shapes.uses[value] or shapes.uses[first[name]]  -- set by hand, and not read yet
      if shapes.uses[value] then found[name] = value end
    end
  end
  return found
end

local function sorted_names(list)
  local names = {}
  for name in pairs(list) do names[#names + 1] = name end
  table.sort(names)
  return names
end

local function is_file(path) return core.kind_of(path) == "file" end

--- A file that a text names, as the script of the model would find it; or nil.
local function file_of(text)
  local folder = desk.source and desk.source.path and desk.source.path:match "^(.*)/[^/]*$"
  local beside = folder and text:sub(1, 1) ~= "/" and folder .. "/" .. text
  return beside and is_file(beside) and beside or is_file(text) and text or nil
end

--- What a curve is to the editor.
local function drawing_of(shape)
  if core.shape_kind(shape) == "curve" then
    local points, degree = core.curve_points(shape)
    return { kind = "curve", points = points, degree = degree }
  end
  local points, degree, ends = core.contour_points(shape)
  return { kind = "contour", points = points, degree = degree, ends = ends }
end

local function increases(points)
  for i = 2, #points do
    if points[i][1] < points[i - 1][1] then return false end
  end
  return true
end

--- The curve that a text names or is; nil and why there is none.
local function shape_of_text(text)
  local use = shapes.uses[text]
  if not use and curve_text.is(text) then
    local points = curve_text.read(text, "edit_curve")
    use = (points.ends or not increases(points)) and "contour" or "curve"
  end
  local name = curve_text.is(text) and text or file_of(text) or text
  local known, from_file = shapes.uses[name], nil
  for _, make in ipairs { use == "profile" and shapes.contour or use and shapes[use] or shapes.curve, shapes.contour } do
    local ok, shape = pcall(make, name)
    if ok then
      shapes.uses[name] = known or shapes.uses[name]
      return shape
    end
    from_file = from_file or shape
    shapes.uses[name] = known
  end
  return nil, (tostring(from_file):gsub("^%S-:%d+: ", ""))
end

local beginnings = {
  func = { kind = "curve", points = { { 0, 1 }, { 0.5, 1 }, { 1, 1 } } },
  con = { kind = "contour", points = { { 0, 1 }, { 0.5, 1 }, { 1, 0.5 }, { 1, 0 } } },
}

--- What a text stands for: { kind, points, degree, ends, title, parameter = its name, value = its text, file = where it
-- is from, target = the file to be written }.
local function named(text)
  local found, parameter = curve_parameters(), nil
  if found[text] then
    parameter = text
  else
    local names = {}
    for _, name in ipairs(sorted_names(found)) do
      if found[name] == text then names[#names + 1] = name end
    end
    if #names > 1 then
      fail("edit_curve: '%s' is the value of the parameters %s; name one: edit_curve \"%s\"", text:sub(1, 60),
        table.concat(names, " and "), names[1])
    end
    parameter = names[1]
  end
  local value = parameter and found[parameter] or text
  local shape, why = shape_of_text(value)
  if not shape then
    local new = beginnings[value:match "%.(%a+)$" or ""]
    if parameter or not new or core.kind_of(value) then
      fail("edit_curve: %s%s", why, parameter and "" or core.did_you_mean(text, sorted_names(found)))
    end
    return { kind = new.kind, points = new.points, degree = 3, title = value .. " (new)", file = value, target = value }
  end
  local drawing = drawing_of(shape)
  drawing.parameter, drawing.value, drawing.profile = parameter, value, shapes.uses[value] == "profile"
  local is_text = curve_text.is(value)
  drawing.title = parameter and (is_text and parameter or parameter .. " (" .. value .. ")") or is_text and drawing.kind or value
  drawing.file = not is_text and file_of(value) or nil
  drawing.target = not parameter and drawing.file or nil
  return drawing
end

local function drawing_for(what)
  if what == nil then
    local names = sorted_names(curve_parameters())
    if #names ~= 1 then
      fail("edit_curve: which curve? %s", #names > 1 and "edit_curve \"" .. table.concat(names, "\", edit_curve \"") .. "\"" or
        "Give the name of a parameter that holds one, of a file or a shipped curve, or a curve: edit_curve(tunica.curve \"raised\")")
    end
    return named(names[1])
  end
  if type(what) == "string" then return named(what) end
  local shape = what
  if type(what) == "table" then shape = shapes.curve(what) end
  if core.shape_kind(shape) == "apex" then
    fail "edit_curve: an apex is made of a profile and of growth; edit those, and make another"
  end
  local drawing = drawing_of(shape)
  drawing.shape = shape
  return drawing
end

-- The editor on the terminal ------------------------------------------------------------------------------------------------

local function save(path, shape)
  if core.shape_kind(shape) == "curve" then core.save_curve(shape, path) else core.save_contour(shape, path) end
end

--- Edits a drawing. Returns the curve and its text, or nothing if it was left; and the file it was written to as it is.
local function edit(drawing)
  drawing.save = save
  local name = (drawing.parameter or "curve") .. (drawing.kind == "curve" and ".func" or ".con")
  drawing.file = drawing.file or name
  local editor, why = curve_editor.new(drawing)
  if not editor then fail("edit_curve: %s", why) end
  if drawing.target then
    editor.accept = function(shape) save(drawing.target, shape) end
  end
  local function work(terminal)
    while not editor.outcome do
      local width, height = terminal.size()
      terminal.draw(editor:draw(width, height))
      local key, column, row = terminal.key()
      if key == "stop" then
        editor.outcome = "leave"
      elseif key ~= "resize" then
        editor:press(key, column, row)
      end
    end
  end
  if not screen.full then fail "edit_curve: the editor needs the prompt, in a terminal; edit_curve(which, \"0,0.3 1,1\") does not" end
  local ok, message = pcall(screen.full, work)
  if not ok then
    fail("edit_curve: %s; edit_curve(which, \"0,0.3 1,1\") sets points without it", (tostring(message):gsub("^%S-:%d+: ", "")))
  end
  if editor.outcome ~= "accept" then return nil end
  return editor.shape, editor:text(), editor.written == editor:text() and editor.file or nil
end

-- Where the result goes -----------------------------------------------------------------------------------------------------

--- The line typed becomes one that does the same without the editor, for transcript.
local function note_line(text)
  local line = desk.lines[#desk.lines]
  if not line then return end
  local calls = select(2, line.text:gsub("edit_curve", ""))
  if calls ~= 1 then return end
  if not text then
    line.text = "-- " .. line.text:gsub("\n", "\n-- ")
    return
  end
  local function with(inner) return "edit_curve(" .. (inner:match "%S" and inner or "nil") .. ", \"" .. text .. "\")" end
  local changed, count = line.text:gsub("edit_curve%s*(%b())", function(inner) return with(inner:sub(2, -2)) end)
  if count == 0 then changed = line.text:gsub("edit_curve%s*([\"'][^\"']*[\"'])", with) end
  line.text = changed
end

--- The parameter's new value: the file that was written just now, if the script would find that one, else the points.
local function value_of(text, file)
  if file and file_of(file) == file then return file end
  return text
end

local function short(text) return screen.cut(text, 60) end

local function set_parameter(drawing, text)
  local model = desk.need_model "edit_curve"
  local name = drawing.parameter
  if text == drawing.value and not (drawing.file and is_file(drawing.file)) then return desk.say("%s is as it was", name) end
  if not desk.source then
    history.keep("edit_curve", true)
    model.params[name] = text
    desk.say("%s: %s -> %s, for what reads it from now on; this model was typed here, so what was made of the old curve stays", name,
      short(drawing.value), short(text))
    return
  end
  desk.reload({ [name] = text }, "edit_curve")
  desk.say("%s: %s -> %s; the state at t = %.6g is kept", name, short(drawing.value), short(text), desk.model().time)
  if drawing.profile and desk.inside(desk.model()).tissue then
    desk.say("growth moves the cells as they are onto the new surface; load { \"%s\", %s = P.%s } begins anew on it", desk.source.name,
      name, name)
  end
end

local function check_given(drawing, given)
  local shape = given
  if type(given) == "string" or type(given) == "table" then
    shape = (drawing.kind == "curve" and shapes.curve or shapes.contour)(given)
  end
  if core.shape_kind(shape) ~= drawing.kind then
    fail("edit_curve: expected a %s to take the place of one, came %s", drawing.kind, core.describe(given))
  end
  local d = drawing_of(shape)
  local editor = curve_editor.new { kind = d.kind, points = d.points, degree = d.degree, ends = d.ends, profile = drawing.profile }
  if editor and editor.wrong then fail("edit_curve: %s", editor.wrong) end
  return shape, curve_text.write(d.points, d.degree, d.ends)
end

local function changed(what, given)
  local drawing = drawing_for(what)
  local shape, text, file
  if given ~= nil then
    shape, text = check_given(drawing, given)
    if drawing.target then save(drawing.target, shape) end
  else
    shape, text, file = edit(drawing)
    note_line(text)
  end
  if not shape then
    desk.say "left as it was"
    if drawing.shape then return drawing.shape end
    return (shape_of_text(drawing.value or ""))
  end
  if drawing.parameter then
    local ok, why = pcall(set_parameter, drawing, value_of(text, file))
    if not ok then
      if given == nil then desk.say("not taken; what was drawn: \"%s\"", text) end
      error(why, 0)
    end
  elseif drawing.target then
    desk.say("written: %s", drawing.target)
  end
  return shape
end

op { name = "prompt.edit_curve", returns = "the curve",
  args = { { name = "which", type = "string|curve|contour|list", doc = "a parameter of the model by name or by value (P.growth), a " ..
      "file (.func, .con), a shipped curve, a curve of your own, or points" },
    { name = "to", type = "string|curve|contour|list", doc = "what it becomes, without the editor: points, also as text" } },
  doc = "Opens the editor of curves in the terminal: the curve with its control points, which keys and mouse move, add and delete. " ..
    "Enter takes the result: a parameter holds it from then on as text, the script is read again and the state kept; a file is " ..
    "written; c = edit_curve(c) changes a variable. Ctrl-C leaves the curve as it was. ? in the editor lists its keys.",
  example = 'load "growth/apex"\nedit_curve("growth", "0,0.3 0.5,1 2,1")\nprint(P.growth)',
  fn = changed }

--- tunica curve FILE
local function edit_file(path)
  local shape = changed(path)
  if not shape then return end
  local drawing = drawing_of(shape)
  desk.say("%s", curve_text.write(drawing.points, drawing.degree, drawing.ends))
end

return { edit_file = edit_file, parameters = curve_parameters }
