// SPDX-License-Identifier: MIT
#pragma once

#include "solve/stepper.h"

namespace tunica {

/// Explicit one-step methods. Those with fixed steps keep nothing; the adaptive ones use the last stage of a step as
/// the first of the next.
std::unique_ptr<Stepper> make_euler(const StepperOptions&);  ///< thesis 9.2
/// Super-time-stepping (Alexiades, Amiez and Gremaud 1996, Commun. Numer. Methods Eng. 12, 31): five Euler steps of
/// unequal lengths, stable eleven times as far as one on the negative real axis, for diffusion; order 1.
std::unique_ptr<Stepper> make_sts(const StepperOptions&);
std::unique_ptr<Stepper> make_heun(const StepperOptions&);  ///< explicit trapezoid, order 2
std::unique_ptr<Stepper> make_rk4(const StepperOptions&);   ///< the classical method of order 4
/// Bogacki and Shampine (1989), Appl. Math. Lett. 2, 321: order 3, error of order 2.
std::unique_ptr<Stepper> make_bs32(const StepperOptions&);
/// Dormand and Prince (1980), J. Comput. Appl. Math. 6, 19: order 5, error of order 4.
std::unique_ptr<Stepper> make_dp54(const StepperOptions&);

}  // namespace tunica
