-- SPDX-License-Identifier: MIT
--- Tables as text: values separated by commas, semicolons or tabs, quoted where they hold one of these (RFC 4180).

local fail = require("tunica.registry").fail

local csv = {}

local most = 64 * 1024 * 1024  -- bytes

local function content(path)
  local file, problem = io.open(path, "rb")
  if not file then fail("cannot read %s", problem) end
  local text, why = file:read(most + 1)
  local size = file:seek "end"
  file:close()
  if why then fail("cannot read %s: %s", path, why) end
  text = text or ""
  if #text > most then fail("%s is too large: %.0f MB; at most %.0f are read", path, (size or #text) / 2 ^ 20, most / 2 ^ 20) end
  if text:find "%z" then fail("%s is no text: it holds a zero byte", path) end
  return (text:gsub("^\239\187\191", ""))
end

--- The mark that separates values: the first of comma, semicolon and tab in the first line outside quotes.
local function separator_of(text) return (text:match "^[^\r\n]*" or ""):gsub('"[^"]*"', ""):match "[,;\t]" or "," end

--- One value from `at`: itself, and where the mark behind it is; counts lines within quotes.
local function field(path, text, at, separator, line)
  if text:sub(at, at) ~= '"' then
    local stop = text:find("[" .. separator .. "\r\n]", at) or #text + 1
    return text:sub(at, stop - 1), stop, line
  end
  local parts, from, first = {}, at + 1, line
  while true do
    local quote = text:find('"', from, true)
    if not quote then fail("%s:%d: a quoted value does not end", path, first) end
    parts[#parts + 1] = text:sub(from, quote - 1)
    if text:sub(quote + 1, quote + 1) ~= '"' then
      local value = table.concat(parts)
      local stop = quote + 1
      if stop <= #text and not text:find("^[" .. separator .. "\r\n]", stop) then
        fail("%s:%d: text follows a quoted value", path, first)
      end
      local _, breaks = value:gsub("\n", "")
      return value, stop, line + breaks
    end
    parts[#parts + 1] = '"'
    from = quote + 2
  end
end

--- read(path) -> list of { line = number in the file, fields = { text ... } }; empty lines are left out. Errors: not to be read;
-- a record that has more or fewer values than the first.
function csv.read(path)
  local text = content(path)
  local separator, records, at, line = separator_of(text), {}, 1, 1
  while at <= #text do
    local record, stop = { line = line, fields = {} }, nil
    repeat
      record.fields[#record.fields + 1], stop, line = field(path, text, at, separator, line)
      at = stop + 1
    until text:sub(stop, stop) ~= separator
    if text:sub(stop, stop + 1) == "\r\n" then at = at + 1 end
    line = line + 1
    local empty = #record.fields == 1 and record.fields[1]:match "^%s*$"
    if not empty then
      if records[1] and #record.fields ~= #records[1].fields then
        fail("%s:%d: %d values, but the first line has %d", path, record.line, #record.fields, #records[1].fields)
      end
      records[#records + 1] = record
    end
  end
  return records
end

return csv
