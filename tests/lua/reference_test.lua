-- SPDX-License-Identifier: MIT
-- The reference page and the declarations for editors are what the registry and the models say: scripts/reference writes them.
local core = require "tunica.core"
local registry = require "tunica.registry"
local reference = require "tunica.prompt.reference"
local stubs = require "tunica.prompt.stubs"

local function up_to_date(path, text)
  local there, old = pcall(core.read_file, path)
  if there and old == text then return end
  local line = 1
  for a, b in (old or ""):gmatch "()([^\n]*)\n" do
    if text:sub(a, a + #b - 1) ~= b then break end
    line = line + 1
  end
  error(string.format("%s is not up to date (from line %d on): run scripts/reference", path, line), 0)
end

up_to_date(core.shared_folder "doc" .. "/reference.md", reference.text())
up_to_date(core.shared_folder "stubs" .. "/tunica.lua", stubs.text())

-- The same text at each call; nothing of this machine in it; every operation is there; declarations are Lua.
local text, declarations = reference.text(), stubs.text()
assert(text == reference.text() and declarations == stubs.text())
assert(not (text .. declarations):find(core.shared_folder "doc", 1, true))
for _, entry in ipairs(registry.all()) do
  assert(text:find("### `" .. entry.title, 1, true), entry.name)
  if entry.owner ~= "prompt" then
    local declared = entry.kind == "property" and "---@field " .. entry.member or
      "function " .. entry.name
    assert(declarations:find(declared, 1, true), entry.name)
  end
end
-- Every result has a type: `returns` of an entry is among the words that stubs.lua knows.
for line in declarations:gmatch "[^\n]+" do
  assert(not line:find("---@return any", 1, true) and not line:match "^%-%-%-@field [%w_]+ any ", line)
end
assert(loadstring(declarations))
assert(#stubs.left_out() == 0, table.concat(stubs.left_out(), ", "))
