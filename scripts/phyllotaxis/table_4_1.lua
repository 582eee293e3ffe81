--- How low the threshold may be for a pattern to be kept.
-- WHAT    for six patterns, the lowest threshold at which the primordia at the start are followed by others of the same
--         pattern. Fibonacci spirals are kept over the widest range; then come Lucas, bijugate, anomalous ... Prints the
--         table.
-- HOW     one inhibitor (4.3) on a flat apex, from 20 primordia at the limit angle (10 pairs). Thresholds rise by 3 %; the
--         lowest of six in a row that all keep the pattern counts. Kept: the mean of the last 30 of 60 within 3 degrees of
--         the limit (4 for Lucas and bijugate, 8 for Fibonacci, whose angle changes with the threshold), steady within 4, and
--         parastichies of the sequence.
-- TRY     samples=360 (quicker)   ratio=1.1   b=1.5
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.3.2, table 4.1. The radius makes the unit of the
--         thresholds the thesis's, from one of its six numbers (Lucas)
local tunica = require "tunica"

local P = tunica.params {
  b = { 1, "decay of the inhibition with age", unit = "1/time", min = 0 },
  radius = { 0.0871, "of the ring", unit = "length", min = 1e-6 },
  samples = { 720, "places on the ring", min = 3 },
  ratio = { 1.03, "of one threshold to the one before", min = 1.001 },
  lowest = { 3, "threshold to begin with", unit = "1/length", min = 0 },
  highest = { 160, "threshold to end with", unit = "1/length", min = 0 },
}

-- name, jugacy, angle, a pair of its sequence, the thesis's threshold
local patterns = {
  { "Fibonacci", 1, 137.51, { 1, 2 }, 4 }, { "Lucas", 1, 99.50, { 3, 4 }, 22 }, { "bijugate", 2, 68.76, { 2, 4 }, 31 },
  { "anomalous", 1, 151.14, { 2, 5 }, 37 }, { "other (3,7)", 1, 106.45, { 3, 7 }, 65 }, { "2nd accessory", 1, 77.96, { 4, 5 }, 128 },
}

local apex = tunica.apex { profile = "disk", growth = 1 }

local function kept(pattern, threshold)
  local _, jugacy, angle, pair = unpack(pattern)
  local model = tunica.phyllotaxis { apex = apex, radius = P.radius, samples = P.samples, jugacy = 1, params = P, tolerance = 0.01,
    stop = { primordia = 80 } }
  model:inhibition { field = function(d, age) return math.exp(-P.b * age) / d end, below = threshold }
  model:initial { count = 20, angle = angle, jugacy = jugacy }
  model:advance()
  local judged = model:pattern { first = 51, jugacy = jugacy, expected = { angle = angle, jugacy = jugacy, pair = pair } }.judgement
  return judged.hold, judged.why
end

local function minimum(pattern)
  local threshold, first, row = P.lowest, nil, 0
  while threshold < P.highest do
    if kept(pattern, threshold) then
      first, row = first or threshold, row + 1
      if row == 6 then return first end
    else
      first, row = nil, 0
    end
    threshold = threshold * P.ratio
  end
end

print(string.format("%-15s %7s %8s %10s %8s %6s", "pattern", "jugacy", "angle", "threshold", "thesis", "at 128"))
for _, pattern in ipairs(patterns) do
  local found = minimum(pattern)
  print(string.format("%-15s %7d %8.2f %10s %8.0f %6s", pattern[1], pattern[2], pattern[3], found and string.format("%.1f", found) or "none",
    pattern[5], kept(pattern, 128) and "kept" or "lost"))
  io.stdout:flush()
end
