// SPDX-License-Identifier: MIT
// Surfaces that tissues grow on: written in Lua, or bulging; growth and removal on them.
#include "lua/bind_shape.h"
#include "lua/bind_tissue.h"
#include "lua/surfaces.h"
#include "shape/bulges.h"
#include "tissue/topology.h"

namespace tunica::lua {
namespace {

/// Key in the Lua registry of the table that finds the value of a surface by its address (weak).
const char surfaces_key = 0;

void push_surfaces(lua_State* L) {
  lua_pushlightuserdata(L, const_cast<char*>(&surfaces_key));
  lua_rawget(L, LUA_REGISTRYINDEX);
  if (!lua_isnil(L, -1)) return;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_newtable(L);
  lua_pushliteral(L, "v");
  lua_setfield(L, -2, "__mode");
  lua_setmetatable(L, -2);
  lua_pushlightuserdata(L, const_cast<char*>(&surfaces_key));
  lua_pushvalue(L, -2);
  lua_rawset(L, LUA_REGISTRYINDEX);
}

/// A function of a surface that is kept in its environment.
class Kept {
 public:
  Kept(Host& host, const char* name) : host_(host), name_(name) {}
  void owner(const void* surface) { owner_ = surface; }

  /// Pushes the function. @return the thread to call it on
  lua_State* push() const {
    lua_State* L = host_.active;
    if (!L) fail("a surface written in Lua can be asked only while a script runs");
    if (!lua_checkstack(L, 16)) fail("too many nested calls");
    push_surfaces(L);
    lua_pushlightuserdata(L, const_cast<void*>(owner_));
    lua_rawget(L, -2);
    if (lua_isnil(L, -1)) fail("the surface is gone");
    lua_getfenv(L, -1);
    lua_getfield(L, -1, name_);
    lua_insert(L, -4);
    lua_pop(L, 3);
    return L;
  }

  Vec3 vector(const Vec3& p, std::initializer_list<double> more = {}) const {
    lua_State* L = push();
    const int top = lua_gettop(L);
    lua_pushvalue(L, top);
    for (const double x : {p.x(), p.y(), p.z()}) lua_pushnumber(L, x);
    for (const double x : more) lua_pushnumber(L, x);
    call(L, 3 + static_cast<int>(more.size()), 3);
    Vec3 result = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      result[axis] = lua_type(L, top + 1 + axis) == LUA_TNUMBER ? lua_tonumber(L, top + 1 + axis) : NAN;
      if (!std::isfinite(result[axis])) refuse(L, top, "three finite numbers x, y, z", top + 1 + axis);
    }
    lua_settop(L, top - 1);
    return result;
  }

  double number(double x) const {
    lua_State* L = push();
    const int top = lua_gettop(L);
    lua_pushvalue(L, top);
    lua_pushnumber(L, x);
    call(L, 1, 1);
    const double result = lua_type(L, top + 1) == LUA_TNUMBER ? lua_tonumber(L, top + 1) : NAN;
    if (!std::isfinite(result)) refuse(L, top, "a finite number", top + 1);
    lua_settop(L, top - 1);
    return result;
  }

 private:
  [[noreturn]] void refuse(lua_State* L, int function, const char* wanted, int came) const {
    std::string place;
    if (lua_isfunction(L, function)) {
      lua_Debug about;
      lua_pushvalue(L, function);
      lua_getinfo(L, ">S", &about);
      place = fmt::format(" ({}:{})", about.short_src, about.linedefined);
    }
    fail("the function '{}' of a surface{} must return {}; came {}", name_, place, wanted, describe(L, came));
  }

  Host& host_;
  const char* name_;
  const void* owner_ = nullptr;
};

/// A surface whose operations are functions of a script.
class ScriptSurface : public Surface {
 public:
  ScriptSurface(Host& host, bool has_normal)
      : has_normal_(has_normal), advance_(host, "advance"), closest_(host, "closest"), normal_(host, "normal") {
    for (Kept* each : {&advance_, &closest_, &normal_}) each->owner(this);
  }
  Vec3 advance(const Vec3& p, double t, double dt) const override { return advance_.vector(p, {t, dt}); }
  Vec3 closest(const Vec3& p) const override { return closest_.vector(p); }
  bool has_outside() const override { return has_normal_; }
  Vec3 normal(const Vec3& p) const override {
    if (!has_normal_) fail("the surface has no 'normal'");
    const Vec3 n = normal_.vector(p);
    const double length = n.norm();
    if (!(length > 0)) fail("the normal of a surface must have a length, came (0, 0, 0)");
    return n / length;
  }

