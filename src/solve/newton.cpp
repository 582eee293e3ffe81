// SPDX-License-Identifier: MIT
#include "solve/newton.h"

#include <algorithm>
#include <cmath>

#include "solve/biconjugate_gradient.h"

namespace tunica {

namespace {

constexpr int most_iterations = 8;  ///< with factors that were kept
constexpr int most_fresh_iterations = 12;
constexpr int fresh_iterations = 2;  ///< what a step takes with fresh factors
constexpr double slowest = 0.7;      ///< contraction beyond which iteration is given up
constexpr double allowed_g = 0.2;    ///< relative change of g that kept factors stand

}  // namespace

void Newton::attach(System& system) {
  if (!jacobian_) {
    jacobian_ = std::make_unique<Jacobian>(system);
  }
  jacobian_->prepare();
  if (structure_ != jacobian_->structure()) {
    structure_ = jacobian_->structure();
    if (residual_ == 0) factor_.analyse(jacobian_->matrix());
    factored_ = false;
  }
  for (AlignedBuffer* buffer : {&rates_, &change_, &start_})
    if (buffer->size() != system.state_size()) buffer->resize(system.state_size());
  step_.resize(jacobian_->size());
}

bool Newton::refactor(System& system, double t, const double* y, double g) {
  jacobian_->evaluate(t, y);
  ++work_.jacobians;
  factored_g_ = g, factored_t_ = t, gained_ = 0;
  factored_y_.assign(y, y + system.state_size());
  if (residual_ > 0) return factored_ = true;
  ++work_.factorizations;
  return factored_ = factor_.factor(jacobian_->matrix(), 1, g);
}

bool Newton::solve_linear(double g) {
  if (residual_ == 0) {
    factor_.solve(step_.data());
    return true;
  }
  const LinearOutcome outcome = biconjugate_gradient(jacobian_->matrix(), 1, g, residual_, step_);
  work_.linear_iterations += outcome.iterations;
  return outcome.converged;
}

std::string Newton::solve(System& system, const ErrorNorm& norm, double t, const double* c, double g, double* u) {
  attach(system);
  const size_t size = system.state_size();
  std::copy(u, u + size, start_.data());
  if (!factored_ && !factored_y_.empty() && factored_y_.size() == size && residual_ == 0) {
    AlignedBuffer y;  // after load(): the factors as they were
    y.resize(size);
    std::copy(factored_y_.begin(), factored_y_.end(), y.data());
    const double gained = gained_;
    refactor(system, factored_t_, y.data(), factored_g_);
    gained_ = gained;
  }
  const bool usable =
      residual_ == 0 && factored_ && std::fabs(g / factored_g_ - 1) <= allowed_g && gained_ <= factor_.factor_work();
  fresh_ = false;
  if (!usable) {
    if (!refactor(system, t, u, g)) return "the matrix of the step is singular or not finite";
    fresh_ = true;
  }
  std::string problem = iterate(system, norm, t, c, g, u);
  if (problem.empty() || fresh_) return problem;
  std::copy(start_.data(), start_.data() + size, u);
  if (!refactor(system, t, u, g)) return "the matrix of the step is singular or not finite";
  fresh_ = true;
  return iterate(system, norm, t, c, g, u);
}

std::string Newton::iterate(System& system, const ErrorNorm& norm, double t, const double* c, double g, double* u) {
  const size_t size = system.state_size();
  double before = 0, contraction = 0;
  const int most = fresh_ ? most_fresh_iterations : most_iterations;
  for (int i = 0; i < most; ++i) {
    system.rates(t, u, rates_.data());
    ++work_.evaluations;
    ++work_.newton_iterations;
    if (residual_ > 0 && i > 0) refactor(system, t, u, g);
    double* change = change_.data();
    for (size_t k = 0; k < size; ++k) change[k] = c[k] + g * rates_.data()[k] - u[k];
    jacobian_->gather(change, step_.data());
    if (!solve_linear(g)) return "biconjugate gradients broke down or did not converge";
    jacobian_->scatter(step_.data(), change);
    const double size_of_change = norm(change);
    if (!(size_of_change < 1e300)) return "an iterate is not finite";
    for (size_t k = 0; k < size; ++k) u[k] += change[k];
    if (i >= fresh_iterations) gained_ += factor_.solve_work() + 20.0 * static_cast<double>(step_.size());
    if (i > 0) {
      contraction = size_of_change / before;
      if (!(contraction < slowest) && size_of_change > 0.1)
        return fmt::format("its iterations contract by {:.2g} only", contraction);
      if (contraction / (1 - std::min(contraction, 0.9)) * size_of_change <= 0.1) return {};
    } else if (size_of_change <= 1e-3) {
      return {};
    }
    before = size_of_change;
  }
  return fmt::format("it did not converge in {} iterations", most);
}

void Newton::save(ByteWriter& out) const {
  out.put(factored_g_);
  out.put(factored_t_);
  out.put(gained_);
  out.put(static_cast<uint64_t>(factored_y_.size()));
  for (const double y : factored_y_) out.put(y);
}

void Newton::load(ByteReader& in) {
  factored_g_ = in.get<double>();
  factored_t_ = in.get<double>();
  gained_ = in.get<double>();
  factored_y_.resize(in.get<uint64_t>());
  for (double& y : factored_y_) y = in.get<double>();
  factored_ = false;
}

}  // namespace tunica
