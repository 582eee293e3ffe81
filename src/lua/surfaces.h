// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lua/bind_model.h"
#include "tissue/surface.h"

namespace tunica::lua {

/// A surface as a value of the library's Lua half. What it calls in Lua, and what it lies upon, is in the environment
/// of its userdata, so that the garbage collector sees it.
struct SurfaceObject {
  std::shared_ptr<Surface> surface;
};
template <>
struct TypeName<SurfaceObject> {
  static constexpr const char* value = "tunica.surface";
};

/// Pushes a value for a surface. Its environment is the table on top of the stack, which it takes the place of.
void push_surface(lua_State* L, std::shared_ptr<Surface> surface);
/// The surface at a stack index. Operations that use it hold an Entering: it may be a script. Errors: something else.
std::shared_ptr<Surface> surface_at(lua_State* L, int at);
/// The same, or nullptr where there is nil.
std::shared_ptr<Surface> optional_surface_at(lua_State* L, int at);

}  // namespace tunica::lua
