// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "rule/jacobian.h"

namespace tunica {

struct LinearOutcome {
  bool converged;
  uint64_t iterations;
};

/// b := (d I - g J)^-1 b by biconjugate gradients without preconditioner, until the mean square of the residual is
/// below `tolerance` (thesis 9.6.5). Kept for comparison with factorisation. Not converged: a breakdown, a residual
/// that is not a number, or more iterations than unknowns.
LinearOutcome biconjugate_gradient(const SparseRows& j, double d, double g, double tolerance, std::vector<double>& b);

}  // namespace tunica
