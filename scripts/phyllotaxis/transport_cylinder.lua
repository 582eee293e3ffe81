--- Phyllotaxis by the transport of auxin, on an apex with the neighbourhoods of a cylinder.
-- WHAT    rings of cells move down from the tip; auxin is made outside the central zone, and cells pump it towards neighbours
--         that have more: peaks arise near the border of the zone, one after the other or in whorls. The more cells there are
--         in a ring, the more peaks there are in a whorl; spirals go on where peaks were put in a spiral.
-- HOW     a cell shares its PIN1 out to its walls, exponentially, by the auxin behind them (5.4); PIN1 is made where there is
--         auxin (5.5); auxin is made, decays, diffuses and is carried (5.6). At regular times a ring is put in below that of
--         the tip. The oldest ring is held as it is, so that the edge makes no peaks.
-- TRY     variant=decussate   variant=fibonacci   variant=fibonacci seeds=0   variant=fibonacci around=25   noise=0.3
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.4, figs 5.5 and 5.6; the values are our own
local tunica = require "tunica"

-- One set of values keeps spirals. Lengths are multiplied by `scale`: D and T go with its square, the speed of rings with it.
local function spiral(scale, own)
  local all = { D = 3.8 * scale ^ 2, T = 27.7 * scale ^ 2, interval = 6 / scale, b = 4, kT = 1, rho = 0.255, kI = 0, mu = 0.05,
    rho_pin = 1, auxin = 1, pin = 0.9, seeds = 8, hold = 20, settling = 0, dt = 0.012 }
  for name, value in pairs(own) do all[name] = value end
  return all
end

local P = tunica.params {
  variant = { "distichous", "pattern of fig. 5.6" },
  variants = {
    distichous = {},
    decussate = { around = 27, low = 76, high = 90 },
    tricussate = { around = 38, jugacy = 3, low = 50, high = 60 },  -- 38 is no multiple of 3: whorls are uneven
    fibonacci = spiral(1, { around = 33, angle = 137.5, apart = 4, low = 120, high = 144 }),
    lucas = spiral(0.78, { around = 40, angle = 99.5, seeds = 12, first = 3, apart = 2.6, dt = 0.015, low = 90, high = 120 }),
    spiro_distichous = spiral(0.35,
      { around = 15, angle = 168, seeds = 9, first = 1, apart = 3.9, dt = 0.04, low = 150, high = 176 }),
  },
  around = { 13, "cells in a ring", min = 3 },
  rows = { 42, "rings, at most: then the oldest goes when one is put in", min = 12 },
  rows_first = { 42, "rings at the start", min = 2 },
  central = { 4, "rings of the central zone, in which no auxin is made", min = 1 },
  interval = { 20, "from one new ring to the next", unit = "time", min = 1e-6 },
  insertions = { 146, "rings put in until the end", min = 1 },
  D = { 8, "diffusion", min = 0 },
  T = { 15, "transport", min = 0 },
  b = { 3, "base of the allocation of PIN1", min = 1 },
  kT = { 0.5, "saturation of transport", min = 0 },
  rho = { 1.2, "production of auxin", min = 0 },
  kI = { 1, "saturation of that production", min = 0 },
  mu = { 0.1, "decay of auxin", min = 0 },
  rho_pin = { 2, "production of PIN1 for each unit of auxin", min = 0 },
  kP = { 1, "saturation of that production", min = 0 },
  mu_pin = { 1, "decay of PIN1", min = 0 },
  auxin = { 0.1, "at the start", min = 0 },
  pin = { 0.1, "PIN1 at the start", min = 0 },
  noise = { 0.01, "of auxin at the start and in new rings, relative", min = 0, max = 1 },
  seeds = { 0, "peaks at the start", min = 0 },
  angle = { 137.5, "from one of them to the next", unit = "degrees" },
  first = { 5, "rings from the central zone to the youngest of them", min = 1 },
  apart = { 4, "rings from one of them to the next", min = 0.1 },
  hold = { 0, "time without growth at the start", unit = "time", min = 0 },
  settling = { 26, "rings put in before primordia count", min = 0 },
  level = { 5, "auxin of a peak, at least", min = 0 },
  jugacy = { 0, "primordia in a whorl; 0: found from angles and times", min = 0 },
  low = { 152, "least divergence that is of the pattern", unit = "degrees" },
  high = { 180, "greatest divergence that is of the pattern", unit = "degrees" },
  dt = { 0.01, "time step", min = 1e-9 },
  method = "euler",
}

