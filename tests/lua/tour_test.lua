-- SPDX-License-Identifier: MIT
-- Every line of the tour runs as it stands there, in an empty folder. Needs the prompt.
local core = require "tunica.core"
local found, session = pcall(require, "tunica.prompt.session")
if not found then return print "skipped: this program has no prompt yet" end

local folder = os.tmpname()
os.remove(folder)
core.mkdir(folder)

--- Files are named by the tour as if one were in the folder.
local function in_folder(line)
  return (line:gsub('"(mine%.lua)"', '"' .. folder .. '/%1"'):gsub('"(mine%.png)"', '"' .. folder ..
    '/%1"'):gsub('"(monday)"', '"' .. folder .. '/%1"')
    :gsub('"(typed%.lua)"', '"' .. folder .. '/%1"'))
end

local write, typed = io.write, 0
local print_before = print
io.write, print = function() end, function() end -- luacheck: ignore
local function finish(message)
  io.write, print = write, print_before -- luacheck: ignore
  core.remove_all(folder)
  if message then error(message, 0) end
end

local function run(line)
  local outcome = session.turn(in_folder(line), true)
  typed = typed + 1
  if outcome ~= "done" and not (outcome == "leave" and line == "quit()") then finish("the tour's line fails: " .. line) end
  session.look()
end

local path = folder .. "/mine.lua"
for head, block in core.read_file(core.shared_folder "doc" .. "/tour.md"):gmatch "```lua([^\n]*)\n(.-)```" do
  if head:match "file=" then
    core.write_atomic(path, block)
  elseif head:match "insert=" then
    core.write_atomic(path, (core.read_file(path):gsub("\nreturn model", function() return "\n" .. block ..
      "\nreturn model" end)))
  else
    for line in block:gmatch "[^\n]+" do run(line) end
  end
end
if not core.kind_of(folder .. "/mine.png") then finish "no picture" end
if typed < 40 then finish("only " .. typed .. " lines") end
finish()
