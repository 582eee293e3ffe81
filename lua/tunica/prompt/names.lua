-- SPDX-License-Identifier: MIT
--- Gives a table of globals the names that the prompt has: for the prompt itself, and for scripts that transcript wrote.

--- Every module of tunica.prompt that returns functions by name, in the order in which they are looked for.
local parts = { "help", "work" }

return function(globals)
  local tunica = require "tunica"
  require("tunica.prompt.desk").globals = globals
  for _, part in ipairs(parts) do
    for name, fn in pairs(require("tunica.prompt." .. part)) do rawset(globals, name, fn) end
  end
  rawset(globals, "tunica", tunica)
  return globals
end