for _, name in ipairs { "central", "seeds", "jugacy", "settling" } do
  if P[name] ~= math.floor(P[name]) then error(name .. " must be a whole number, came " .. P[name], 0) end
end
if P.jugacy > 20 then error("jugacy: there are at most 20 primordia in a whorl here, came " .. P.jugacy, 0) end

--- Ring and angle of the peak k of those at the start; 0 is the youngest.
local function seed(k)
  return math.floor(P.central + P.first + k * P.apart + 0.5), -k * P.angle % 360
end

local function auxin_at_start(c)
  for k = 0, P.seeds - 1 do
    local row, angle = seed(k)
    local aside = (c.column - math.floor(angle / 360 * P.around + 0.5)) % P.around
    local away = math.max(math.abs(c.row - row), math.min(aside, P.around - aside))
    if away <= 1 then return away == 0 and 8 or 4.8 end
  end
  return P.auxin
end

local tissue = tunica.cylinder { around = P.around, rows = math.min(P.rows_first, P.rows) }
tissue:cell { auxin = function(c) return auxin_at_start(c) * (1 + c:uniform(-P.noise, P.noise)) end, pin = P.pin }

local stop = P.hold + P.insertions * P.interval
local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = stop }

model:derive(function(c) c.pull = P.b ^ c.auxin end)
model:derive(function(c) c.share = c.pin / c:sum(function(n) return n.pull end) end)
model:derive("side", function(s) s.pin = s.cell.share * s.neighbour.pull end)  -- (5.4)

model:rate(function(c, d)
  local made = tunica.where(tunica.at_least(c.row, P.central), P.rho / (1 + P.kI * c.auxin), 0)
  local diffusion = P.D * c:sum(function(n) return n.auxin - c.auxin end)
  local arriving = c:sum(function(n) return n.share * c.pull * n.auxin ^ 2 / (1 + P.kT * c.auxin ^ 2) end)
  local leaving = c:sum(function(n) return c.share * n.pull * c.auxin ^ 2 / (1 + P.kT * n.auxin ^ 2) end)
  local held = tunica.at_least(c.row, P.rows - 1)
  d.auxin = tunica.where(held, 0, made - P.mu * c.auxin + diffusion + P.T * (arriving - leaving))  -- (5.6)
  d.pin = tunica.where(held, 0, P.rho_pin * c.auxin / (1 + P.kP * c.pin) - P.mu_pin * c.pin)  -- (5.5)
end)

-- Primordia are peaks, followed down the apex ----------------------------------------------------------------------------

