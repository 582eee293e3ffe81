-- SPDX-License-Identifier: MIT
--- Files and table of `tunica stability`: the runs that were tried, and the limits found.

local core = require "tunica.core"
local study = require "tunica.chart.study"

local trials = {}

local header = "method,setting of,setting,bounded,pattern,what is wrong"

local function key(method, by, setting) return string.format("%s %s %s", method, by, core.shortest(setting)) end
local function plain(text) return ((text or ""):gsub('[,"%c]', ";")) end

--- The trials of a file; none if there is no file.
function trials.read(path)
  local self = { path = path, lines = { header }, by_key = {} }
  if not core.kind_of(path) then return self end
  for line in core.read_file(path):gmatch "([^\n]+)" do
    local method, by, setting, bounded, kept, why = line:match "^([^,]*),([^,]*),([^,]*),([01]),([01]),([^,]*)$"
    setting = tonumber(setting)
    if setting then
      self.lines[#self.lines + 1] = line
      self.by_key[key(method, by, setting)] = { bounded = bounded == "1", pattern = kept == "1", why = why ~= "" and why or nil }
    end
  end
  return self
end

function trials.find(self, method, by, setting) return self.by_key[key(method, by, setting)] end

--- Adds a trial, also to the file.
function trials.add(self, t)
  self.by_key[key(t.method, t.by, t.setting)] = t
  self.lines[#self.lines + 1] = table.concat({ t.method, t.by, core.shortest(t.setting), t.bounded and 1 or 0, t.pattern and 1 or 0,
    plain(t.why) }, ",")
  core.write_atomic(self.path, table.concat(self.lines, "\n") .. "\n")
end

local function value_text(limit)
  if not limit then return "" end
  if not limit.value then return "none" end
  return (limit.open and ">= " or "") .. study.short(limit.value)
end

--- The limits as a file: an empty place where a limit has no meaning or was not found.
function trials.write_results(self)
  local lines = { "method,setting of,largest bounded,at least,beyond it,largest that keeps the pattern,at least,beyond it,2/rho or 2.785/rho" }
  for _, r in ipairs(self.results) do
    local fields = { r.label, r.by }
    for _, limit in ipairs { r.bounded or {}, r.pattern } do
      fields[#fields + 1] = limit.value and core.shortest(limit.value) or ""
      fields[#fields + 1] = limit.open and 1 or ""
      fields[#fields + 1] = plain(limit.why)
    end
    fields[#fields + 1] = r.theory and core.shortest(r.theory) or ""
    lines[#lines + 1] = table.concat(fields, ",")
  end
  core.write_atomic(self.folder .. "/stability.csv", table.concat(lines, "\n") .. "\n")
end

--- The table on standard output: first the steps, then the tolerances.
function trials.table(self)
  local text = {}
  for _, by in ipairs { "dt", "tolerance" } do
    local fixed = by == "dt"
    local lines = { fixed and { "method", "bounded", "theory", "beyond", "keeps the pattern", "beyond" } or
      { "method", "keeps the pattern", "beyond" } }
    for _, r in ipairs(self.results) do
      if r.by == by then
        lines[#lines + 1] = fixed and { r.label, value_text(r.bounded), r.theory and study.short(r.theory) or "", r.bounded.why or "",
          value_text(r.pattern), r.pattern.why or "" } or { r.label, value_text(r.pattern), r.pattern.why or "" }
      end
    end
    if #lines > 1 then
      text[#text + 1] = fixed and "Largest dt, to 1 %\n" or "Loosest tolerance, to a factor of 2\n"
      text[#text + 1] = study.columns(lines, fixed and { false, true, true, false, true, false } or { false, true, false }) .. "\n"
    end
  end
  return table.concat(text)
end

return trials
