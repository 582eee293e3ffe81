// SPDX-License-Identifier: MIT
#include "solve/auto.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rule/jacobian.h"
#include "solve/bdf.h"
#include "solve/chebyshev.h"
#include "solve/runge_kutta.h"
#include "solve/spectral_radius.h"

namespace tunica {

namespace {

/// Accepted steps of a trial: at least the first, and until they no longer grow, but at most the second.
constexpr int least_steps = 3, trial_steps = 14;
constexpr uint64_t trial_evaluations = 400;  ///< and no more than so many evaluations
/// Work between choices, in trials: after the first, since a transient tells little of what comes; after another method
/// was chosen; and after many choices that changed nothing.
constexpr double first_patience = 2, least_patience = 4, most_patience = 40;
/// Evaluations before the next choice; more where the cost seems to have changed, since after a restart it always does.
constexpr double least_wait = 50, wait_if_changed = 200;
constexpr double usual_look = 50;  ///< evaluations, at most, that a look at rkc2 alone should cost
/// Methods whose steps are as long as they are stable must beat rkc2 by so much: its steps can grow when the state
/// grows smooth, theirs cannot.
constexpr double advantage = 1.6;
constexpr double changed = 3;  ///< a cost that differs by this factor calls for a new choice
/// Above so many stages, step after step, implicit steps are cheaper: some 4e4 for step times spectral radius.
constexpr double many_stages = 250;

struct Candidate {
  const char* name;
  std::unique_ptr<Stepper> (*make)(const StepperOptions&);
  double weight;       ///< time of an evaluation with what the method adds to it, measured against each other
  double evaluations;  ///< per step
  double stability;    ///< longest step times spectral radius; 0: as long as it likes
};
constexpr std::array<Candidate, 4> candidates{{{"rkc2", make_rkc2, 1.05, 0, 0},
                                               {"bs32", make_bs32, 1.3, 3, 2.51},
                                               {"dp54", make_dp54, 1.3, 6, 3.31},
                                               {"bdf", make_bdf, 1, 0, 0}}};
constexpr int rkc = 0, bdf = 3;

/// What a trial has shown.
struct Trial {
  double cost = INFINITY;   ///< weighted evaluations per unit of time
  double length = 0;        ///< of the last accepted step
  double in_last_step = 0;  ///< evaluations
};

class Auto : public Stepper {
 public:
  explicit Auto(const StepperOptions& options) : options_(options) { choose(0); }

  const char* name() const override { return "auto"; }
  int order() const override { return current_->order(); }
  int error_order() const override { return current_->steps() == Steps::own ? 2 : current_->error_order(); }
  Steps steps() const override { return Steps::adaptive; }
  bool remembers() const override { return true; }

  void restart(System& system, double t, const double* y) override {
    if (t > restarted_) spacing_ = t - restarted_;
    restarted_ = t;
    keeps_rate_ = evaluates_anew_ = false;
    current_->restart(system, t, y);
  }

  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    if (due()) compare(system, t, y, h);
    const uint64_t before = current_->work().evaluations;
    StepResult result = current_->step(system, t, y, h, y_new);
    in_step_ += current_->work().evaluations - before - (evaluates_anew_ ? 1 : 0);
    evaluates_anew_ = false;
    length_ = result.taken;
    gather_work();
    return result;
  }

  void accepted() override {
    current_->accepted();
    if (length_ > 0 && in_step_ > 0) {
      const double cost = candidates[which_].weight * static_cast<double>(in_step_) / length_;
      recent_ = recent_ == 0 ? cost : 0.8 * recent_ + 0.2 * cost;
      stages_ = 0.8 * stages_ + 0.2 * static_cast<double>(in_step_);
    }
    since_ += in_step_;
    in_step_ = 0;
    keeps_rate_ = which_ != bdf;
  }

  bool between(System& system, double t, double* y) override { return current_->between(system, t, y); }
  std::string choice() const override { return candidates[which_].name; }
  std::string why() const override { return why_; }

