// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tunica::lua {

/// Writes a query to the controlling terminal and returns all that comes from it up to the end of the primary device
/// attributes ("...c"), keys typed meanwhile included; after at most a second what has come until then. The terminal's
/// settings are put back. Returns "" where there is no terminal, or where this process is in the background (asking
/// would stop it).
std::string terminal_reply(const std::string& query);

}  // namespace tunica::lua
