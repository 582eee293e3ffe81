// SPDX-License-Identifier: MIT
#include "solve/steady.h"

#include <algorithm>
#include <cmath>

#include "solve/rightmost.h"
#include "solve/sparse_factor.h"
#include "solve/tree_elimination.h"

namespace tunica {

namespace {

class Search {
 public:
  Search(System& system, double t, double* y, const SteadyOptions& options)
      : system_(system), jacobian_(system), t_(t), y_(y), options_(options) {
    rates_.resize(system.state_size());
  }

  Steady run() {
    if (jacobian_.linear()) {
      if (!by_elimination()) by_factors();
      if (!(result_.residual <= std::max(options_.tolerance, 1e-12)))
        fail("the steady state that was found leaves a residual of {:.3g}: the rates are too nearly undetermined",
             result_.residual);
    } else {
      by_newton();
    }
    if (options_.stability && result_.how != "elimination") look_at_stability();
    return result_;
  }

 private:
  void rates(const double* y, double* dydt) {
    ++result_.work.evaluations;
    system_.rates(t_, y, dydt);
  }

  bool by_elimination() {
    if (jacobian_.derivative().uniform == no_node) return false;
    std::fill_n(y_, system_.state_size(), 0.0);  // linear: where it starts does not matter
    jacobian_.evaluate_partials(t_, y_);
    rates(y_, rates_.data());  // what does not depend on the state
    if (!solve_tree(system_, jacobian_, rates_.data(), y_)) return false;
    result_.how = "elimination";
    const System::Values m = jacobian_.uniform();
    const Index n = m.per == System::Values::Per::all ? 1 : system_.tissue().cells();
    result_.growth = *std::max_element(m.data, m.data + n);  // no eigenvalue is further right (Gershgorin)
    result_.stable = result_.growth < 0;
    rates(y_, rates_.data());
    double largest = 0, source = 0;
    for (Index c = 0; c < system_.tissue().cells(); ++c) {
      largest = std::max(largest, std::fabs(rates_.data()[c]));
      source = std::max(source, std::fabs(y_[c]));
    }
    result_.residual = source > 0 ? largest / source : largest;
    return true;
  }

  void evaluate(const double* y) {
    jacobian_.prepare();
    jacobian_.evaluate(t_, y);
    ++result_.work.jacobians;
  }

  bool factor(double d) {
    if (!analysed_) factor_.analyse(jacobian_.matrix());
    analysed_ = true;
    ++result_.work.factorizations;
    return factor_.factor(jacobian_.matrix(), d, 1);
  }

  /// trial = y + (d I - J)^-1 rates
  void step_to_trial() {
    std::vector<double> change(jacobian_.size());
    jacobian_.gather(rates_.data(), change.data());
    factor_.solve(change.data());
    std::fill_n(trial_.data(), system_.state_size(), 0.0);
    jacobian_.scatter(change.data(), trial_.data());
    for (size_t i = 0; i < system_.state_size(); ++i) trial_.data()[i] += y_[i];
  }

  void by_factors() {
    result_.how = "sparse factors";
    trial_.resize(system_.state_size());
    evaluate(y_);
    if (!factor(0) || !(factor_.pivot_ratio() > 1e-14))
      fail(
          "the steady state is not determined: the rates do not say how much there is in all (nothing decays, or what "
          "is "
          "made in one place can be kept anywhere); give every column a decay, or run the model to the end");
    for (int i = 0; i < 3; ++i) {  // the first solves, the others take rounding back
      rates(y_, rates_.data());
      step_to_trial();
      std::copy(trial_.data(), trial_.data() + system_.state_size(), y_);
      ++result_.iterations;
    }
    rates(y_, rates_.data());
    result_.residual = relative(rates_.data(), y_);
  }

