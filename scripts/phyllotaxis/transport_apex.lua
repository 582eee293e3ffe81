--- Phyllotaxis by auxin transport on a cellular shoot apex.
-- WHAT    cells of the peripheral zone pump auxin towards neighbours that have more of it. Where two neighbours reach a threshold a
--         primordium starts; it drains its surroundings, so that the next arises where the gap is widest: a spiral, or whorls.
-- HOW     PIN1 goes to walls by their length and, exponentially, by the auxin behind them (5.7); PIN1 and auxin are made and decay
--         (5.8, 5.9). Primordia make more auxin, polarize PIN1 towards their centre (5.10, 5.11) and drain what is above a limit.
-- TRY     variant=fine (54 cells around in place of 24: the spiral lasts)   variant=distichous   variant=decussate
--         variant=tricussate   variant=seedling --until 85 (from no primordia, on an apex that grows up: pairs, on some
--         seeds then a spiral)   initial=0 (no primordia at the start)
--         r_birth=0.5 r_most=0.6 (primordia that stay small: no spiral)   scatter=8 (a disturbed start)
--         method=euler dt=0.02 (fails)   height=0.5 (primordia bulge)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.5, figs 5.8-5.11, table 5.1
local tunica = require "tunica"
local shoot = require "parts.shoot"

local P = tunica.params(shoot.with({}, {
  variant = { "fibonacci", "the pattern: fibonacci, distichous, decussate, tricussate; fine, a spiral of more cells that lasts; " ..
    "seedling, from none" },
  variants = {
    fibonacci = {},
    fine = { radius = 1.936, slope = 63.18, growth = 0.06789, growth_tip = 2.544, growth_to = 1.245, growth_over = 0.427,
      central = 3.248, peripheral = 3.124, max_area = 0.17, mu = 0.6017, kI = 0.0645, kT = 1.387, most = 29.46, rho_pin0 = 11,
      rho_pin = 0.956, kP = 2.095, mu_pin = 4.402, r_birth = 1.902, r_rate = 0.6237, r_most = 2.71, first = 0.3538, dt = 0.02 },
    seedling = { radius = 1.762, slope = 71.1, growth = 0.05449, growth_tip = 3.081, growth_to = 1.232, growth_over = 0.5427,
      central = 3.892, peripheral = 2.984, max_area = 0.1678, mu = 0.5725, kI = 0.04893, kT = 1.825, most = 23.63,
      rho_pin0 = 11.62, rho_pin = 0.8687, kP = 2.026, mu_pin = 4.703, r_birth = 2.46, r_rate = 0.4547, r_most = 2.485,
      young = 0.35, growing_up = 22, onset = 15, initial = 0, auxin = 0, dt = 0.02 },
    distichous = { angle = 180, initial = 6, plastochron = 4, radius = 0.9, central = 0.95, growth = 0.11,
      growth_to = 1.26, r_most = 2.3, dt = 0.025 },
    decussate = { jugacy = 2, angle = 90, initial = 8, plastochron = 3, b = 4.171, radius = 1.949, central = 2.275, growth = 0.109,
      growth_tip = 1.366, growth_to = 2.802, r_most = 2.122, r_rate = 1.262, mu = 0.2301, kI = 0.359, most = 15.99, rho_pin0 = 2.52,
      slope = 75.12, dt = 0.025 },
    tricussate = { jugacy = 3, angle = 60, initial = 12, plastochron = 3, b = 5.159, radius = 3.961, central = 3.445,
      peripheral = 3.062, growth = 0.0816, growth_tip = 1.573, growth_to = 4.207, growth_over = 0.2574, r_birth = 1.066,
      r_most = 2.767, r_rate = 2.418, mu = 0.2094, kI = 0.2797, kT = 1.23, kP = 1.105, most = 21.27, rho_pin0 = 2.195,
      rho_pin = 0.4482, mu_pin = 1.712, slope = 64.95, first = 0.3497, max_area = 0.1802, dt = 0.02 },
  },
}))

local my = shoot.apex(P)
local model = shoot.model(my)
shoot.report(my)

return model
