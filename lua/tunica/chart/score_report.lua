-- SPDX-License-Identifier: MIT
--- What a chart of a score says: its table, how runs failed, which setting to take; chart.csv and chart.json.

local core = require "tunica.core"
local study = require "tunica.chart.study"
local rows = require "tunica.chart.rows"
local sample = require "tunica.chart.sample"

local report = {}

local short = study.short

--- "rkc2 tolerance 0.01, step 0.1": a setting in words.
function report.label(row)
  local text = string.format("%s %s %s", row.method, row.by, core.shortest(row.setting))
  for _, p in ipairs(row.listed) do text = string.format("%s, %s %s", text, p.name, p.text) end
  return text
end

--- What matters of a failure's message: without what to try, which the table says better.
function report.brief(why)
  local limit = why:match "above this method's limit of about ([%d.e+-]+)"
  local text = why:gsub(" %(method [^)]*%)", ""):gsub(": a concentration cannot be.*", ""):gsub(" Look at its rule.*", "")
    :gsub("; try a smaller dt.*", ""):gsub(": its iterations.*", ""):gsub("%.$", "")
  return limit and string.format("%s; dt is at most %s there", text, limit) or text
end

--- Rows that have runs: combinations in their order, methods in the kernel's, coarse settings first.
local function sorted(self)
  local rank, list = {}, {}
  for i, way in ipairs(core.methods_of_solution()) do rank[way.name] = i end
  for _, row in ipairs(self.rows) do
    if #row.runs > 0 then list[#list + 1] = row end
  end
  table.sort(list, function(a, b)
    if a.combination ~= b.combination then return a.combination < b.combination end
    if a.method ~= b.method then return rank[a.method] < rank[b.method] end
    if a.by ~= b.by then return a.by < b.by end
    return a.setting > b.setting
  end)
  return list
end

-- Which to take ----------------------------------------------------------------------------------------------------

--- The cheapest row that keeps the score; of one method, if named. Within a method and combination evaluations tell which is
-- cheaper, since seconds are disturbed by whatever else runs; between them seconds.
local function cheapest(self, method)
  local least, best = {}, nil
  for _, row in ipairs(self.rows) do
    local key = string.format("%s %d", row.method, row.combination)
    local other = least[key]
    if row.keeps and (not other or row.evaluations < other.evaluations) then least[key] = row end
  end
  for _, row in ipairs(self.rows) do
    local found = least[string.format("%s %d", row.method, row.combination)] == row and (not method or row.method == method)
    if found and (not best or row.seconds < best.seconds) then best = row end
  end
  return best
end

--- How many seeds it takes until twice the error of a paired difference is what matters.
local function seeds_for(row, difference)
  return math.ceil(row.pairs * (2 * row.difference_error / difference) ^ 2)
end

--- How small a difference these seeds show; in words.
local function power_of(self, row)
  local seen, wanted = 2 * row.difference_error, self.options.error
  if seen == 0 then return "On every seed it gives the same score as the finest." end
  local text = string.format("A difference of %s or more would have shown with these %d seeds", short(seen), row.pairs)
  if seen <= wanted then return text .. "." end
  return string.format("%s; that is too few to tell one of %s: some %d are needed.", text, short(wanted), seeds_for(row, wanted))
end

local function spread(mean, error) return string.format("%s +- %s", short(mean), short(error)) end

