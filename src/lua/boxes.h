// SPDX-License-Identifier: MIT
#pragma once

#include "lua/guard.h"
#include "lua/handle.h"

// What handle.cpp (making and checking) and metatables.cpp (behaviour in Lua) share; not for others.

namespace tunica::lua {

struct TissueBox {
  std::shared_ptr<Tissue> tissue;
};

/// The box outlives the handle: the environment of the handle's userdata holds it.
struct Handle {
  TissueBox* box;
  Id id;
  Index hint;  ///< where the element was when last seen; believed only if its identity is still there
  Kind kind;
};

inline constexpr int tissue_type = kinds;  ///< the types are the kinds of element, and this one
inline constexpr const char* type_names[] = {"cell", "wall", "side", "junction", "tissue"};

/// Key in the Lua registry of the table that finds the Lua value of a tissue by its address (weak).
inline const char boxes_key = 0;

/// The type of a value, or -1.
int type_of(lua_State* L, int at);
Handle* handle_at(lua_State* L, int at);  ///< nullptr: the value is no handle
Tissue& open_tissue(const TissueBox& box);
Index resolve(Handle& handle, const Tissue& tissue);          ///< none: the element is gone
Index resolve_or_fail(Handle& handle, const Tissue& tissue);  ///< errors: gone
inline std::string article(const char* noun) { return std::string("a ") + noun; }

}  // namespace tunica::lua
