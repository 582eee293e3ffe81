// SPDX-License-Identifier: MIT
#include "lua/rescue.h"

#include "base/container.h"
#include "base/error.h"
#include "base/files.h"
#include "lua/guard.h"

namespace tunica::lua {

namespace {

constexpr const char* held_key = "tunica.rescue";

std::string_view text_on_top(lua_State* L) {
  if (lua_type(L, -1) != LUA_TSTRING) fail("rescue: expected text, came a {}", luaL_typename(L, -1));
  size_t size = 0;
  const char* start = lua_tolstring(L, -1, &size);
  return {start, size};
}

std::string_view field(lua_State* L, int table, const char* name) {
  lua_getfield(L, table, name);
  const std::string_view text = text_on_top(L);
  lua_pop(L, 1);  // the table holds it
  return text;
}

/// core.rescue { path =, note =, bytes = } or { path =, note =, sections = }, or core.rescue(): what is to be written
/// if a function of Lua's own does not return when everything is to stop. The tables must not be changed afterwards.
int rescue(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 1);
    if (Rescue* held = host(L).rescue) held->set(L);
    return 0;
  });
}

}  // namespace

void Rescue::set(lua_State* L) {
  std::map<std::string, std::string_view> parts;
  std::string path, note;
  const int table = lua_gettop(L);
  if (lua_istable(L, table)) {
    path = field(L, table, "path"), note = field(L, table, "note");
    lua_getfield(L, table, "sections");
    if (lua_istable(L, -1)) {
      for (lua_pushnil(L); lua_next(L, table + 1); lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) fail("rescue: sections have names");
        parts.emplace(lua_tostring(L, -2), text_on_top(L));
      }
    } else {
      parts.emplace("", field(L, table, "bytes"));
    }
    lua_settop(L, table);
  }
  const std::lock_guard lock(mutex_);
  path_ = std::move(path), note_ = std::move(note), parts_ = std::move(parts);
  written_ = false;
  lua_setfield(L, LUA_REGISTRYINDEX, held_key);  // the bytes of before may go only now
}

std::string Rescue::write() {
  const std::lock_guard lock(mutex_);
  if (path_.empty() || written_) return written_ ? note_ : "";
  try {
    if (const size_t slash = path_.rfind('/'); slash != std::string::npos && slash > 0)
      make_folders(path_.substr(0, slash));
    if (parts_.size() == 1 && parts_.begin()->first.empty()) {
      write_atomic(path_, parts_.begin()->second);
    } else {
      write_atomic(path_, pack_sections(parts_));
    }
    written_ = true;
    return note_;
  } catch (const std::exception& error) {
    return fmt::format("nothing could be kept: {}", error.what());
  }
}

void register_rescue(lua_State* L) {
  lua_pushcfunction(L, rescue);
  lua_setfield(L, -2, "rescue");
}

}  // namespace tunica::lua
