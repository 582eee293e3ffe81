-- SPDX-License-Identifier: MIT
--- What the prompt may write: width, colours, characters beyond ASCII. The program says so at its start; the values here hold
-- where there is no terminal. `folds`: somebody reads along, on however plain a terminal; `terminal`: it can also take a line back.

local screen = { folds = false, terminal = false, colour = false, unicode = false }

--- Columns of the terminal now; the program replaces it.
function screen.width() return 80 end

local codes = { red = "1;31", dim = "2", bold = "1", green = "32", yellow = "33", cyan = "36" }

function screen.paint(colour, text)
  if not screen.colour then return text end
  return "\27[" .. codes[colour] .. "m" .. text .. "\27[0m"
end

--- Number of characters; every character counts as one column.
function screen.length(text) return select(2, text:gsub("[^\128-\191]", "")) end

--- The text cut to `width` characters, with an ellipsis if something is missing.
function screen.cut(text, width)
  if #text <= width or screen.length(text) <= width then return text end
  local mark = screen.unicode and "…" or "..."
  local keep, at = math.max(0, width - screen.length(mark)), 1
  for _ = 1, keep do
    at = text:find("[^\128-\191]", at + 1) or #text + 1
  end
  return text:sub(1, at - 1) .. mark
end

--- The text in lines of at most `width` characters, broken at spaces; the lines after the first begin with `indent`.
function screen.wrap(text, width, indent)
  indent = indent or ""
  local lines, line = {}, nil
  for word in text:gmatch "%S+" do
    if line and screen.length(line) + 1 + screen.length(word) > width then
      lines[#lines + 1] = line
      line = indent .. word
    else
      line = line and line .. " " .. word or word
    end
  end
  lines[#lines + 1] = line
  return table.concat(lines, "\n")
end

--- Text for the screen as it is now: lines that are wider are broken at spaces, and go on two columns further in, or after
-- `column` blanks, up to where they are taken as they are. Where there is no screen lines stay whole.
function screen.fold(text, column)
  local width = screen.width()
  if not screen.folds then return text end
  if column and column > width / 2 then column = nil end
  return (text:gsub("[^\n]+", function(line)
    if screen.length(line) <= width then return nil end
    local head = column and line:sub(1, column) or line:match "^ *"
    local body = head:gsub(" ", "\1") .. line:sub(#head + 1)  -- blanks that stay
    return (screen.wrap(body, width, (" "):rep(column or #head + 2)):gsub("\1", " "))
  end))
end

local named = { ["\n"] = "\\n", ["\t"] = "\\t", ["\r"] = "\\r" }

--- Text that cannot disturb a terminal: control characters as \n, \27.
function screen.printable(text)
  return (text:gsub("[%c\127]", function(c) return named[c] or "\\" .. c:byte() end))
end

return screen
