// SPDX-License-Identifier: MIT
// Contours, curves and apices as values of scripts, which never change; making and using the first two.
#include "lua/bind_shape.h"

#include <cmath>

#include "base/files.h"
#include "lua/bind_tissue.h"
#include "lua/curve_files.h"
#include "shape/lstudio.h"

namespace tunica::lua {
namespace {

template <class T>
struct Type;
template <>
struct Type<Contour> {
  static constexpr const char *name = "contour", *key = "tunica.contour", *article = "a contour";
};
template <>
struct Type<NamedCurve> {
  static constexpr const char *name = "curve", *key = "tunica.curve", *article = "a curve";
};
template <>
struct Type<Apex> {
  static constexpr const char *name = "apex", *key = "tunica.apex", *article = "an apex";
};

template <class T>
const T* peek(lua_State* L, int at) {
  if (lua_type(L, at) != LUA_TUSERDATA || !lua_getmetatable(L, at)) return nullptr;
  luaL_getmetatable(L, Type<T>::key);
  const bool same = lua_rawequal(L, -1, -2);
  lua_pop(L, 2);
  return same ? static_cast<const T*>(lua_touserdata(L, at)) : nullptr;
}

template <class T>
const T& object_at(lua_State* L, int at) {
  const T* object = peek<T>(L, at);
  if (!object) fail("expected {}, came {}", Type<T>::article, describe(L, at));
  return *object;
}

template <class T>
int push(lua_State* L, T object) {
  new (lua_newuserdata(L, sizeof(T))) T(std::move(object));
  luaL_getmetatable(L, Type<T>::key);
  lua_setmetatable(L, -2);
  return 1;
}

template <class T>
int collect(lua_State* L) {
  static_cast<T*>(lua_touserdata(L, 1))->~T();
  return 0;
}

/// object.name: a method, else an error that names the nearest.
template <class T>
int index(lua_State* L) {
  return guard(L, [&] {
    lua_pushvalue(L, 2);
    lua_rawget(L, lua_upvalueindex(1));
    if (!lua_isnil(L, -1)) return 1;
    std::vector<std::string> names;
    for (lua_pushnil(L); lua_next(L, lua_upvalueindex(1)); lua_pop(L, 1))
      if (lua_type(L, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -2));
    if (lua_type(L, 2) != LUA_TSTRING) fail("{} has no {}", Type<T>::article, describe(L, 2));
    const std::string name = check_string(L, 2, "a name");
    fail("{} has no '{}'{}", Type<T>::article, name.substr(0, 100), did_you_mean(name, names));
    return 0;
  });
}

template <class T>
int refuse_setting(lua_State* L) {
  return guard(L, [&]() -> int { fail("{} cannot be changed; make another", Type<T>::article); });
}

void push_sentence(lua_State* L, const std::string& text) { lua_pushlstring(L, text.data(), text.size()); }

/// A name in words: " 'dome'", or "".
std::string named(const std::string& name) { return name.empty() ? "" : " '" + name + "'"; }

int contour_text(lua_State* L) {
  return guard(L, [&] {
    const Contour& c = contour_at(L, 1);
    push_sentence(L, fmt::format("contour{} of {} points, degree {}", named(c.name), c.points.size(), c.degree));
    return 1;
  });
}

int curve_text(lua_State* L) {
  return guard(L, [&] {
    const auto& [name, curve] = curve_at(L, 1);
    if (curve.is_constant())
      push_sentence(L, fmt::format("curve{}, {:.6g} everywhere", named(name), curve(0)));
    else
      push_sentence(L, fmt::format("curve{} from x = {:.6g} to {:.6g}, values {:.4g} to {:.4g}", named(name),
                                   curve.first(), curve.last(), curve.least(), curve.greatest()));
    return 1;
  });
}

// === Contours

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
    return push(L, Contour{lua_isnil(L, 4) ? "" : check_string(L, 4, "'name'"), std::move(points), degree, ends,
                           std::move(spline)});
  });
}

/// load_contour(name or file, name of one in a gallery or nil)
int load_contour(lua_State* L) {
  return guard(L, [&] {
    DrawnCurve drawn = find_curve(L, check_string(L, 1, "the name of a contour"), false,
                                  lua_isnoneornil(L, 2) ? "" : check_string(L, 2, "'item'"));
    BSpline spline = drawn.contour();
    return push(L, Contour{drawn.name, std::move(drawn.points), 3, drawn.ends, std::move(spline)});
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
    return push(L, std::move(c));
  });
}

int save_contour(lua_State* L) {
  return guard(L, [&] {
    const Contour& c = contour_at(L, 1);
    write_curve_file(L, check_string(L, 2, "'file'"), write_contour(c.name, c.points, c.degree, c.ends));
    return 0;
  });
}

// === Functions

/// new_curve(points, degree, name or nil)
int new_curve(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 3);
    std::vector<Vec2> points = points_at(L, 1, "a point of the curve");
    const int degree = lua_isnil(L, 2) ? 3 : static_cast<int>(check_integer(L, 2, "'degree'", 1, Curve::most_degree));
    return push(L, NamedCurve{lua_isnil(L, 3) ? "" : check_string(L, 3, "'name'"), Curve(std::move(points), degree)});
  });
}

