// SPDX-License-Identifier: MIT
#include "lua/state.h"

#include <cstdlib>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "lua/bind_shape.h"
#include "lua/guard.h"
#include "lua/rescue.h"

namespace tunica::lua {

namespace {

void remove_field(lua_State* L, const char* table, const char* field) {
  lua_getglobal(L, table);
  lua_pushnil(L);
  lua_setfield(L, -2, field);
  lua_pop(L, 1);
}

void remove_global(lua_State* L, const char* name) {
  lua_pushnil(L);
  lua_setglobal(L, name);
}

void open(lua_State* L, lua_CFunction library, const char* name) {
  lua_pushcfunction(L, library);
  lua_pushstring(L, name);
  lua_call(L, 1, 0);
}

/// os.exit([code]): the state is closed first, so that what the script held is given back.
int exit_program(lua_State* L) {
  const int code = lua_isboolean(L, 1) ? (lua_toboolean(L, 1) ? 0 : 1) : static_cast<int>(luaL_optinteger(L, 1, 0));
  lua_close(L);
  std::exit(code);
}

constexpr double longest_repetition = 1e8;

/// string.rep of a limited length: it cannot be broken off, and would take seconds for a slip of the keyboard.
int repeat(lua_State* L) {
  size_t size = 0, between = 0;
  luaL_checklstring(L, 1, &size);
  if (!lua_isnoneornil(L, 3)) luaL_checklstring(L, 3, &between);
  const double count = luaL_checknumber(L, 2), length = count * static_cast<double>(size + between);
  if (length > longest_repetition)
    return luaL_error(L, "string.rep: the text would have %f bytes; at most %f are possible", length,
                      longest_repetition);
  const int arguments = lua_gettop(L);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, arguments, 1);
  return 1;
}

void limit_repetition(lua_State* L) {
  lua_getglobal(L, "string");
  lua_getfield(L, -1, "rep");
  lua_pushcclosure(L, repeat, 1);
  lua_setfield(L, -2, "rep");
  lua_pop(L, 1);
}

/// Scripts get the two harmless functions of `debug`; the rest can change locals of the library and types of handles.
void limit_debug(lua_State* L) {
  lua_getglobal(L, "debug");
  lua_createtable(L, 0, 2);
  for (const char* name : {"traceback", "getinfo"}) {
    lua_getfield(L, -2, name);
    lua_setfield(L, -2, name);
  }
  lua_getfield(L, LUA_REGISTRYINDEX, "_LOADED");
  lua_pushvalue(L, -2);
  lua_setfield(L, -2, "debug");
  lua_pop(L, 1);
  lua_setglobal(L, "debug");
  lua_setfield(L, LUA_REGISTRYINDEX, "tunica.debug");
}

/// A number like 3LL or 2i makes LuaJIT load `ffi` by itself, with which a script could crash the program. So it is
/// loaded here, kept alive, and out of reach.
void hide_ffi(lua_State* L) {
  open(L, luaopen_ffi, LUA_FFILIBNAME);
  lua_getfield(L, LUA_REGISTRYINDEX, "_LOADED");
  lua_getfield(L, -1, LUA_FFILIBNAME);
  lua_setfield(L, LUA_REGISTRYINDEX, "tunica.ffi");
  lua_pushnil(L);
  lua_setfield(L, -2, LUA_FFILIBNAME);
  lua_pop(L, 1);
}

void open_standard(lua_State* L) {
  open(L, luaopen_base, "");
  open(L, luaopen_package, LUA_LOADLIBNAME);
  open(L, luaopen_table, LUA_TABLIBNAME);
  open(L, luaopen_io, LUA_IOLIBNAME);
  open(L, luaopen_os, LUA_OSLIBNAME);
  open(L, luaopen_string, LUA_STRLIBNAME);
  open(L, luaopen_math, LUA_MATHLIBNAME);
  open(L, luaopen_debug, LUA_DBLIBNAME);
  open(L, luaopen_bit, LUA_BITLIBNAME);
  limit_repetition(L);
  limit_debug(L);
  hide_ffi(L);
  // luaopen_jit is not called and the engine is put off: compiled loops cannot be interrupted, and x^2 differs in the
  // last bit between compiled and interpreted code.
  luaJIT_setmode(L, 0, LUAJIT_MODE_ENGINE | LUAJIT_MODE_OFF);
  remove_field(L, "string", "dump");
  remove_field(L, "package", "loadlib");
  remove_field(L, "package", "cpath");
  remove_field(L, "package", "seeall");
  remove_field(L, "table", "foreach");  // would show the order that pairs hides
  remove_global(L, "module");
  remove_global(L, "newproxy");
  lua_getglobal(L, "os");
  lua_pushcfunction(L, exit_program);
  lua_setfield(L, -2, "exit");
  lua_pop(L, 1);
}

void open_core(lua_State* L) {
  lua_getfield(L, LUA_REGISTRYINDEX, "_LOADED");
  lua_newtable(L);
  register_tissue(L);
  register_model(L);
  register_view(L);
  register_apex_view(L);
  register_run(L);
  register_rescue(L);
  register_shapes(L);
  lua_setfield(L, -2, "tunica.core");
  lua_pop(L, 1);
}

int open_all(lua_State* L) {
  const auto& library = *static_cast<const std::string*>(lua_touserdata(L, 1));
  lua_settop(L, 0);
  open_standard(L);
  open_reproducible(L);
  open_loaders(L, library);
  host(L);
  set_curves_folder(L, library);
  lua_pushlstring(L, library.data(), library.size());
  lua_setfield(L, LUA_REGISTRYINDEX, "tunica.lua folder");
  open_core(L);
  return 0;
}

/// The error as text: strings as they are, other values by their __tostring, else what they are.
void push_error_text(lua_State* L, int index) {
  if (lua_type(L, index) == LUA_TSTRING) return lua_pushvalue(L, index);
  if (luaL_callmeta(L, index, "__tostring") && lua_type(L, -1) == LUA_TSTRING) return;
  lua_pushfstring(L, "error with a value that is not text (a %s)", luaL_typename(L, index));
}

/// The lines of the user's code that are being run, innermost first: "sheet.lua:12 in 'grow'".
std::vector<std::string> users_frames(lua_State* L) {
  std::vector<std::string> frames;
  lua_Debug frame;
  for (int level = 1; lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "nSl", &frame);
    if (frame.currentline < 0 || std::strncmp(frame.source, "=tunica/", 8) == 0) continue;
    const std::string in = frame.name && *frame.name ? fmt::format(" in '{}'", frame.name) : "";
    frames.push_back(fmt::format("{}:{}{}", frame.short_src, frame.currentline, in));
  }
  return frames;
}

