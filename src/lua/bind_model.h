// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lua/bind_tissue.h"
#include "lua/symbol.h"

namespace tunica::lua {

/// Rules of a model, traced or to be run directly, before they are bound.
struct Rules {
  std::shared_ptr<Tissue> tissue;
  std::shared_ptr<Equations> equations = std::make_shared<Equations>();
  Tracer tracer{equations, tissue};
  struct Traced {
    std::string what;  ///< "derive", "rate" or "flux"
    Kind kind;
    std::vector<Target> targets;
  };
  std::vector<Traced> traced;
  std::set<std::pair<Kind, std::string>> derived;  ///< columns that some rule derives
};

/// Objects of the library in Lua: a userdata that owns the C++ object, of a type of its own.
template <class T>
struct TypeName;
template <>
struct TypeName<Rules> {
  static constexpr const char* value = "tunica.rules";
};

template <class T>
T& object_at(lua_State* L, int at) {
  if (lua_type(L, at) == LUA_TUSERDATA && lua_getmetatable(L, at)) {
    luaL_getmetatable(L, TypeName<T>::value);
    const bool same = lua_rawequal(L, -1, -2);
    lua_pop(L, 2);
    if (same) return **static_cast<T**>(lua_touserdata(L, at));
  }
  fail("expected {}, got {}", TypeName<T>::value, describe(L, at));
}

template <class T>
int collect(lua_State* L) {
  T** slot = static_cast<T**>(lua_touserdata(L, 1));
  delete *slot;
  *slot = nullptr;
  return 0;
}

template <class T>
void push_object(lua_State* L, std::unique_ptr<T> object) {
  T** slot = static_cast<T**>(lua_newuserdata(L, sizeof(T*)));
  *slot = object.release();
  if (luaL_newmetatable(L, TypeName<T>::value)) {
    lua_pushcfunction(L, collect<T>);
    lua_setfield(L, -2, "__gc");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
  }
  lua_setmetatable(L, -2);
}

/// The values of the equations' parameters from the table at a stack index. Errors: one is missing or no number.
std::vector<double> parameter_values(lua_State* L, int at, const Equations& equations);

/// Adds the functions that trace rules to the module on top of the stack.
void register_rules(lua_State* L);
/// Adds the functions that bind rules to a method and run them.
void register_machine(lua_State* L);
/// Adds the functions of phyllotaxis by inhibition fields.
void register_phyllotaxis(lua_State* L);

}  // namespace tunica::lua