 private:
  bool has_normal_;
  Kept advance_, closest_, normal_;
};

/// script_surface({ advance =, closest =, normal = or nil }) -> surface
int script_surface(lua_State* L) {
  return guard(L, [&] {
    check_table(L, 1, "the functions of a surface");
    lua_newtable(L);
    bool has_normal = false;
    for (const char* name : {"advance", "closest", "normal"}) {
      lua_getfield(L, 1, name);
      if (lua_isnil(L, -1) && std::string_view(name) == "normal") {
        lua_pop(L, 1);
        continue;
      }
      check_function(L, -1, fmt::format("'{}'", name).c_str());
      has_normal = std::string_view(name) == "normal";
      lua_setfield(L, -2, name);
    }
    push_surface(L, std::make_shared<ScriptSurface>(host(L), has_normal));
    return 1;
  });
}

Bulges& bulges_at(lua_State* L, int at) {
  const auto found = std::dynamic_pointer_cast<Bulges>(surface_at(L, at));
  if (!found) fail("expected a surface that bulges, came {}", describe(L, at));
  return *found;
}

/// bulges(base, radius, height) -> surface; radius and height: numbers, or what can be called with an age
int make_bulges(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 3);
    auto base = surface_at(L, 1);
    lua_newtable(L);
    lua_pushvalue(L, 1);
    lua_setfield(L, 4, "base");
    const auto kept =
        std::make_shared<std::array<Kept, 2>>(std::array{Kept(host(L), "radius"), Kept(host(L), "height")});
    Bulges::OfAge of_age[2];
    for (int i = 0; i < 2; ++i) {
      if (lua_type(L, 2 + i) == LUA_TNUMBER) {
        of_age[i] = [value = check_number(L, 2 + i, i == 0 ? "'radius'" : "'height'")](double) { return value; };
        continue;
      }
      if (const char* kind = shape_kind(L, 2 + i); kind && std::string_view(kind) == "curve") {
        of_age[i] = [curve = curve_at(L, 2 + i).curve](double age) { return curve(age); };
        continue;
      }
      if (!lua_isfunction(L, 2 + i) && !luaL_getmetafield(L, 2 + i, "__call"))
        fail("'{}' must be a number, or a curve or function of age, came {}", i == 0 ? "radius" : "height",
             describe(L, 2 + i));
      lua_settop(L, 4);
      lua_pushvalue(L, 2 + i);
      lua_setfield(L, 4, i == 0 ? "radius" : "height");
      of_age[i] = [kept, i](double age) { return (*kept)[static_cast<size_t>(i)].number(age); };
    }
    auto surface = std::make_shared<Bulges>(std::move(base), of_age[0], of_age[1]);
    for (Kept& each : *kept) each.owner(surface.get());
    push_surface(L, std::move(surface));
    return 1;
  });
}

Vec3 point_at(lua_State* L, int from) {
  return {check_number(L, from, "'x'"), check_number(L, from + 1, "'y'"), check_number(L, from + 2, "'z'")};
}

int push_point(lua_State* L, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) lua_pushnumber(L, p[axis]);
  return 3;
}

/// bulge(surface, x, y, z, birth)
int bulge(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    bulges_at(L, 1).add(point_at(L, 2), check_number(L, 5, "'birth'"));
    return 0;
  });
}

/// bulges_state(surface) -> time, flat list of x, y, z, birth;  bulges_state(surface, time, list) sets them
int bulges_state(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    Bulges& surface = bulges_at(L, 1);
    if (lua_gettop(L) > 1) {
      const double time = check_number(L, 2, "the time of a surface");
      check_table(L, 3, "the primordia of a surface");
      std::vector<Bulges::Primordium> list;
      const auto field = [&](size_t at) {
        lua_rawgeti(L, 3, static_cast<int>(at));
        const double value = check_number(L, -1, "a primordium's place or birth");
        lua_pop(L, 1);
        return value;
      };
      for (size_t i = 1; i + 3 <= lua_objlen(L, 3); i += 4)
        list.push_back({{field(i), field(i + 1), field(i + 2)}, field(i + 3)});
      surface.set_primordia({});
      surface.set_time(time);
      surface.set_primordia(std::move(list));
      return 0;
    }
    lua_pushnumber(L, surface.time());
    lua_createtable(L, static_cast<int>(4 * surface.primordia().size()), 0);
    int at = 0;
    for (const Bulges::Primordium& each : surface.primordia())
      for (const double value : {each.place.x(), each.place.y(), each.place.z(), each.birth}) {
        lua_pushnumber(L, value);
        lua_rawseti(L, -2, ++at);
      }
    return 2;
  });
}

/// surface_time(surface[, t]) -> time
int surface_time(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    Bulges& surface = bulges_at(L, 1);
    if (!lua_isnoneornil(L, 2)) surface.set_time(check_number(L, 2, "'time'"));
    lua_pushnumber(L, surface.time());
    return 1;
  });
}

void set_field(lua_State* L, const char* name, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, name);
}

