// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <string>

#include "shape/lstudio.h"

namespace tunica::lua {

/// A curve by name: of those shipped, else in a file, whose path is relative to the script that asks (or to the folder
/// the program runs in). `item`: which of a gallery; "": the only one. Errors: none of that name (the nearest is
/// named); a function where a contour is wanted, or the reverse; what read_lstudio says.
DrawnCurve find_curve(lua_State* L, const std::string& name, bool function, const std::string& item);

/// Writes text to a path, relative to the folder the program runs in. Errors: no such path; a rule runs.
void write_curve_file(lua_State* L, const std::string& path, const std::string& text);

}  // namespace tunica::lua
