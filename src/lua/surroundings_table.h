// SPDX-License-Identifier: MIT
#pragma once

#include "lua/guard.h"
#include "view/surroundings.h"

namespace tunica::lua {

/// Pushes what a picture has around its content, as plain data for `read_surroundings`.
void push_surroundings(lua_State* L, const Surroundings& around);
/// From the table at a stack index; none if it is nil. Errors: it is something else.
Surroundings read_surroundings(lua_State* L, int at);

}  // namespace tunica::lua
