// SPDX-License-Identifier: MIT
#pragma once

#include "sweep/table.h"

namespace tunica::shell {

/// Looks through what the file of a sweep notes of itself (what it is of, its last settings, files that runs have
/// read), so that those who read it need not. Notes that are missing are no fault: the sweep was stopped before its
/// first run. Errors: a note that no sweep writes; samples with other than the parameters noted.
void check_notes(const sweep::Table& table);

}  // namespace tunica::shell
