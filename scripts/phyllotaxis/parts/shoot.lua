--- The cellular shoot apex of thesis 5.5: what the models transport_apex, sensitivity, pin1_mutant, auxin_application and
-- ablation have in common. The equations are in shoot.model; a script says which parameters, and what is done to the apex.
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.5, equations 5.7-5.11
local tunica = require "tunica"

local shoot = {}

--- The parameters with their values for the Fibonacci spiral. T, D, b, Th and the three rho are the thesis's; the others were
-- found by sweeps, since it does not give them (share/doc/transport.md).
function shoot.parameters()
  return {
    T = { 22.5, "transport", min = 0 },
    D = { 4, "diffusion", min = 0 },
    b = { 3, "base of the allocation of PIN1 to walls", min = 1 },
    power = { 2, "of auxin in transport", min = 0.5, max = 4 },
    kT = { 1.069, "saturation of transport", min = 0 },
    rho_proximal = { 3, "production of auxin outside the central zone", min = 0 },
    rho_peripheral = { 3, "more of it in the peripheral zone", min = 0 },
    rho_primordium = { 3.5, "more of it in a primordium, falling off from its centre", min = 0 },
    kI = { 0.343, "saturation of the production of auxin", min = 0 },
    mu = { 0.21, "decay of auxin", min = 0 },
    most = { 16.57, "auxin at which a primordium drains into the tissue below", min = 0 },
    drain = { 100, "speed at which what is above that leaves", unit = "1 / time", min = 0 },
    rho_pin0 = { 2.41, "production of PIN1", min = 0 },
    rho_pin = { 0.536, "production of PIN1 for each unit of auxin", min = 0 },
    kP = { 1, "saturation of that production", min = 0 },
    mu_pin = { 1.813, "decay of PIN1", min = 0 },
    pin = { 0.94, "PIN1 at the start", min = 0 },
    steady_pin = { false, "whether PIN1 stays as it is at the start" },
    Th = { 7.5, "auxin in two neighbours at which a primordium starts", min = 0 },
    r_birth = { 0.88, "radius of a primordium at birth", min = 1e-3 },
    r_rate = { 1.198, "speed at which it grows", min = 1e-6 },
    r_most = { 2.097, "greatest radius", min = 1e-3 },
    height = { 0, "how high a primordium bulges in the end", min = 0 },
    height_rate = { 0.12, "speed at which it does", unit = "length / time", min = 1e-6 },
    radius = { 1.452, "of the sphere that the tip of the apex is part of", min = 0.1 },
    slope = { 74.9, "of the flank", unit = "degrees", min = 5, max = 90 },
    growth = { 0.1704, "relative elemental growth rate of the flank", unit = "1 / time", min = 1e-6 },
    growth_tip = { 1.465, "growth rate at the tip, relative to that", min = 0.05 },
    growth_to = { 2.04, "arc length at which the one goes over into the other", min = 0.1 },
    growth_over = { 0.3, "half of the width over which it does", min = 0.01 },
    central = { 1.651, "arc length from the tip to the border of the central zone", min = 0 },
    peripheral = { 3.063, "width of the peripheral zone", min = 0.1 },
    proximal = { 1.8, "width of what is kept of the proximal zone", min = 0 },
    widening = { 0, "rate at which the zones widen (the apex with them it does not)", unit = "1 / time", min = -1, max = 1 },
    young = { 1, "size of the zones at the start, relative to that which they grow to", min = 0.05, max = 1 },
    growing_up = { 20, "time in which all but 1 / e of the difference is made up", min = 1e-3 },
    onset = { 0, "time over which production sets in, from none", min = 0 },
    max_area = { 0.283, "area at which a cell divides", min = 1e-4 },
    variation = { 0.1, "of that area from cell to cell", min = 0, max = 0.9 },
    gap = { 0.23, "least distance of a new wall from old junctions, relative to the root of max_area", min = 0, max = 1 },
    pinch = { 0.05, "of the new wall's length, by which each end is drawn inwards", min = 0, max = 0.4 },
    step = { 0.2, "time between two steps of growth", min = 1e-4, max = 2 },
    initial = { 10, "primordia at the start, in a spiral", min = 0, max = 100 },
    angle = { 137.5, "between two of them", unit = "degrees" },
    plastochron = { 1.55, "between two of them", unit = "time", min = 1e-3 },
    first = { 0.343, "place of the youngest, as a share of the peripheral zone", min = 0, max = 1 },
    scatter = { 0, "standard deviation of these angles: how well is a disturbed spiral mended?", unit = "degrees", min = 0 },
    jugacy = { 1, "of them start at once, evenly around the apex; angle is then between whorls", min = 1, max = 6 },
    auxin = { 1.5, "auxin at the start, between them", min = 0 },
    dt = { 0.04, "time step; of euler at most a tenth of it", min = 1e-6 },
    method = "sts",  -- five Euler steps of unequal lengths: stable to steps ten times as long as Euler's
  }
