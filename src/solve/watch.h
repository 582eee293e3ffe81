// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rule/system.h"

namespace tunica {

/// Why a step was refused. The state is the one before the bad step.
struct Failure {
  std::string
      kind;     ///< "not finite", "negative", "oscillation", "step size", or what the method gave as StepResult::failed
  double time;  ///< at the end of the refused step
  std::string column;
  Kind element;
  Id id;  ///< of the cell (wall, side) where it shows
  double value;
  std::string message;  ///< all of this, and what to try
};

class StepFailed : public Error {
 public:
  explicit StepFailed(Failure f) : Error(f.message), failure(std::move(f)) {}
  Failure failure;
};

/// Looks at what a step gives for what cannot be right. Costs less than evaluating the rates.
class Watch {
 public:
  struct Symptom {
    const char* kind;
    size_t column;  ///< in System::state()
    Index element;
    double value;
  };

  /// Columns in which negative values are meant (displacements); all others that begin non-negative must stay so.
  void allow_negative(std::vector<std::string> columns) { signed_ = std::move(columns); }
  /// A new beginning from state y. A symptom if y itself is not finite. `margin` as below: values a little further
  /// below zero than steps may bring them are taken for meant, so that a pause does not change what is refused.
  std::optional<Symptom> begin(const System& system, const double* y, double margin);
  /// Not finite or negative. `flags` as in StepResult, or null. `margin`: how far below zero a value may be, relative
  /// to the largest in its column before.
  std::optional<Symptom> state(const System& system, const double* y, const double* y_new,
                               const std::vector<uint8_t>* flags, double margin) const;
  /// Forward-Euler instability shows as a change that turns round at every step and grows: looked for in six steps out
  /// of 128. `step`: number of this one.
  std::optional<Symptom> oscillation(const System& system, uint64_t step, const double* y, const double* y_new);
  /// Where the state changes most, for want of a better place to name.
  static Symptom most_changed(const System& system, const char* kind, const double* y, const double* y_new);

 private:
  std::vector<std::string> signed_;
  std::vector<uint8_t> watch_negative_;
  AlignedBuffer before_;  ///< the change in the step before
  int alternations_ = 0;
};

}  // namespace tunica
