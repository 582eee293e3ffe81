// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rule/system.h"

namespace tunica {

/// A method of integration: one step from a state to the next. Keeps no history, so a run can be stopped, saved and
/// resumed between any two steps.
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual const char* name() const = 0;
  virtual int order() const = 0;
  /// y_new = the state at t + h. Returns flags (not_finite, negative) per state column.
  virtual const std::vector<uint8_t>& step(System& system, double t, const double* y, double h, double* y_new) = 0;
};

/// Methods by name: "euler" (thesis 9.2), "heun" (explicit trapezoid, order 2). Errors: unknown name (names the
/// nearest).
std::unique_ptr<Stepper> make_stepper(const std::string& name);
std::vector<std::string> stepper_names();

}  // namespace tunica
