// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tissue/tissue.h"

namespace tunica {

/// What differs between the columns of two tissues, as "cell.auxin".
struct CarriedColumns {
  std::vector<std::string> added;       ///< declared only by the tissue that was filled
  std::vector<std::string> undeclared;  ///< only in the one it was filled from; kept
};

/// Makes `to` the same as `from`: structure, identities, state. Columns stay declared as they are in `to` (initial
/// value, inheritance); those that only `to` has keep their values where an element of the same identity is still
/// there, and are the initial value elsewhere. Errors: one has geometry, the other none; `to` is locked. `to` is then
/// unchanged.
CarriedColumns carry_over(Tissue& to, const Tissue& from);

}  // namespace tunica