  /// Largest |f| of each column over the largest sum of |J_ij y_j| of its rows; the worst of the columns.
  double relative(const double* f, const double* y) {
    const SparseRows& j = jacobian_.matrix();
    std::vector<double> compact(jacobian_.size()), rate(jacobian_.size());
    jacobian_.gather(y, compact.data());
    jacobian_.gather(f, rate.data());
    double worst = 0;
    for (size_t k = 0; k + 1 < jacobian_.offsets().size(); ++k) {
      double largest = 0, scale = 0;
      for (int i = jacobian_.offsets()[k]; i < jacobian_.offsets()[k + 1]; ++i) {
        double sum = 0;
        for (int32_t at = j.begin[i]; at < j.begin[i + 1]; ++at) sum += std::fabs(j.value[at] * compact[j.column[at]]);
        scale = std::max(scale, sum);
        if (!(std::fabs(rate[i]) <= largest)) largest = std::fabs(rate[i]);
      }
      const double share = scale > 0 ? largest / scale : largest;
      if (!(share <= worst)) worst = share;
    }
    return worst;
  }

  void accept(double residual) {
    std::copy(trial_.data(), trial_.data() + system_.state_size(), y_);
    std::swap(rates_, trial_rates_);
    result_.residual = residual;
    evaluate(y_);
  }

  /// The relative residual after a step with the factors at hand, shortened to `share`.
  double try_step(double share) {
    step_to_trial();
    for (size_t i = 0; share < 1 && i < system_.state_size(); ++i)
      trial_.data()[i] = y_[i] + share * (trial_.data()[i] - y_[i]);
    rates(trial_.data(), trial_rates_.data());
    return relative(trial_rates_.data(), trial_.data());
  }

  bool done() const { return result_.residual <= options_.tolerance; }

  void by_newton() {
    result_.how = "newton";
    for (AlignedBuffer* buffer : {&trial_, &trial_rates_}) buffer->resize(system_.state_size());
    evaluate(y_);
    rates(y_, rates_.data());
    result_.residual = relative(rates_.data(), y_);
    std::vector<double> start(y_, y_ + system_.state_size());
    if (damped_newton()) return;
    std::copy(start.begin(), start.end(), y_);
    evaluate(y_);
    rates(y_, rates_.data());
    result_.residual = relative(rates_.data(), y_);
    continuation();
    if (done()) return;
    fail(
        "no steady state was found in {} iterations: the residual is {:.3g}, asked for is {:.3g}; begin nearer to it "
        "(run the "
        "model for a while first), or there is none (the pattern moves or swings)",
        result_.iterations, result_.residual, options_.tolerance);
  }

  /// Steps of Newton's method, halved until the residual falls. False if it does not.
  bool damped_newton() {
    for (int i = 0; i < 40; ++i, ++result_.iterations) {
      poll(options_.cancel);
      if (done()) return true;
      if (!factor(0)) return false;
      double share = 1, after = try_step(share);
      while (!(after <= (1 - 0.2 * share) * result_.residual)) {
        share /= 2;
        if (share < 1e-3) return false;
        after = try_step(share);
      }
      accept(after);
    }
    return done();
  }

  /// Pseudo-transient continuation: implicit Euler steps through time, longer as the residual falls; Newton's method in
  /// the end. The residual may rise on the way, as it does while a pattern forms.
  void continuation() {
    double steepest = 1e-300;
    for (int i = 0; i < jacobian_.size(); ++i)
      steepest = std::max(steepest, std::fabs(jacobian_.matrix().value[jacobian_.matrix().place(i, i)]));
    double tau = 10 / steepest;
    for (; result_.iterations < options_.most_iterations && !done(); ++result_.iterations) {
      poll(options_.cancel);
      const double after = factor(1 / tau) ? try_step(1) : INFINITY;
      if (!(after <= 2 * result_.residual + options_.tolerance)) {
        if (tau * steepest < 1e-8) return;
        tau /= 4;
        continue;
      }
      tau = std::min(tau * std::clamp(result_.residual / std::max(after, 1e-300), 1.2, 10.0), 1e12 / steepest);
      accept(after);
    }
  }

  void look_at_stability() {
    const auto rightmost = rightmost_eigenvalue(jacobian_.matrix());
    result_.stability_known = rightmost.has_value();
    result_.growth = rightmost.value_or(0);
    result_.stable = rightmost && *rightmost < 0;
  }

  System& system_;
  Jacobian jacobian_;
  SparseFactor factor_;
  bool analysed_ = false;
  double t_;
  double* y_;
  const SteadyOptions& options_;
  AlignedBuffer rates_, trial_, trial_rates_;
  Steady result_;
};

}  // namespace

Steady find_steady(System& system, double t, double* y, const SteadyOptions& options) {
  return Search(system, t, y, options).run();
}

}  // namespace tunica
