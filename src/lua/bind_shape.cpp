// SPDX-License-Identifier: MIT
// Contours, curves and apices as values of scripts, which never change; making and using the first two.
#include "lua/bind_shape.h"

#include <cmath>

#include "base/files.h"
#include "lua/bind_tissue.h"
#include "lua/curve_files.h"
#include "lua/symbol.h"
#include "shape/lstudio.h"

namespace tunica::lua {
namespace {

constexpr const char* straight_key = "tunica.straight";

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

/// curve(x), x a symbol of a rule: straight from point to point it is an expression, which the library makes
/// (trace_curves); any other has no closed form.
int call_with_symbol(lua_State* L) {
  const auto& [name, curve] = curve_at(L, 1);
  if (!curve.is_constant() && curve.degree() > 1)
    fail(
        "the curve{} is a B-spline of degree {}, which has no formula to be traced; with degree = 1, straight from point "
        "to "
        "point, it is traced, or call it with a number in an event and let the rule read a variable",
        named(name), curve.degree());
  lua_getfield(L, LUA_REGISTRYINDEX, straight_key);
  push_points(L, curve.points());
  lua_pushvalue(L, 2);
  lua_call(L, 2, 1);
  return 1;
}

/// trace_curves(function(points, x) that gives the straight lines between points as an expression of x)
int trace_curves(lua_State* L) {
  return guard(L, [&] {
    check_function(L, 1, "what makes expressions of curves");
    lua_settop(L, 1);
    lua_setfield(L, LUA_REGISTRYINDEX, straight_key);
    return 0;
  });
}

int call_curve(lua_State* L) {
  return guard(L, [&] {
    if (is_symbol(L, 2)) return call_with_symbol(L);
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
    const auto& [name, curve] = curve_at(L, 1);
    push_points(L, curve.points());
    lua_pushinteger(L, curve.degree());
    lua_pushlstring(L, name.data(), name.size());
    return 3;
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

void push_contour(lua_State* L, Contour contour) { push(L, std::move(contour)); }
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
  const luaL_Reg functions[] = {{"new_curve", new_curve},
                                {"load_curve", load_curve},
                                {"trace_curves", trace_curves},
                                {"curve_derivative", curve_derivative},
                                {"curve_integral", curve_integral},
                                {"curve_points", curve_points},
                                {"save_curve", save_curve},
                                {"shape_kind", kind_of_shape},
                                {nullptr, nullptr}};
  add_functions(L, functions);
  register_contours(L);
  register_apices(L);
  lua_newtable(L);
  add_type<Contour>(L, contour_text, nullptr);
  add_type<NamedCurve>(L, curve_text, call_curve);
  add_type<Apex>(L, apex_text, nullptr);
  lua_setfield(L, -2, "shape_methods");
}

}  // namespace tunica::lua
