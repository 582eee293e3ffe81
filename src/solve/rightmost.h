// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "rule/jacobian.h"

namespace tunica {

/// Largest real part among the eigenvalues of J: all of them for small matrices, else those nearest to several points
/// on the positive axis (shift-invert Arnoldi), which miss a pair that is far off the axis. None if nothing converged.
std::optional<double> rightmost_eigenvalue(const SparseRows& j);

}  // namespace tunica
