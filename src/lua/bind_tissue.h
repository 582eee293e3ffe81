// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>

#include "lua/guard.h"
#include "lua/handle.h"

namespace tunica::lua {

/// The parts of register_tissue, each in its own file; each adds functions to the module on top of the stack. They are
/// called by lua/tunica/*.lua, which checks arguments for the user; they check again, so that none can crash.
void register_elements(lua_State* L);   ///< identity, neighbourhood, navigation
void register_iteration(lua_State* L);  ///< over a tissue, around a cell
void register_columns(lua_State* L);    ///< declaring, filling, summing
void register_builders(lua_State* L);   ///< tissues from nothing and from files
void register_structure(lua_State* L);  ///< removal, rows, graphs, numbering, validity
void register_division(lua_State* L);
void register_growth(lua_State* L);    ///< growth, statistics, peaks, files
void register_surfaces(lua_State* L);  ///< surfaces, growth and removal on them
void register_apex_tissue(lua_State* L);
void register_pattern(lua_State* L);  ///< patterns of primordia

/// Adds C functions to the table on top of the stack.
inline void add_functions(lua_State* L, const luaL_Reg* functions) {
  for (; functions->name; ++functions) {
    lua_pushcfunction(L, functions->func);
    lua_setfield(L, -2, functions->name);
  }
}

/// For the length of a callback: nothing may change the structure of the tissue.
class Locked {
 public:
  explicit Locked(Tissue& tissue) : tissue_(tissue), before_(tissue.locked()) { tissue_.lock(true); }
  ~Locked() { tissue_.lock(before_); }
  Locked(const Locked&) = delete;

 private:
  Tissue& tissue_;
  bool before_;
};

}  // namespace tunica::lua
