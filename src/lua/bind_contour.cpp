// SPDX-License-Identifier: MIT
// Contours: making them, and what scripts ask of them.
#include <algorithm>
#include <cmath>

#include "lua/bind_shape.h"
#include "lua/bind_tissue.h"
#include "lua/curve_files.h"
#include "shape/lstudio.h"

namespace tunica::lua {
namespace {

/// new_contour(points, degree or nil, ends or nil, name or nil)
int new_contour(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 4);
    std::vector<Vec2> points = points_at(L, 1, "a point of the contour");
    const int fits = std::max(1, std::min(3, static_cast<int>(points.size()) - 1));
    const int degree =
        lua_isnil(L, 2) ? fits : static_cast<int>(check_integer(L, 2, "'degree'", 1, BSpline::most_degree));
    const std::string word = lua_isnil(L, 3) ? "clamped" : check_string(L, 3, "'ends'");
    if (word != "open" && word != "clamped" && word != "closed")
      fail("'ends' must be one of 'open', 'clamped', 'closed', came {}{}", describe(L, 3),
           did_you_mean(word, {"open", "clamped", "closed"}));
    const Ends ends = word == "open" ? Ends::open : word == "closed" ? Ends::closed : Ends::clamped;
    BSpline spline(points, degree, ends);
    push_contour(L, Contour{lua_isnil(L, 4) ? "" : check_string(L, 4, "'name'"), std::move(points), degree, ends,
                            std::move(spline)});
    return 1;
  });
}

/// load_contour(name or file, name of one in a gallery or nil)
int load_contour(lua_State* L) {
  return guard(L, [&] {
    DrawnCurve drawn = find_curve(L, check_string(L, 1, "the name of a contour"), false,
                                  lua_isnoneornil(L, 2) ? "" : check_string(L, 2, "'item'"));
    BSpline spline = drawn.contour();
    push_contour(L, Contour{drawn.name, std::move(drawn.points), 3, drawn.ends, std::move(spline)});
    return 1;
  });
}

int contour_points(lua_State* L) {
  return guard(L, [&] {
    const Contour& c = contour_at(L, 1);
    push_points(L, c.points);
    lua_pushinteger(L, c.degree);
    lua_pushstring(L, c.ends == Ends::open ? "open" : c.ends == Ends::closed ? "closed" : "clamped");
    return 3;
  });
}

/// contour_at(contour, share of its parameter from 0 to 1) -> x, y, tangent x, tangent y
int contour_place(lua_State* L) {
  return guard(L, [&] {
    const BSpline& s = contour_at(L, 1).spline;
    const double u = s.begin() + check_number(L, 2, "'u'") * (s.end() - s.begin());
    const Vec2 p = s.at(u), t = s.direction(u);
    for (const double value : {p.x(), p.y(), t.x(), t.y()}) lua_pushnumber(L, value);
    return 4;
  });
}

const ArcLength& measured(const Contour& c) {
  if (!c.measured) c.measured = std::make_shared<const ArcLength>(c.spline);
  return *c.measured;
}

/// The arc length at a stack index: of a closed contour any, as a place from 0 to its length.
double arc_at(lua_State* L, int at, const Contour& c) {
  const double s = check_number(L, at, "'s'"), length = measured(c).length();
  if (c.ends == Ends::closed) {
    const double within = s - length * std::floor(s / length);
    return std::clamp(within, 0., length);
  }
  if (!(s >= -1e-10 * length && s <= length * (1 + 1e-10)))
    fail("'s' must be an arc length from 0 to the contour's length {:.10g}, came {:.10g}", length, s);
  return std::clamp(s, 0., length);
}

int push_pair(lua_State* L, const Vec2& p) {
  lua_pushnumber(L, p.x());
  lua_pushnumber(L, p.y());
  return 2;
}

int contour_length(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, measured(contour_at(L, 1)).length());
    return 1;
  });
}

/// contour_along(contour, arc length) -> x, y
int contour_along(lua_State* L) {
  return guard(L, [&] {
    const Contour& c = contour_at(L, 1);
    return push_pair(L, measured(c).at(arc_at(L, 2, c)));
  });
}

/// contour_tangent(contour, arc length) -> x, y
int contour_tangent(lua_State* L) {
  return guard(L, [&] {
    const Contour& c = contour_at(L, 1);
    return push_pair(L, measured(c).tangent(arc_at(L, 2, c)));
  });
}

/// contour_closest(contour, x, y) -> arc length, x, y
int contour_closest(lua_State* L) {
  return guard(L, [&] {
    const ArcLength& curve = measured(contour_at(L, 1));
    const double s = curve.nearest({check_number(L, 2, "'x'"), check_number(L, 3, "'y'")}).a;
    lua_pushnumber(L, s);
    return 1 + push_pair(L, curve.at(s));
  });
}

/// contour_area(contour) -> the area within
int contour_area(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, measured(contour_at(L, 1)).area());
    return 1;
  });
}

/// contour_changed(contour, factor, reverse)
int contour_changed(lua_State* L) {
  return guard(L, [&] {
    Contour c = contour_at(L, 1);
    const double factor = check_number(L, 2, "'factor'");
    if (!(factor > 0)) fail("'factor' must be positive, came {}", describe(L, 2));
    for (Vec2& p : c.points) p *= factor;
    if (lua_toboolean(L, 3)) std::reverse(c.points.begin(), c.points.end());
    c.spline = BSpline(c.points, c.degree, c.ends);
    c.measured = nullptr;
    push_contour(L, std::move(c));
    return 1;
  });
}

int save_contour(lua_State* L) {
  return guard(L, [&] {
    const Contour& c = contour_at(L, 1);
    write_curve_file(L, check_string(L, 2, "'file'"), write_contour(c.name, c.points, c.degree, c.ends));
    return 0;
  });
}

}  // namespace

void register_contours(lua_State* L) {
  const luaL_Reg functions[] = {
      {"new_contour", new_contour},         {"load_contour", load_contour},       {"contour_points", contour_points},
      {"contour_place", contour_place},     {"contour_length", contour_length},   {"contour_along", contour_along},
      {"contour_tangent", contour_tangent}, {"contour_closest", contour_closest}, {"contour_area", contour_area},
      {"contour_changed", contour_changed}, {"save_contour", save_contour},       {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
