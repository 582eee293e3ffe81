// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lua/bind_model.h"
#include "solve/integrator.h"

namespace tunica::lua {

/// How a model is solved.
struct Solution {
  std::string method;
  double dt, tolerance;
  bool fixed_steps;
};

/// Equations bound to a tissue and a method.
struct Machine {
  std::shared_ptr<System> system;
  Solution solution;
  std::vector<std::string> signed_columns;
  std::unique_ptr<Integrator> integrator;
  std::optional<Failure> failure;
  double seconds = 0;  ///< of computing, since the cost was last taken, as all below
  double cell_steps = 0;
  uint64_t steps = 0;
  Work before;  ///< the integrator's work when the cost was last taken
};

template <>
struct TypeName<Machine> {
  static constexpr const char* value = "tunica.machine";
};

/// Adds the functions that find steady states and say what `auto` has chosen.
void register_steady(lua_State* L);

}  // namespace tunica::lua
