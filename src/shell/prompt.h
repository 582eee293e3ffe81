// SPDX-License-Identifier: MIT
#pragma once

#include "shell/session.h"

namespace tunica::shell {

struct PromptOptions {
  bool banner = true;         ///< versions at the start
  bool keeps_history = true;  ///< false: private, nothing is read or written
  bool runs_init = true;      ///< the user's init.lua
  bool failed = false;        ///< what ran before the prompt
};

/// Reads inputs from standard input and runs them until its end; shows values; Ctrl-C returns to the prompt. Where that
/// is no terminal there is no prompt, and an input that fails gives a code other than 0. Returns the exit code.
int run_prompt(Session& session, const PromptOptions& options);

}  // namespace tunica::shell
