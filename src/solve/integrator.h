// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solve/stepper.h"
#include "solve/watch.h"

namespace tunica {

/// Takes a model through time with one method, watching each step.
///
/// Fixed steps lie on a grid of multiples of `dt`; a target (an event) off the grid is met by one shorter step, from
/// which a new grid begins; a step taken anew to end within itself is followed by one that ends on the grid again.
/// Adaptive steps are as long as the tolerance and `dt` allow; the one that would pass the target is cut to meet it.
/// Where output is wanted, or how often a run is interrupted, changes no step: fixed steps pause at the end of a step,
/// adaptive ones show the state interpolated to the moment asked for and go on from the real one, unless what the
/// tissue holds was changed meanwhile.
class Integrator {
 public:
  static constexpr double unlimited = std::numeric_limits<double>::infinity();
  /// `dt`: the step, or the longest that an adaptive method takes. `tolerance`: the one given to the stepper.
  Integrator(std::shared_ptr<System> system, std::unique_ptr<Stepper> stepper, double dt, double tolerance = 1e-6);

  double time() const { return inside_ ? shown_ : end(); }  ///< of the state that the tissue holds
  uint64_t steps() const { return steps_; }
  const Stepper& stepper() const { return *stepper_; }
  System& system() { return *system_; }
  double dt() const { return dt_; }
  bool adaptive() const { return stepper_->steps() != Stepper::Steps::fixed; }
  double slack() const;  ///< times nearer than this are the same
  Work work() const;     ///< of the method, and of what is done around its steps

  enum class Status { reached, paused, out_of_time, interrupted };
  /// Steps towards `target`. Pauses at `pause` (fixed steps: after the first step that ends then or later; in the past:
  /// after one step); returns when `out_of_time()` says so (asked now and then). The tissue holds the state whenever
  /// this returns or throws. Errors: StepFailed; Cancelled is turned into Status::interrupted.
  Status advance(double target, std::optional<double> pause, const std::function<bool()>& out_of_time,
                 const CancelFlag* cancel, const std::vector<double>& parameters);

  /// Writes the derived columns for the state that the tissue holds. Errors: StepFailed, if `checked` and a value is
  /// not finite. Steps do not ask: what a rate reads shows in the state, the rest when someone looks.
  void derive(const std::vector<double>& parameters, bool checked);
  /// To be called before the last step is looked into, in a process that may only have loaded it.
  void look(const std::vector<double>& parameters) { enter(parameters); }
  /// The last step, if it can still be looked into: nothing was changed or loaded since.
  struct Step {
    double begin, end;
  };
  std::optional<Step> last_step() const;
  /// Lets the tissue hold the state at a time within the last step, interpolated; time() is then this one.
  void show(double time);
  /// Takes the last step back and goes from its start to `time`, exactly: for an event that is due there. Heeds no
  /// cancel flag.
  Status retake(double time);
  /// Adaptive steps, with a state shown within the last one: from there to its end.
  bool inside_last_step() const { return inside_; }

  void allow_negative(std::vector<std::string> columns) { watch_.allow_negative(std::move(columns)); }
  /// What the rules say has changed: what the method keeps is to be forgotten.
  void rules_changed() { seen_.clear(); }
  /// Goes on from the time and steps of another method.
  void continue_from(double time, uint64_t steps);

  void save(ByteWriter& out) const;
  /// What was saved under another method gives time and number of steps only.
  void load(ByteReader& in);

 private:
  struct Run;  // arguments of one advance()
  double end() const {
    if (between_) return *between_;
    return index_ == 0 ? origin_ : origin_ + static_cast<double>(index_) * dt_;
  }
  double margin() const { return adaptive() && tolerance_ > 1e-9 ? tolerance_ : 1e-9; }
  AlignedBuffer& before() { return adaptive() ? y_before_ : y_new_; }
  void enter(const std::vector<double>& parameters);
  void leave();
  std::string fingerprint() const;
  Status guarded(const std::function<Status()>& work);
  Status run(const Run& run);
  Status run_fixed(const Run& run);
  Status run_adaptive(const Run& run);
  std::optional<Status> within_last_step(const Run& run);
  void back();
  void fixed_step(double h, double end);
  void adaptive_step(double target);
  void accept(const StepResult& result, bool shortened);
  void reject(const StepResult& result, const std::optional<Watch::Symptom>& symptom);
  std::optional<Watch::Symptom> bad_rate(double time, const double* y);
  double first_length();
  void interpolate(double time, double* y);
  void check_derived(int column);
  std::string method() const;  ///< in words, for messages
  std::string alternation(const Watch::Symptom& symptom) const;
  [[noreturn]] void refuse(const Watch::Symptom& symptom, double time, const std::string& advice);
  [[noreturn]] void refuse_method(const StepResult& result, double time);
  std::string explanation();

  std::shared_ptr<System> system_;
  std::unique_ptr<Stepper> stepper_;
  double dt_, tolerance_;
  double origin_ = 0;   ///< fixed: of the grid of steps; adaptive: end of the last step
  uint64_t index_ = 0;  ///< fixed: steps taken on it
  uint64_t steps_ = 0;
  AlignedBuffer y_, y_new_;  ///< fixed: between steps, y_new_ is the state before the last step
  AlignedBuffer y_before_;   ///< adaptive: the same
  Watch watch_;

  std::optional<double> between_;  ///< fixed: the time, if it lies within step index_ + 1 of the grid
  struct {
    double origin;
    uint64_t index;
    std::optional<double> between;
  } begun_{};               ///< fixed: where the last step began, on the grid
  double begin_ = 0;        ///< of the last step
  bool have_last_ = false;  ///< the last step can be looked into
  bool inside_ = false;     ///< the tissue holds the state at shown_, within the last step
  double shown_ = 0;
  bool have_slopes_ = false;
  AlignedBuffer slope_begin_, slope_end_;
  std::string seen_;  ///< fingerprint of what the tissue held and the parameters when last left
  std::vector<double> parameters_;

  double next_ = 0;           ///< length to try next; 0: to be found
  double error_before_ = 1;   ///< of the last accepted step
  double longest_ = 0;        ///< step tried so far
  bool rejected_ = false;     ///< the last try
  uint64_t rejections_ = 0;   ///< in all
  uint64_t evaluations_ = 0;  ///< other than those of the method
};

}  // namespace tunica
