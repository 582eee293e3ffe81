-- SPDX-License-Identifier: MIT
--- One conversation at the prompt: what was typed is compiled, run, and its values shown; names that it made stay.
--
-- A top-level `local` survives its line: the prompt keeps its value, and later inputs find it as they would a global. A function
-- made in the same input has the variable itself, so it does not see what later inputs assign to that name.

local core = require "tunica.core"
local screen = require "tunica.prompt.screen"
local debug = select(2, ...).debug

local session = {}

-- Names -----------------------------------------------------------------------------------------------------------------

-- What the user has made lives in a table of its own, over the commands of the prompt, over Lua's globals (in which scripts put
-- theirs). A name may have been declared by a `local` without a value.
local names, declared = {}, {}

--- Modules whose functions are known at the prompt, and only there. A module may name them in its field `commands`, else all are.
session.modules = { "running", "help", "work" }

local commands

local function load_commands()
  commands = {}
  for _, name in ipairs(session.modules) do
    local found, module = pcall(require, "tunica.prompt." .. name)
    if found then
      for command, fn in next, module.commands or module do commands[command] = fn end
    elseif not tostring(module):find("has no part 'tunica.prompt", 1, true) then
      error(module, 0)
    end
  end
  commands.tunica = require "tunica"
  require("tunica.warnings").fold = screen.fold
  local desk = package.loaded["tunica.prompt.desk"]
  if desk then desk.globals = names end
end

--- The functions of the prompt by name.
function session.commands()
  if not commands then load_commands() end
  return commands
end

--- A name as an input sees it; and whether there is one.
function session.lookup(name)
  local value = rawget(names, name)
  if value == nil then value = session.commands()[name] end
  if value == nil then value = rawget(_G, name) end
  return value, value ~= nil or declared[name] == true
end

