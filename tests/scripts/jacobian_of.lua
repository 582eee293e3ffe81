-- SPDX-License-Identifier: MIT
-- The exact Jacobian of a shipped model (path in the environment variable MODEL) against complex steps, after a few steps.
local core = require "tunica.core"
local inside = require("tunica.model").inside
local params = require "tunica.params"
local model = dofile(os.getenv "MODEL")
if not require("tunica.model").is_model(model) then
  print "no rates"
  return
end
model:advance { to = 3 * (model:solution().dt or 0.1) }
local my = inside[model]
local error_found, entries = core.check_jacobian(my.machine, my.params and params.values(my.params) or {}, 12)
print(string.format("%.1e of %d entries", error_found, entries))
assert(error_found <= 1e-12, "the Jacobian is wrong")
