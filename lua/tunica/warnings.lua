-- SPDX-License-Identifier: MIT
--- What is legal but may not be meant: said once for each place in the script, and listed in run.json.

local registry = require "tunica.registry"

local warnings = { list = {} }
local said = {}

--- Breaks lines for who reads along; the prompt replaces it.
function warnings.fold(text) return text end

--- Writes a line on standard error.
function warnings.write(text) io.stderr:write(warnings.fold("tunica: " .. text), "\n") end

--- Says it with the line of the user's own code, unless the same was said for that line with other figures.
function warnings.say(format, ...)
  local where = registry.where()
  if said[where .. format] then return end
  said[where .. format] = true
  local text = (where == "" and "" or where .. ": ") .. string.format(format, ...)
  warnings.list[#warnings.list + 1] = text
  warnings.write("warning: " .. text)
end

return warnings