int load_curve(lua_State* L) {
  return guard(L, [&] {
    const DrawnCurve drawn = find_curve(L, check_string(L, 1, "the name of a curve"), true,
                                        lua_isnoneornil(L, 2) ? "" : check_string(L, 2, "'item'"));
    return push(L, NamedCurve{drawn.name, drawn.function()});
  });
}

int call_curve(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, curve_at(L, 1).curve(check_number(L, 2, "'x'")));
    return 1;
  });
}

int curve_derivative(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, curve_at(L, 1).curve.derivative(check_number(L, 2, "'x'")));
    return 1;
  });
}

int curve_integral(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, curve_at(L, 1).curve.integral(check_number(L, 2, "'from'"), check_number(L, 3, "'to'")));
    return 1;
  });
}

int curve_points(lua_State* L) {
  return guard(L, [&] {
    const Curve& curve = curve_at(L, 1).curve;
    push_points(L, curve.points());
    lua_pushinteger(L, curve.degree());
    return 2;
  });
}

int save_curve(lua_State* L) {
  return guard(L, [&] {
    const auto& [name, curve] = curve_at(L, 1);
    write_curve_file(L, check_string(L, 2, "'file'"), write_function(name, curve));
    return 0;
  });
}

/// shape_kind(value) -> "contour", "curve", "apex" or nil
int kind_of_shape(lua_State* L) {
  const char* kind = lua_gettop(L) > 0 ? shape_kind(L, 1) : nullptr;
  if (kind)
    lua_pushstring(L, kind);
  else
    lua_pushnil(L);
  return 1;
}

/// The table on top gets `name`: the empty table of methods that scripts reach through the type's metatable.
template <class T>
void add_type(lua_State* L, lua_CFunction text, lua_CFunction call) {
  lua_newtable(L);
  luaL_newmetatable(L, Type<T>::key);
  lua_pushvalue(L, -2);
  lua_pushcclosure(L, index<T>, 1);
  lua_setfield(L, -2, "__index");
  const luaL_Reg events[] = {{"__newindex", refuse_setting<T>},
                             {"__gc", collect<T>},
                             {"__tostring", text},
                             {"__call", call},
                             {nullptr, nullptr}};
  add_functions(L, events);
  lua_pushstring(L, Type<T>::name);
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);
  lua_setfield(L, -2, Type<T>::name);
}

}  // namespace

const Contour& contour_at(lua_State* L, int at) { return object_at<Contour>(L, at); }
const NamedCurve& curve_at(lua_State* L, int at) { return object_at<NamedCurve>(L, at); }
const Apex& apex_at(lua_State* L, int at) { return object_at<Apex>(L, at); }

void push_apex(lua_State* L, Apex apex) { push(L, std::move(apex)); }

const char* shape_kind(lua_State* L, int at) {
  if (peek<Contour>(L, at)) return Type<Contour>::name;
  if (peek<NamedCurve>(L, at)) return Type<NamedCurve>::name;
  return peek<Apex>(L, at) ? Type<Apex>::name : nullptr;
}

void push_points(lua_State* L, const std::vector<Vec2>& points) {
  lua_createtable(L, static_cast<int>(points.size()), 0);
  for (size_t i = 0; i < points.size(); ++i) {
    lua_createtable(L, 2, 0);
    for (int axis = 0; axis < 2; ++axis) {
      lua_pushnumber(L, points[i][axis]);
      lua_rawseti(L, -2, axis + 1);
    }
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
}

std::vector<Vec2> points_at(lua_State* L, int at, const char* what) {
  check_table(L, at, "a list of points");
  std::vector<Vec2> points(lua_objlen(L, at));
  if (points.size() > BSpline::most_points) fail("at most {} points, not {}", BSpline::most_points, points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    lua_rawgeti(L, at, static_cast<int>(i) + 1);
    if (lua_type(L, -1) != LUA_TTABLE || lua_objlen(L, -1) != 2)
      fail("{} must be {{ x, y }}; item {} is {}", what, i + 1, describe(L, -1));
    for (int axis = 0; axis < 2; ++axis) {
      lua_rawgeti(L, -1, axis + 1);
      points[i][axis] = check_number(L, -1, what);
      lua_pop(L, 1);
    }
    lua_pop(L, 1);
  }
  return points;
}

void register_shapes(lua_State* L) {
  const luaL_Reg functions[] = {{"new_contour", new_contour},
                                {"load_contour", load_contour},
                                {"contour_points", contour_points},
                                {"contour_place", contour_place},
                                {"contour_length", contour_length},
                                {"contour_along", contour_along},
                                {"contour_tangent", contour_tangent},
                                {"contour_closest", contour_closest},
                                {"contour_area", contour_area},
                                {"contour_changed", contour_changed},
                                {"save_contour", save_contour},
                                {"new_curve", new_curve},
                                {"load_curve", load_curve},
                                {"curve_derivative", curve_derivative},
                                {"curve_integral", curve_integral},
                                {"curve_points", curve_points},
                                {"save_curve", save_curve},
                                {"shape_kind", kind_of_shape},
                                {nullptr, nullptr}};
  add_functions(L, functions);
  register_apices(L);
  lua_newtable(L);
  add_type<Contour>(L, contour_text, nullptr);
  add_type<NamedCurve>(L, curve_text, call_curve);
  add_type<Apex>(L, apex_text, nullptr);
  lua_setfield(L, -2, "shape_methods");
}

}  // namespace tunica::lua
