// SPDX-License-Identifier: MIT
#include "solve/chebyshev.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/spectral_radius.h"
#include "solve/tolerance.h"

namespace tunica {

namespace {

/// Above this many stages an implicit method is quicker, and rounding in the stages begins to show.
constexpr int most_stages = 1000;
constexpr int steps_between_estimates = 25;
/// The power method stops some percent low; the step must be stable all the same.
constexpr double safety = 1.2;

/// Coefficients of the stages for one number of them; names as in the paper (2.2 to 2.5).
struct Coefficients {
  int stages = 0;
  double first = 0;  ///< mu~_1
  struct Stage {
    double y0, before, before_last, rate, rate0;  ///< 1 - mu - nu, mu, nu, mu~, gamma~
  };
  std::vector<Stage> stage;  ///< [j] for j = 2 ... s
  std::vector<double> time;  ///< [j]: c_j

  void set(int s);
};

void Coefficients::set(int s) {
  if (stages == s) return;
  stages = s;
  const double w0 = 1 + 2.0 / (13.0 * s * s);
  std::vector<double> T(s + 1), dT(s + 1), ddT(s + 1), b(s + 1), a(s + 1);  // Chebyshev polynomials at w0
  T[0] = 1, T[1] = w0, dT[1] = 1;
  for (int j = 2; j <= s; ++j) {
    T[j] = 2 * w0 * T[j - 1] - T[j - 2];
    dT[j] = 2 * w0 * dT[j - 1] - dT[j - 2] + 2 * T[j - 1];
    ddT[j] = 2 * w0 * ddT[j - 1] - ddT[j - 2] + 4 * dT[j - 1];
  }
  const double w1 = dT[s] / ddT[s];
  for (int j = 2; j <= s; ++j) b[j] = ddT[j] / (dT[j] * dT[j]);
  b[0] = b[1] = b[2];
  for (int j = 0; j <= s; ++j) a[j] = 1 - b[j] * T[j];
  first = b[1] * w1;
  stage.assign(s + 1, {});
  time.assign(s + 1, 0.0);
  for (int j = 2; j <= s; ++j) {
    const double mu = 2 * b[j] * w0 / b[j - 1], nu = -b[j] / b[j - 2], rate = 2 * b[j] * w1 / b[j - 1];
    stage[j] = {1 - mu - nu, mu, nu, rate, -a[j - 1] * rate};
    time[j] = w1 * ddT[j] / dT[j];
  }
  time[1] = time[2] / dT[2];
  time[s] = 1;
}

class Chebyshev : public Stepper {
 public:
  explicit Chebyshev(const StepperOptions& o) : norm_(o.tolerance), fixed_(o.fixed_steps) {}
  const char* name() const override { return "rkc2"; }
  int order() const override { return 2; }
  Steps steps() const override { return fixed_ ? Steps::fixed : Steps::adaptive; }
  bool remembers() const override { return true; }

  void restart(System&, double, const double*) override {
    have_rate_ = tried_ = false;
    age_ = steps_between_estimates;
  }

  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    const size_t size = system.state_size();
    for (AlignedBuffer* buffer : {&rate_, &rate_new_, &work1_, &work2_})
      if (buffer->size() != size) buffer->resize(size);
    if (!have_rate_) rates(system, t, y, rate_.data());
    have_rate_ = true;
    if (age_ >= steps_between_estimates || (tried_ && age_ > 0)) estimate(system, t, y);
    StepResult result{.taken = h};
    if (!choose_stages(h, result)) return result;
    stages(system, t, y, result.taken, y_new);
    if (fixed_) return result;
    rates(system, t + result.taken, y_new, rate_new_.data());
    norm_.scale(system, y);
    const double *f = rate_.data(), *f_new = rate_new_.data(), length = result.taken;
    result.error = norm_.of([=](size_t i) { return 0.8 * (y[i] - y_new[i]) + 0.4 * length * (f[i] + f_new[i]); });
    tried_ = true;
    return result;
  }

  void accepted() override {
    tried_ = false;
    ++age_;
    if (fixed_)
      have_rate_ = false;
    else
      std::swap(rate_, rate_new_);
  }

