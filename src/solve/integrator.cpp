// SPDX-License-Identifier: MIT
#include "solve/integrator.h"

#include <algorithm>
#include <cmath>

namespace tunica {

namespace {

/// Steps between looks at the clock, and the pattern of looking for oscillation: four steps in a row out of 128.
constexpr uint64_t clock_interval = 16, watch_interval = 128, watch_length = 6;

}  // namespace

Integrator::Integrator(std::shared_ptr<System> system, std::unique_ptr<Stepper> stepper, double dt)
    : system_(std::move(system)), stepper_(std::move(stepper)), dt_(dt) {
  if (!(dt > 0) || !std::isfinite(dt)) fail("dt must be a positive time step, not {}", dt);
}

void Integrator::load_state(const std::vector<double>& parameters) {
  system_->prepare(parameters);
  const size_t size = system_->state_size();
  for (AlignedBuffer* buffer : {&y_, &y_new_, &before_})
    if (buffer->size() != size) buffer->resize(size);
  system_->read_state(y_.data());
  watch_negative_.assign(system_->state().size(), 0);
  for (size_t k = 0; k < watch_negative_.size(); ++k) {
    const System::StateColumn& s = system_->state()[k];
    const double* first = y_.data() + s.offset;
    for (Index i = 0; i < s.count; ++i)
      if (!std::isfinite(first[i]))
        refuse("not finite", k, i, first[i], time(), "it was so before the step; look at what set it");
    const bool meant = std::find(signed_.begin(), signed_.end(), s.name) != signed_.end();
    watch_negative_[k] = !meant && std::none_of(first, first + s.count, [](double v) { return v < 0; });
  }
  alternations_ = 0;
}

Integrator::Status Integrator::advance(double target, std::optional<double> pause,
                                       const std::function<bool()>& out_of_time, const CancelFlag* cancel,
                                       const std::vector<double>& parameters) {
  const double slack = 1e-9 * dt_;
  if (target < time() - slack) fail("cannot run backwards, from time {} to {}", time(), target);
  if (target <= time() + slack) return Status::reached;
  load_state(parameters);
  struct Unlock {
    Tissue& tissue;
    ~Unlock() { tissue.lock(false); }
  } unlock{system_->tissue()};
  system_->tissue().lock(true);
  const auto run = [&] {
    while (true) {
      if (cancel && cancel->requested()) return Status::interrupted;
      const double next = origin_ + static_cast<double>(index_ + 1) * dt_;
      if (next > target + slack) {
        step(target - time(), target);
        origin_ = target;
        index_ = 0;
        return Status::reached;
      }
      step(dt_, next);
      ++index_;
      if (time() >= target - slack) return Status::reached;
      if (pause && time() >= *pause - slack) return Status::paused;
      if (steps_ % clock_interval == 0 && out_of_time && out_of_time()) return Status::out_of_time;
    }
  };
  Status status = Status::interrupted;
  try {
    status = run();
  } catch (const Cancelled&) {
  } catch (...) {
    system_->write_state(y_.data());
    throw;
  }
  system_->write_state(y_.data());
  return status;
}

void Integrator::step(double h, double end) {
  const std::vector<uint8_t>& flags = stepper_->step(*system_, time(), y_.data(), h, y_new_.data());
  if (std::any_of(flags.begin(), flags.end(), [](uint8_t f) { return f != 0; })) check(flags, end);
  if (steps_ % watch_interval < watch_length) check_oscillation(end);
  std::swap(y_, y_new_);
  ++steps_;
}

void Integrator::check(const std::vector<uint8_t>& flags, double time) {
  for (size_t k = 0; k < flags.size(); ++k) {
    const System::StateColumn& s = system_->state()[k];
    const double* values = y_new_.data() + s.offset;
    if (flags[k] & not_finite) {
      for (Index i = 0; i < s.count; ++i)
        if (!std::isfinite(values[i]))
          refuse("not finite", k, i, values[i], time, "try a smaller dt, or look for a division by zero in its rule");
    }
    if ((flags[k] & negative) && watch_negative_[k]) {
      const double* old = y_.data() + s.offset;
      const double largest = *std::max_element(old, old + s.count);
      for (Index i = 0; i < s.count; ++i)
        if (values[i] < -1e-9 * largest)
          refuse("negative", k, i, values[i], time,
                 "a concentration cannot be; try a smaller dt. If it may be negative, list it in signed = { ... } of "
                 "tunica.model");
    }
  }
}

/// Forward-Euler instability shows as a change that turns round at every step and grows.
void Integrator::check_oscillation(double time) {
  const uint64_t phase = steps_ % watch_interval;
  const size_t size = system_->state_size();
  double* before = before_.data();
  const double *y = y_.data(), *next = y_new_.data();
  if (phase == 0) {
    for (size_t i = 0; i < size; ++i) before[i] = next[i] - y[i];
    alternations_ = 0;
    return;
  }
  for (size_t k = 0; k < system_->state().size(); ++k) {
    const System::StateColumn& s = system_->state()[k];
    double product = 0, last = 0, now = 0, largest = 0;
    Index where = 0;
    for (Index i = 0; i < s.count; ++i) {
      const double change = next[s.offset + i] - y[s.offset + i], previous = before[s.offset + i];
      product += change * previous;
      last += previous * previous;
      now += change * change;
      if (std::fabs(change) > largest) largest = std::fabs(change), where = i;
    }
    if (product < -0.9 * std::sqrt(last * now) && now > last && largest > 1e-6 * std::fabs(y[s.offset + where]))
      alternations_ += 1;
    if (phase == watch_length - 1 && alternations_ >= static_cast<int>(watch_length) - 1)
      refuse("oscillation", k, where, next[s.offset + where], time,
             "the change turns round at every step and grows: dt is too long for this method");
  }
  for (size_t i = 0; i < size; ++i) before[i] = next[i] - y[i];
}

void Integrator::refuse(const char* kind, size_t column, Index element, double value, double time,
                        const std::string& advice) {
  const System::StateColumn& s = system_->state()[column];
  const Id id = system_->tissue().id(s.kind, element);
  const std::string what = std::string(kind) == "oscillation" ? fmt::format("{} swings (now {:.6g})", s.name, value)
                                                              : fmt::format("{} became {:.6g}", s.name, value);
  throw StepFailed({kind, time, s.name, s.kind, id, value,
                    fmt::format("{} in {} {} at time {:.9g} (method {}, dt {:.6g}): {}", what, name_of(s.kind), id,
                                time, stepper_->name(), dt_, advice)});
}

void Integrator::save(ByteWriter& out) const {
  out.put(origin_);
  out.put(index_);
  out.put(steps_);
  out.put(dt_);
}

void Integrator::load(ByteReader& in) {
  origin_ = in.get<double>();
  index_ = in.get<uint64_t>();
  steps_ = in.get<uint64_t>();
  dt_ = in.get<double>();
}

}  // namespace tunica
