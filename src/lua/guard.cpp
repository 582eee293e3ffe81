// SPDX-License-Identifier: MIT
#include "lua/guard.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace tunica::lua {
namespace {

/// The address of this variable is the key of the host in the Lua registry: no script can name it.
const char host_key = 0;

}  // namespace

bool is_users_code(const lua_Debug& frame) {
  return frame.currentline >= 0 && std::strncmp(frame.source, "=tunica/", 8) != 0;
}

Host& host(lua_State* L) {
  lua_pushlightuserdata(L, const_cast<char*>(&host_key));
  lua_rawget(L, LUA_REGISTRYINDEX);
  void* memory = lua_touserdata(L, -1);
  lua_pop(L, 1);
  if (memory) return *static_cast<Host*>(memory);
  lua_pushlightuserdata(L, const_cast<char*>(&host_key));
  static_assert(std::is_trivially_destructible_v<Host>, "Lua frees the host without a destructor");
  Host* fresh = new (lua_newuserdata(L, sizeof(Host))) Host;
  fresh->main = L;
  lua_rawset(L, LUA_REGISTRYINDEX);
  return *fresh;
}

void push_where(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (is_users_code(frame)) {
      lua_pushfstring(L, "%s:%d: ", frame.short_src, frame.currentline);
      return;
    }
  }
  lua_pushliteral(L, "");
}

void push_message(lua_State* L, const char* message) {
  constexpr size_t most = 1000;
  const std::string_view text(message);
  lua_pushlstring(L, text.data(), std::min(text.size(), most));
  if (text.size() <= most) return;
  lua_pushliteral(L, " ...");
  lua_concat(L, 2);
}

ScriptError::ScriptError(lua_State* L)
    : Error(lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "an error that is not text"),
      reference_(luaL_ref(L, LUA_REGISTRYINDEX)) {}

void ScriptError::push(lua_State* L) const {
  lua_rawgeti(L, LUA_REGISTRYINDEX, reference_);
  luaL_unref(L, LUA_REGISTRYINDEX, reference_);
}

namespace {
constexpr const char* note_key = "tunica.note_errors";
}

void note_errors(lua_State* L) {
  host(L).notes_errors = lua_isfunction(L, -1);
  lua_setfield(L, LUA_REGISTRYINDEX, note_key);
}

void call(lua_State* L, int arguments, int results) {
  const Running script(false);
  if (!host(L).notes_errors) {
    if (lua_pcall(L, arguments, results, 0) != 0) throw ScriptError(L);
    return;
  }
  const int handler = lua_gettop(L) - arguments;
  lua_getfield(L, LUA_REGISTRYINDEX, note_key);
  lua_insert(L, handler);
  const int status = lua_pcall(L, arguments, results, handler);
  lua_remove(L, handler);
  if (status != 0) throw ScriptError(L);
}

}  // namespace tunica::lua