end

--- Declarations with other values: changed { T = 19 }, and with more of them.
function shoot.with(values, more)
  local declared = shoot.parameters()
  for name, value in pairs(values) do
    if type(declared[name]) == "table" then declared[name][1] = value else declared[name] = value end
  end
  for name, declaration in pairs(more or {}) do declared[name] = declaration end
  return declared
end

-- The apex, its cells and its primordia --------------------------------------------------------------------------------

--- Growth: constant in the tip, constant on the flank, and between them a smooth step.
local function growth_of(P)
  local tip, from, to = P.growth * P.growth_tip, math.max(0, P.growth_to - P.growth_over), P.growth_to + P.growth_over
  local third = (to - from) / 3
  return tunica.curve { { 0, tip }, { from, tip }, { from + third, tip }, { to - third, P.growth }, { to, P.growth },
    { to + 1, P.growth } }
end

--- A value that grows with age from one to another at a speed.
local function ramp(from, speed, to)
  if to <= from or speed <= 0 then return to end
  return tunica.curve { { 0, from }, { (to - from) / speed, to }, degree = 1 }
end

--- The apex { surface =, apex =, tissue =, primordia =, P = } with its first primordia; without rules.
function shoot.apex(P)
  for _, name in ipairs { "initial", "jugacy" } do
    if P[name] ~= math.floor(P[name]) then error(name .. " must be a whole number, came " .. P[name], 0) end
  end
  local largest = P.most * math.log(P.b)
  if largest > 300 then error(string.format("b ^ most is beyond all numbers: most is %g, b %g", P.most, P.b), 0) end
  local cells = P.max_area > 0 and 2 * math.pi * (P.central + P.peripheral + P.proximal) ^ 2 / P.max_area
  if cells > 100000 then error(string.format("max_area = %g would make some %.0f cells", P.max_area, cells), 0) end
  if cells < 20 then error(string.format("max_area = %g leaves no room for cells: the apex has an area of some %.3g", P.max_area,
    cells * P.max_area), 0) end
  if P.r_birth > P.r_most then error("r_birth, the radius at birth, is greater than r_most", 0) end
  local apex = tunica.apex { cap = { P.radius, P.slope }, growth = growth_of(P) }
  local my = { P = P, apex = apex, primordia = {} }
  my.surface = tunica.bulges { on = apex, radius = ramp(P.r_birth, P.r_rate, P.r_most),
    height = ramp(0, P.height_rate, P.height) }
  my.border = P.central + P.peripheral + P.proximal
  my.tissue = tunica.apex_tissue { on = apex, to = my.border, max_area = P.max_area, variation = P.variation, growth = 0.1 }
  my.tissue:locate { on = apex }
  for i = 1, P.initial do
    local whorl, birth = math.ceil(i / P.jugacy), -(math.ceil(P.initial / P.jugacy) - math.ceil(i / P.jugacy)) * P.plastochron
    local theta, a = whorl * P.angle + (i - 1) % P.jugacy * 360 / P.jugacy, P.central + P.first * P.peripheral
    theta = theta + P.scatter * 2 * (math.random() + math.random() + math.random() - 1.5)
    my.surface:add { theta = theta, a = a, birth = birth }
    my.primordia[i] = { time = birth, angle = theta % 360, a = a }
  end
  if P.height > 0 then my.tissue:grow { on = my.surface, time = 1e-9 } end  -- onto the bulges
  my.tissue:differentiate { on = my.surface }
  my.tissue:cell { drained = { 0, divide = "split" }, pin = P.pin, auxin = function(c)
    if c.closeness > 0 then return P.most * c.closeness end
    return (c.a < P.central and 0.7 or 1) * P.auxin
  end }
  return my
end

