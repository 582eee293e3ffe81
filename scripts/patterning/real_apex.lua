--- Auxin peaks on a real shoot apex.
-- WHAT    the transport model of patterning/sheet on the cells of a segmented shoot apical meristem, given as a file.
-- HOW     the cell mesh is read as MorphoGraphX writes it (PLY); lengths are scaled so that the mean cell has area 0.5, the
--         scale of patterning/sheet. Transport as in (5.7-5.9), on the curved surface.
-- TRY     file=my_apex.ply   walls=traced (every point of the mesh)   rho=4 (no pattern)   D=3 (more peaks)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.5; meshes: MorphoGraphX, Barbier de Reuille et al. 2015
local tunica = require "tunica"

local P = tunica.params {
  file = { "", "a cell mesh (PLY); left out: a small dome made here" },
  walls = { "straight", "walls between junctions: straight or traced" },
  T = { 22.5, "transport", min = 0 },
  D = { 4, "diffusion", min = 0 },
  b = { 3, "base of the allocation of PIN1", min = 1 },
  kT = { 1, "saturation of transport", min = 0 },
  rho = { 6, "production of auxin", min = 0 },
  kI = { 1, "saturation of that production", min = 0 },
  mu = { 0.5, "decay of auxin", min = 0 },
  rho_pin0 = { 0.6, "production of PIN1", min = 0 },
  rho_pin = { 0.5, "production of PIN1 for each unit of auxin", min = 0 },
  kP = { 1, "saturation of that production", min = 0 },
  mu_pin = { 1, "decay of PIN1", min = 0 },
  dt = { 0.005, "time step", min = 1e-9 },
}

-- Without a file: a sheet raised to a dome.
local function dome()
  local sheet = tunica.sheet { cells = 350, max_area = 0.75 }
  local R = 9
  sheet:deform(function(x, y) return x, y, math.sqrt(math.max(0, R ^ 2 - x ^ 2 - y ^ 2)) end)
  return sheet
end

local tissue = P.file ~= "" and tunica.load { P.file, walls = P.walls } or dome()
local scale = math.sqrt(0.5 / tissue:mean "area")
tissue:deform(function(x, y, z) return scale * x, scale * y, scale * z end)
tissue:cell { auxin = function(c) return 1 + c:uniform(-0.01, 0.01) end, pin = 0.94 }

local model = tunica.model { tissue = tissue, params = P, dt = P.dt, stop = 60 }

model:derive(function(c) c.pull = P.b ^ c.auxin end)
model:derive(function(c) c.share = c.pin / c:sum(function(n, w) return w.length * n.pull end) end)
model:derive("side", function(s) s.pin = s.cell.share * s.neighbour.pull end)

model:rate(function(c, d)
  d.auxin = P.rho / (1 + P.kI * c.auxin) - P.mu * c.auxin
  d.pin = (P.rho_pin0 + P.rho_pin * c.auxin) / (1 + P.kP * c.pin) - P.mu_pin * c.pin
end)

model:flux("auxin", function(w, a, b)
  local a_to_b = a.share * b.pull * a.auxin ^ 2 / (1 + P.kT * b.auxin ^ 2)
  local b_to_a = b.share * a.pull * b.auxin ^ 2 / (1 + P.kT * a.auxin ^ 2)
  return w.length * (P.D * (a.auxin - b.auxin) + P.T * (a_to_b - b_to_a))
end)

model:view { colour = "auxin", palette = "greens", sides = { "pin", colour = "#e02020" }, size = { 900, 820 }, every = 2 }
model:report {
  peaks = function() return (tissue:count_peaks("auxin", 5)) end,
  spacing = function() return (select(2, tissue:peaks("auxin", 5))) end,
  highest = function() return tissue:max "auxin" end,
  sides = function()
    local shares, out = tissue:statistics().shares, {}
    for n = 3, 9 do out["share_of_" .. n] = shares[n] or 0 end
    return out
  end,
  area_cv = function() return tissue:statistics().area_cv end,
  lewis = function() return tissue:statistics().lewis_slope end,
}

return model
