// SPDX-License-Identifier: MIT
#pragma once

#include "solve/stepper.h"

namespace tunica {

/// RKC2: explicit, second order, with as many stages s as the step needs: stable to h * rho = 0.65 s^2 on the negative
/// real axis, for diffusion (Sommeijer, Shampine and Verwer 1997, J. Comput. Appl. Math. 88, 315). Adaptive, or with
/// the steps it is asked for (StepperOptions::fixed_steps). The spectral radius rho is estimated as it goes.
std::unique_ptr<Stepper> make_rkc2(const StepperOptions&);

}  // namespace tunica
