// SPDX-License-Identifier: MIT
#pragma once

#include "shell/sweep_work.h"

namespace tunica::shell {

/// Looks for better samples with an optimizer (sweep/search.h), from the best of the plan's samples, or from the
/// model's own values if there are none. It is taken up where it was by telling the optimizer what the file holds.
/// False when stopped by a signal. Errors: UsageError if the file holds a search with other settings.
bool refine(SweepWork& work, const SweepOptions& options, const SweepPlan& plan, sweep::Table& table);

}  // namespace tunica::shell
