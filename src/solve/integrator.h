// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "solve/stepper.h"

namespace tunica {

/// Why a step was refused. The state is the one before the bad step.
struct Failure {
  std::string kind;  ///< "not finite", "negative", "oscillation"
  double time;       ///< at the end of the refused step
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

/// Takes fixed steps through time with one method, watching each. Steps lie on a grid of multiples of `dt`; a target
/// (an event) off the grid is met by one shorter step, from which a new grid begins. Where output is wanted, or how
/// often a run is interrupted at multiples of `dt`, changes no step.
class Integrator {
 public:
  Integrator(std::shared_ptr<System> system, std::unique_ptr<Stepper> stepper, double dt);

  double time() const { return origin_ + static_cast<double>(index_) * dt_; }
  uint64_t steps() const { return steps_; }
  const Stepper& stepper() const { return *stepper_; }
  System& system() { return *system_; }
  double dt() const { return dt_; }

  enum class Status { reached, paused, out_of_time, interrupted };
  /// Steps towards `target`. Pauses after the first step that ends at or after `pause`; returns when `out_of_time()`
  /// says so (asked now and then). The tissue holds the state whenever this returns or throws. Errors: StepFailed;
  /// Cancelled is turned into Status::interrupted.
  Status advance(double target, std::optional<double> pause, const std::function<bool()>& out_of_time,
                 const CancelFlag* cancel, const std::vector<double>& parameters);

  /// Columns in which negative values are meant (displacements); all others that begin non-negative must stay so.
  void allow_negative(std::vector<std::string> columns) { signed_ = std::move(columns); }

  void save(ByteWriter& out) const;
  void load(ByteReader& in);

 private:
  void load_state(const std::vector<double>& parameters);
  void step(double h, double end);
  void check(const std::vector<uint8_t>& flags, double time);
  void check_oscillation(double time);
  [[noreturn]] void refuse(const char* kind, size_t column, Index element, double value, double time,
                           const std::string& advice);

  std::shared_ptr<System> system_;
  std::unique_ptr<Stepper> stepper_;
  double dt_;
  double origin_ = 0;   ///< of the grid of steps
  uint64_t index_ = 0;  ///< steps taken on it
  uint64_t steps_ = 0;
  AlignedBuffer y_, y_new_, before_;
  std::vector<std::string> signed_;
  std::vector<uint8_t> watch_negative_;
  int alternations_ = 0;
};

}  // namespace tunica
