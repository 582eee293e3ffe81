--- Twenty-five patterns from one set of parameters.
-- WHAT    all patterns of table 4.2, from sixth accessory to whorls of ten, each kept by the same model: they differ only in
--         the primordia that are there at the start. Prints the table, and draws a page like fig. 4.12.
-- HOW     two inhibitors (4.4, 4.5) on a dome that is a B-spline. The primordia at the start are a lattice at the limit
--         angle, at the plastochron at which the next one is due. Judged: the second half. Kept: the mean angle is in the
--         allowable interval of the parastichies and steady, and whorls are even. Near: also within a degree of the limit
--         angle.
-- TRY     samples=480   long=4.3   page= (no picture)   shape=cylinder
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 4.4.2, table 4.2, fig. 4.12; the values are our own
local tunica = require "tunica"

local P = tunica.params {
  shape = { "dome", "of the apex: dome, or cylinder" },
  long = { 0, "threshold of the long-range inhibition; 0: that of the shape, as below", unit = "1/length", min = 0 },
  b_long = { 0, "its decay with age", unit = "1/time", min = 0 },
  onset = { 0, "rate at which primordia begin to send it out", unit = "1/time", min = 0 },
  short = { 0, "threshold of the short-range inhibition", unit = "1/length", min = 0 },
  b_short = { 0, "its decay with age", unit = "1/time", min = 0 },
  samples = { 720, "places on the ring: a multiple of 240, so that every whorl fits", min = 3 },
  page = { "table_4_2.png", "picture of all; empty: none" },
}

-- name, whorls at the start, jugacy, divergence angle, parastichies in the thesis
local patterns = {
  { "6th accessory", 40, 1, 41.77, "(8,9)" }, { "5th accessory", 40, 1, 47.26, "(7,8)" }, { "3rd accessory", 40, 1, 64.08, "(6,11)" },
  { "other (5,11)", 40, 1, 66.89, "(5,11)" }, { "2nd accessory", 20, 1, 77.96, "(5,9)" }, { "other (4,9)", 40, 1, 82.15, "(9,13)" },
  { "Lucas", 20, 1, 99.50, "(7,11)" }, { "other (3,7)", 20, 1, 106.45, "(7,10)" }, { "other (3,8)", 20, 1, 132.18, "(8,11)" },
  { "Fibonacci", 20, 1, 137.51, "(8,13)" }, { "1st anomalous", 30, 1, 151.14, "(7,12)" }, { "2nd anomalous", 20, 1, 158.14, "(7,9)" },
  { "3rd anomalous", 20, 1, 162.42, "(9,11)" }, { "bijugate 2nd acc.", 10, 2, 38.98, "(8,10)" }, { "bijugate Lucas", 10, 2, 49.75, "(6,8)" },
  { "bijugate", 10, 2, 68.75, "(6,10)" }, { "bijugate anomalous", 10, 2, 75.57, "(4,10)" }, { "trijugate Lucas", 10, 3, 33.17, "(9,12)" },
  { "trijugate", 10, 3, 45.84, "(6,9)" }, { "tetrajugate", 5, 4, 34.38, "(8,12)" }, { "pentajugate", 5, 5, 27.50, "(5,10)" },
  { "hexajugate", 5, 6, 22.92, "(6,12)" }, { "whorls of 6", 7, 6, 30, "(6,6)" }, { "whorls of 8", 4, 8, 22.5, "(8,8)" },
  { "whorls of 10", 2, 10, 18, "(10,10)" },
}

local shapes = {
  dome = { long = 4.57, b_long = 3.62, onset = 4.59, short = 9.91, b_short = 23.7, apex = tunica.apex { profile = "dome", growth = 1 }, radius = 1 },
  cylinder = { long = 5.4011, b_long = 3.254, onset = 4.858, short = 10.449, b_short = 28.174, path = function(age) return 1, -age end },
}
local shape = shapes[P.shape] or error("there is no shape '" .. P.shape .. "'; there are dome and cylinder", 0)
for _, name in ipairs { "long", "b_long", "onset", "short", "b_short" } do
  if P[name] == 0 then P[name] = shape[name] end
end

local function model_of(initial, jugacy, angle)
  local total = math.max(2 * initial + math.max(10, 2 * jugacy), initial + 30)
  local model = tunica.phyllotaxis { apex = shape.apex, radius = shape.radius, path = shape.path, samples = P.samples, params = P,
    tolerance = 0.01, stop = { primordia = total } }
  model:inhibition {
    field = function(d, age) return (1 - math.exp(-P.onset * age)) * math.exp(-P.b_long * age) / d end,
    below = P.long,
  }
  model:inhibition { field = function(d, age) return math.exp(-P.b_short * age) / d end, below = P.short }
  model:initial { count = initial, angle = angle, jugacy = jugacy }
  return model, total
end

print(string.format("%-20s %7s %10s %8s %6s %8s %7s  %s", "pattern", "jugacy", "limit", "mean", "sd", "thesis", "pair", "kept"))
local kept, near, pictures, captions = 0, 0, {}, {}
for i, row in ipairs(patterns) do
  local name, whorls, jugacy, angle, theirs = unpack(row)
  local model, total = model_of(whorls * jugacy, jugacy, angle)
  model:advance()
  local half = model.count - math.floor(total / 2 / jugacy) * jugacy
  local p = model:pattern { first = half + 1, jugacy = jugacy, expected = { angle = angle, jugacy = jugacy } }
  local judged = p.judgement
  kept, near = kept + (judged.lenient and 1 or 0), near + (math.abs(p.mean - angle) <= 1 and judged.lenient and 1 or 0)
  local pair = p.pair and p.pair[1] and string.format("(%d,%d)", p.pair[1], p.pair[2]) or "-"
  print(string.format("%-20s %7d %10.2f %8.2f %6.2f %8s %7s  %s", name, jugacy, angle, p.mean, p.sd, theirs, pair,
    judged.lenient and (math.abs(p.mean - angle) <= 1 and "yes, near" or "yes") or "no: " .. judged.why))
  if P.page ~= "" then
    pictures[i] = os.tmpname() .. ".png"
    model:picture { pictures[i], from = "oblique", size = { 300, 400 }, legend = false, title = false, reach = 4.5 }
    captions[i] = string.format("%s %.1f", name, p.mean)
  end
end
print(string.format("%d of %d kept, %d of them within a degree of the limit", kept, #patterns, near))
if P.page ~= "" then
  tunica.page { pictures, file = P.page, captions = captions, columns = 5 }
  for _, path in ipairs(pictures) do os.remove(path) end
  print("page: " .. P.page)
end
