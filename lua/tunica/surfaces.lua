-- SPDX-License-Identifier: MIT
--- Surfaces that tissues grow on: written in Lua, and surfaces with primordia that bulge out of them.

local core = require "tunica.core"
local registry = require "tunica.registry"
local plain = require "tunica.plain"
local op, fail = registry.op, registry.fail

local surfaces = {}

local inside = setmetatable({}, { __mode = "k" })  -- what the kernel knows of each surface
local methods, bulging = {}, {}

--- What the kernel knows of a surface: of one made here, or an apex itself; nil for any other value.
function surfaces.core_of(value)
  if inside[value] then return inside[value].core end
  return core.shape_kind(value) == "apex" and value or nil
end

local function is_surface(value) return value ~= nil and surfaces.core_of(value) ~= nil end
local function is_bulging(value) return value ~= nil and inside[value] ~= nil and inside[value].bulges == true end
surfaces.is_bulging = is_bulging
registry.type("surface", "a surface (tunica.apex, tunica.bulges or tunica.surface)", is_surface, methods)
registry.type("bulges", "a surface that bulges (tunica.bulges)", is_bulging, bulging)

local function wrap(core_object, bulges)
  local name = bulges and "a surface that bulges" or "a surface"
  local surface = setmetatable({}, {
    __metatable = "surface", __tostring = function() return name end,
    __index = function(_, key)
      local member = bulges and bulging[key] or methods[key]
      if member then return member end
      local names = {}
      for each in pairs(methods) do names[#names + 1] = each end
      for each in pairs(bulges and bulging or {}) do names[#names + 1] = each end
      fail("%s has no '%s'%s", name, tostring(key), type(key) == "string" and core.did_you_mean(key, names) or "")
    end,
    __newindex = function(_, key) fail("'%s' of %s cannot be set", tostring(key), name) end,
  })
  inside[surface] = { core = core_object, bulges = bulges }
  return surface
end

-- Written in Lua -----------------------------------------------------------------------------------------------------

local sphere = [[
local tunica = require "tunica"
local function closest(x, y, z)
  local r = math.sqrt(x * x + y * y + z * z)
  return x / r, y / r, z / r
end
local sphere = tunica.surface { closest = closest, normal = closest,
  advance = function(x, y, z, t, dt) return closest(x, y - 0.1 * dt, z) end }
]]

op { name = "tunica.surface", kind = "named", returns = "a surface", source = "thesis 10.2",
  args = {
    { name = "advance", type = "function", required = true,
      doc = "function(x, y, z, t, dt) that returns where a point of the surface will be: x, y, z" },
    { name = "closest", type = "function", required = true,
      doc = "function(x, y, z) that returns the point of the surface closest to a point in space" },
    { name = "normal", type = "function",
      doc = "function(x, y, z) that returns the direction outward there; without it, cells keep facing where they do" },
  },
  doc = "A growing surface by its two operations. It serves wherever the built-in ones do: tissue:grow { on = surface }, " ..
    "tissue:divide { ..., on = surface }.",
  fn = function(t) return wrap(core.script_surface { advance = t.advance, closest = t.closest, normal = t.normal }) end,
  example = sphere .. "print(sphere:closest(0, 3, 0))" }

local function coordinates(of)
  local list = {}
  for i, axis in ipairs { "x", "y", "z" } do
    list[i] = { name = axis, type = "number", required = true, doc = "coordinate of " .. of }
  end
  return list
end
local function coordinates_and(of, ...)
  local list = coordinates(of)
  for _, each in ipairs { ... } do list[#list + 1] = each end
  return list
end

op { name = "surface:closest", args = coordinates "a point in space", returns = "x, y, z",
  doc = "The point of the surface closest to a point.", source = "thesis 10.2",
  fn = function(self, x, y, z) return core.surface_closest(surfaces.core_of(self), x, y, z) end,
  example = sphere .. "print(sphere:closest(1, 2, 3))" }
op { name = "surface:normal", args = coordinates "a point", returns = "x, y, z, of length 1",
  doc = "The direction outward where the surface is closest to a point.",
  fn = function(self, x, y, z) return core.surface_normal(surfaces.core_of(self), x, y, z) end,
  example = sphere .. "print(sphere:normal(1, 2, 3))" }
op { name = "surface:advance", returns = "x, y, z", source = "thesis 10.2",
  args = coordinates_and("a point of the surface",
    { name = "dt", type = "number", required = true, unit = "time", doc = "how long it grows" },
    { name = "from", type = "number", default = 0, unit = "time", doc = "the time at the start" }),
  doc = "Where a point of the surface will be.",
  fn = function(self, x, y, z, dt, from) return core.surface_advance(surfaces.core_of(self), x, y, z, dt, from) end,
  example = sphere .. "print(sphere:advance(1, 0, 0, 0.5))" }

-- Bulging ------------------------------------------------------------------------------------------------------------

local bumpy = sphere .. [[
local surface = tunica.bulges { on = sphere, radius = 0.3, height = function(age) return math.min(0.1, 0.02 * age) end }
surface:add { place = { 0, 1, 0.5 }, birth = 0 }
surface:time(3)
]]

--- What a checkpoint holds of a surface that bulges: its primordia and its time.
local function keep(surface, object)
  plain.keep(surface, function()
    local time, list = core.bulges_state(object)
    return { time = time, primordia = list }
  end, function(state) core.bulges_state(object, state.time, state.primordia) end)
end

op { name = "tunica.bulges", kind = "named", returns = "a surface", source = "thesis 5.5, fig. 5.8",
  args = {
    { name = "on", type = "surface", required = true, doc = "the surface without primordia, as tunica.apex" },
    { name = "radius", type = "any", required = true, unit = "length",
      doc = "of a primordium: a number, or a curve or function of its age" },
    { name = "height", type = "any", required = true, unit = "length", doc = "of a primordium, likewise" },
  },
  doc = "A surface out of which primordia bulge. Each is carried along by the growth of the surface below; points nearer " ..
    "to its centre than its radius r are lifted along the normal by height (1 - (d/r)^2)^2. Where some overlap the highest " ..
    "counts, smoothly. The surface has a time, which tissue:grow { on = surface } moves on. A checkpoint holds its primordia " ..
    "if it is a local of the script that functions of the model use.",
  fn = function(t)
    if is_bulging(t.on) then
      fail "tunica.bulges: this surface bulges already; add the primordia to it (bulges:add), or lay both on what is below"
    end
    local object = core.bulges(surfaces.core_of(t.on), t.radius, t.height)
    local surface = wrap(object, true)
    inside[surface].base = t.on
    keep(surface, object)
    return surface
  end,
  example = bumpy .. "print(surface:closest(0, 2, 1))" }
--- The apex that a surface is or bulges out of.
function surfaces.apex_below(surface)
  while is_bulging(surface) do surface = inside[surface].base end
  return surface
end

op { name = "bulges:add", kind = "named", source = "thesis 5.5",
  args = {
    { name = "theta", type = "number", position = 1, unit = "degrees", doc = "angle of its centre on an apex" },
    { name = "a", type = "number", position = 2, min = 0, unit = "length", doc = "arc length of its centre from the tip of the apex" },
    { name = "birth", type = "number", position = 3, unit = "time", doc = "when it is born; now, if left out" },
    { name = "place", type = "vector", doc = "instead of theta and a: a point { x, y, z } of any surface" },
  },
  doc = "Adds a primordium.",
  fn = function(self, t)
    local x, y, z
    if t.place and not t.theta and not t.a then
      x, y, z = t.place[1], t.place[2], t.place[3] or 0
    elseif t.theta and t.a and not t.place then
      local base = surfaces.apex_below(self)
      if not core.is_on_apex(surfaces.core_of(base)) then
        fail("bulges:add: theta and a are places of an apex; on this surface give place = { x, y, z }")
      end
      x, y, z = base:position(t.theta, t.a)
    else
      fail("bulges:add: give theta and a, or place = { x, y, z }")
    end
    core.bulge(inside[self].core, x, y, z, t.birth or core.surface_time(inside[self].core))
  end,
  example = bumpy .. "surface:add { place = { 0, 1, -0.5 } }" }
op { name = "bulges:time", args = { { name = "t", type = "number", unit = "time", doc = "the new time; left out: it stays" } },
  doc = "The time of the surface; or sets it.", returns = "a number",
  fn = function(self, t) return (core.surface_time(inside[self].core, t)) end, example = bumpy .. "print(surface:time())" }
op { name = "bulges:list", returns = "a list of tables { which =, x =, y =, z =, radius =, height =, age = }",
  doc = "The primordia that are there now: number in the order of adding, top, radius, height and age.",
  fn = function(self) return core.bumps(inside[self].core) end, example = bumpy .. "print(surface:list()[1].radius)" }
op { name = "bulges:within", args = coordinates "a point of the surface", source = "thesis (5.10), (5.11)",
  returns = "the number of the primordium, distance from its centre / radius; nothing outside all",
  doc = "The primordium in which a point of the surface lies most deeply. Distances are on the surface without primordia.",
  fn = function(self, x, y, z) return core.bump_at(inside[self].core, x, y, z) end,
  example = bumpy .. "print(surface:within(surface:closest(0, 2, 1.1)))" }

return surfaces
