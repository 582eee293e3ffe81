-- SPDX-License-Identifier: MIT
--- One value of a sweep's runs against another: in a file, or in characters.

local screen = require "tunica.prompt.screen"

--- Whether the terminal's characters are UTF-8, as its locale says.
local function has_unicode()
  for _, name in ipairs { "LC_ALL", "LC_CTYPE", "LANG" } do
    local value = os.getenv(name)
    if value and value ~= "" then return value:lower():find "utf%-?8" ~= nil end
  end
  return false
end

--- Draws given.x against given.y into given.file, and returns its path; without a file returns the plot as text.
return function(given)
  if given.file then return require("tunica").plot(given) end
  screen.unicode = has_unicode()
  local title = string.format("%s: %s against %s", given.title, given.ylabel, given.xlabel)
  return require "tunica.prompt.plot"({ { x = given.x, y = given.y } }, { title = title })
end
