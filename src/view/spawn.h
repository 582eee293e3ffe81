// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "base/cancel.h"

namespace tunica {

/// Starts a program, found by PATH as command[0], as a process of its own group: a Ctrl-C meant for the run does not
/// reach it. `input` becomes its standard input, `messages` its output and errors. No fork: the renderer's threads
/// would not survive it. Returns its process, or minus the system's error number (-ENOENT: no such program).
pid_t spawn(const std::vector<std::string>& command, int input, int messages);

/// Waits until a process that spawn started has ended, and ends it when cancelled. True if it was content (exit code 0).
bool wait_for(pid_t process, const CancelFlag* cancel = nullptr);

}  // namespace tunica
