// SPDX-License-Identifier: MIT
// Every way in which Lua code enters: text only, and noted so that a run can be repeated from its directory. What is
// bytecode is the program's own, made of the library by its build.
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "base/files.h"
#include "lua/compiled_library.h"
#include "lua/guard.h"
#include "lua/state.h"

namespace tunica::lua {

namespace {

constexpr size_t largest_source = size_t{64} << 20;

std::string text_at(lua_State* L, int index) {
  size_t size = 0;
  const char* text = luaL_checklstring(L, index, &size);
  return {text, size};
}

/// What `load` was given: text, or a function that returns pieces.
std::string source_of(lua_State* L) {
  if (!lua_isfunction(L, 1)) return text_at(L, 1);
  std::string text;
  for (;;) {
    lua_pushvalue(L, 1);
    lua_call(L, 0, 1);
    size_t size = 0;
    const char* piece = lua_tolstring(L, -1, &size);
    if (!piece || size == 0) return text;
    text.append(piece, size);
    if (text.size() > largest_source) fail("load: more than {} bytes of source", largest_source);
    lua_pop(L, 1);
  }
}

/// Runs `body`, giving nil and the message as Lua's own load functions do.
template <class Body>
int nil_and_message(lua_State* L, Body&& body) {
  try {
    body();
    return 1;
  } catch (const std::exception& error) {
    lua_pushnil(L);
    lua_pushstring(L, error.what());
  }
  return 2;
}

/// load(text or function [, name [, mode [, environment]]]); loadstring(text [, name]). The mode is always "t".
int load(lua_State* L) {
  lua_settop(L, 4);
  return nil_and_message(L, [&] {
    const std::string text = source_of(L);
    const std::string name = lua_isnoneornil(L, 2) ? "=(load)" : text_at(L, 2);
    load_text(L, text, name.empty() ? "=" : name);
    if (!lua_isnoneornil(L, 4)) {
      luaL_checktype(L, 4, LUA_TTABLE);
      lua_pushvalue(L, 4);
      lua_setfenv(L, -2);
    }
  });
}

void load_users_file(lua_State* L, const std::string& path) {
  const std::string text = read_file(path, largest_source);
  load_text(L, text, "@" + path);
  note_source(L, path, text);
}

int load_file(lua_State* L) {
  return nil_and_message(L, [&] { load_users_file(L, text_at(L, 1)); });
}

int do_file(lua_State* L) {
  guard(L, [&] {
    load_users_file(L, text_at(L, 1));
    return 0;
  });
  const int bottom = lua_gettop(L) - 1;
  lua_call(L, 0, LUA_MULTRET);
  return lua_gettop(L) - bottom;
}

/// require "tunica", "tunica.x": the library. Its chunks get, after their name, a table with the whole `debug`.
int run_library_chunk(lua_State* L) {
  lua_settop(L, 1);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_createtable(L, 0, 1);
  lua_getfield(L, LUA_REGISTRYINDEX, "tunica.debug");
  lua_setfield(L, -2, "debug");
  lua_call(L, 2, 1);
  return 1;
}

int find_library(lua_State* L) {
  return guard(L, [&] {
    std::string name = text_at(L, 1);
    if (name != "tunica" && !name.starts_with("tunica.")) return 0;
    std::string file = name == "tunica" ? "init" : name.substr(7);
    for (char& c : file)
      if (c == '.') c = '/';
    const std::string path = text_at(L, lua_upvalueindex(1)) + "/tunica/" + file + ".lua";
    if (!std::filesystem::exists(path)) {
      lua_pushfstring(L, "\n\tthe library has no part '%s' (%s)", name.c_str(), path.c_str());
      return 1;
    }
    load_part(L, file, read_file(path, largest_source));
    lua_pushcclosure(L, run_library_chunk, 1);
    return 1;
  });
}

/// require of a script's own modules, by package.path.
int find_module(lua_State* L) {
  return guard(L, [&] {
    std::string name = text_at(L, 1), tried;
    for (char& c : name)
      if (c == '.') c = '/';
    lua_getglobal(L, "package");
    lua_getfield(L, -1, "path");
    std::istringstream templates(lua_isstring(L, -1) ? lua_tostring(L, -1) : "");
    for (std::string path; std::getline(templates, path, ';');) {
      for (size_t at = path.find('?'); at != std::string::npos; at = path.find('?', at + name.size()))
        path.replace(at, 1, name);
      if (std::filesystem::is_regular_file(path)) {
        load_users_file(L, path);
        return 1;
      }
      tried += "\n\tno file '" + path + "'";
    }
    lua_pushlstring(L, tried.data(), tried.size());
    return 1;
  });
}

int find_preloaded(lua_State* L) {
  lua_getfield(L, LUA_REGISTRYINDEX, "_PRELOAD");
  lua_pushvalue(L, 1);
  lua_rawget(L, -2);
  if (lua_isnil(L, -1)) lua_pushliteral(L, "");
  return 1;
}

}  // namespace

namespace {

constexpr const char* copies_key = "tunica.copies";

/// The next entry of core.sources(), left on the stack for more fields.
void push_entry(lua_State* L, const std::string& path, std::string_view text) {
  luaL_findtable(L, LUA_REGISTRYINDEX, "tunica.sources", 1);
  lua_createtable(L, 0, 3);
  lua_pushlstring(L, path.data(), path.size());
  lua_setfield(L, -2, "path");
  lua_pushlstring(L, text.data(), text.size());
  lua_setfield(L, -2, "text");
  lua_pushvalue(L, -1);
  lua_rawseti(L, -3, static_cast<int>(lua_objlen(L, -3)) + 1);
  lua_remove(L, -2);
}

}  // namespace

void note_source(lua_State* L, const std::string& path, std::string_view text) {
  push_entry(L, path, text);
  lua_pop(L, 1);
}

void note_file(lua_State* L, const std::string& path, const std::string& asked, bool beside, std::string_view text) {
  push_entry(L, path, text);
  lua_pushlstring(L, asked.data(), asked.size());
  lua_setfield(L, -2, "asked");
  lua_pushboolean(L, beside);
  lua_setfield(L, -2, "beside");
  lua_pop(L, 1);
}

void set_copy(lua_State* L, const std::string& asked, const std::string& path) {
  luaL_findtable(L, LUA_REGISTRYINDEX, copies_key, 1);
  lua_pushlstring(L, path.data(), path.size());
  lua_setfield(L, -2, asked.c_str());
  lua_pop(L, 1);
}

std::string copy_of(lua_State* L, const std::string& asked) {
  luaL_findtable(L, LUA_REGISTRYINDEX, copies_key, 1);
  lua_getfield(L, -1, asked.c_str());
  const std::string path = lua_isstring(L, -1) ? lua_tostring(L, -1) : "";
  lua_pop(L, 2);
  return path;
}

void set_search_folders(lua_State* L, const std::string& folders) {
  std::istringstream list(folders);
  std::string path;
  for (std::string folder; std::getline(list, folder, ';');) {
    const std::string prefix = folder.empty() || folder == "." ? "" : folder + "/";
    path += (path.empty() ? "" : ";") + prefix + "?.lua;" + prefix + "?/init.lua";
  }
  lua_getglobal(L, "package");
  lua_pushlstring(L, path.data(), path.size());
  lua_setfield(L, -2, "path");
  lua_pop(L, 1);
}

void open_loaders(lua_State* L, const std::string& library) {
  const luaL_Reg functions[] = {
      {"load", load}, {"loadstring", load}, {"loadfile", load_file}, {"dofile", do_file}, {nullptr, nullptr}};
  for (const luaL_Reg* f = functions; f->name; ++f) {
    lua_pushcfunction(L, f->func);
    lua_setglobal(L, f->name);
  }
  lua_getglobal(L, "package");
  lua_createtable(L, 3, 0);
  lua_pushcfunction(L, find_preloaded);
  lua_rawseti(L, -2, 1);
  lua_pushlstring(L, library.data(), library.size());
  lua_pushcclosure(L, find_library, 1);
  lua_rawseti(L, -2, 2);
  lua_pushcfunction(L, find_module);
  lua_rawseti(L, -2, 3);
  lua_setfield(L, -2, "loaders");
  lua_pop(L, 1);
  set_search_folders(L, ".");
}

}  // namespace tunica::lua