--- Every name that an input can use, sorted.
function session.names()
  local seen, list = {}, {}
  for _, each in ipairs { names, declared, session.commands(), _G } do
    for name in next, each do seen[name] = true end
  end
  for name in next, seen do
    if type(name) == "string" then list[#list + 1] = name end
  end
  table.sort(list)
  return list
end

local at_start = {}
for name in next, _G do at_start[name] = true end

--- Names made by the user or a script, sorted.
function session.made()
  local list = {}
  for name in next, names do list[#list + 1] = tostring(name) end
  for name in next, _G do
    if type(name) == "string" and not at_start[name] and names[name] == nil then list[#list + 1] = name end
  end
  table.sort(list)
  return list
end

--- A top-level local, or `ans`.
function session.keep(name, value)
  rawset(names, name, value)
  declared[name] = true
end

-- Functions that compiled inputs call.
local helpers = {}

setmetatable(names, {
  __index = function(_, name)
    if helpers[name] then return helpers[name] end
    local value, found = session.lookup(name)
    if found then return value end
    error(string.format("%svariable '%s' is not defined%s", core.where(), tostring(name),
      type(name) == "string" and core.did_you_mean(name, session.names()) or ""), 0)
  end,
})
session.globals = names

-- Compiling -------------------------------------------------------------------------------------------------------------

local inputs = 0

--- Prompts of a transcript that was pasted are taken off.
local function without_prompts(text)
  if not text:match "^>>? " then return text end
  local lines = {}
  for line in (text .. "\n"):gmatch "(.-)\n" do
    if line:match "^>>? " then lines[#lines + 1] = line:gsub("^>>? ", "", 1) end
  end
  return table.concat(lines, "\n")
end

local help_words = { ["??"] = "search", ["?"] = "help" }

--- `?x` and `??words`, with any blanks: the operation of the help and its word.
local function help_of(text)
  local mark, word = text:match "^%s*(%?%??)%s*(.-)%s*$"
  if not mark then mark, word = "?", text:match "^%s*([%a_][%w_.:]*)%s*%?%s*$" end
  if not word and text:match "^%s*help%s*$" then word = "" end
  if not word then return nil end
  return help_words[mark], word
end

local function is_incomplete(message) return message:find("near '<eof>'", -12, true) ~= nil end

--- Compiles; `until = 50`, which Lua refuses in a table, is read as ["until"] = 50.
local function load_text(text, name)
  local fn, message = load(text, "=" .. name, "t", names)
  if fn or not message:find("near 'until'", 1, true) then return fn, message end
  local again = load((text:gsub("%f[%w_]until%s*=%f[^=]", '["until"] =')), "=" .. name, "t", names)
  return again, message
end

local function keep_list(list)
  for _, each in ipairs(list) do session.keep(each.name, each.value) end
end

--- Called at the end of an input, by it: takes its locals.
local function keep_locals()
  local list = {}
  for i = 1, 250 do
    local name, value = debug.getlocal(2, i)
    if not name then break end
    if name:match "^[%a_][%w_]*$" then list[#list + 1] = { name = name, value = value } end
  end
  keep_list(list)
end

helpers.__keep_locals = keep_locals
function helpers.__values(...) return ... end

--- Compiles as an expression, else as statements that keep their locals. Returns the function and whether it is an expression; or
-- nil and the message, or "more" if the text goes on.
local function compile(text, name)
  -- Not a tail call: the input stays on the stack, and errors can name its line.
  if load_text("return " .. text, name) then
    local close = text:find("--", 1, true) and "\n)" or ")"
    return load_text("return __values(" .. text .. close, name), true
  end
  local plain, message = load_text(text, name)
  if not plain then return nil, is_incomplete(message) and "more" or message end
  return load_text(text .. "\n" .. "__keep_locals()", name) or plain, false
end

-- Turns -----------------------------------------------------------------------------------------------------------------

local function errors() return require "tunica.prompt.errors" end

local function complain(message)
  io.stdout:flush()
  io.stderr:write(table.concat(errors().describe(message), "\n"), "\n")
end

local function show(results, count)
  local values = require "tunica.prompt.values"
  for i = 1, count do
    local ok, text = pcall(values.show, results[i])
    io.write(ok and text or "a " .. type(results[i]), "\n")
  end
end

local function pack(...) return select("#", ...), { ... } end

--- Runs a compiled input. True if no error came out of it.
local function run(fn, name, shown, is_expression)
  errors().forget()
  errors().keep = function(source, list)
    if source == "=" .. name then keep_list(list) end
  end
  local count, results = pack(xpcall(fn, errors().note))
  errors().keep = nil
  if not results[1] then
    if core.cancelled() then io.stderr:write("interrupted\n") else complain(results[2]) end
    return false
  end
  if is_expression and count > 1 then
    local values = { select(2, unpack(results, 1, count)) }
    if values[1] ~= nil then session.keep("ans", values[1]) end
    if shown then show(values, count - 1) end
  end
  return true
end

local function turn_help(operation, word)
  session.commands()  -- their help comes with them
  local found, help = pcall(require, "tunica.prompt.help")
  if not found then
    complain(help)
    return false
  end
  local fn = help[operation] or help.help
  return run(function()
    if word == "" then fn() else fn(word) end
  end, "help")
end

-- Variables in rules ------------------------------------------------------------------------------------------------------

local function is_plain(value)
  local kind = type(value)
  return kind == "number" or kind == "string" or kind == "boolean"
end

local known_values = {}

--- Whether a plain variable of the prompt has another value than when this was asked last.
local function changed_variables()
  local changed = false
  for name, value in next, names do
    if name ~= "ans" and is_plain(value) and known_values[name] ~= value then
      known_values[name], changed = value, true
    end
  end
  return changed
end

local function has_typed_rule(my)
  for _, r in ipairs(my.rules) do
    if getfenv(r.fn) == names then return true end
  end
end

--- Rules that were typed here may read variables of the prompt, which were traced as constants: once one has changed, such rules
-- are traced again at the next step.
function session.settle_variables()
  if not changed_variables() then return end
  for _, kind in ipairs { "model", "phyllotaxis" } do
    local module = package.loaded["tunica." .. kind]
    for _, my in next, module and module.inside or {} do
      if my.held and has_typed_rule(my) then my.held, my.watch = "", nil end
    end
  end
end

-- Inputs ------------------------------------------------------------------------------------------------------------------

--- What someone may have meant who knows other prompts: a line to follow a message about what cannot be read; or nil.
local function hint_of(text)
  local word, rest = text:match "^%s*([%a_][%w_]*)%s+(%S.-)%s*$"
  if word and not rest:find "[=({]" and type((session.lookup(word))) == "function" then
    local given = rest:match "^[%w_./-]*$" and not tonumber(rest) and string.format(' "%s"', rest) or "(" .. rest .. ")"
    return string.format("  what a function is given stands in brackets, or as text in quotes: %s%s", word, given)
  end
  if text:match "^%s*[!;]%s*%a" then
    return string.format("  commands of the system: os.execute %q", (text:match "^%s*[!;]%s*(.-)%s*$"))
  end
  if text:match "^%s*%%%a" then return "  help() lists what can be typed" end
end

local told = {}

local function is_parameters(value) return require("tunica.prompt.values").kind(value) == "parameters" end

--- `D = 2` where a parameter has that name makes a variable of the prompt, which the model does not see: said once.
local function tell_variable(text)
  local name = text:match "^%s*([%a_][%w_]*)%s*=[^=]"
  local P = name and not told[name] and rawget(names, "P")
  if not P or not is_parameters(P) then return end
  for key in pairs(P) do
    if key == name then
      told[name] = true
      print(screen.fold(string.format("%s is a variable of yours now; the model's parameter is P.%s", name, name)))
    end
  end
end

local leaving = false

--- quit(): leaves at the end of this input.
function session.leave() leaving = true end

local words_to_leave = { quit = true, exit = true }

--- Before each prompt: what watches files looks at them.
function session.look()
  local desk = package.loaded["tunica.prompt.desk"]
  if desk then desk.look() end
end

--- The model that a script returned, before the prompt came.
function session.take(model, name)
  session.commands()
  local desk = require "tunica.prompt.desk"
  if not desk.inside(model) then  -- something that a script made to be run like a model
    names.model = model
    return
  end
  local source = { name = name, files = {}, overrides = {}, built = {} }
  for i, file in ipairs(core.sources()) do source.files[i] = { path = file.path, text = file.text } end
  for key, value in pairs(core.overrides()) do source.overrides[key] = value end
  source.path = source.files[1] and source.files[1].path
  if not model.name then model.name = name end
  desk.take(model, source.path and source.path ~= "-" and source or nil)
end

--- Takes an input: "more" if it goes on in the next line, else "done" or "failed". `last`: there is no next line.
function session.turn(text, last)
  text = without_prompts(text)
  local operation, word = help_of(text)
  if operation then return turn_help(operation, word) and "done" or "failed" end
  local only_word = text:match "^%s*(%a+)%s*$"
  if only_word and words_to_leave[only_word] and rawget(names, only_word) == nil then return "leave" end
  local name = string.format("[%d]", inputs + 1)
  local bare, hides = text:gsub(";%s*$", "", 1)
  errors().typed[name] = text
  local fn, kind = compile(bare, name)
  if not fn and kind == "more" and not last then return "more" end
  inputs = inputs + 1
  if not fn then
    complain(kind == "more" and select(2, load(text, "=" .. name)) or kind)
    local hint = hint_of(text)
    if hint then io.stderr:write(screen.fold(hint), "\n") end
    return "failed"
  end
  session.commands()
  local desk = package.loaded["tunica.prompt.desk"]
  if desk then desk.begin_line(text) end
  local ok = run(fn, name, hides == 0, kind)
  if desk then desk.end_line(ok) end
  session.settle_variables()
  if ok then tell_variable(text) end
  return leaving and "leave" or ok and "done" or "failed"
end

--- Runs the user's init file. What is wrong with it is said; the prompt starts all the same.
function session.init(path)
  local read, text = pcall(core.read_file, path)
  if not read then return false end
  local fn, message = load(text, "@" .. path, "t", names)
  if not fn then
    complain(message)
    return false
  end
  return run(fn, path)
end

--- To be called once, when the prompt comes: from then on the place is noted at which an error is first raised. `private`: what
-- is typed is not to be kept anywhere.
function session.start(private)
  screen.private = private
  local function note(message) return errors().note(message) end
  core.note_errors(note)
  -- The library catches errors to put its state in order, and raises them again: what the stack said would be lost.
  function _G.pcall(f, ...) return xpcall(f, note, ...) end
end

return session
