-- SPDX-License-Identifier: MIT
--- The runs of one setting on many seeds: their mean score, what of them failed, and how they differ from those of the finest
-- setting on the same seeds.

local core = require "tunica.core"
local faults = require "tunica.chart.faults"

local sample = {}

sample.no_score = "have no score"

--- Runs as the program tells them, of these seeds only, with their results decoded.
function sample.read(told, seeds)
  local by_seed, runs = {}, {}
  for _, run in ipairs(told) do by_seed[run.seed] = run end
  for _, seed in ipairs(seeds) do
    local run = by_seed[seed]
    if run then
      if run.result ~= "" then
        run.course = core.decode(run.result).course
      end
      run.result = nil
      runs[#runs + 1] = run
    end
  end
  return runs
end

--- Whether all runs, two at least, ended in the same state with the same score.
function sample.alike(runs)
  for _, run in ipairs(runs) do
    if not run.course or run.course["end"] ~= runs[1].course["end"] or run.score ~= runs[1].score then return false end
  end
  return #runs > 1
end

--- Mean and standard error of numbers; nil of none, and no error of one.
function sample.mean(values)
  local n, sum, squares = #values, 0, 0
  if n == 0 then return nil end
  for _, value in ipairs(values) do sum = sum + value end
  local mean = sum / n
  for _, value in ipairs(values) do squares = squares + (value - mean) ^ 2 end
  return mean, n > 1 and math.sqrt(squares / (n - 1) / n) or nil
end

--- When a run that broke down did so, as its message says.
local function time_of(message) return tonumber(message:match " [at][to] time ([%d.e+-]+)") end

--- How runs fail, by the status of a sweep's row.
local ways = { time = "are out of time", memory = "are out of memory", crashed = "crash",
  killed = "are killed" }

--- Whether a numerical failure is of values that run away, and not of a method that finds no solution.
local function bursts(message)
  for _, word in ipairs { " became ", "negative", "finite", "turns round" } do
    if message:find(word, 1, true) then return true end
  end
  return false
end

--- Why a run does not count, when, and how it failed in few words; nil if it counts.
local function trouble(run, reference)
  if run.status ~= "done" then
    local how = run.status == "numerical" and (bursts(run.message) and "blow up" or "break down") or ways[run.status] or "fail"
    return run.message ~= "" and run.message or run.status, time_of(run.message), how
  end
  if not run.score then return run.why, nil, sample.no_score end
  if reference and run.course then
    local why, time, words = faults.of(reference.usual, run.course)
    return why, time, why and "run on, " .. words
  end
end

--- The median of what runs have cost: a few may have been disturbed.
local function cost_of(runs, name)
  local values = {}
  for i, run in ipairs(runs) do values[i] = run.course[name] end
  table.sort(values)
  return values[math.ceil(#values / 2)]
end

--- Fills in a row: n, mean, error (standard), failures { seed, why, time, how }, seconds and evaluations (medians), wall
-- (longest); with a reference also pairs, difference, difference_error, differs, keeps.
function sample.judge(self, row, reference)
  local good, scores, differences = {}, {}, {}
  row.failures, row.wall = {}, 0
  for _, run in ipairs(row.runs) do
    local why, time, how = trouble(run, reference)
    row.wall = math.max(row.wall, run.wall)
    if why then
      row.failures[#row.failures + 1] = { seed = run.seed, why = why, time = time, how = how }
    else
      good[#good + 1], scores[#scores + 1] = run, run.score
      local other = reference and reference.scores[run.seed]
      if other then differences[#differences + 1] = run.score - other end
    end
  end
  row.n, row.mean, row.error = #good, sample.mean(scores)
  for _, name in ipairs { "seconds", "solver_seconds", "evaluations" } do row[name] = cost_of(good, name) end
  if not reference then return end
  row.pairs, row.difference, row.difference_error = #differences, sample.mean(differences)
  -- A difference that is there for certain, but smaller than what matters for certain too, is none.
  local size, twice = math.abs(row.difference or 0), 2 * (row.difference_error or 0)
  row.differs = row.difference_error ~= nil and size > twice and size + twice > self.options.error
  row.whole = #row.runs == #self.options.seeds and #row.failures == 0
  row.keeps = row.whole and not row.differs
end

--- What other settings are held against.
function sample.reference(self, row)
  local scores, courses = {}, {}
  for i, run in ipairs(row.runs) do scores[run.seed], courses[i] = run.score, run.course end
  local reference = { scores = scores, usual = faults.measure(courses, self.goal), wall = row.wall, row = row }
  sample.judge(self, row, reference)
  return reference
end

return sample
