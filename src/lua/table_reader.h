// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <lua.hpp>
#include <optional>
#include <string>

#include "lua/boxes.h"
#include "view/scene.h"

namespace tunica::lua {

/// Fields of a table of settings at a stack index, checked. The reader leaves the stack as it was.
/// Errors: a field of another type, named; numbers out of range.
class TableReader {
 public:
  TableReader(lua_State* L, int table) : L_(L), table_(table) {}

  /// Pushes a field; false, and nothing pushed, if it is nil.
  bool push(const char* key) const {
    if (!lua_checkstack(L_, 8)) fail("too many nested calls");
    lua_getfield(L_, table_, key);
    if (!lua_isnil(L_, -1)) return true;
    lua_pop(L_, 1);
    return false;
  }
  std::optional<double> number(const char* key) const {
    if (!push(key)) return std::nullopt;
    const double value = check_number(L_, -1, key);
    lua_pop(L_, 1);
    return value;
  }
  double number(const char* key, double low, double high, double otherwise) const {
    const double value = number(key).value_or(otherwise);
    if (!(value >= low && value <= high)) fail("'{}' must be from {} to {}, came {}", key, low, high, value);
    return value;
  }
  std::optional<std::string> text(const char* key) const {
    if (!push(key)) return std::nullopt;
    std::string value = check_string(L_, -1, key);
    lua_pop(L_, 1);
    return value;
  }
  std::optional<bool> boolean(const char* key) const {
    if (!push(key)) return std::nullopt;
    if (!lua_isboolean(L_, -1)) fail("'{}' must be true or false, came {}", key, describe(L_, -1));
    const bool value = lua_toboolean(L_, -1);
    lua_pop(L_, 1);
    return value;
  }
  std::optional<Vec3> vector(const char* key) const {
    if (!push(key)) return std::nullopt;
    const Vec3 value = vector_at(lua_gettop(L_), key);
    lua_pop(L_, 1);
    return value;
  }
  Vec3 vector_at(int at, const char* what) const {
    check_table(L_, at, what);
    const auto size = static_cast<int>(lua_objlen(L_, at));
    if (size != 2 && size != 3) fail("'{}' must be {{ x, y }} or {{ x, y, z }}, came {} numbers", what, size);
    Vec3 value = Vec3::Zero();
    for (int axis = 0; axis < size; ++axis) {
      lua_rawgeti(L_, at, axis + 1);
      value[axis] = check_number(L_, -1, what);
      lua_pop(L_, 1);
    }
    return value;
  }
  lua_State* state() const { return L_; }

 private:
  lua_State* L_;
  int table_;
};

}  // namespace tunica::lua
