// SPDX-License-Identifier: MIT
#pragma once

#include "solve/integrator.h"

namespace tunica {

/// Arguments of one advance(); see there.
struct Integrator::Run {
  double target;
  std::optional<double> pause;
  std::function<bool()> out_of_time;
  const CancelFlag* cancel;
};

}  // namespace tunica