  void save(ByteWriter& out) const override {
    out.put(radius_);
    out.put(static_cast<int32_t>(age_));
    out.put(static_cast<uint8_t>(tried_));
    out.array(vector_.data(), vector_.size());
  }
  void load(ByteReader& in) override {
    radius_ = in.get<double>();
    age_ = in.get<int32_t>();
    tried_ = in.get<uint8_t>() != 0;
    const auto saved = in.array<double>();
    vector_.resize(saved.size());
    std::copy(saved.begin(), saved.end(), vector_.data());
    have_rate_ = false;
  }

 private:
  void estimate(System& system, double t, const double* y) {
    const SpectralRadius found = spectral_radius(system, t, y, rate_.data(), vector_);
    work_.evaluations += found.evaluations;
    radius_ = safety * found.radius;
    age_ = std::isfinite(radius_) ? 0 : steps_between_estimates;
  }

  /// s with 0.65 (s^2 - 1) >= h rho. An adaptive step that would need too many is made shorter.
  bool choose_stages(double h, StepResult& result) {
    const auto needed = [&](double length) { return 1 + std::sqrt(1.54 * length * radius_ + 1); };
    if (!std::isfinite(radius_)) {
      coefficients_.set(2);  // the state that comes out of it says what is wrong
      return true;
    }
    if (needed(h) >= most_stages + 1) {
      const double longest = 0.999 * (square(most_stages - 1.0) - 1) / (1.54 * radius_);
      if (fixed_) {
        result.failed = "stages";
        result.detail = fmt::format(
            "a step of {:.6g} would need {:.0f} stages (the spectral radius is about {:.6g}); take dt <= {:.3g}, or an "
            "implicit method",
            h, needed(h), radius_, longest);
        return false;
      }
      result.taken = longest;
    }
    coefficients_.set(std::max(2, static_cast<int>(needed(result.taken))));
    return true;
  }
  static double square(double x) { return x * x; }

  /// Y1 = y + mu~1 h f;  Yj = (1 - mu - nu) y + mu Y(j-1) + nu Y(j-2) + mu~ h f(Y(j-1)) + gamma~ h f, in one loop each.
  void stages(System& system, double t, const double* y, double h, double* y_new) {
    const size_t size = system.state_size();
    const double* f0 = rate_.data();
    const int s = coefficients_.stages;
    // The stages alternate between two buffers, so that the last lands in y_new.
    double* last = s % 2 == 0 ? work1_.data() : y_new;
    double* before = s % 2 == 0 ? y_new : work1_.data();
    const double first = coefficients_.first * h;
    for (size_t i = 0; i < size; ++i) {
      before[i] = y[i];
      last[i] = y[i] + first * f0[i];
    }
    double* f = work2_.data();
    for (int j = 2; j <= s; ++j) {
      rates(system, t + coefficients_.time[j - 1] * h, last, f);
      combine(coefficients_.stage[j], h, size, y, f0, f, last, before);
      std::swap(last, before);
    }
  }

  static void combine(const Coefficients::Stage& c, double h, size_t size, const double* __restrict y,
                      const double* __restrict f0, const double* __restrict f, const double* __restrict last,
                      double* __restrict before) {
    const double y0 = c.y0, mu = c.before, nu = c.before_last, rate = c.rate * h, rate0 = c.rate0 * h;
    for (size_t i = 0; i < size; ++i)
      before[i] = y0 * y[i] + mu * last[i] + nu * before[i] + rate * f[i] + rate0 * f0[i];
  }

  ErrorNorm norm_;
  bool fixed_;
  Coefficients coefficients_;
  AlignedBuffer rate_, rate_new_, work1_, work2_;
  AlignedBuffer vector_;  ///< where the next power method starts
  double radius_ = 0;     ///< estimate with its safety factor
  int age_ = steps_between_estimates;
  bool have_rate_ = false, tried_ = false;
};

}  // namespace

std::unique_ptr<Stepper> make_rkc2(const StepperOptions& o) { return std::make_unique<Chebyshev>(o); }

}  // namespace tunica
