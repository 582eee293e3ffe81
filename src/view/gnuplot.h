// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/cancel.h"

namespace tunica {

/// Lets gnuplot, a program of its own, carry out commands; they say which files to write.
/// Errors: gnuplot is not installed (names the package), does not start, or fails (with the first of what it says);
/// Cancelled: it is ended then.
void run_gnuplot(const std::string& commands, const CancelFlag* cancel = nullptr);

}  // namespace tunica