  void save(ByteWriter& out) const override {
    out.put(static_cast<int32_t>(which_));
    out.put(spacing_), out.put(restarted_), out.put(recent_), out.put(expected_);
    out.put(patience_), out.put(stages_), out.put(length_), out.put(since_), out.put(spent_on_trials_),
        out.put(static_cast<uint8_t>(compared_)), out.put(static_cast<uint8_t>(keeps_rate_));
    out.array(why_.data(), why_.size());
    out.array(vector_.data(), vector_.size());
    current_->save(out);
  }
  void load(ByteReader& in) override {
    choose(in.get<int32_t>());
    spacing_ = in.get<double>(), restarted_ = in.get<double>();
    recent_ = in.get<double>(), expected_ = in.get<double>();
    patience_ = in.get<double>(), stages_ = in.get<double>(), length_ = in.get<double>(), since_ = in.get<uint64_t>(),
    spent_on_trials_ = in.get<uint64_t>();
    compared_ = in.get<uint8_t>() != 0;
    keeps_rate_ = evaluates_anew_ = in.get<uint8_t>() != 0;
    const auto text = in.array<char>();
    why_.assign(text.begin(), text.end());
    const auto vector = in.array<double>();
    vector_.resize(vector.size());
    std::copy(vector.begin(), vector.end(), vector_.data());
    current_->load(in);
  }

 private:
  void choose(int which) {
    which_ = which;
    stages_ = 0;
    keeps_rate_ = evaluates_anew_ = false;
    current_ = candidates[which].make({.tolerance = options_.tolerance});
    done_ = {};
  }

  bool due() const {
    if (!compared_) return true;
    if (in_step_ > 0) return false;  // between attempts at one step
    if (which_ != bdf && stages_ > many_stages && since_ > 4 * many_stages) return true;
    // That rkc2 has become cheaper still is no reason to look at others: what they cost at best does not fall.
    const bool different = recent_ > changed * expected_ || (which_ != rkc && recent_ * changed < expected_);
    const double waits = different ? std::min(patience_, least_patience) : patience_;
    // Another look mostly tries rkc2 alone: the others' least costs are known.
    const double look = std::min(static_cast<double>(spent_on_trials_), which_ == rkc ? 1e300 : usual_look);
    return static_cast<double>(since_) > std::max(different ? wait_if_changed : least_wait, waits * look);
  }

  /// What the method in use has done, added to what others did before it and to the trials.
  void gather_work() {
    const Work& w = current_->work();
    const auto move = [&](uint64_t Work::*count) {
      work_.*count += w.*count - done_.*count;
      done_.*count = w.*count;
    };
    for (auto count : {&Work::evaluations, &Work::jacobians, &Work::factorizations, &Work::newton_iterations,
                       &Work::linear_iterations, &Work::rejected})
      move(count);
  }

  void compare(System& system, double t, const double* y, double h) {
    spent_on_trials_ = 0;
    const double rho = radius(system, t, y);
    std::array<Trial, candidates.size()> trials;
    int best = rkc;
    double enough = INFINITY;  // rkc2 need not show more than that it beats what the others cost at best
    for (int k = 0; k < bdf; ++k)
      if (k != rkc)
        enough = std::min(enough, candidates[k].weight * candidates[k].evaluations * rho / candidates[k].stability);
    for (int k = 0; k < bdf; ++k) {
      const Candidate& c = candidates[k];
      // What it costs at best, with steps as long as it is stable: no trial is needed where that is too much already.
      const double least = c.stability > 0 ? c.weight * c.evaluations * rho / c.stability : 0;
      trials[k].cost = least;
      if (k != rkc && !(least < trials[best].cost)) continue;
      if (compared_ && k == which_ && recent_ > 0)
        trials[k] = {recent_, length_};  // known from its steps
      else
        trials[k] = attempt(system, k, t, y, h, k == rkc ? enough : 0);
      const bool bounded = c.stability > 0 && trials[k].length * rho > 0.5 * c.stability;
      if (trials[k].cost * (bounded && best == rkc ? advantage : 1) < trials[best].cost) best = k;
    }
    const bool stiff = which_ == bdf ? trials[best].in_last_step > many_stages / 2
                                     : best == rkc && stages_ > many_stages && implicit_possible(system);
    if (stiff) best = bdf;
    expected_ = recent_ = std::isfinite(trials[best].cost) && !stiff ? trials[best].cost : 0;
    explain(trials, best, stiff, rho);
    since_ = 0;
    patience_ = !compared_ ? first_patience : best == which_ ? std::min(2 * patience_, most_patience) : least_patience;
    compared_ = true;
    if (best == which_) return;
    choose(best);
    current_->restart(system, t, y);
  }

