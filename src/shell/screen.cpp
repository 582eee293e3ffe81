// SPDX-License-Identifier: MIT
// What the Lua half may do on the terminal.
#include "shell/screen.h"

#include <langinfo.h>
#include <unistd.h>

#include <clocale>
#include <cstdlib>
#include <cstring>

#include "base/error.h"
#include "lua/guard.h"
#include "shell/full_screen.h"
#include "shell/prompt_editor.h"
#include "shell/terminal.h"

namespace tunica::shell {

namespace {

int width_of_terminal(lua_State* L) {
  lua_pushinteger(L, terminal_width());
  return 1;
}

/// Whether the terminal shows more than ASCII. Without any setting of a locale it is taken to be UTF-8.
bool choose_characters() {
  const char* chosen = setlocale(LC_CTYPE, "");
  if (!chosen || std::strcmp(chosen, "C") == 0) {
    const auto given = [](const char* name) {
      const char* value = std::getenv(name);
      return value && *value;
    };
    if (!given("LC_ALL") && !given("LC_CTYPE") && !given("LANG")) setlocale(LC_CTYPE, "C.UTF-8");
  }
  const char* terminal = std::getenv("TERM");
  return std::strcmp(nl_langinfo(CODESET), "UTF-8") == 0 && !(terminal && std::strcmp(terminal, "dumb") == 0);
}

FullScreen* open_screen = nullptr;

FullScreen& the_screen() {
  if (!open_screen) fail("the screen is not open any more");
  return *open_screen;
}

int columns_of(const std::string& text) {
  int columns = 0;
  for (const char c : text) columns += (c & 0xC0) != 0x80;
  return columns;
}

int size_of_screen(lua_State* L) {
  return lua::guard(L, [&] {
    lua_pushinteger(L, the_screen().width());
    lua_pushinteger(L, the_screen().height());
    return 2;
  });
}

int draw_rows(lua_State* L) {
  return lua::guard(L, [&] {
    FullScreen& screen = the_screen();
    lua_settop(L, 3);
    luaL_checktype(L, 1, LUA_TTABLE);
    screen.clear();
    const int rows = static_cast<int>(lua_objlen(L, 1));
    for (int row = 0; row < rows; ++row) {
      lua_rawgeti(L, 1, row + 1);
      const int runs = lua_istable(L, -1) ? static_cast<int>(lua_objlen(L, -1)) : 0;
      for (int i = 1, column = 0; i <= runs; ++i) {
        lua_rawgeti(L, -1, i);
        lua_rawgeti(L, -1, 1);
        lua_rawgeti(L, -2, 2);
        const std::string text = lua_tostring(L, -2) ? lua_tostring(L, -2) : "";
        screen.put(row, column, text, lua_tostring(L, -1) ? lua_tostring(L, -1) : "");
        column += columns_of(text);
        lua_pop(L, 3);
      }
      lua_pop(L, 1);
    }
    screen.show(lua_isnil(L, 2) ? -1 : static_cast<int>(lua_tointeger(L, 2)), static_cast<int>(lua_tointeger(L, 3)));
    return 0;
  });
}

int read_key(lua_State* L) {
  return lua::guard(L, [&] {
    const auto key =
        the_screen().key([](void* state) { return lua::host(static_cast<lua_State*>(state)).cancel.requested(); }, L);
    lua_pushlstring(L, key.name.data(), key.name.size());
    lua_pushinteger(L, key.column);
    lua_pushinteger(L, key.row);
    return 3;
  });
}

/// full_screen(fn) calls fn(terminal) with the functions size() -> columns, rows; draw(rows, column or nil, row), rows
/// as lists of runs { text, style or nil }; key() -> name, column, row. Returns what fn does. Whatever happens in fn,
/// the terminal is as before when this returns.
int full_screen(lua_State* L) {
  const int status = lua::guard(L, [&] {
    luaL_checktype(L, 1, LUA_TFUNCTION);
    lua_settop(L, 1);
    if (open_screen) fail("the screen is open already");
    FullScreen screen(in_colour(STDOUT_FILENO));
    open_screen = &screen;
    lua_createtable(L, 0, 3);
    const luaL_Reg functions[] = {{"size", size_of_screen}, {"draw", draw_rows}, {"key", read_key}, {nullptr, nullptr}};
    luaL_register(L, nullptr, functions);
    const int result = lua_pcall(L, 1, 1, 0);
    open_screen = nullptr;
    return result;
  });
  return status == 0 ? 1 : lua_error(L);
}

}  // namespace

void tell_screen(Session& session) {
  lua_State* L = session.lua();
  lua_getglobal(L, "require");
  lua_pushliteral(L, "tunica.prompt.screen");
  if (!session.call(1, 1)) return;
  const bool unicode = choose_characters();
  lua_pushboolean(L, isatty(STDOUT_FILENO) && error_is_terminal());
  lua_setfield(L, -2, "terminal");
  lua_pushboolean(L, isatty(STDOUT_FILENO));
  lua_setfield(L, -2, "folds");
  lua_pushboolean(L, in_colour(STDOUT_FILENO));
  lua_setfield(L, -2, "colour");
  lua_pushboolean(L, unicode);
  lua_setfield(L, -2, "unicode");
  lua_pushcfunction(L, width_of_terminal);
  lua_setfield(L, -2, "width");
  lua_pushcfunction(L, full_screen);
  lua_setfield(L, -2, "full");
  lua_pop(L, 1);
}

}  // namespace tunica::shell
