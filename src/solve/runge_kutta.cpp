// SPDX-License-Identifier: MIT
#include "solve/runge_kutta.h"

#include <array>
#include <utility>

#include "solve/tolerance.h"

namespace tunica {

namespace {

/// Buffers of the state's size, kept while it stays the same.
template <size_t count>
void fit(std::array<AlignedBuffer, count>& buffers, size_t size) {
  for (AlignedBuffer& buffer : buffers)
    if (buffer.size() != size) buffer.resize(size);
}

class Euler : public Stepper {
 public:
  const char* name() const override { return "euler"; }
  int order() const override { return 1; }
  double stability() const override { return 2; }
  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    ++work_.evaluations;
    StepResult result{.taken = h};
    result.flags = &system.euler(t, y, h, y_new);
    return result;
  }
};

/// Euler steps of unequal lengths, 1 / ((nu - 1) cos((2j - 1) pi / 2s) + 1 + nu) for j = s ... 1 with s = 5, nu = .05,
/// scaled to the step: what they do to a mode is a Chebyshev polynomial. The shortest comes first and takes out the
/// fastest modes before a longer one could make them grow; in the other order concentrations fall below zero on the
/// way.
class SuperTimeStepping : public Stepper {
 public:
  const char* name() const override { return "sts"; }
  int order() const override { return 1; }
  /// Twice the sum of those lengths: so far all modes but the slowest shrink to a fifth at every step. None grows up to
  /// 22.99, but what is near that swings for long.
  double stability() const override { return 21.89; }
  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    static constexpr std::array<double, 5> lengths{0.04676478324198304, 0.056798933368409764, 0.08700493014069491,
                                                   0.1858308205986036, 0.6236005326503086};
    fit(between_, system.state_size());
    double *to = y_new, *other = between_[0].data();
    StepResult result{.taken = h};
    for (const double length : lengths) {
      ++work_.evaluations;
      result.flags = &system.euler(t, y, length * h, to);
      t += length * h;
      y = to;
      std::swap(to, other);
    }
    return result;
  }

 private:
  std::array<AlignedBuffer, 1> between_;
};

/// y* = y + h f(t, y);  y_new = y + h/2 (f(t, y) + f(t + h, y*))
class Heun : public Stepper {
 public:
  const char* name() const override { return "heun"; }
  int order() const override { return 2; }
  double stability() const override { return 2; }
  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    const size_t size = system.state_size();
    fit(k_, size);
    const double *first = k_[0].data(), *second = k_[1].data();
    rates(system, t, y, k_[0].data());
    for (size_t i = 0; i < size; ++i) y_new[i] = y[i] + h * first[i];
    rates(system, t + h, y_new, k_[1].data());
    for (size_t i = 0; i < size; ++i) y_new[i] = y[i] + 0.5 * h * (first[i] + second[i]);
    return {.taken = h};
  }

 private:
  std::array<AlignedBuffer, 2> k_;
};

class RungeKutta4 : public Stepper {
 public:
  const char* name() const override { return "rk4"; }
  int order() const override { return 4; }
  double stability() const override { return 2.785; }
  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    const size_t size = system.state_size();
    fit(k_, size);
    const double *k1 = k_[0].data(), *k2 = k_[1].data(), *k3 = k_[2].data(), *k4 = k_[3].data();
    rates(system, t, y, k_[0].data());
    for (size_t i = 0; i < size; ++i) y_new[i] = y[i] + 0.5 * h * k1[i];
    rates(system, t + 0.5 * h, y_new, k_[1].data());
    for (size_t i = 0; i < size; ++i) y_new[i] = y[i] + 0.5 * h * k2[i];
    rates(system, t + 0.5 * h, y_new, k_[2].data());
    for (size_t i = 0; i < size; ++i) y_new[i] = y[i] + h * k3[i];
    rates(system, t + h, y_new, k_[3].data());
    for (size_t i = 0; i < size; ++i) y_new[i] = y[i] + h / 6 * (k1[i] + k4[i] + 2 * (k2[i] + k3[i]));
    return {.taken = h};
  }

 private:
  std::array<AlignedBuffer, 4> k_;
};

