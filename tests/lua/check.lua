-- SPDX-License-Identifier: MIT
--- What the tests in this folder share.

local check = {}

--- Fails unless the values are equal.
function check.equal(came, expected, what)
  if came ~= expected then
    error(string.format("%s: expected %s, came %s", what or "values", tostring(expected), tostring(came)), 2)
  end
end

--- Fails unless two numbers differ by at most `tolerance`.
function check.near(came, expected, tolerance, what)
  if not (math.abs(came - expected) <= tolerance) then
    error(string.format("%s: expected %.17g within %g, came %.17g", what or "numbers", expected, tolerance, came), 2)
  end
end

--- Calls f, which must fail on its own first line with a message that holds every one of the texts.
function check.fails(f, ...)
  local ok, message = pcall(f)
  if ok then error("an error was expected: " .. table.concat({ ... }, ", "), 2) end
  if type(message) ~= "string" then error("the error is not text: " .. tostring(message), 2) end
  for _, text in ipairs { ... } do
    if not message:find(text, 1, true) then error(string.format("expected '%s' in: %s", text, message), 2) end
  end
  local info = debug.getinfo(f, "S")
  local line = tonumber(message:match(":(%d+): "))
  if not (line and line >= info.linedefined and line <= info.lastlinedefined) then
    error("the error does not point at the line that made it: " .. message, 2)
  end
  return message
end

--- Fails unless the tissue keeps every invariant.
function check.valid(tissue)
  local ok, problems = tissue:validate()
  if not ok then error(table.concat(problems, "\n"), 2) end
end

return check
