// SPDX-License-Identifier: MIT
#pragma once

#include "rule/system.h"

namespace tunica {

struct SpectralRadius {
  double radius = 0;  ///< of df/dy, as found: a lower bound, usually 1 to 6 % low; not a number if f is not finite
  int evaluations = 0;
  bool converged = false;
};

/// Estimates the spectral radius of df/dy at (t, y) by the nonlinear power method (Sommeijer, Shampine and Verwer
/// 1997, J. Comput. Appl. Math. 88, 315), until it changes by less than `accuracy`. `rate` is f(t, y). `vector` is
/// where to start and becomes the eigenvector found; of another size than the state, or zero, a start is made from
/// counter-based random numbers. It changes only at the end, so that an estimate broken off leaves it as it was.
/// Errors: Cancelled; whatever a rule throws.
SpectralRadius spectral_radius(System& system, double t, const double* y, const double* rate, AlignedBuffer& vector,
                               double accuracy = 0.01, int most_iterations = 50);

}  // namespace tunica