/// Coefficients of a pair whose last stage is the first of the next step: row j gives the argument of stage j + 1.
template <size_t stages>
struct Tableau {
  const char* name;
  int order, error_order;
  double stability;
  std::array<double, stages> c;
  std::array<std::array<double, stages - 1>, stages - 1> a;  ///< its last row is the new state
  std::array<double, stages> error;                          ///< weights of the stages in the error
};

constexpr Tableau<4> bogacki_shampine{"bs32",
                                      3,
                                      3,
                                      2.51,
                                      {0, 1. / 2, 3. / 4, 1},
                                      {{{1. / 2}, {0, 3. / 4}, {2. / 9, 1. / 3, 4. / 9}}},
                                      {-5. / 72, 1. / 12, 1. / 9, -1. / 8}};

constexpr Tableau<7> dormand_prince{"dp54",
                                    5,
                                    5,
                                    3.31,
                                    {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1},
                                    {{{1. / 5},
                                      {3. / 40, 9. / 40},
                                      {44. / 45, -56. / 15, 32. / 9},
                                      {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                      {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                                      {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}}},
                                    {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40}};

template <size_t stages, const Tableau<stages>& tableau>
class EmbeddedPair : public Stepper {
 public:
  explicit EmbeddedPair(double tolerance) : norm_(tolerance) {}
  const char* name() const override { return tableau.name; }
  int order() const override { return tableau.order; }
  int error_order() const override { return tableau.error_order; }
  Steps steps() const override { return Steps::adaptive; }

  void restart(System&, double, const double*) override { have_first_ = false; }

  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    fit(k_, system.state_size());
    if (!have_first_) rates(system, t, y, k_[0].data());
    have_first_ = true;
    stage<1>(system, t, y, h, y_new);
    norm_.scale(system, y);
    StepResult result{.taken = h};
    result.error =
        norm_.of([&](size_t i) { return h * weighted(tableau.error, i, std::make_index_sequence<stages>()); });
    return result;
  }

  /// The derivative at the new state is the next step's first. (Computed anew after a restart, it has the same bits.)
  void accepted() override { std::swap(k_.front(), k_.back()); }

 private:
  template <size_t n, size_t... j>
  double weighted(const std::array<double, n>& weights, size_t i, std::index_sequence<j...>) const {
    return ((weights[j] * k_[j].data()[i]) + ...);
  }

  template <size_t n>
  void stage(System& system, double t, const double* y, double h, double* argument) {
    const size_t size = system.state_size();
    for (size_t i = 0; i < size; ++i)
      argument[i] = y[i] + h * weighted(tableau.a[n - 1], i, std::make_index_sequence<n>());
    rates(system, t + tableau.c[n] * h, argument, k_[n].data());
    if constexpr (n + 1 < stages) stage<n + 1>(system, t, y, h, argument);
  }

  std::array<AlignedBuffer, stages> k_;
  bool have_first_ = false;
  ErrorNorm norm_;
};

}  // namespace

std::unique_ptr<Stepper> make_euler(const StepperOptions&) { return std::make_unique<Euler>(); }
std::unique_ptr<Stepper> make_sts(const StepperOptions&) { return std::make_unique<SuperTimeStepping>(); }
std::unique_ptr<Stepper> make_heun(const StepperOptions&) { return std::make_unique<Heun>(); }
std::unique_ptr<Stepper> make_rk4(const StepperOptions&) { return std::make_unique<RungeKutta4>(); }
std::unique_ptr<Stepper> make_bs32(const StepperOptions& o) {
  return std::make_unique<EmbeddedPair<4, bogacki_shampine>>(o.tolerance);
}
std::unique_ptr<Stepper> make_dp54(const StepperOptions& o) {
  return std::make_unique<EmbeddedPair<7, dormand_prince>>(o.tolerance);
}

}  // namespace tunica
