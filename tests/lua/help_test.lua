-- SPDX-License-Identifier: MIT
-- help and search: for every operation, option, model and parameter; at any width.
local core = require "tunica.core"
local registry = require "tunica.registry"
local desk = require "tunica.prompt.desk"
local pages = require "tunica.prompt.pages"
local script = require "tunica.prompt.script"
local names = require "tunica.prompt.names"
local check = require "check"

local said
desk.say = function(format, ...) said = said .. string.format(format, ...) .. "\n" end
local g = names()

local function asked(...)
  said = ""
  g.help(...)
  return said
end

local function says(text, ...)
  for _, expected in ipairs { ... } do
    if not text:find(expected, 1, true) then error(string.format("expected '%s' in: %s", expected, text), 2) end
  end
end

-- Every operation: with its arguments and its example.
local operations = 0
for _, entry in ipairs(registry.all()) do
  local text = asked(entry.title)
  says(text, entry.title, pages.wrap(entry.doc, "", ""))
  for _, spec in ipairs(entry.args) do says(text, spec.name, spec.unit or "") end
  if entry.example then says(text, "example:", entry.example:match "[^\n]+") end
  assert(#asked(entry.member) > 0)
  operations = operations + 1
end
assert(operations > 200)

-- Every option, shipped model and parameter, method and type.
for _, entry in ipairs(registry.all()) do
  for _, spec in ipairs(entry.args) do says(asked(spec.name), spec.name) end
end
for _, model in ipairs(script.shipped()) do
  local text = asked(model.name)
  says(text, model.about:match "^%S+", "what", "source")
  for _, p in ipairs(script.parameters(model.path)) do says(text, "  " .. p.name .. " ") end
  says(asked(model.name:match "[^/]+$"), model.name)
  assert(#script.parameters(model.path) > 0 or model.name:find "table", model.name)
end
says(asked "rkc2", "Runge-Kutta-Chebyshev")
says(asked "tissue", "tissue:divide", "tissue:count_peaks")
says(asked "models", "patterning/sheet")
says(asked(), 'load "ring"', "search")

-- Things themselves; parameters of the model at hand.
said = ""
g.load "ring"
says(asked "D", "P.D, a parameter of patterning/ring", "diffusion (1; 0 or more)")
g.P.D = 3
says(asked(g.P), "now 3")
says(asked(g.model), "Auxin peaks on a ring", "parameters:")
says(asked(g.tissue), "50 cells", "tissue:divide")
says(asked(g.tissue.divide), "tissue:divide")
says(asked(require("tunica").ring), "tunica.ring")
says(asked(g.tissue:find(3)), "cell 3", "cell:neighbours")
says(asked(5), "5")
says(asked(print), "no operation")
check.fails(function() g.help "tisue:divide" end, "did you mean 'tissue:divide'?")
check.fails(function() g.help "qwertz" end, 'search "qwertz"')
check.fails(function() g.help "" end, "nothing is called")

-- Search: all words must occur.
said = ""
g.search "parastichies"
says(said, "tunica.allowable_interval", "phyllotaxis/high_order")
said = ""
g.search "errera wall"
says(said, "tissue:divide")
assert(not said:find "tunica.plot", said)
said = ""
g.search "zyzzyva"
says(said, "no text holds")
check.fails(function() g.search "  " end, "which word")

-- No line is longer than a narrow terminal, words and examples aside.
local width = pages.width
for _, columns in ipairs { 30, 40, 80 } do
  pages.width = function() return columns end
  for _, name in ipairs { "models", "tissue", "phyllotaxis" } do
    for line in asked(name):gsub("example:.*", ""):gmatch "[^\n]+" do
      assert(#line <= columns or not line:match "%S%s+%S+%s+%S", line)
    end
  end
end
pages.width = width

-- Examples of the prompt's own operations run there; what they print is not of interest, pictures are taken away.
local pictures = {}
print = function(text) pictures[#pictures + 1] = tostring(text):match "^picture: (.*)" or tostring(text):match "^/%S+%.png$" end -- luacheck: ignore
local write = io.write
io.write = function() end -- luacheck: ignore
local folder = os.tmpname()
os.remove(folder)
for _, entry in ipairs(pages.of_owner "prompt") do
  assert(entry.doc:match "%.$", entry.name)
  for _, spec in ipairs(entry.args) do assert(spec.doc, entry.name) end
  local chunk = assert(loadstring(assert(entry.example, entry.name), "=example of " .. entry.name))
  setfenv(chunk, setmetatable({ print = function() end }, { __index = g, __newindex = g }))
  chunk()
end

-- Wrong arguments: an error with a text, never a crash; the model at hand stays.
local model = desk.model()
for _, entry in ipairs(pages.of_owner "prompt") do
  for _, value in ipairs { -1, 0 / 0, "", ("x"):rep(100000), {}, { {} }, { 0 / 0 }, function() end, g.model, g.tissue, "\0",
    "/", true } do
    if entry.member ~= "edit" and not (entry.member == "undo" or entry.member == "redo") then
      local ok, message = pcall(entry.call, value)
      assert(ok or type(message) == "string" and #message < 2000, entry.name)
    end
  end
end
assert(desk.model() == model)
for _, path in ipairs(pictures) do os.remove(path) end
io.write = write -- luacheck: ignore
assert(core.kind_of "/" == "folder")
