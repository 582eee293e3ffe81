--- Phyllotaxis by auxin transport on a cellular shoot apex.
-- WHAT    cells of the peripheral zone pump auxin towards neighbours that have more of it. Where two neighbours reach a threshold a
--         primordium starts; it drains its surroundings, so that the next arises where the gap is widest: a spiral, or whorls.
-- HOW     PIN1 goes to walls by their length and, exponentially, by the auxin behind them (5.7); PIN1 and auxin are made and decay
--         (5.8, 5.9). Primordia make more auxin, polarize PIN1 towards their centre (5.10, 5.11) and drain what is above a limit.
-- TRY     initial=0 (without primordia at the start)   r_most=0.89 (primordia that stay small: no spiral)   dt=0.02 (fails)
-- SOURCE  R. S. Smith, PhD thesis, University of Calgary 2007, section 5.5, figs 5.8-5.11, table 5.1
local tunica = require "tunica"
local shoot = require "parts.shoot"

local P = tunica.params(shoot.parameters())

local my = shoot.apex(P)
local model = shoot.model(my)
shoot.report(my)

return model
