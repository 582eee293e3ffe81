-- SPDX-License-Identifier: MIT
--- What `require "tunica"` gives: the functions of every part of the library. A name that it lacks is an error that
-- names the nearest one.

local registry = require "tunica.registry"
local core = require "tunica.core"

-- Each part declares its operations with the registry.
for _, part in ipairs {
  "elements", "surfaces", "builders", "tissue", "shapes", "model", "phyllotaxis", "view", "plot", "phyllotaxis_view", "run",
  "pattern", "experiments",
} do
  require("tunica." .. part)
end

local names = {}
for name in pairs(registry.module) do names[#names + 1] = name end

return setmetatable({}, {
  __index = function(_, name)
    local member = registry.module[name]
    if member ~= nil then return member end
    registry.fail("tunica has no '%s'%s", tostring(name), type(name) == "string" and core.did_you_mean(name, names) or "")
  end,
  __newindex = function(_, name)
    registry.fail("'%s' cannot be set: tunica itself cannot be changed", tostring(name))
  end,
  __metatable = "tunica",
})