--- The size of the zones at a time, relative to P; `exp`: of numbers, or of rules.
local function size_of_zones(P, t, exp) return exp(P.widening * t) * (1 - (1 - P.young) * exp(-t / P.growing_up)) end

--- A primordium starts between two neighbours with auxin above the threshold, in the peripheral zone and outside primordia.
local function initiate(my)
  local P, size, before = my.P, size_of_zones(my.P, my.surface:time(), math.exp), #my.primordia
  while true do
    if #my.primordia > before + 12 then
      error(string.format("more than 12 primordia start at once at time %.4g: auxin is above the threshold Th = %.4g nearly everywhere",
        my.surface:time(), P.Th), 0)
    end
    local first, second = my.tissue:pair { "auxin", above = P.Th,
      where = { primordium = 0, a = { P.central * size, (P.central + P.peripheral) * size } } }
    if not first then return end
    local x, y, z = (first.x + second.x) / 2, (first.y + second.y) / 2, (first.z + second.z) / 2
    local theta, a = my.apex:closest(x, y, z)
    my.surface:add { place = { x, y, z } }
    my.tissue:differentiate { on = my.surface }
    my.primordia[#my.primordia + 1] = { time = my.surface:time(), angle = theta % 360, a = a }
  end
end

-- The model --------------------------------------------------------------------------------------------------------------

--- The model of the apex `my`: equations 5.7 to 5.11, growth, division, and the start of primordia. With my.mortal its cells have a
-- column `living`: those where it is 0 stay as they are and grow with the apex, but make, carry and divide nothing.
function shoot.model(my)
  local P, tissue, surface, apex = my.P, my.tissue, my.surface, my.apex
  local primordia, border, power = my.primordia, my.border, P.power  -- a number in the rule: squares are cheaper than powers
  local mortal = my.mortal
  local model = tunica.model { tissue = tissue, params = P, dt = P.dt, method = P.method, stop = my.stop or 40 }

  -- What is above `most` has left already for all that looks at it, and leaves at the rate `drain`.
  model:derive(function(c) c.level = tunica.min(c.auxin, P.most) end)
  model:derive(function(c)  -- (5.11)
    local pull = P.b ^ tunica.max(c.level, P.most * c.closeness)
    c.pull = mortal and c.living * pull or pull
  end)
  -- (5.7); a cell that has lost its last neighbour allocates nothing
  model:derive(function(c) c.share = c.pin / tunica.max(1e-9, c:sum(function(n, w) return w.length * n.pull end)) end)
  model:derive("side", function(s) s.pin = s.cell.share * s.neighbour.pull end)  -- for pictures: PIN1 by length of wall

  model:rate(function(c, d, t)
    local size = size_of_zones(P, t, tunica.exp)
    -- A factor of the three rho, which are the same in all cells: a factor of the sum would cost a product in each.
    local set_in = tunica.where(tunica.below(t, P.onset), t / tunica.max(P.onset, 1e-9), 1)
    local in_zone = set_in * P.rho_proximal +
      tunica.where(tunica.below(c.a, (P.central + P.peripheral) * size), set_in * P.rho_peripheral, 0)
    local made = tunica.where(tunica.below(c.a, P.central * size), 0, in_zone + set_in * P.rho_primordium * c.closeness)  -- (5.10)
    if mortal then made = c.living * made end
    local leaves = P.drain * tunica.max(0, c.auxin - P.most)
    d.auxin = made / (1 + P.kI * c.auxin) - P.mu * c.auxin - leaves
    d.drained = leaves * c.area
  end)
  if not P.steady_pin then
    model:rate(function(c, d)  -- (5.8)
      local made = (P.rho_pin0 + P.rho_pin * c.auxin) / (1 + P.kP * c.pin)
      d.pin = (mortal and c.living * made or made) - P.mu_pin * c.pin
    end)
  end
  model:flux("auxin", function(w, a, b)  -- (5.9)
    local into_b = a.level ^ power / (1 + P.kT * b.level ^ power)
    local into_a = b.level ^ power / (1 + P.kT * a.level ^ power)
    local carried = w.length * (P.D * (a.level - b.level) + P.T * (a.share * b.pull * into_b - b.share * a.pull * into_a))
    return mortal and a.living * b.living * carried or carried
  end)

  local function divides(c) return c.living > 0 end
  model:every(P.step, function()
    tissue:grow { on = surface, time = P.step }
    tissue:divide { above = P.max_area, where = mortal and tissue:min "living" == 0 and divides or nil, variation = P.variation, on = surface,
      gap = P.gap * math.sqrt(P.max_area), pinch = P.pinch }
    tissue:remove { on = apex, beyond = border }
    initiate { P = P, tissue = tissue, surface = surface, apex = apex, primordia = primordia }
  end)
  my.model = model
  return model
end

-- What came of it ----------------------------------------------------------------------------------------------------------

--- Divergence angles of the primordia that started themselves, 0 to 360, as long as there are so many.
function shoot.angles(my, most)
  local list, angles = my.primordia, {}
  for i = math.max(2, my.P.initial + 1), #list do
    if not most or #angles < most then angles[#angles + 1] = (list[i].angle - list[i - 1].angle) % 360 end
  end
  return angles
end

--- The share of angles between 110 and 165 degrees, with the handedness of the start, and with either at each.
function shoot.shares(angles)
  local same, either = 0, 0
  for _, angle in ipairs(angles) do
    if angle > 110 and angle < 165 then same = same + 1 end
    if angle > 110 and angle < 165 or angle > 195 and angle < 250 then either = either + 1 end
  end
  local n = math.max(1, #angles)
  return same / n, either / n
end

--- The difference of two angles, -180 to 180.
local function turn(from, to) return (to - from + 180) % 360 - 180 end

--- How many whorls of `jugacy` primordia followed each other from the start: each evenly spaced around the apex and between those of
-- the whorl before, to within `tolerance` degrees (times the even spacing), and complete before the next begins.
function shoot.whorls(my, jugacy, tolerance)
  local list, first = my.primordia, my.P.initial + 1
  local even, whorls, before = 360 / jugacy, 0, nil
  for i = first, #list - jugacy + 1, jugacy do
    -- Angles modulo the even spacing are the same throughout a whorl: their mean is its own.
    local own, apart, off = list[i].angle, {}, {}
    for k = 0, jugacy - 1 do
      local from_first = turn(own, list[i + k].angle)
      local slot = math.floor(from_first / even + 0.5)
      apart[slot % jugacy] = true
      off[k] = from_first - slot * even
    end
    local sum, complete = 0, true
    for k = 0, jugacy - 1 do
      sum = sum + off[k]
      complete = complete and apart[k] == true
    end
    local mean = sum / jugacy
    for k = 0, jugacy - 1 do complete = complete and math.abs(off[k] - mean) <= tolerance * even end
    local place = (own + mean) % even
    if before then
      local between = math.abs(turn(0, (place - before) * jugacy)) / 360  -- 1/2: exactly between
      complete = complete and math.abs(between - 0.5) <= tolerance
    end
    if not complete then break end
    whorls, before = whorls + 1, place
  end
  return whorls
end

--- PIN1 in the cells outside the central zone that belong to no primordium.
local function pin_outside(my)
  local sum, n = 0, 0
  for c in my.tissue:cells() do
    if c.primordium == 0 and c.a >= my.P.central and not (my.mortal and c.living == 0) then sum, n = sum + c.pin, n + 1 end
  end
  return n > 0 and sum / n or 0
end

--- How many cells there are around the apex where primordia start.
local function cells_around(my)
  local sum, n = 0, 0
  for i = my.P.initial + 1, #my.primordia do sum, n = sum + my.primordia[i].a, n + 1 end
  if n == 0 then return 0 end
  return 2 * math.pi * (my.apex:profile(sum / n)) / math.sqrt(my.tissue:mean "area")
end

-- The thesis's divergence angles: table 5.1 from the first primordium on; table 5.2, the ten that follow ten at 137.5 degrees.
local published = {
  ["table 5.1"] = { 162.7, 96.3, 155.9, 123.4, 143.2, 139.3, 128.6, 142.1, 124.8, 144.2, 131.9, 125.4, 141.2, 132.3, 131.6, 125.0, 137.3,
    135.4, 124.1, 123.0, 144.8, 114.6, 128.9, 133.1, 135.0, 143.0, 150.0, 130.9, 123.5, 132.8, 126.7, 136.4, 130.1, 134.6, 130.9,
    135.2, 125.4, 153.2, 126.1 },
  fixed_pin = { 145.1, 143.8, 139.5, 133.8, 143.3, 134.7, 130.0, 125.7, 137.4, 144.3 },
  iaa_saturation = { 137.3, 128.6, 138.9, 122.2, 143.4, 139.3, 122.6, 143.5, 126.9, 136.0 },
  transport_power = { 127.7, 145.4, 125.2, 136.3, 130.9, 126.8, 135.5, 124.2, 148.9, 122.8 },
  allocation_base = { 144.0, 131.2, 134.9, 119.8, 145.1, 137.2, 125.0, 126.2, 128.1, 133.7 },
}

--- A plot of the divergence angles beside those of the thesis, all in the handedness of the first.
local function divergence_plot(my)
  local angles, numbers, series = shoot.angles(my), {}, {}
  for i in ipairs(angles) do numbers[i] = math.max(1, my.P.initial) + i end
  if my.P.initial == 0 and angles[1] and angles[1] > 180 then
    for i, angle in ipairs(angles) do angles[i] = 360 - angle end
  end
  if #angles > 0 then series[1] = { x = numbers, y = angles, title = "this run", style = "both" } end
  local name = my.P.initial == 0 and my.P.rho_pin0 > 0 and "table 5.1" or my.variant and published[my.variant] and my.variant
  if name and my.P.jugacy == 1 then
    local x = {}
    for i in ipairs(published[name]) do x[i] = math.max(1, my.P.initial) + i end
    series[#series + 1] = { x = x, y = published[name], title = "thesis, " .. name:gsub("_", " "), style = "both" }
  end
  if #series == 0 then series[1] = { x = { 0 }, y = { 0 }, title = "no primordia" } end
  return { series = series, xlabel = "primordium", ylabel = "divergence angle", yrange = { 0, 360 }, lines = { { y = 137.5, text = "137.5" } } }
end

local function words(angles)
  local text = {}
  for i, angle in ipairs(angles) do text[i] = string.format("%.0f", angle) end
  return table.concat(text, " ")
end

--- A camera that looks down upon the flank at an angle around the axis.
function shoot.facing(my, angle)
  local x, _, z = my.apex:position(angle, my.P.central + my.P.peripheral)
  local far = math.sqrt(x * x + z * z)
  return { direction = { -x / far, -0.45, -z / far }, up = { 0, 1, 0 } }
end

--- Reports and pictures that all of these models have. `most`: of the angles; `looks`: options of the pictures of cells that differ,
-- and `camera` of the one from the side. my.note() may say more.
function shoot.report(my, most, looks)
  local P, list = my.P, my.primordia
  my.model:report {
    primordia = function() return #list - P.initial end,
    angles = function() return words(shoot.angles(my, most)) end,
    spiral = function() return (shoot.shares(shoot.angles(my, most))) end,
    spiral_either_way = function() return (select(2, shoot.shares(shoot.angles(my, most)))) end,
    whorls = function() return shoot.whorls(my, P.jugacy, 0.12) end,
    plastochron = function()
      local from, n = P.initial + 1, #list
      return n > from and (list[n].time - list[from].time) / (n - from) or 0
    end,
    pin_outside = function() return pin_outside(my) end,
    cells_around = function() return cells_around(my) end,
    cells = function() return my.mortal and my.tissue:sum "living" or #my.tissue end,
    note = function()
      local own = my.note and my.note()
      if own then return own end
      if #list > P.initial then return "" end
      local most = 0
      for c in my.tissue:cells() do
        if c.primordium == 0 then most = math.max(most, c.auxin) end
      end
      return string.format("no primordium started: no two neighbours in the peripheral zone have more than the threshold %.4g; the most anywhere outside primordia is %.4g", P.Th, most)
    end,
    drained = function() return my.tissue:sum "drained" end,  -- amount of auxin, by the cells that are still there
  }
  local shown = { colour = "auxin", palette = "greens", range = { 0, 12 }, sides = { "pin", colour = "#e02020" }, light = true,
    every = 0.4, size = { 820, 760 } }  -- whole steps of all the variants
  for key, value in pairs(looks or {}) do shown[key] = value end
  local cameras = { top = { direction = { 0, -1, 0 }, up = { 0, 0, -1 } }, side = shown.camera or
    { direction = { 0, -0.45, -1 }, up = { 0, 1, 0 } } }
  for name, camera in pairs(cameras) do
    local view = { name = name }
    for key, value in pairs(shown) do view[key] = value end
    view.camera = camera
    my.model:view(view)
  end
  my.model:view { name = "divergence", plot = function() return divergence_plot(my) end }
end

return shoot
