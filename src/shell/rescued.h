// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace tunica::shell {

/// Looks after the files `rescued-PID` (sessions) and `rescued-PID.lua` (what was typed) in a folder, which prompts left
/// that had to end: of the newest twenty, those of the last 30 days stay, the others are removed. Returns one line for
/// each that came since this was asked last, newest first: when it was written and how to go on with it.
std::vector<std::string> look_after_rescued(const std::string& folder);

}  // namespace tunica::shell
