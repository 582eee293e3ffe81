--- What the spiral of the auxin transport model depends on: four changes of its equations.
-- WHAT    each variant takes a part of the model away or changes it, with the other parameters adjusted as the thesis did: PIN1 that
--         is the same everywhere, production of auxin without saturation, a weaker power of transport, a sharper polarization.
-- HOW     as transport_apex, from ten primordia at 137.5 degrees; the angles of those that follow show whether the spiral goes on.
-- TRY     variant=fixed_pin   variant=iaa_saturation   variant=transport_power   variant=allocation_base
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.6, table 5.2
local tunica = require "tunica"
local shoot = require "parts.shoot"

local P = tunica.params(shoot.with({}, {
  variant = { "transport_power", "what is changed" },
  variants = {
    none = {},
    fixed_pin = { steady_pin = true, pin = 0.94, rho_proximal = 2.5, rho_primordium = 2.5 },
    iaa_saturation = { kI = 0, rho_proximal = 1, rho_peripheral = 0.9, rho_primordium = 1, dt = 0.025 },
    transport_power = { power = 1.5, T = 19, Th = 7, peripheral = 2.73 },
    allocation_base = { b = 4, D = 4.5, T = 22, dt = 0.025 },
  },
}))

local my = shoot.apex(P)
my.variant = P.variant  -- its row of table 5.2 goes into the plot
local model = shoot.model(my)
shoot.report(my, 20)

return model
