// SPDX-License-Identifier: MIT
#pragma once

#include "shell/session.h"

namespace tunica::shell {

/// Reads lines from standard input and runs them until its end; shows values; Ctrl-C returns to the prompt.
/// Returns the exit code.
int run_prompt(Session& session, bool banner);

}  // namespace tunica::shell
