// SPDX-License-Identifier: MIT
#include <cmath>

#include "lua/bind_shape.h"
#include "lua/handle.h"
#include "lua/symbol.h"

namespace tunica::lua {

std::string describe(lua_State* L, int at) {
  Kind kind;
  Id id;
  Tissue* tissue = nullptr;
  switch (lua_type(L, at)) {
    case LUA_TNONE:
      return "nothing";
    case LUA_TNIL:
      return "nil";
    case LUA_TBOOLEAN:
      return lua_toboolean(L, at) ? "true" : "false";
    case LUA_TNUMBER:
      return std::isnan(lua_tonumber(L, at)) ? "the number nan"
                                             : fmt::format("the number {:.10g}", lua_tonumber(L, at));
    case LUA_TSTRING: {
      const std::string text = lua_tostring(L, at);
      return text.size() > 40 ? fmt::format("the text '{}...'", text.substr(0, 40))
                              : fmt::format("the text '{}'", text);
    }
    case LUA_TUSERDATA:
      if (is_tissue(L, at)) return "a tissue";
      if (peek_handle(L, at, kind, id, tissue)) return fmt::format("{} {}", name_of(kind), id);
      if (is_symbol(L, at)) return "a symbol of a rule";
      if (const char* shape = shape_kind(L, at)) return fmt::format("{} {}", *shape == 'a' ? "an" : "a", shape);
      return "a value of another library";
    default:
      return std::string("a ") + lua_typename(L, lua_type(L, at));
  }
}

double check_number(lua_State* L, int at, const char* what) {
  if (lua_type(L, at) != LUA_TNUMBER || !std::isfinite(lua_tonumber(L, at)))
    fail("{} must be a finite number, came {}", what, describe(L, at));
  return lua_tonumber(L, at);
}

int64_t check_integer(lua_State* L, int at, const char* what, int64_t low, int64_t high) {
  const double value = lua_type(L, at) == LUA_TNUMBER ? lua_tonumber(L, at) : std::nan("");
  if (!(value >= static_cast<double>(low) && value <= static_cast<double>(high)) || value != std::floor(value))
    fail("{} must be a whole number from {} to {}, came {}", what, low, high, describe(L, at));
  return static_cast<int64_t>(value);
}

std::string check_string(lua_State* L, int at, const char* what) {
  if (lua_type(L, at) != LUA_TSTRING) fail("{} must be text, came {}", what, describe(L, at));
  size_t size = 0;
  const char* text = lua_tolstring(L, at, &size);
  return {text, size};
}

void check_function(lua_State* L, int at, const char* what) {
  if (lua_type(L, at) != LUA_TFUNCTION) fail("{} must be a function, came {}", what, describe(L, at));
}

void check_table(lua_State* L, int at, const char* what) {
  if (lua_type(L, at) != LUA_TTABLE) fail("{} must be a table, came {}", what, describe(L, at));
}

Kind check_kind(lua_State* L, int at) {
  const std::string name = check_string(L, at, "the kind of element");
  for (int kind = 0; kind < kinds; ++kind)
    if (name == name_of(static_cast<Kind>(kind))) return static_cast<Kind>(kind);
  fail("there are the kinds cell, wall, side and junction; '{}' is none", name);
}

}  // namespace tunica::lua
