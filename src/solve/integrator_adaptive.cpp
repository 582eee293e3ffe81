// SPDX-License-Identifier: MIT
// Steps whose length the tolerance decides, and looking into the last step.
#include <algorithm>
#include <cmath>

#include "solve/integrator_run.h"
#include "solve/tolerance.h"

namespace tunica {

namespace {

/// A step shorter than this, relative to the time or to the longest step tried, cannot be told from none.
constexpr double least_step = 1e-12;

/// Short work that is not to be broken off: what it is part of could not be gone on with in the same bits.
class Uninterrupted {
 public:
  explicit Uninterrupted(System& system) : system_(system), before_(system.heed(nullptr)) {}
  ~Uninterrupted() { system_.heed(before_); }
  Uninterrupted(const Uninterrupted&) = delete;

 private:
  System& system_;
  const CancelFlag* before_;
};

/// The length h for which t + h is the target, to the last bit where there is one.
double exact_length(double t, double target) {
  const double h = target - t;
  for (const double candidate : {h, std::nextafter(h, -INFINITY), std::nextafter(h, INFINITY)})
    if (t + candidate == target) return candidate;
  return h;
}

}  // namespace

Integrator::Status Integrator::run_adaptive(const Run& run) {
  if (inside_) {
    if (const auto status = within_last_step(run)) return *status;
  }
  while (true) {
    if (run.cancel && run.cancel->requested()) return Status::interrupted;
    const double shown = time();
    adaptive_step(run.target);
    inside_ = false;
    if (run.pause && *run.pause > shown && *run.pause < end() - slack()) {
      show(*run.pause);
      return Status::paused;
    }
    if (end() >= run.target - slack()) return Status::reached;
    if (run.pause && end() >= *run.pause - slack()) return Status::paused;
    if (run.out_of_time && run.out_of_time()) return Status::out_of_time;
  }
}

/// What can be done without a new step, when the state shown lies within the last one.
std::optional<Integrator::Status> Integrator::within_last_step(const Run& run) {
  const double near = slack();
  if (run.target < end() - near) {  // a new event before the end of the step: that step is not taken
    back();
    return {};
  }
  if (run.pause && *run.pause > shown_ + near && *run.pause < end() - near) {
    show(*run.pause);
    return Status::paused;
  }
  if (run.target > end() + near) return {};
  inside_ = false;
  return Status::reached;
}

/// The state before the last step.
void Integrator::back() {
  std::swap(y_, before());
  if (adaptive()) {
    origin_ = begin_;
  } else {
    origin_ = begun_.origin;
    index_ = begun_.index;
    between_ = begun_.between;
  }
  --steps_;
  inside_ = have_last_ = have_slopes_ = false;
  stepper_->restart(*system_, begin_, y_.data());
}

void Integrator::adaptive_step(double target) {
  const double t = end();
  const bool own = stepper_->steps() == Stepper::Steps::own;
  if (!own && !(next_ > 0)) next_ = first_length();
  while (true) {
    double h = std::min(own && !rejected_ ? Integrator::unlimited : next_, dt_);
    const bool shortened = t + 1.0001 * h >= target;
    if (shortened) h = exact_length(t, target);
    if (!own) longest_ = std::max(longest_, h);
    const StepResult result = stepper_->step(*system_, t, y_.data(), h, y_new_.data());
    if (own) longest_ = std::max(longest_, result.taken);
    std::optional<Watch::Symptom> symptom;
    if (!result.failed) symptom = watch_.state(*system_, y_.data(), y_new_.data(), result.flags, margin());
    if (!result.failed && !symptom && result.error <= 1) {
      accept(result, shortened && result.taken == h);
      if (shortened && result.taken == h && end() != target) {
        origin_ = target;  // the method believes to be a last bit away from it
        stepper_->restart(*system_, target, y_.data());
      }
      return;
    }
    reject(result, symptom);
  }
}

/// Proportional-integral control of the step (Gustafsson 1991; Hairer and Wanner II, IV.2).
void Integrator::accept(const StepResult& result, bool shortened) {
  const double power = 1.0 / stepper_->error_order(), error = std::max(result.error, 1e-10);
  double factor = 0.9 * std::pow(error, -0.7 * power) * std::pow(error_before_, 0.4 * power);
  factor = std::clamp(factor, 0.2, rejected_ ? 1.0 : 5.0);
  const double proposed = result.taken * factor;
  if (!(shortened && result.taken < next_)) {
    next_ = proposed;
    error_before_ = std::max(error, 1e-4);
  } else if (!rejected_) {
    next_ = std::max(next_, proposed);  // a step cut to meet the target says little
  }
  rejected_ = false;
  begin_ = end();
  origin_ = begin_ + result.taken;
  index_ = 0;
  std::swap(y_before_, y_);
  std::swap(y_, y_new_);
  stepper_->accepted();
  have_last_ = true;
  have_slopes_ = false;
  ++steps_;
}

void Integrator::reject(const StepResult& result, const std::optional<Watch::Symptom>& symptom) {
  const double tried = result.taken > 0 ? result.taken : next_;
  double factor = 0.25;
  if (!result.failed && !symptom && std::isfinite(result.error))
    factor = std::clamp(0.9 * std::pow(result.error, -1.0 / stepper_->error_order()), 0.1, 0.9);
  next_ = tried * factor;
  rejected_ = true;
  ++rejections_;
  if (next_ > least_step * std::max(std::fabs(end()), longest_)) return;
  next_ = 0;
  if (result.failed) refuse_method(result, end());
  std::optional<Watch::Symptom> bad = symptom;
  if (!bad && !std::isfinite(result.error)) bad = bad_rate(end() + tried, y_new_.data());
  Watch::Symptom where = bad ? *bad : Watch::most_changed(*system_, "step size", y_.data(), y_new_.data());
  const std::string why = std::string(where.kind) == "not finite" ? "it, or its rate, is then not finite"
                          : symptom                               ? "it is then negative"
                                                                  : "the error is then too large";
  where.kind = "step size";
  refuse(where, end(),
         fmt::format("no step is short enough ({:.3g} was tried): {}. Look at its rule for a jump, a division by zero "
                     "or a value that runs away{}",
                     tried, why,
                     symptom ? "; if it may be negative, list it in signed = { ... } of tunica.model"
                             : "; a larger tolerance may help"));
}

/// Where the rates of a state are not finite, if anywhere.
std::optional<Watch::Symptom> Integrator::bad_rate(double time, const double* y) {
  AlignedBuffer rate;
  rate.resize(system_->state_size());
  system_->rates(time, y, rate.data());
  for (size_t k = 0; k < system_->state().size(); ++k) {
    const System::StateColumn& s = system_->state()[k];
    for (Index i = 0; i < s.count; ++i)
      if (!std::isfinite(rate.data()[s.offset + i])) return Watch::Symptom{"not finite", k, i, y[s.offset + i]};
  }
  return {};
}

/// The length of the very first step (Hairer, Norsett and Wanner I, II.4).
double Integrator::first_length() {
  const size_t size = system_->state_size();
  AlignedBuffer rate, moved, rate_moved;
  for (AlignedBuffer* buffer : {&rate, &moved, &rate_moved}) buffer->resize(size);
  const double *y = y_.data(), *f = rate.data(), *g = rate_moved.data();
  ErrorNorm norm(tolerance_);
  norm.scale(*system_, y);
  system_->rates(end(), y, rate.data());
  evaluations_ += 2;
  const double state = norm(y), speed = norm(f);
  const double h0 = state > 1e-5 && speed > 1e-5 ? 0.01 * state / speed : 1e-6;
  for (size_t i = 0; i < size; ++i) moved.data()[i] = y[i] + h0 * f[i];
  system_->rates(end() + h0, moved.data(), rate_moved.data());
  const double bend = norm.of([=](size_t i) { return g[i] - f[i]; }) / h0, most = std::max(speed, bend);
  const double h1 = most > 1e-15 ? std::pow(0.01 / most, 1.0 / stepper_->error_order()) : std::max(1e-6, 1e-3 * h0);
  const double h = std::min(100 * h0, h1);
  return h > 0 && std::isfinite(h) ? std::min(h, dt_) : std::min(1e-6, dt_);
}

std::optional<Integrator::Step> Integrator::last_step() const {
  if (!have_last_) return {};
  return Step{begin_, end()};
}

void Integrator::interpolate(double time, double* y) {
  if (stepper_->between(*system_, time, y)) return;
  const size_t size = system_->state_size();
  const double h = end() - begin_, x = (time - begin_) / h;
  const double *y0 = before().data(), *y1 = y_.data();
  if (stepper_->order() == 1) {
    for (size_t i = 0; i < size; ++i) y[i] = y0[i] + x * (y1[i] - y0[i]);
    return;
  }
  if (!have_slopes_) {
    for (AlignedBuffer* buffer : {&slope_begin_, &slope_end_})
      if (buffer->size() != size) buffer->resize(size);
    system_->rates(begin_, y0, slope_begin_.data());
    system_->rates(end(), y1, slope_end_.data());
    evaluations_ += 2;
    have_slopes_ = true;
  }
  const double *f0 = slope_begin_.data(), *f1 = slope_end_.data();
  const double a = x * x * (3 - 2 * x), b = h * x * (1 - x) * (1 - x), c = -h * x * x * (1 - x);
  for (size_t i = 0; i < size; ++i) y[i] = y0[i] + a * (y1[i] - y0[i]) + b * f0[i] + c * f1[i];
}

void Integrator::show(double time) {
  if (!have_last_ || !(time >= begin_ && time <= end())) fail("internal: time {} is not in the last step", time);
  if (time == end()) {
    inside_ = false;
    system_->write_state(y_.data());
    if (stepper_->remembers()) seen_ = fingerprint();
    return;
  }
  const Uninterrupted whole(*system_);
  AlignedBuffer state;
  state.resize(system_->state_size());
  interpolate(time, state.data());
  system_->write_state(state.data());
  inside_ = true;
  shown_ = time;
  if (stepper_->remembers()) seen_ = fingerprint();
}

Integrator::Status Integrator::retake(double time) {
  if (!have_last_ || !(time > begin_)) fail("internal: time {} is not after the start of the last step", time);
  const Uninterrupted whole(*system_);
  back();
  return guarded([&] {
    if (adaptive()) return run_adaptive({time, {}, {}, nullptr});
    fixed_step(time - begin_, time);
    between_ = time;
    return Status::reached;
  });
}

}  // namespace tunica
