// SPDX-License-Identifier: MIT
#include "solve/implicit.h"

#include <algorithm>
#include <cmath>

#include "solve/newton.h"

namespace tunica {

namespace {

/// y_new = y + h ((1 - theta) f(t, y) + theta f(t + h, y_new)); theta = 1: backward Euler, 1/2: Crank-Nicolson.
class Theta : public Stepper {
 public:
  Theta(const char* name, double theta, const StepperOptions& options)
      : name_(name), theta_(theta), norm_(options.tolerance), newton_(work_) {}

  const char* name() const override { return name_; }
  int order() const override { return theta_ == 1 ? 1 : 2; }
  bool remembers() const override { return true; }
  void use_biconjugate_gradients(double residual) { newton_.use_biconjugate_gradients(residual); }

  void restart(System&, double, const double*) override { newton_.restart(); }

  StepResult step(System& system, double t, const double* y, double h, double* y_new) override {
    const size_t size = system.state_size();
    if (constant_.size() != size) constant_.resize(size);
    double* c = constant_.data();
    std::copy(y, y + size, y_new);
    if (theta_ == 1) {
      std::copy(y, y + size, c);
    } else {
      rates(system, t, y, c);
      for (size_t i = 0; i < size; ++i) c[i] = y[i] + (1 - theta_) * h * c[i];
    }
    norm_.scale(system, y);
    const std::string problem = newton_.solve(system, norm_, t + h, c, theta_ * h, y_new);
    if (problem.empty()) return {.taken = h};
    return {.failed = "newton",
            .detail = "Newton's method found no solution: " + problem +
                      ". There may be none near by: try a smaller dt, or an adaptive method (rkc2, bdf)"};
  }

  void save(ByteWriter& out) const override { newton_.save(out); }
  void load(ByteReader& in) override { newton_.load(in); }

 private:
  const char* name_;
  double theta_;
  ErrorNorm norm_;
  Newton newton_;
  AlignedBuffer constant_;
};

}  // namespace

std::unique_ptr<Stepper> make_backward_euler(const StepperOptions& options) {
  return std::make_unique<Theta>("backward_euler", 1.0, options);
}

std::unique_ptr<Stepper> make_crank_nicolson(const StepperOptions& options) {
  return std::make_unique<Theta>("crank_nicolson", 0.5, options);
}

std::unique_ptr<Stepper> make_bicg(const StepperOptions& options) {
  auto method = std::make_unique<Theta>("bicg", 0.5, options);
  method->use_biconjugate_gradients(std::sqrt(options.tolerance));
  return method;
}

}  // namespace tunica
