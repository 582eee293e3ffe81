// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tunica::shell {

/// "tunica 0.1.0 (LuaJIT ..., Eigen ..., gcc ...)"
std::string versions_as_text();

/// The same as one JSON object.
std::string versions_as_json();

}  // namespace tunica::shell