int describe_error(lua_State* L) {
  return guard(L, [&] {
    constexpr size_t most = 10;
    push_error_text(L, 1);
    size_t size = 0;
    const char* start = lua_tolstring(L, -1, &size);
    std::string text(start, size);
    const auto frames = users_frames(L);
    // One frame that the message names already would say nothing more.
    if (frames.size() == 1 && text.starts_with(frames[0] + ":")) return 1;
    for (size_t i = 0; i < frames.size() && i < most; ++i) text += "\n  at " + frames[i];
    if (frames.size() > most) text += "\n  ...";
    lua_pushlstring(L, text.data(), text.size());
    return 1;
  });
}

}  // namespace

State::State(const std::string& library) : state_(luaL_newstate()) {
  if (!state_) fail("out of memory: cannot start Lua");
  if (lua_cpcall(state_, open_all, const_cast<std::string*>(&library)) != 0) {
    const std::string message = lua_tostring(state_, -1) ? lua_tostring(state_, -1) : "cannot start Lua";
    lua_close(state_);
    throw Error(message);
  }
}

State::~State() { lua_close(state_); }

void load_text(lua_State* L, std::string_view text, const std::string& name) {
  if (text.starts_with('\x1b'))
    fail("{} is compiled Lua (bytecode), which is never loaded; give the source text", name.substr(1));
  if (luaL_loadbufferx(L, text.data(), text.size(), name.c_str(), "t") == 0) return;
  std::string message = lua_tostring(L, -1);
  lua_pop(L, 1);
  throw Error(message);
}

std::optional<std::string> call_protected(lua_State* L, int arguments, int results) {
  const int handler = lua_gettop(L) - arguments;
  lua_pushcfunction(L, describe_error);
  lua_insert(L, handler);
  const int status = lua_pcall(L, arguments, results, handler);
  lua_remove(L, handler);
  if (status == 0) return std::nullopt;
  size_t size = 0;
  const char* text = lua_tolstring(L, -1, &size);
  std::string message = text ? std::string(text, size) : "an error that is not text";
  lua_pop(L, 1);
  return message;
}

}  // namespace tunica::lua
