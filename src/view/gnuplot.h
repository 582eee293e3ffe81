// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tunica {

/// Lets gnuplot, a program of its own, carry out commands; they say which files to write.
/// Errors: gnuplot is not installed (names the package), does not start, or fails (with the first of what it says).
void run_gnuplot(const std::string& commands);

}  // namespace tunica
