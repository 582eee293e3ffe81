-- SPDX-License-Identifier: MIT
--- The names that the prompt has, as the environment of a script: for what transcript wrote, for tests and the reference.

--- Modules whose functions have names at the prompt.
local parts = { "help", "work" }

--- A table with all of them, over Lua's globals; the prompt's own table where there is a prompt.
return function()
  local found, session = pcall(require, "tunica.prompt.session")
  if found then
    session.commands()
    return session.globals
  end
  local globals = setmetatable({ tunica = require "tunica" }, { __index = _G })
  for _, part in ipairs(parts) do
    for name, fn in pairs(require("tunica.prompt." .. part)) do globals[name] = fn end
  end
  require("tunica.prompt.desk").globals = globals
  return globals
end
