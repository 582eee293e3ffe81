// SPDX-License-Identifier: MIT
#pragma once

#include "solve/stepper.h"

namespace tunica {

/// Chooses among rkc2, bs32, dp54 and bdf by what they cost: each takes a few trial steps from the state at hand, and
/// the one with the fewest evaluations per unit of time goes on. So the stiffness (stages and step bounds follow from
/// the spectral radius), the tolerance, the spacing of events (no step is longer) and bends in the rules (rejected
/// steps) all weigh as they do in fact. bdf is tried where rkc2 would need very many stages. The choice is made again
/// when the cost has changed, and now and then, such that trials stay below a twentieth of the work. Counts decide,
/// never a clock.
std::unique_ptr<Stepper> make_auto(const StepperOptions& options);

}  // namespace tunica
