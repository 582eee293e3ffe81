// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "rule/jacobian.h"
#include "solve/stepper.h"

namespace tunica {

/// A state in which nothing changes, f(t, y) = 0, and what is known of it.
struct Steady {
  std::string how;      ///< "elimination", "sparse factors" or "newton"
  int iterations = 0;   ///< of Newton's method
  double residual = 0;  ///< largest |f| over the largest term of its column's Jacobian rows times the state
  double growth = 0;    ///< largest real part found among the eigenvalues of the Jacobian: stable if negative
  bool stable = false;
  bool stability_known = true;  ///< false if the eigenvalues did not converge
  Work work;
};

struct SteadyOptions {
  double tolerance = 1e-10;  ///< of the residual
  int most_iterations = 500;
  bool stability = true;  ///< look at the eigenvalues
  const CancelFlag* cancel = nullptr;
};

/// From `y` (padded) to a steady state, in `y`. Linear rules are solved directly: one cell column on a tissue without
/// cycles (a line, a tree) by elimination without subtractions in O(n), which keeps all digits however long the
/// gradient; others by sparse factors. Otherwise Newton's method with pseudo-transient continuation. Errors: a rule
/// that was not traced; a singular problem (nothing decays); no convergence (the best state is in `y`).
Steady find_steady(System& system, double t, double* y, const SteadyOptions& options = {});

}  // namespace tunica
