// SPDX-License-Identifier: MIT
#pragma once

#include "solve/stepper.h"

namespace tunica {

/// Backward differentiation formulas of order 1 to 5 with steps of their own (CVODE of SUNDIALS), with the exact
/// Jacobian: sparse direct factors up to some thousand unknowns, beyond that GMRES preconditioned by the factors of
/// each state column's own block. Checkpoints hold the state at the last restart and how many steps were taken since;
/// they are taken again on loading, so that a resumed run has the same bits.
std::unique_ptr<Stepper> make_bdf(const StepperOptions& options);

}  // namespace tunica