--- Which setting to take, in words and for the record.
function report.recommend(self)
  local reference = self.reference and self.reference.row
  local best = reference and cheapest(self)
  if not best then return "No setting is recommended: there is no finest one to hold others against.\n" end
  local lines = { string.format("Cheapest that keeps %s: %s, %s s a run: %s.", self.options.score, report.label(best),
    short(best.seconds), spread(best.mean, best.error)) }
  if best == reference then
    local others = 0
    for _, row in ipairs(self.rows) do others = others + (row.keeps and row ~= best and 1 or 0) end
    lines[2] = others > 0 and "That is the finest setting itself: coarser ones cost no less."
      or "That is the finest setting itself: every coarser one fails somewhere or differs."
  else
    lines[1] = lines[1] .. string.format(" The finest, %s: %s s, %s; difference %s.", report.label(reference),
      short(reference.seconds), spread(reference.mean, reference.error), spread(best.difference, best.difference_error))
    lines[2] = power_of(self, best)
  end
  local others = {}
  for _, way in ipairs(self.methods) do
    local own = cheapest(self, way.name)
    if own and own ~= best and own.method ~= best.method then
      others[#others + 1] = string.format("%s, %s s", report.label(own), short(own.seconds))
    end
  end
  if #others > 0 then lines[#lines + 1] = "Of the other methods: " .. table.concat(others, "; ") .. "." end
  return table.concat(lines, "\n") .. "\n", { setting = report.label(best), method = best.method, [best.by] = best.setting,
    seconds = best.seconds, mean = best.mean, difference = best.difference, difference_error = best.difference_error,
    seeds_needed = best ~= reference and best.difference_error > 0 and seeds_for(best, self.options.error) or nil }
end

-- The table --------------------------------------------------------------------------------------------------------

local function mark_of(self, row)
  if self.best == row then return "*" end
  return row.differs and "!" or ""
end

local function table_text(self)
  local head = { "", "method", "setting" }
  for _, p in ipairs(self.rows[1].listed) do head[#head + 1] = p.name end
  for _, name in ipairs { "seconds", "evaluations", "score", "+-", "difference", "+-", "failed" } do head[#head + 1] = name end
  local lines, right = { head }, {}
  for i = 4, #head do right[i] = true end
  for _, row in ipairs(sorted(self)) do
    local by = row.by == "dt" and "dt" or "tol"
    local line = { mark_of(self, row), row.method, string.format("%s %s", by, core.shortest(row.setting)) }
    for _, p in ipairs(row.listed) do line[#line + 1] = p.text end
    local held = row.pairs and row.pairs > 0
    local finest = self.reference and self.reference.row == row
    for _, text in ipairs { short(row.seconds), row.evaluations and string.format("%.0f", row.evaluations) or "-",
      short(row.mean), short(row.error), finest and "finest" or held and short(row.difference) or "-",
      held and not finest and short(row.difference_error) or "-",
      #row.failures > 0 and string.format("%d of %d", #row.failures, #row.runs) or #row.runs < #self.options.seeds
        and string.format("(%d runs)", #row.runs) or "" } do line[#line + 1] = text end
    lines[#lines + 1] = line
  end
  return study.columns(lines, right) ..
    "* recommended   ! differs from the finest: by more than twice the error of the difference, and perhaps by what matters\n"
end

--- The times at which runs failed: "t = 3.6", "t = 3.6 to 20".
local function times_of(failures)
  local first, last = math.huge, -math.huge
  for _, f in ipairs(failures) do
    if f.time then first, last = math.min(first, f.time), math.max(last, f.time) end
  end
  if first > last then return "" end
  return first == last and ", t = " .. short(first) or string.format(", t = %s to %s", short(first), short(last))
end

--- Failures by how they came about, the most first; in each the earliest first.
function report.kinds(row)
  local by_how, kinds = {}, {}
  for _, f in ipairs(row.failures) do
    if not by_how[f.how] then
      by_how[f.how] = { how = f.how }
      kinds[#kinds + 1] = by_how[f.how]
    end
    table.insert(by_how[f.how], f)
  end
  for _, kind in ipairs(kinds) do
    table.sort(kind, function(a, b)
      if a.time ~= b.time then return (a.time or math.huge) < (b.time or math.huge) end
      return a.seed < b.seed
    end)
  end
  table.sort(kinds, function(a, b)
    if #a ~= #b then return #a > #b end
    return a.how < b.how
  end)
  return kinds
end

--- How the runs of each setting failed, of each kind the earliest in full.
local function failures_text(self)
  local lines = {}
  for _, row in ipairs(sorted(self)) do
    for _, kind in ipairs(report.kinds(row)) do
      lines[#lines + 1] = string.format("  %s: %d of %d %s%s; seed %d: %s", report.label(row), #kind, #row.runs, kind.how,
        times_of(kind), kind[1].seed, report.brief(kind[1].why))
    end
  end
  if #lines == 0 then return "" end
  return "How runs failed: what makes nothing more after that has no pattern\n" .. table.concat(lines, "\n") .. "\n"
end

-- Files ------------------------------------------------------------------------------------------------------------

local header = "method,setting of,setting,parameters,seeds,score,standard error,difference,standard error of it,differs," ..
  "failed,CPU seconds,of them solving,evaluations,first failure"

local function write_csv(self)
  local lines = { header }
  for _, row in ipairs(sorted(self)) do
    local listed = {}
    for i, p in ipairs(row.listed) do listed[i] = p.name .. "=" .. p.text end
    local fields = { row.method, row.by, row.setting, table.concat(listed, " "), #row.runs, row.mean or "", row.error or "",
      row.difference or "", row.difference_error or "", row.differs and 1 or "", #row.failures, row.seconds or "",
      row.solver_seconds or "", row.evaluations or "", row.failures[1] and row.failures[1].why or "" }
    for i, value in ipairs(fields) do
      fields[i] = type(value) == "number" and core.shortest(value) or (tostring(value):gsub('[,"%c]', ";"))
    end
    lines[#lines + 1] = table.concat(fields, ",")
  end
  core.write_atomic(self.folder .. "/chart.csv", table.concat(lines, "\n") .. "\n")
end

--- Files, picture and what is printed, of the runs that are there.
function report.conclude(self)
  if self.reference then
    for _, row in ipairs(self.rows) do sample.judge(self, row, self.reference) end
  end
  self.best = self.reference and cheapest(self)
  write_csv(self)
  local text, found = report.recommend(self)
  self.record.recommended, self.record.complete = found, self.complete or false
  study.write_record(self)
  local drawn, why = require("tunica.chart.score_picture").draw(self, sorted(self))
  local picture = drawn and self.complete and core.terminal_picture(core.read_file(self.folder .. "/chart.png"))
  if picture then study.print(self, picture) end
  study.print(self, table_text(self) .. failures_text(self) .. text)
  if not drawn then study.note(self, "no pictures: %s", why) end
  study.print(self, "directory  " .. self.folder .. "\n")
end

return report
