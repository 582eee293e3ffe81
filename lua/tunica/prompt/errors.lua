-- SPDX-License-Identifier: MIT
--- What the prompt says of an error: the message, the line of source with a mark, the user's own functions that led there, and
-- what the innermost one held.

local core = require "tunica.core"
local screen = require "tunica.prompt.screen"
local values = require "tunica.prompt.values"
local debug = select(2, ...).debug

local errors = {}

--- Texts typed at the prompt, by the name of their chunk.
errors.typed = {}

local noted  -- of the innermost place at which an error was raised: { message, frames, locals }

local most_frames, most_locals = 10, 10

local function is_users(about) return about.currentline >= 0 and about.source:sub(1, 8) ~= "=tunica/" end

local function locals_of(level)
  local list, seen = {}, {}
  for i = 1, 200 do
    local name, value = debug.getlocal(level + 1, i)
    if not name then break end
    if name:sub(1, 1) ~= "(" then
      if seen[name] then list[seen[name]].value = value
      else
        list[#list + 1] = { name = name, value = value }
        seen[name] = #list
      end
    end
  end
  return list
end

local function note(message)
  local frames, innermost = {}, nil
  for level = 3, 200 do
    local about = debug.getinfo(level, "nSlf")
    if not about then break end
    if is_users(about) then
      innermost = innermost or locals_of(level)
      about.at_top = about.what == "main"
      frames[#frames + 1] = about
      if about.at_top and errors.keep then errors.keep(about.source, locals_of(level)) end
    end
  end
  noted = { message = message, frames = frames, locals = innermost or {} }
end

--- A message handler. It keeps what the stack says where an error is first raised, and hands the message on: the library catches
-- errors and raises them again when it has put its own state in order.
function errors.note(message)
  if not (noted and rawequal(noted.message, message)) then pcall(note, message) end
  return message
end

function errors.forget() noted = nil end

-- Source ----------------------------------------------------------------------------------------------------------------

local function line_of(text, number)
  local at = 1
  for line in (text .. "\n"):gmatch "(.-)\n" do
    if at == number then return line end
    at = at + 1
  end
end

--- The line of a file as it was when it was loaded, or of an input.
local function source_line(name, number)
  if errors.typed[name] then return line_of(errors.typed[name], number) end
  local found
  for _, source in ipairs(core.sources()) do
    if source.path == name then found = source.text end
  end
  if not found then
    local ok, text = pcall(core.read_file, name)
    found = ok and text
  end
  return found and line_of(found, number)
end

--- Where in the line the message points, as first and last character, or nil.
local function marked(line, message)
  for _, word in ipairs { "field", "global", "local", "method", "upvalue", "variable", "has no", "parameter" } do
    local name = message:match(word .. " '([%a_][%w_]*)'")
    local first, last
    if name then first, last = line:find("%f[%w_]" .. name .. "%f[^%w_]") end
    if first then return first, last end
  end
  local near = message:match "near '(.-)'"
  if near and near ~= "<eof>" then
    local first, last, after = nil, nil, 1
    repeat
      local a, b = line:find(near, after, true)
      if a then first, last, after = a, b, b + 1 end
    until not a
    return first, last
  end
end

local function show_source(out, name, number, message)
  local line = source_line(name, number)
  if not line or line:match "^%s*$" then return end
  local margin = string.format("  %d | ", number)
  local text = screen.cut(line:gsub("\t", " "), screen.width() - #margin)
  out[#out + 1] = screen.paint("dim", margin) .. text
  local first, last = marked(line, message)
  if first and last <= #text then
    local before = #margin + screen.length(line:sub(1, first - 1))
    out[#out + 1] = string.rep(" ", before) .. screen.paint("red", string.rep("^", last - first + 1))
  end
end

-- Frames ----------------------------------------------------------------------------------------------------------------

local function words_of_event(e)
  if e.kind == "after" then return "the event after " .. e.time .. " primordia" end
  return string.format("the event %s %s", e.kind, values.number(e.time))
end

--- "the rate rule of cells", "the event every 0.5": what a function is to a model; or nil.
local function role_of(fn)
  for _, kind in ipairs { "model", "phyllotaxis" } do
    local module = package.loaded["tunica." .. kind]
    for _, my in next, module and module.inside or {} do
      for _, r in ipairs(my.rules) do
        if r.fn == fn then return string.format("the %s rule of %ss", r.what, r.kind) end
      end
      for _, e in ipairs(my.events) do
        if e.fn == fn then return words_of_event(e) end
      end
      for _, c in ipairs(my.conditions) do
        if c.test == fn then return "a condition of model:when" end
        if c.fn == fn then return "the event of a condition" end
      end
      for _, r in ipairs(my.reports) do
        if r.fn == fn then return "the report " .. r.name end
      end
    end
  end
end

local function frame_text(about)
  local name = about.source:sub(1, 1) == "@" and about.source:sub(2) or about.short_src
  local role = role_of(about.func)
  local of = role and ", " .. role or about.name and about.name ~= "" and " in '" .. about.name .. "'" or ""
  return string.format("  at %s:%d%s", name, about.currentline, of)
end

local function show_frames(out, frames)
  -- One line at the prompt, which the message names already, says nothing more.
  if #frames == 1 and frames[1].at_top then return end
  for i, about in ipairs(frames) do
    if i > most_frames then
      out[#out + 1] = "  ..."
      break
    end
    out[#out + 1] = frame_text(about)
  end
end

local function show_locals(out, list)
  local width = screen.width()
  for i, each in ipairs(list) do
    if i > most_locals then
      out[#out + 1] = string.format("    ... %d more", #list - most_locals)
      break
    end
    local ok, text = pcall(values.brief, each.value)
    out[#out + 1] = screen.cut("    " .. each.name .. " = " .. (ok and text or "?"), width)
  end
end

-- Everything ------------------------------------------------------------------------------------------------------------

local function text_of(message)
  if type(message) == "string" then return message end
  if type(message) == "table" or type(message) == "userdata" then
    local ok, text = pcall(tostring, message)
    local meta = debug.getmetatable(message)
    if ok and type(meta) == "table" and rawget(meta, "__tostring") and type(text) == "string" then return text end
  end
  return "error with a value that is not text (a " .. type(message) .. ")"
end

--- The lines to write about an error that came out of an input.
function errors.describe(message)
  local text = text_of(message)
  local shown = "error: " .. text:gsub("[%c\127]", function(c) return (c == "\n" or c == "\t") and c or "\\" .. c:byte() end)
  local out = { (screen.fold(shown):gsub("^error: ", screen.paint("red", "error: "))) }
  local called = text:match "attempt to call global '([%w_]+)'"
  local session = package.loaded["tunica.prompt.session"]
  if called and session and session.commands()[called] then
    out[2] = string.format("  a variable hides the command '%s'; %s = nil brings it back", called, called)
  end
  local about = noted
  noted = nil
  if about and not rawequal(about.message, message) then
    local within = type(about.message) == "string" and text:find(about.message, 1, true)
    about = within and about or nil
  end
  local place, number = text:match "^(.-):(%d+): "
  if not place and about and about.frames[1] then
    place, number = about.frames[1].source:sub(2), about.frames[1].currentline
  end
  if place then show_source(out, place, tonumber(number), text) end
  if not about then return out end
  show_frames(out, about.frames)
  if not (about.frames[1] and about.frames[1].at_top) and #about.locals > 0 then
    out[#out + 1] = "  where"
    show_locals(out, about.locals)
  end
  return out
end

return errors
