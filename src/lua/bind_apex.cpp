// SPDX-License-Identifier: MIT
// What scripts ask of an apex. Angles are in degrees there, in radians here.
#include <cmath>

#include "lua/bind_shape.h"
#include "lua/bind_tissue.h"

namespace tunica::lua {
namespace {

/// The profile at `at`: a contour, or a list { radius of a cap, its slope at the end in degrees, length }.
Profile profile_at(lua_State* L, int at) {
  if (lua_type(L, at) != LUA_TTABLE) return Profile(contour_at(L, at).spline);
  double cap[3];
  for (int i = 0; i < 3; ++i) {
    lua_rawgeti(L, at, i + 1);
    cap[i] = lua_tonumber(L, -1);
    lua_pop(L, 1);
  }
  return Profile::cap(cap[0], cap[1] * M_PI / 180, cap[2]);
}

/// new_apex(contour or cap, growth: curve or number) -> apex, the least rate of growth, and where it is; the last two only
/// if the rate is negative somewhere
int new_apex(lua_State* L) {
  return guard(L, [&] {
    Profile profile = profile_at(L, 1);
    Curve growth =
        lua_type(L, 2) == LUA_TNUMBER ? Curve::constant(check_number(L, 2, "'growth'")) : curve_at(L, 2).curve;
    push_apex(L, Apex(std::move(profile), std::move(growth)));
    const Apex& apex = apex_at(L, -1);
    if (!apex.shrinks()) return 1;
    lua_pushnumber(L, apex.growth().least());
    lua_pushnumber(L, apex.growth().least_at());
    return 3;
  });
}

constexpr double degree = M_PI / 180;

int push_vector(lua_State* L, const Vec3& p) {
  for (const double value : {p.x(), p.y(), p.z()}) lua_pushnumber(L, value);
  return 3;
}

Vec3 place_on_stack(lua_State* L, int at) {
  return {check_number(L, at, "'x'"), check_number(L, at + 1, "'y'"), check_number(L, at + 2, "'z'")};
}

int apex_position(lua_State* L) {
  return guard(L, [&] {
    const double theta = check_number(L, 2, "'theta'"), a = check_number(L, 3, "'a'");
    return push_vector(L, apex_at(L, 1).position(theta * degree, a));
  });
}

int apex_normal(lua_State* L) {
  return guard(L, [&] {
    const double theta = check_number(L, 2, "'theta'"), a = check_number(L, 3, "'a'");
    return push_vector(L, apex_at(L, 1).normal(Apex::Place{theta * degree, a}));
  });
}

int apex_closest(lua_State* L) {
  return guard(L, [&] {
    const Apex::Place place = apex_at(L, 1).place_of(place_on_stack(L, 2));
    lua_pushnumber(L, place.theta / degree);
    lua_pushnumber(L, place.a);
    return 2;
  });
}

int apex_after(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, apex_at(L, 1).after(check_number(L, 2, "'a'"), check_number(L, 3, "'dt'")));
    return 1;
  });
}

/// A function of the apex and one number.
template <auto value>
int apex_number(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, value(apex_at(L, 1), check_number(L, 2, "the argument")));
    return 1;
  });
}

double speed_of(const Apex& apex, double a) { return apex.speed(a); }
double growth_of(const Apex& apex, double a) { return apex.growth()(a); }
double area_of(const Apex& apex, double a) { return apex.area(a); }
double arc_of(const Apex& apex, double r) { return apex.profile().arc_at_radius(r); }

/// apex_profile(apex, a) -> x, y, tangent x, tangent y
int apex_profile(lua_State* L) {
  return guard(L, [&] {
    const double a = check_number(L, 2, "'a'");
    const Profile& profile = apex_at(L, 1).profile();
    const Vec2 p = profile.at(a), t = profile.tangent(a);
    for (const double x : {p.x(), p.y(), t.x(), t.y()}) lua_pushnumber(L, x);
    return 4;
  });
}

/// apex_measures(apex) -> length of the profile, widest radius, radius of the hole
int apex_measures(lua_State* L) {
  return guard(L, [&] {
    const Profile& p = apex_at(L, 1).profile();
    for (const double x : {p.length(), p.widest(), p.hole()}) lua_pushnumber(L, x);
    return 3;
  });
}

}  // namespace

int apex_text(lua_State* L) {
  return guard(L, [&] {
    const Profile& p = apex_at(L, 1).profile();
    const std::string words =
        fmt::format("apex with a profile of length {:.6g}, radius up to {:.6g}{}", p.length(), p.widest(),
                    p.has_hole() ? fmt::format(", a hole of radius {:.6g} at the tip", p.hole()) : "");
    lua_pushlstring(L, words.data(), words.size());
    return 1;
  });
}

void register_apices(lua_State* L) {
  const luaL_Reg functions[] = {{"new_apex", new_apex},
                                {"apex_position", apex_position},
                                {"apex_normal", apex_normal},
                                {"apex_closest", apex_closest},
                                {"apex_after", apex_after},
                                {"apex_speed", apex_number<speed_of>},
                                {"apex_growth", apex_number<growth_of>},
                                {"apex_area", apex_number<area_of>},
                                {"apex_arc_at_radius", apex_number<arc_of>},
                                {"apex_profile", apex_profile},
                                {"apex_measures", apex_measures},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
