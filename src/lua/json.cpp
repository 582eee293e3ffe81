// SPDX-License-Identifier: MIT
#include "lua/json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace tunica::lua {

namespace {

using nlohmann::json;

constexpr int deepest = 100;

json read_value(lua_State* L, int index, const std::string& where, int depth);

json read_number(double number) {
  if (std::isnan(number)) return "NaN";
  if (std::isinf(number)) return number > 0 ? "Infinity" : "-Infinity";
  // Counts read as counts; 2^53 is where doubles stop telling whole numbers apart.
  if (number == std::trunc(number) && std::abs(number) < 0x1p53 && !(number == 0 && std::signbit(number)))
    return static_cast<int64_t>(number);
  return number;
}

json read_list(lua_State* L, int table, int size, const std::string& where, int depth) {
  json list = json::array();
  for (int i = 1; i <= size; ++i) {
    lua_rawgeti(L, table, i);
    list.push_back(read_value(L, lua_gettop(L), fmt::format("{}[{}]", where, i), depth));
    lua_pop(L, 1);
  }
  return list;
}

/// Whether an empty table was marked as a list (core.as_list).
bool marked_as_list(lua_State* L, int table) {
  if (!luaL_getmetafield(L, table, "__list")) return false;
  lua_pop(L, 1);
  return true;
}

json read_table(lua_State* L, int table, const std::string& where, int depth) {
  if (depth > deepest) fail("cannot write {} as JSON: more than {} tables inside each other", where, deepest);
  luaL_checkstack(L, 4, "JSON");
  const int size = static_cast<int>(lua_objlen(L, table));
  int count = 0;
  for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1)) ++count;
  if (size > 0 && count == size) return read_list(L, table, size, where, depth);
  if (count == 0 && marked_as_list(L, table)) return json::array();
  json object = json::object();
  for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING)
      fail("cannot write {} as JSON: it has a {} as key; expected text keys, or a list 1, 2, ...", where,
           luaL_typename(L, -2));
    const std::string key = lua_tostring(L, -2);
    object[key] = read_value(L, lua_gettop(L), where + "." + key, depth);
  }
  return object;
}

json read_value(lua_State* L, int index, const std::string& where, int depth) {
  size_t size = 0;
  switch (lua_type(L, index)) {
    case LUA_TNIL:
      return nullptr;
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) != 0;
    case LUA_TNUMBER:
      return read_number(lua_tonumber(L, index));
    case LUA_TSTRING: {
      const char* text = lua_tolstring(L, index, &size);
      return std::string(text, size);
    }
    case LUA_TTABLE:
      return read_table(L, index, where, depth + 1);
    default:
      fail("cannot write {} as JSON: it is a {}", where, luaL_typename(L, index));
  }
}

void push_value(lua_State* L, const json& value, int depth) {
  if (depth > deepest) fail("JSON with more than {} levels", deepest);
  luaL_checkstack(L, 4, "JSON");
  if (value.is_object()) {
    lua_createtable(L, 0, static_cast<int>(value.size()));
    for (const auto& [key, item] : value.items()) {
      lua_pushlstring(L, key.data(), key.size());
      push_value(L, item, depth + 1);
      lua_rawset(L, -3);
    }
  } else if (value.is_array()) {
    lua_createtable(L, static_cast<int>(value.size()), 0);
    for (size_t i = 0; i < value.size(); ++i) {
      push_value(L, value[i], depth + 1);
      lua_rawseti(L, -2, static_cast<int>(i) + 1);
    }
  } else if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    lua_pushlstring(L, text.data(), text.size());
  } else if (value.is_number()) {
    lua_pushnumber(L, value.get<double>());
  } else if (value.is_boolean()) {
    lua_pushboolean(L, value.get<bool>());
  } else {
    lua_pushnil(L);
  }
}

}  // namespace

std::string to_json(lua_State* L, int index, bool indented) {
  const json value = read_value(L, index, "the value", 0);
  return value.dump(indented ? 2 : -1, ' ', false, json::error_handler_t::replace);
}

void push_json(lua_State* L, std::string_view text) {
  const json value = json::parse(text, nullptr, false);
  if (value.is_discarded()) fail("not valid JSON");
  push_value(L, value, 0);
}

}  // namespace tunica::lua
