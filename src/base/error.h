// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tunica {

/// What a user did wrong or the world refused: the message says what was expected, what came, and what to do.
/// Thrown inside the kernel; translated once, at the boundary to Lua or C.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws an Error with a formatted message.
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

/// The candidate that `name` was most likely meant to be (edit distance at most a third of its length, at least 1),
/// or "" if none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean 'x'?", or "" if no candidate is near. To be appended to an error message.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace tunica
