// SPDX-License-Identifier: MIT
// What Lua leaves to chance, made a function of the script and its seed.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "lua/guard.h"
#include "lua/state.h"

namespace tunica::lua {

namespace {

// === pairs: numbers ascending, then strings by bytes, then false, true, then the rest as `next` finds them (tables and
// functions as keys have no order of their own that lasts from one process to the next).

struct Key {
  int rank;
  double number;
  std::string_view text;  // of a string that the table keeps alive
  int place;              // in the list of keys

  bool operator<(const Key& other) const {
    if (rank != other.rank) return rank < other.rank;
    if (rank == 0) return number < other.number;
    if (rank == 1) return text < other.text;
    return place < other.place;
  }
};

Key key_at_top(lua_State* L, int place) {
  Key key{4, 0, {}, place};
  size_t size = 0;
  switch (lua_type(L, -1)) {
    case LUA_TNUMBER:
      key.rank = 0;
      key.number = lua_tonumber(L, -1);
      break;
    case LUA_TSTRING: {
      const char* text = lua_tolstring(L, -1, &size);
      key.rank = 1;
      key.text = {text, size};
      break;
    }
    case LUA_TBOOLEAN:
      key.rank = lua_toboolean(L, -1) ? 3 : 2;
      break;
    default:
      break;
  }
  return key;
}

/// iterator(table): the keys wait in the first upvalue, the second counts. Entries removed meanwhile are left out.
int next_in_order(lua_State* L) {
  auto place = static_cast<int>(lua_tointeger(L, lua_upvalueindex(2)));
  for (;;) {
    lua_rawgeti(L, lua_upvalueindex(1), ++place);
    if (lua_isnil(L, -1)) return 1;
    lua_pushvalue(L, -1);
    lua_rawget(L, lua_upvalueindex(3));
    if (!lua_isnil(L, -1)) break;
    lua_pop(L, 2);
  }
  lua_pushinteger(L, place);
  lua_replace(L, lua_upvalueindex(2));
  return 2;
}

/// Pushes the table's keys as a list in order.
void push_sorted_keys(lua_State* L, int table) {
  lua_newtable(L);
  const int list = lua_gettop(L);
  std::vector<Key> keys;
  for (lua_pushnil(L); lua_next(L, table);) {
    lua_pop(L, 1);
    keys.push_back(key_at_top(L, static_cast<int>(keys.size()) + 1));
    lua_pushvalue(L, -1);
    lua_rawseti(L, list, keys.back().place);
  }
  if (std::is_sorted(keys.begin(), keys.end())) return;
  std::sort(keys.begin(), keys.end());
  lua_createtable(L, static_cast<int>(keys.size()), 0);
  for (size_t i = 0; i < keys.size(); ++i) {
    lua_rawgeti(L, list, keys[i].place);
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
  lua_remove(L, list);
}

int pairs_in_order(lua_State* L) {
  luaL_checkany(L, 1);
  if (luaL_getmetafield(L, 1, "__pairs")) {
    lua_pushvalue(L, 1);
    lua_call(L, 1, 3);
    return 3;
  }
  luaL_checktype(L, 1, LUA_TTABLE);
  push_sorted_keys(L, 1);
  lua_pushinteger(L, 0);
  lua_pushvalue(L, 1);
  lua_pushcclosure(L, next_in_order, 3);
  lua_pushvalue(L, 1);
  return 2;
}

// === math.random

double draw(lua_State* L) {
  Host& of = host(L);
  const uint64_t seed = of.random.seeded ? of.random.seed : of.seed;
  return uniform({.seed = seed, .purpose = purpose("math.random"), .cell = of.random.drawn++, .step = 0});
}

/// math.random() in [0, 1); math.random(n) integer in 1..n; math.random(m, n) integer in m..n.
int random_number(lua_State* L) {
  if (lua_gettop(L) == 0) {
    lua_pushnumber(L, draw(L));
    return 1;
  }
  const bool two = lua_gettop(L) >= 2;
  const double low = two ? std::floor(luaL_checknumber(L, 1)) : 1;
  const double high = std::floor(luaL_checknumber(L, two ? 2 : 1));
  if (!(low <= high) || !std::isfinite(high - low))
    return luaL_argerror(L, two ? 2 : 1, lua_pushfstring(L, "no whole number from %f to %f", low, high));
  lua_pushnumber(L, low + std::floor(draw(L) * (high - low + 1)));
  return 1;
}

int random_seed(lua_State* L) {
  const double seed = luaL_checknumber(L, 1);
  if (!std::isfinite(seed)) return luaL_argerror(L, 1, "the seed must be finite");
  host(L).random = {
      .seed = static_cast<uint64_t>(static_cast<int64_t>(std::fmod(seed, 0x1p62))), .drawn = 0, .seeded = true};
  return 0;
}

// === Undefined variables

int undefined_variable(lua_State* L) {
  if (lua_type(L, 2) != LUA_TSTRING) return 0;
  return guard(L, [&]() -> int {
    const std::string name = lua_tostring(L, 2);
    std::vector<std::string> names;
    for (lua_pushnil(L); lua_next(L, 1); lua_pop(L, 1))
      if (lua_type(L, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -2));
    std::sort(names.begin(), names.end());
    fail("variable '{}' is not defined{}", name, did_you_mean(name, names));
  });
}

}  // namespace

void open_reproducible(lua_State* L) {
  lua_pushcfunction(L, pairs_in_order);
  lua_setglobal(L, "pairs");
  lua_getglobal(L, "math");
  lua_pushcfunction(L, random_number);
  lua_setfield(L, -2, "random");
  lua_pushcfunction(L, random_seed);
  lua_setfield(L, -2, "randomseed");
  lua_pop(L, 1);
  lua_pushvalue(L, LUA_GLOBALSINDEX);
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, undefined_variable);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
}

}  // namespace tunica::lua
