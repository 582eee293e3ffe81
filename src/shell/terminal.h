// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace tunica::shell {

/// Whether standard error is a terminal that takes cursor movements (TERM is not "dumb").
bool error_is_terminal();

enum class Colour { automatic, always, never };

/// What --color says. NO_COLOR, if set, has the last word.
void choose_colour(Colour colour);

/// Whether what is written to this descriptor is to be in colour.
bool in_colour(int descriptor);

/// "tunica: <kind>: text" on standard error; the kind in colour on a terminal unless NO_COLOR is set.
void say_error(std::string_view text);
void say_warning(std::string_view text);
void say_note(std::string_view text);

}  // namespace tunica::shell
