// SPDX-License-Identifier: MIT
// Functions behind lua/tunica/model.lua that need no machine: saved tissues, a look into functions.
#include "lua/bind_model.h"

#include "lua/guard.h"
#include "tissue/carry.h"

namespace tunica::lua {

namespace {

int tissue_save(lua_State* L) {
  return guard(L, [&] {
    ByteWriter out;
    tissue_at(L, 1).save(out);
    lua_pushlstring(L, out.bytes().data(), out.bytes().size());
    return 1;
  });
}

int tissue_load(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = tissue_at(L, 1);
    require_changeable(tissue);
    size_t size = 0;
    if (lua_type(L, 2) != LUA_TSTRING) fail("expected a saved tissue, got {}", describe(L, 2));
    const char* bytes = lua_tolstring(L, 2, &size);
    ByteReader in({bytes, size});
    tissue.load(in);
    return 0;
  });
}

void push_names(lua_State* L, const std::vector<std::string>& names) {
  lua_createtable(L, static_cast<int>(names.size()), 0);
  for (size_t i = 0; i < names.size(); ++i) {
    lua_pushlstring(L, names[i].data(), names[i].size());
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
}

/// tissue_carry(to, from) -> columns that only `to` declares, columns that only `from` has; see tissue/carry.h
int tissue_carry(lua_State* L) {
  return guard(L, [&] {
    Tissue& to = tissue_at(L, 1);
    require_changeable(to);
    const CarriedColumns names = carry_over(to, tissue_at(L, 2));
    push_names(L, names.added);
    push_names(L, names.undeclared);
    return 2;
  });
}

/// with_lock(tissue, f, ...): calls f; meanwhile the tissue's structure cannot change.
int with_lock(lua_State* L) {
  return guard(L, [&] {
    const Locked locked(tissue_at(L, 1));
    check_function(L, 2, "a function");
    call(L, lua_gettop(L) - 2, 0);
    return 0;
  });
}

// === Looking into functions

/// upvalues(function) -> list of { name, value, identity }
int upvalues(lua_State* L) {
  return guard(L, [&] {
    check_function(L, 1, "a function");
    lua_newtable(L);
    if (lua_iscfunction(L, 1)) return 1;
    for (int i = 1;; ++i) {
      const char* name = lua_getupvalue(L, 1, i);
      if (!name) break;
      lua_createtable(L, 3, 0);
      lua_insert(L, -2);
      lua_rawseti(L, -2, 2);
      lua_pushstring(L, name);
      lua_rawseti(L, -2, 1);
      lua_pushfstring(L, "%p", lua_upvalueid(L, 1, i));
      lua_rawseti(L, -2, 3);
      lua_rawseti(L, -2, i);
    }
    return 1;
  });
}

/// same_upvalues(function, list) -> whether its upvalues are the values of the list, each the very same
int same_upvalues(lua_State* L) {
  return guard(L, [&] {
    check_function(L, 1, "a function");
    check_table(L, 2, "a list");
    bool same = !lua_iscfunction(L, 1);
    for (int i = 1; same && lua_getupvalue(L, 1, i); ++i) {
      lua_rawgeti(L, 2, i);
      same = lua_rawequal(L, -1, -2);
      lua_settop(L, 2);
    }
    lua_pushboolean(L, same);
    return 1;
  });
}

int set_upvalue(lua_State* L) {
  return guard(L, [&] {
    check_function(L, 1, "a function");
    const auto which = static_cast<int>(check_integer(L, 2, "an upvalue", 1, 255));
    if (lua_iscfunction(L, 1)) fail("not a Lua function");
    lua_settop(L, 3);
    if (!lua_setupvalue(L, 1, which)) fail("the function has no upvalue {}", which);
    return 0;
  });
}

/// Leaves the functions that list bytecode, and LuaJIT's version, in the registry and takes the rest of the library
/// `jit` away again.
void open_bytecode_functions(lua_State* L) {
  lua_pushcfunction(L, luaopen_jit);
  lua_pushliteral(L, LUA_JITLIBNAME);
  lua_call(L, 1, 0);
  luaJIT_setmode(L, 0, LUAJIT_MODE_ENGINE | LUAJIT_MODE_OFF);
  lua_getglobal(L, LUA_JITLIBNAME);
  lua_getfield(L, -1, "version");
  lua_setfield(L, LUA_REGISTRYINDEX, "tunica.luajit");
  lua_pop(L, 1);
  lua_getfield(L, LUA_REGISTRYINDEX, "_PRELOAD");
  lua_getfield(L, -1, "jit.util");
  if (lua_isfunction(L, -1)) {
    lua_call(L, 0, 1);
  } else {
    lua_pop(L, 1);
    lua_getfield(L, LUA_REGISTRYINDEX, "_LOADED");
    lua_getfield(L, -1, "jit.util");
    lua_remove(L, -2);
  }
  lua_setfield(L, -3, "bytecode");
  for (const char* name : {"jit.util", "jit.profile"}) {
    lua_pushnil(L);
    lua_setfield(L, -2, name);
  }
  lua_pop(L, 1);
  lua_getfield(L, LUA_REGISTRYINDEX, "_LOADED");
  for (const char* name : {"jit", "jit.util", "jit.opt"}) {
    lua_pushnil(L);
    lua_setfield(L, -2, name);
  }
  lua_pop(L, 1);
  lua_pushnil(L);
  lua_setglobal(L, "jit");
}

}  // namespace

void register_model(lua_State* L) {
  register_symbols(L);
  register_rules(L);
  register_machine(L);
  register_phyllotaxis(L);
  const luaL_Reg functions[] = {{"tissue_save", tissue_save}, {"with_lock", with_lock},
                                {"tissue_load", tissue_load}, {"tissue_carry", tissue_carry},
                                {"upvalues", upvalues},       {"same_upvalues", same_upvalues},
                                {"set_upvalue", set_upvalue}, {nullptr, nullptr}};
  add_functions(L, functions);
  open_bytecode_functions(L);
}

}  // namespace tunica::lua
