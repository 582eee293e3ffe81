// SPDX-License-Identifier: MIT
#include "solve/stepper.h"

#include "solve/auto.h"
#include "solve/bdf.h"
#include "solve/chebyshev.h"
#include "solve/implicit.h"
#include "solve/runge_kutta.h"

namespace tunica {

const std::vector<MethodInfo>& methods() {
  using Steps = Stepper::Steps;
  static const std::vector<MethodInfo> table{
      {"euler", "forward Euler", 1, Steps::fixed, false, make_euler},
      {"sts", "super-time-stepping, five unequal Euler steps, for diffusion", 1, Steps::fixed, false, make_sts},
      {"heun", "explicit trapezoid (Heun)", 2, Steps::fixed, false, make_heun},
      {"rk4", "classical Runge-Kutta", 4, Steps::fixed, false, make_rk4},
      {"bs32", "Bogacki-Shampine 3(2)", 3, Steps::adaptive, false, make_bs32},
      {"dp54", "Dormand-Prince 5(4)", 5, Steps::adaptive, false, make_dp54},
      {"rkc2", "Runge-Kutta-Chebyshev, for diffusion", 2, Steps::adaptive, false, make_rkc2, true},
      {"backward_euler", "backward Euler, modified Newton", 1, Steps::fixed, true, make_backward_euler},
      {"crank_nicolson", "Crank-Nicolson, modified Newton", 2, Steps::fixed, true, make_crank_nicolson},
      {"bicg", "Crank-Nicolson, Newton with biconjugate gradients", 2, Steps::fixed, true, make_bicg},
      {"bdf", "backward differentiation formulas (CVODE)", 5, Steps::own, true, make_bdf},
      {"auto", "what costs least, tried on the way", 0, Steps::adaptive, false, make_auto},
  };
  return table;
}

const MethodInfo& find_method(const std::string& name) {
  std::vector<std::string> names;
  for (const MethodInfo& m : methods()) {
    if (name == m.name) return m;
    names.push_back(m.name);
  }
  fail("unknown method '{}'{}; there are: {}", name, did_you_mean(name, names), fmt::join(names, ", "));
}

std::unique_ptr<Stepper> make_stepper(const std::string& name, const StepperOptions& options) {
  return find_method(name).make(options);
}

}  // namespace tunica
