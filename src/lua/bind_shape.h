// SPDX-License-Identifier: MIT
#pragma once

#include "lua/guard.h"
#include "lua/handle.h"
#include "shape/apex.h"

namespace tunica::lua {

/// A planar curve as scripts hold it: what it was drawn from, and the B-spline.
struct Contour {
  std::string name;
  std::vector<Vec2> points;
  int degree;
  Ends ends;
  BSpline spline;
  mutable std::shared_ptr<const ArcLength> measured = nullptr;  ///< by arc length; made when first asked for
};

/// A function of one variable as scripts hold it.
struct NamedCurve {
  std::string name;
  Curve curve;
};

/// Adds the functions of curves and apices to the module on top of the stack.
void register_shapes(lua_State* L);
void register_contours(lua_State* L);  ///< the part of it in bind_contour.cpp
void register_apices(lua_State* L);    ///< the part of it in bind_apex.cpp
int apex_text(lua_State* L);           ///< __tostring of an apex
/// Notes where the shipped curves are, beside the library (share/curves in the sources).
void set_curves_folder(lua_State* L, const std::string& library);

/// What a value is, in a word ("contour", "curve", "apex"), or nullptr.
const char* shape_kind(lua_State* L, int at);
/// The object at a stack index. Errors: something else.
const Contour& contour_at(lua_State* L, int at);
const NamedCurve& curve_at(lua_State* L, int at);
const Apex& apex_at(lua_State* L, int at);
void push_contour(lua_State* L, Contour contour);
void push_apex(lua_State* L, Apex apex);

/// Pushes a list of { x, y }.
void push_points(lua_State* L, const std::vector<Vec2>& points);
/// Reads a list of { x, y } at a stack index. Errors: what is none, with its number.
std::vector<Vec2> points_at(lua_State* L, int at, const char* what);

}  // namespace tunica::lua
