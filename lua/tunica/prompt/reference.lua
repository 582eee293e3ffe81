-- SPDX-License-Identifier: MIT
--- The reference page (share/doc/reference.md), from the registry and the headers of the shipped models.

local core = require "tunica.core"
local pages = require "tunica.prompt.pages"
local script = require "tunica.prompt.script"
require "tunica.prompt.names"()

local reference = {}

local head = [[
# Reference

Every operation, and every shipped model with its parameters. Written by `scripts/reference` from the registry of operations and
the heads of the models; the same text is at the prompt: `help "tissue:divide"`, `search "divide"`.

Named arguments are given as a table, `tissue:divide { above = 1 }`; those without `=` also by their place, as in
`tunica.ring { 50 }`. What is in brackets may be left out.
]]

local function cell(text) return (text:gsub("|", "\\|"):gsub("\n", " ")) end

local function operation(entry)
  local out = { "### `" .. pages.signature(entry) .. "`\n", entry.doc }
  if entry.returns then out[#out + 1] = "\nGives " .. entry.returns .. "." end
  if #entry.args > 0 or entry.rest then
    out[#out + 1] = "\n| argument | | may be |\n|---|---|---|"
    for _, spec in ipairs(entry.args) do
      out[#out + 1] = string.format("| `%s` | %s | %s |", spec.name, cell(spec.doc), cell(pages.expected(spec)))
    end
    for _, spec in ipairs(entry.options or {}) do
      out[#out + 1] = string.format("| `%s =` | %s | %s |", spec.name, cell(spec.doc), cell(pages.expected(spec)))
    end
    if entry.rest then
      out[#out + 1] = string.format("| name = value | %s | %s |", cell(entry.rest.doc or "any other names"),
        cell(pages.expected(entry.rest)))
    end
  end
  if entry.source then out[#out + 1] = "\nSource: " .. entry.source .. "." end
  if entry.example then out[#out + 1] = "\n```lua\n" .. entry.example:gsub("%s+$", "") .. "\n```" end
  return table.concat(out, "\n")
end

local function model(m)
  local out = { "### `" .. m.name .. "`\n", m.about }
  for _, section in ipairs(script.header(core.read_file(m.path)).sections) do
    out[#out + 1] = string.format("\n*%s* %s", section.title:sub(1, 1) .. section.title:sub(2):lower() .. ".", section.text)
  end
  local list = script.parameters(m.path)
  if #list > 0 then out[#out + 1] = "\n| parameter | |\n|---|---|" end
  for _, p in ipairs(list) do out[#out + 1] = string.format("| `%s` | %s |", p.name, cell(pages.parameter(p))) end
  return table.concat(out, "\n")
end

--- The page as text.
function reference.text()
  local out = { head }
  for _, owner in ipairs(pages.owners) do
    out[#out + 1] = string.format("## %s\n\n%s.\n", owner[1], owner[2]:sub(1, 1):upper() .. owner[2]:sub(2))
    for _, entry in ipairs(pages.of_owner(owner[1])) do out[#out + 1] = operation(entry) .. "\n" end
  end
  out[#out + 1] = "## Methods of integration\n\n| method | |\n|---|---|"
  for _, way in ipairs(core.methods_of_solution()) do
    out[#out + 1] = string.format("| `%s` | %s; order %d%s |", way.name, way.title, way.order, way.adaptive and ", adaptive" or
      "")
  end
  out[#out + 1] = "\n## Shipped models\n"
  for _, m in ipairs(script.shipped()) do out[#out + 1] = model(m) .. "\n" end
  return table.concat(out, "\n")
end

return reference