  double radius(System& system, double t, const double* y) {
    if (trial_.size() != system.state_size()) trial_.resize(system.state_size());
    rates(system, t, y, trial_.data());
    const SpectralRadius found = spectral_radius(system, t, y, trial_.data(), vector_);
    work_.evaluations += found.evaluations;
    spent_on_trials_ += found.evaluations + 1;
    return found.radius;
  }

  static bool implicit_possible(System& system) {
    const Jacobian jacobian(system);
    return jacobian.missing().empty() && jacobian.kinks().empty();
  }

  /// A few steps with one method from the state at hand, which stays what it is; fewer once they cost less than
  /// `enough`.
  Trial attempt(System& system, int which, double t, const double* y, double h, double enough) {
    const auto method = candidates[which].make({.tolerance = options_.tolerance});
    const size_t size = system.state_size();
    for (AlignedBuffer* buffer : {&trial_, &trial_new_})
      if (buffer->size() != size) buffer->resize(size);
    std::copy(y, y + size, trial_.data());
    method->restart(system, t, y);
    Trial found;
    for (int accepted = 0; accepted < trial_steps && method->work().evaluations < trial_evaluations;) {
      h = spacing_ > 0 ? std::min(h, spacing_) : h;
      const uint64_t before = method->work().evaluations;
      const StepResult r = method->step(system, t, trial_.data(), h, trial_new_.data());
      const double error = r.failed || !std::isfinite(r.error) ? 1e6 : std::max(r.error, 1e-6);
      if (error <= 1) {
        method->accepted();
        std::swap(trial_, trial_new_);
        t += r.taken;
        found.in_last_step = static_cast<double>(method->work().evaluations - before);
        found.length = r.taken;
        found.cost = candidates[which].weight * found.in_last_step / r.taken;
        ++accepted;
      }
      const double factor = std::clamp(0.9 * std::pow(error, -1.0 / method->error_order()), 0.2, 5.0);
      if (error <= 1 && accepted >= least_steps && (factor < 1.5 || found.cost < enough)) break;
      h = (r.taken > 0 ? r.taken : h) * factor;
    }
    work_.evaluations += method->work().evaluations;
    spent_on_trials_ += method->work().evaluations;
    return found;
  }

  void explain(const std::array<Trial, candidates.size()>& trials, int best, bool stiff, double rho) {
    why_ = fmt::format("{}: ", candidates[best].name);
    if (stiff)
      why_ += fmt::format("explicit steps need {:.0f} stages each, and the rules can be differentiated", stages_);
    else
      why_ += "fewest evaluations per unit of time in trial steps";
    why_ += " (";
    for (int k = 0; k < bdf; ++k) {
      why_ += fmt::format("{}{} {:.3g}", k ? "; " : "", candidates[k].name, trials[k].cost / candidates[k].weight);
      why_ += trials[k].length > 0 ? fmt::format(" in steps of {:.2g}", trials[k].length) : " at best";
    }
    why_ += fmt::format("; spectral radius {:.3g}", rho);
    if (spacing_ > 0) why_ += fmt::format("; changes from outside every {:.3g}", spacing_);
    why_ += ")";
  }

  StepperOptions options_;
  int which_ = 0;
  std::unique_ptr<Stepper> current_;
  Work done_;  ///< of current_, that work_ holds
  double spacing_ = 0, restarted_ = 0;
  double recent_ = 0, expected_ = 0;  ///< weighted evaluations per unit of time: seen, and at the last choice
  double length_ = 0, stages_ = 0, patience_ = least_patience;  ///< stages_: evaluations per step, of late
  uint64_t in_step_ = 0, since_ = 0, spent_on_trials_ = 0;
  bool compared_ = false;
  /// Whether the next step begins with a rate that is known; after load() it is computed anew, which must not count.
  bool keeps_rate_ = false, evaluates_anew_ = false;
  std::string why_;
  AlignedBuffer trial_, trial_new_, vector_;
};

}  // namespace

std::unique_ptr<Stepper> make_auto(const StepperOptions& options) { return std::make_unique<Auto>(options); }

}  // namespace tunica
