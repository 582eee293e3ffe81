--- A shoot apex that makes no PIN1: no primordia.
-- WHAT    without transport auxin is the same in all of the peripheral zone, below the threshold: the naked stem of the pin1 mutant.
--         NPA, which blocks transport, does the same to an apex in the midst of its spiral.
-- HOW     transport_apex with nothing of (5.8) but the decay of PIN1; or with all transport scaled down from a time on.
-- TRY     variant=npa (from the time `npa_from` on, T is scaled down to `npa_leaves`)   kI=0 (no saturation: too much auxin)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.5.3, fig. 5.12a
local tunica = require "tunica"
local shoot = require "parts.shoot"

local P = tunica.params(shoot.with({}, {
  npa_from = { 0, "when NPA is given", unit = "time", min = 0 },
  npa_leaves = { 1, "share of the transport that it leaves", min = 0, max = 1 },
  variant = { "pin1", "pin1, or npa on a wild type" },
  variants = {
    pin1 = { rho_pin0 = 0, rho_pin = 0, pin = 0, initial = 0 },
    npa = { npa_from = 8, npa_leaves = 0.05 },
  },
}))

local my = shoot.apex(P)
local model = shoot.model(my)
shoot.report(my)
if P.npa_leaves < 1 then
  model:at(P.npa_from, function() P.T = P.T * P.npa_leaves end)
end
model:report {
  highest = function() return my.tissue:max "auxin" end,
  last = function() return #my.primordia > 0 and my.primordia[#my.primordia].time + 0 or 0 end,
}

return model
