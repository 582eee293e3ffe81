// SPDX-License-Identifier: MIT
#include "solve/integrator.h"

#include <algorithm>
#include <cmath>

#include "solve/integrator_run.h"
#include "solve/spectral_radius.h"
#include "tissue/statistics.h"

namespace tunica {

namespace {

/// Steps between looks at the clock.
constexpr uint64_t clock_interval = 16;

}  // namespace

Integrator::Integrator(std::shared_ptr<System> system, std::unique_ptr<Stepper> stepper, double dt, double tolerance)
    : system_(std::move(system)), stepper_(std::move(stepper)), dt_(dt), tolerance_(tolerance) {
  if (!(dt > 0) || !(std::isfinite(dt) || adaptive())) fail("dt must be a positive time step, not {}", dt);
  if (!(tolerance > 0) || !std::isfinite(tolerance)) fail("the tolerance must be a positive number, not {}", tolerance);
}

double Integrator::slack() const {
  if (!adaptive()) return std::max(1e-9 * dt_, 4e-16 * std::fabs(time()));
  return 1e-12 * std::max(std::fabs(time()), longest_);
}

Work Integrator::work() const {
  Work work = stepper_->work();
  work.evaluations += evaluations_;
  work.rejected += rejections_;
  return work;
}

/// A fingerprint of all that rates may depend on: structure, columns except derived ones.
std::string Integrator::fingerprint() const {
  const Tissue& tissue = system_->tissue();
  const Equations& e = system_->equations();
  ByteWriter out;
  for (int k = 0; k < kinds; ++k) {
    const Kind kind = static_cast<Kind>(k);
    const Index count = tissue.count(kind);
    out.put(count);
    for (const auto& column : tissue.columns(kind)) {
      const auto derives = [&](int slot) {
        return e.columns[slot].kind == kind && e.columns[slot].name == column->name;
      };
      bool derived = false;
      for (const Equations::Derivation& d : e.derivations)
        for (const Target& t : d.traced) derived = derived || derives(t.column);
      for (const DirectRule& rule : e.direct_derivations)
        derived = derived || std::any_of(rule.columns.begin(), rule.columns.end(), derives);
      if (derived) continue;
      out.text(column->name);
      out.text(hash({reinterpret_cast<const char*>(column->values.data()), sizeof(double) * count}));
    }
  }
  if (tissue.cells() > 0) out.put(tissue.id(Kind::cell, tissue.cells() - 1));
  out.array(parameters_.data(), parameters_.size());
  return hash(out.bytes());
}

void Integrator::enter(const std::vector<double>& parameters) {
  parameters_ = parameters;
  system_->prepare(parameters);
  const size_t size = system_->state_size();
  const bool known = !seen_.empty() && (!inside_ || y_.size() == size);
  for (AlignedBuffer* buffer : {&y_, &y_new_, &y_before_})
    if (buffer->size() != size && (buffer != &y_before_ || adaptive())) buffer->resize(size);
  const bool unchanged = stepper_->remembers() && known && seen_ == fingerprint();
  have_slopes_ = false;
  if (!unchanged && inside_) {
    origin_ = shown_;
    index_ = 0;
    inside_ = false;
  }
  if (!inside_) system_->read_state(y_.data());
  have_last_ = unchanged && inside_;
  if (const auto symptom = watch_.begin(*system_, y_.data(), margin()))
    refuse(*symptom, time(), "it was so before the step; look at what set it");
  if (!unchanged) stepper_->restart(*system_, end(), y_.data());
}

void Integrator::leave() {
  if (!inside_) system_->write_state(y_.data());
  if (stepper_->remembers()) seen_ = fingerprint();
}

/// Runs `work` with the structure locked; the tissue holds the state whenever it ends.
Integrator::Status Integrator::guarded(const std::function<Status()>& work) {
  struct Unlock {
    Tissue& tissue;
    ~Unlock() { tissue.lock(false); }
  } unlock{system_->tissue()};
  system_->tissue().lock(true);
  Status status = Status::interrupted;
  try {
    status = work();
  } catch (const Cancelled&) {
  } catch (...) {
    leave();
    throw;
  }
  leave();
  return status;
}

Integrator::Status Integrator::advance(double target, std::optional<double> pause,
                                       const std::function<bool()>& out_of_time, const CancelFlag* cancel,
                                       const std::vector<double>& parameters) {
  if (target < time() - slack()) fail("cannot run backwards, from time {} to {}", time(), target);
  if (target <= time() + slack()) return Status::reached;
  enter(parameters);
  return guarded([&] {
    const Run arguments{target, pause, out_of_time, cancel};
    return adaptive() ? run_adaptive(arguments) : run_fixed(arguments);
  });
}

Integrator::Status Integrator::run_fixed(const Run& run) {
  const double near = slack();
  while (true) {
    if (run.cancel && run.cancel->requested()) return Status::interrupted;
    const double next = origin_ + static_cast<double>(index_ + 1) * dt_;
    if (next > run.target + near) {
      fixed_step(run.target - time(), run.target);
      between_.reset();
      origin_ = run.target;
      index_ = 0;
      return Status::reached;
    }
    if (between_ && next - *between_ <= near) {  // nothing is left of the step
      between_.reset();
      ++index_;
      if (next >= run.target - near) return Status::reached;
      continue;
    }
    fixed_step(between_ ? next - *between_ : dt_, next);
    between_.reset();
    ++index_;
    if (time() >= run.target - near) return Status::reached;
    if (run.pause && time() >= *run.pause - near) return Status::paused;
    if (steps_ % clock_interval == 0 && run.out_of_time && run.out_of_time()) return Status::out_of_time;
  }
}

void Integrator::fixed_step(double h, double end) {
  const double begin = time();
  begun_ = {origin_, index_, between_};
  have_last_ = have_slopes_ = false;
  const StepResult result = stepper_->step(*system_, begin, y_.data(), h, y_new_.data());
  if (result.failed) refuse_method(result, end);
  if (const auto symptom = watch_.state(*system_, y_.data(), y_new_.data(), result.flags, margin()))
    refuse(*symptom, end,
           std::string(symptom->kind) == "negative"
               ? "a concentration cannot be; try a smaller dt. If it may be negative, list it in signed = { ... } of "
                 "tunica.model"
               : "try a smaller dt, or look for a division by zero in its rule");
  if (const auto symptom = watch_.oscillation(*system_, steps_, y_.data(), y_new_.data()))
    refuse(
        *symptom, end,
        "the change turns round at every step and grows" + alternation(*symptom) + ": dt is too long for this method");
  std::swap(y_, y_new_);
  stepper_->accepted();
  begin_ = begin;
  have_last_ = true;
  ++steps_;
}

/// Whether the step is longer than the method is stable for, in words; otherwise nothing. Evaluates rates at the last
/// good state, only when something has gone wrong.
std::string Integrator::explanation() {
  if (adaptive() || !(stepper_->stability() > 0)) return "";
  try {
    AlignedBuffer rate, vector;
    rate.resize(system_->state_size());
    system_->rates(time(), y_.data(), rate.data());
    vector.resize(system_->state_size());  // the change in the bad step points along the mode that is unstable
    for (size_t i = 0; i < vector.size(); ++i) {
      const double change = y_new_.data()[i] - y_.data()[i];
      vector.data()[i] = std::isfinite(change) ? change : 0;
    }
    const SpectralRadius found = spectral_radius(*system_, time(), y_.data(), rate.data(), vector, 1e-4, 500);
    const double limit = stepper_->stability() / found.radius;
    if (!(limit > 0) || !std::isfinite(limit) || !(dt_ > 0.94 * limit)) return "";
    return fmt::format(". dt = {:.4g} is {} this method's limit of about {:.3g} here", dt_,
                       dt_ > limit ? "above" : "at", limit);
  } catch (const std::exception&) {
    return "";
  }
}

void Integrator::derive(const std::vector<double>& parameters, bool checked) {
  system_->prepare(parameters);
  AlignedBuffer y;
  y.resize(system_->state_size());
  system_->read_state(y.data());
  system_->derive(time(), y.data());
  if (!checked) return;
  const Equations& e = system_->equations();
  for (const Equations::Derivation& d : e.derivations) {
    for (const Target& target : d.traced) check_derived(target.column);
    if (d.direct >= 0)
      for (const int column : e.direct_derivations[d.direct].columns) check_derived(column);
  }
}

void Integrator::check_derived(int column) {
  const Equations::ColumnRef& ref = system_->equations().columns[column];
  const Tissue& tissue = system_->tissue();
  const double* values = tissue.find_column(ref.kind, ref.name)->values.data();
  const double* end = values + tissue.count(ref.kind);
  const double* wrong = std::find_if(values, end, [](double v) { return !std::isfinite(v); });
  if (wrong == end) return;
  const Id id = tissue.id(ref.kind, static_cast<Index>(wrong - values));
  throw StepFailed({"not finite", time(), ref.name, ref.kind, id, *wrong,
                    fmt::format("{} became {:.6g} in {} {} at time {:.9g} ({}): it is derived; look for a division by "
                                "zero in its rule",
                                ref.name, *wrong, name_of(ref.kind), id, time(), method())});
}

std::string Integrator::method() const {
  const std::string step = adaptive() ? fmt::format("tolerance {:.6g}", tolerance_) : fmt::format("dt {:.6g}", dt_);
  return fmt::format("method {}, {}", stepper_->name(), step);
}

std::string Integrator::alternation(const Watch::Symptom& symptom) const {
  const System::StateColumn& s = system_->state()[symptom.column];
  if (s.kind != Kind::cell) return "";
  std::vector<double> change(s.count);
  for (Index c = 0; c < s.count; ++c) change[c] = y_new_.data()[s.offset + c] - y_.data()[s.offset + c];
  const double index = checkerboard_index(system_->tissue(), change.data());
  return !alternates(system_->tissue(), index)
             ? ""
             : fmt::format(", up and down from cell to cell (checkerboard index {:.2f})", index);
}

void Integrator::refuse(const Watch::Symptom& symptom, double time, const std::string& advice) {
  const System::StateColumn& s = system_->state()[symptom.column];
  const Id id = system_->tissue().id(s.kind, symptom.element);
  const std::string kind = symptom.kind;
  const std::string what = kind == "oscillation" ? fmt::format("{} swings (now {:.6g})", s.name, symptom.value)
                           : kind == "step size" || (std::isfinite(symptom.value) && kind == "not finite")
                               ? fmt::format("{} (now {:.6g})", s.name, symptom.value)
                               : fmt::format("{} became {:.6g}", s.name, symptom.value);
  throw StepFailed({kind, time, s.name, s.kind, id, symptom.value,
                    fmt::format("{} in {} {} at time {:.9g} ({}): {}{}", what, name_of(s.kind), id, time, method(),
                                advice, explanation())});
}

void Integrator::refuse_method(const StepResult& result, double time) {
  // Newton's method and its like only see that something is wrong; where, the rates say.
  // A method with steps of its own stops just short of a jump in time.
  std::optional<Watch::Symptom> bad = bad_rate(time, y_.data());
  for (const double ahead : {1e-6 * (std::fabs(time) + longest_), longest_})
    if (!bad && adaptive()) bad = bad_rate(time + ahead, y_.data());
  if (bad) {
    Watch::Symptom rate = *bad;
    rate.kind = "not finite";
    refuse(
        rate, time,
        fmt::format("its rate is not finite there, so the step (method {}) cannot be computed; look for a division by "
                    "zero in its rule",
                    stepper_->name()));
  }
  const Watch::Symptom where = Watch::most_changed(*system_, result.failed, y_.data(), y_.data());
  const System::StateColumn& s = system_->state()[where.column];
  throw StepFailed({result.failed, time, s.name, s.kind, system_->tissue().id(s.kind, where.element), where.value,
                    fmt::format("the step to time {:.9g} cannot be computed (method {}, {}): {}", time,
                                stepper_->name(), result.failed, result.detail)});
}

void Integrator::continue_from(double time, uint64_t steps) {
  origin_ = time;
  index_ = 0;
  between_.reset();
  steps_ = steps;
  inside_ = have_last_ = false;
  seen_.clear();
}

void Integrator::save(ByteWriter& out) const {
  out.put(adaptive() ? end() : origin_);
  out.put(index_);
  out.put(steps_);
  out.put(dt_);
  if (!stepper_->remembers() && !between_) return;
  out.text(stepper_->name());
  out.put(time());
  out.put(static_cast<uint8_t>(between_.has_value()));
  out.put(next_);
  out.put(error_before_);
  out.put(longest_);
  out.put(static_cast<uint8_t>(rejected_));
  out.put(static_cast<uint8_t>(inside_));
  out.put(begin_);
  out.text(seen_);
  out.array(y_.data(), inside_ ? y_.size() : 0);
  out.array(y_before_.data(), inside_ ? y_before_.size() : 0);
  ByteWriter kept;
  stepper_->save(kept);
  out.text(kept.bytes());
}

void Integrator::load(ByteReader& in) {
  const double origin = in.get<double>();
  const uint64_t index = in.get<uint64_t>(), steps = in.get<uint64_t>();
  const double dt = in.get<double>();
  std::string method;
  double shown = index == 0 ? origin : origin + static_cast<double>(index) * dt;
  if (!in.at_end()) {
    method = in.text();
    shown = in.get<double>();
  }
  if ((method.empty() ? stepper_->remembers() : method != stepper_->name()) || (!adaptive() && dt != dt_)) {
    continue_from(shown, steps);
    return;
  }
  continue_from(origin, steps);
  index_ = index;
  if (method.empty()) return;
  if (in.get<uint8_t>() != 0) between_ = shown;
  next_ = in.get<double>();
  error_before_ = in.get<double>();
  longest_ = in.get<double>();
  rejected_ = in.get<uint8_t>() != 0;
  inside_ = in.get<uint8_t>() != 0;
  shown_ = shown;
  begin_ = in.get<double>();
  seen_ = in.text();
  for (AlignedBuffer* buffer : {&y_, &y_before_}) {
    const auto values = in.array<double>();
    if (!inside_) continue;
    buffer->resize(values.size());
    std::copy(values.begin(), values.end(), buffer->data());
  }
  const std::string kept = in.text();
  ByteReader reader(kept);
  stepper_->load(reader);
}

}  // namespace tunica