-- { time =, angle =, row = its ring now, seen = rings put in since it was first there, counts = whether it is a new one,
-- lost = whether its peak has gone }
local primordia, put_in = {}, 0
for k = P.seeds - 1, 0, -1 do
  local row, angle = seed(k)
  primordia[#primordia + 1] = { time = 0, angle = angle, row = row, seen = 0, counts = false }
end

local function last_row() return tissue:max "row" end

local function rings()
  local auxin = {}
  for c in tissue:cells() do
    auxin[c.row] = auxin[c.row] or {}
    auxin[c.row][c.column] = c.auxin
  end
  return auxin
end

--- Whether a cell has more auxin than the eight around it; of equal ones the first counts.
local function is_peak(auxin, row, column)
  local here = auxin[row][column]
  for down = -1, 1 do
    for aside = -1, 1 do
      local there = auxin[row + down][(column + aside) % P.around]
      local before = down < 0 or down == 0 and aside < 0
      if there > here or there == here and before then return false end
    end
  end
  return true
end

local function near_edge(row) return row > P.rows - 8 end

--- The peaks below the central zone. A peak's angle is that of the vertex of a parabola through three cells, so that it may lie
-- between two.
local function peaks()
  local auxin, found, v = rings(), {}, P.around
  for row = P.central, last_row() - 1 do
    for column = 0, near_edge(row) and -1 or v - 1 do
      local here = auxin[row][column]
      if here >= P.level and is_peak(auxin, row, column) then
        local left, right = auxin[row][(column - 1) % v], auxin[row][(column + 1) % v]
        found[#found + 1] = { row = row, angle = (column + (right - left) / (2 * (2 * here - left - right))) * 360 / v % 360 }
      end
    end
  end
  return found
end

--- Whether a peak is within two cells of a primordium.
local function beside(p, peak)
  local aside = (peak.angle - p.angle) % 360
  return math.abs(peak.row - p.row) <= 2 and math.min(aside, 360 - aside) <= 2.5 * 360 / P.around
end

--- Primordia are moved to their peaks. Peaks without one are new primordia, unless they are beside one (halves of a peak).
local function follow(t)
  local left = peaks()
  for _, p in ipairs(primordia) do
    local gone = not p.lost and not near_edge(p.row)
    for i = #left, 1, -1 do
      if gone and beside(p, left[i]) then
        local peak = table.remove(left, i)
        p.row, p.angle, p.seen, gone = peak.row, peak.angle, p.seen + 1, false
      end
    end
    p.lost = p.lost or gone or nil
  end
  for _, peak in ipairs(left) do
    local known = false
    for _, p in ipairs(primordia) do known = known or not p.lost and beside(p, peak) end
    if not known then
      primordia[#primordia + 1] = { time = t, angle = peak.angle, row = peak.row, seen = 1, counts = put_in >= P.settling }
    end
  end
end

model:every(P.interval, function(t)
  if t <= P.hold then return end
  follow(t)
  if last_row() == P.rows - 1 then tissue:remove_row() end
  tissue:insert_row(0)
  for c in tissue:cells() do
    if c.row == 1 then c.auxin = c.auxin * (1 + c:uniform(-P.noise, P.noise, "new ring")) end
  end
  for _, p in ipairs(primordia) do p.row = p.row + 1 end
  put_in = put_in + 1
end)

-- What came -----------------------------------------------------------------------------------------------------------------

--- New primordia that have lasted. Radii are such that distances on the cylinder keep their proportions on the plane.
local function new()
  local list = {}
  for _, p in ipairs(primordia) do
    if p.counts and p.seen >= 3 then
      list[#list + 1] = { angle = p.angle, time = p.time, radius = math.exp(2 * math.pi * p.row / P.around) }
    end
  end
  return list
end

local function pattern() return tunica.pattern(new(), { jugacy = P.jugacy > 0 and P.jugacy or nil }) end

--- As they come, 0 to 360.
local function divergences()
  local list, text = new(), {}
  for i = 2, #list do text[i - 1] = string.format("%.0f", (list[i].angle - list[i - 1].angle) % 360) end
  return table.concat(text, " ")
end

--- How many come within one ring of another, whatever their angles.
local function per_whorl()
  local count, before = {}, nil
  for _, p in ipairs(new()) do
    if before and p.time - before < 1.5 * P.interval then
      count[#count] = count[#count] + 1
    else
      count[#count + 1] = 1
    end
    before = p.time
  end
  return table.concat(count, " ")
end

--- Share of divergences (of whorls: between them) from `low` to `high`. They are positive towards the hand that most have; where
-- whorls alternate there is no hand.
local function within()
  local found, n = pattern(), 0
  local list = found.jugacy == 1 and found.raw or found.divergences or {}
  for _, angle in ipairs(list) do
    if P.high > 179 / found.jugacy then angle = math.abs(angle) end
    if angle >= P.low - 1e-6 and angle <= P.high + 1e-6 then n = n + 1 end
  end
  return #list > 0 and n / #list or 0
end

local function lost()
  local n = 0
  for _, p in ipairs(primordia) do n = n + (p.lost and 1 or 0) end
  return n
end

-- Seen from above, the cylinder is opened to a bowl, so that all primordia are in the picture.
local function on_bowl(c)
  local radius, angle = c.row + 1, 2 * math.pi * c.column / P.around
  return radius * math.cos(angle), -0.01 * radius ^ 2, radius * math.sin(angle)
end

model:view { name = "cells", colour = "auxin", palette = "greens", range = { 0, 20 }, sides = { "pin", colour = "#e02020" },
  every = 10 * P.interval, size = { 900, 1000 } }
model:view { name = "top", colour = "auxin", palette = "greens", range = { 0, 20 }, place = on_bowl, every = 10 * P.interval,
  size = { 900, 800 }, camera = { direction = { 0, -1, 0 }, up = { 0, 0, 1 } } }
model:report {
  primordia = function() return #new() end,
  pattern = function() return tostring(pattern()) end,
  mean = function() return pattern().raw_mean end,
  deviation = function() return pattern().raw_sd end,
  divergences = divergences,
  per_whorl = per_whorl,
  within = within,
  lost = lost,
  highest = function() return tissue:max "auxin" end,
}

return model
