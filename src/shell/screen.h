// SPDX-License-Identifier: MIT
#pragma once

#include "shell/session.h"

namespace tunica::shell {

/// tunica.prompt.screen gets what the terminal can do: width, colours, characters, and `full`, a function that takes
/// the whole of it (see FullScreen).
void tell_screen(Session& session);

}  // namespace tunica::shell
