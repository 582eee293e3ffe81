// SPDX-License-Identifier: MIT
#pragma once

#include "shell/sweep_options.h"

namespace tunica::shell {

/// `tunica sweep ...`: many runs of a model into one SQLite file. Returns the exit code. Errors: UsageError.
int sweep_command(int argc, char** argv);

/// `tunica sweep show FILE` and `tunica sweep merge OUT PART...`.
int show_sweep(const SweepOptions& options);
int merge_sweeps(const SweepOptions& options);

}  // namespace tunica::shell
