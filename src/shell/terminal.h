// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace tunica::shell {

/// Whether standard error is a terminal that takes cursor movements (TERM is not "dumb").
bool error_is_terminal();

/// "tunica: <kind>: text" on standard error; the kind in colour on a terminal unless NO_COLOR is set.
void say_error(std::string_view text);
void say_warning(std::string_view text);
void say_note(std::string_view text);

}  // namespace tunica::shell
