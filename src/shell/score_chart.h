// SPDX-License-Identifier: MIT
#pragma once

#include "shell/options.h"

namespace tunica::shell {

/// `tunica chart MODEL --score EXPR`: every method and step on many seeds, by the pool and the file of a sweep; which
/// settings are to be run, and what their rows say, is lua/tunica/chart/score.lua. Returns the exit code. Errors:
/// UsageError.
int chart_of_score(const Options& options);

}  // namespace tunica::shell