/// bumps(surface) -> list of { which, x, y, z, radius, height, age }
int bumps(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    const Bulges& surface = bulges_at(L, 1);
    lua_newtable(L);
    int at = 0;
    for (const Bulges::Bump& bump : surface.bumps()) {
      lua_newtable(L);
      set_field(L, "which", static_cast<double>(bump.which + 1));
      set_field(L, "age", surface.time() - surface.primordia()[bump.which].birth);
      set_field(L, "radius", bump.radius);
      set_field(L, "height", bump.height);
      const Vec3 top = surface.lifted(bump.centre);
      set_field(L, "x", top.x());
      set_field(L, "y", top.y());
      set_field(L, "z", top.z());
      lua_rawseti(L, -2, ++at);
    }
    return 1;
  });
}

/// bump_at(surface, x, y, z) -> number of the primordium, distance from its centre / radius; or nothing
int bump_at(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    double fraction = 0;
    const Bulges::Bump* found = bulges_at(L, 1).bump_at(point_at(L, 2), &fraction);
    if (!found) return 0;
    lua_pushnumber(L, static_cast<double>(found->which + 1));
    lua_pushnumber(L, fraction);
    return 2;
  });
}

/// differentiate(tissue, surface)
int differentiate_cells(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    differentiate(tissue_at(L, 1), bulges_at(L, 2));
    return 0;
  });
}

/// surface_closest(surface, x, y, z) -> x, y, z
int surface_closest(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    return push_point(L, surface_at(L, 1)->closest(point_at(L, 2)));
  });
}

int surface_normal(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    return push_point(L, surface_at(L, 1)->normal(point_at(L, 2)));
  });
}

/// surface_advance(surface, x, y, z, dt, t) -> x, y, z
int surface_advance(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    const double dt = check_number(L, 5, "'dt'"), t = check_number(L, 6, "'t'");
    return push_point(L, surface_at(L, 1)->advance(point_at(L, 2), t, dt));
  });
}

/// grow_on(tissue, surface, duration, from or nil)
int grow_on(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 4);
    Tissue& tissue = tissue_at(L, 1);
    require_changeable(tissue);
    const auto surface = surface_at(L, 2);
    const double duration = check_number(L, 3, "'time'");
    const Entering entering(L);
    const auto bulging = std::dynamic_pointer_cast<Bulges>(surface);
    if (!bulging) {
      grow(tissue, *surface, lua_isnil(L, 4) ? 0 : check_number(L, 4, "'from'"), duration);
      return 0;
    }
    if (!lua_isnil(L, 4)) bulging->set_time(check_number(L, 4, "'from'"));
    grow(tissue, *bulging, duration);
    return 0;
  });
}

/// remove_cells(tissue, where) -> number; where: function(cell) that returns true for those that go
int remove_where(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 2);
    Tissue& tissue = tissue_at(L, 1);
    require_changeable(tissue);
    check_function(L, 2, "'where'");
    const Entering entering(L);
    std::vector<Id> gone;
    {
      const Locked lock(tissue);
      for (Index c = 0; c < tissue.cells(); ++c) {
        lua_pushvalue(L, 2);
        push_element(L, 1, Kind::cell, c);
        call(L, 1, 1);
        if (lua_toboolean(L, -1)) gone.push_back(tissue.id(Kind::cell, c));
        lua_pop(L, 1);
      }
    }
    lua_pushnumber(L, static_cast<double>(gone.size()));
    remove_cells(tissue, std::move(gone));
    return 1;
  });
}

}  // namespace

void push_surface(lua_State* L, std::shared_ptr<Surface> surface) {
  const void* address = surface.get();
  push_object(L, std::make_unique<SurfaceObject>(SurfaceObject{std::move(surface)}));
  lua_insert(L, -2);
  lua_setfenv(L, -2);
  push_surfaces(L);
  lua_pushlightuserdata(L, const_cast<void*>(address));
  lua_pushvalue(L, -3);
  lua_rawset(L, -3);
  lua_pop(L, 1);
}

std::shared_ptr<Surface> surface_at(lua_State* L, int at) {
  const char* kind = shape_kind(L, at);
  if (kind && std::string_view(kind) == "apex") return std::make_shared<Apex>(apex_at(L, at));
  return object_at<SurfaceObject>(L, at).surface;
}

std::shared_ptr<Surface> optional_surface_at(lua_State* L, int at) {
  return lua_isnoneornil(L, at) ? nullptr : surface_at(L, at);
}

void register_surfaces(lua_State* L) {
  const luaL_Reg functions[] = {{"script_surface", script_surface},
                                {"bulges", make_bulges},
                                {"bulge", bulge},
                                {"bulges_state", bulges_state},
                                {"surface_time", surface_time},
                                {"bumps", bumps},
                                {"bump_at", bump_at},
                                {"surface_closest", surface_closest},
                                {"surface_normal", surface_normal},
                                {"surface_advance", surface_advance},
                                {"differentiate", differentiate_cells},
                                {"grow_on", grow_on},
                                {"remove_cells", remove_where},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
