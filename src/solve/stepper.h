// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "rule/system.h"

namespace tunica {

/// What became of one step.
struct StepResult {
  double taken = 0;              ///< length of the step; = h unless the method chooses
  double error = 0;              ///< adaptive methods: estimate of the step's error over what the tolerance allows;
                                 ///< accepted if <= 1
  const char* failed = nullptr;  ///< "newton", "linear", "stages": the step could not be computed
  std::string detail;            ///< of a failure: what to tell the user, with advice
  const std::vector<uint8_t>* flags = nullptr;  ///< per state column, not_finite and negative of y_new, if the method
                                                ///< has looked on the way
};

/// What a method has done so far.
struct Work {
  uint64_t evaluations = 0, jacobians = 0, factorizations = 0, newton_iterations = 0, linear_iterations = 0,
           rejected = 0;
};

struct StepperOptions {
  double tolerance = 1e-6;   ///< of the error in one step, relative; see solve/tolerance.h
  bool fixed_steps = false;  ///< for methods that can be either (MethodInfo::either): take the steps asked for
};

/// A method of integration: one step from a state to the next. What it keeps between steps only makes steps cheaper or
/// is saved, so that a run can be stopped, saved and resumed between any two.
class Stepper {
 public:
  enum class Steps { fixed, adaptive, own };  ///< own: the method chooses `taken` <= h itself

  virtual ~Stepper() = default;
  virtual const char* name() const = 0;
  virtual int order() const = 0;
  virtual Steps steps() const { return Steps::fixed; }
  /// Adaptive methods: the power of h with which the estimated error goes.
  virtual int error_order() const { return order() + 1; }
  /// Length of the interval of stability on the negative real axis, if it bounds the step: dt * spectral radius must
  /// not pass it. (Of a method that is made to damp: of the interval in which it does.) 0: no such bound.
  virtual double stability() const { return 0; }

  /// Whether it keeps something between steps that decides bits.
  virtual bool remembers() const { return steps() != Steps::fixed; }

  /// State, structure or rules changed from outside: forget what is kept between steps. `y` is the state at t.
  virtual void restart(System& system, double t, const double* y) { (void)system, (void)t, (void)y; }
  /// y_new = the state at t + taken. A second call without accepted() in between means that the step was rejected.
  /// Errors: Cancelled, and whatever a rule throws; the same step can then be tried again.
  virtual StepResult step(System& system, double t, const double* y, double h, double* y_new) = 0;
  /// The last step is the one that counts: the next begins at its end.
  virtual void accepted() {}
  /// y = the state at t within the last step, if the method has a better interpolant than a cubic through both ends.
  virtual bool between(System& system, double t, double* y) {
    (void)system, (void)t, (void)y;
    return false;
  }
  /// What is kept between steps and decides bits.
  virtual void save(ByteWriter& out) const { (void)out; }
  virtual void load(ByteReader& in) { (void)in; }

  /// For a method that chooses among others: which, and why, in words.
  virtual std::string choice() const { return {}; }
  virtual std::string why() const { return {}; }

  const Work& work() const { return work_; }

 protected:
  void rates(System& system, double t, const double* y, double* dydt) {
    ++work_.evaluations;
    system.rates(t, y, dydt);
  }
  Work work_;
};

/// A method as help, checks of arguments and records show it.
struct MethodInfo {
  const char* name;
  const char* title;
  int order;
  Stepper::Steps steps;
  bool implicit;  ///< needs a Jacobian
  std::unique_ptr<Stepper> (*make)(const StepperOptions&);
  bool either = false;  ///< adaptive, but with fixed steps when dt is given and no tolerance
};

/// All methods there are: the one table from which names, help and choices come.
const std::vector<MethodInfo>& methods();
/// Errors: unknown name (names the nearest).
const MethodInfo& find_method(const std::string& name);
std::unique_ptr<Stepper> make_stepper(const std::string& name, const StepperOptions& options = {});

}  // namespace tunica
