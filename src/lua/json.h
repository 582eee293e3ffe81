// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <string>
#include <string_view>

namespace tunica::lua {

/// The value at `index` as JSON text, names sorted: nil, booleans, numbers, strings, lists (1..n), tables with text
/// keys. An empty table is an object, unless its metatable has a field __list. NaN and infinities, which JSON lacks,
/// become "NaN", "Infinity", "-Infinity". Errors: other values and keys, cycles; the message says where.
std::string to_json(lua_State* L, int index, bool indented);

/// Pushes the value that JSON text holds; null becomes nil. Errors: not JSON.
void push_json(lua_State* L, std::string_view text);

}  // namespace tunica::lua
