// SPDX-License-Identifier: MIT
#pragma once

#include "solve/stepper.h"

namespace tunica {

/// Backward Euler (thesis 9.3) and Crank-Nicolson (9.4) with modified Newton iteration and sparse factors; and
/// Crank-Nicolson as the thesis solves it, with a new Jacobian in each iteration and biconjugate gradients.
std::unique_ptr<Stepper> make_backward_euler(const StepperOptions& options);
std::unique_ptr<Stepper> make_crank_nicolson(const StepperOptions& options);
std::unique_ptr<Stepper> make_bicg(const StepperOptions& options);

}  // namespace tunica
