// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "base/bytes.h"
#include "rule/jacobian.h"
#include "solve/sparse_factor.h"
#include "solve/stepper.h"
#include "solve/tolerance.h"

namespace tunica {

/// Solves u - c - g f(t, u) = 0, the equation of an implicit step, by modified Newton iteration: the factors of
/// I - g J are kept from step to step until the iterations they cost beyond those of fresh ones would have paid for
/// new ones (counted in operations, not seconds, so that runs repeat).
class Newton {
 public:
  explicit Newton(Work& work) : work_(work) {}

  /// The structure, state or rules changed from outside.
  void restart() { factored_ = false, factored_y_.clear(); }
  /// Errors: a rule that was not traced (names it). `u`: first guess, then the solution. Empty if it converged, else
  /// why not. The scale of `norm` must be set; the solution is exact to a tenth of its tolerance.
  std::string solve(System& system, const ErrorNorm& norm, double t, const double* c, double g, double* u);

  /// The thesis's way: a new Jacobian and biconjugate gradients in every iteration, to this mean square residual. 0:
  /// off.
  void use_biconjugate_gradients(double residual) { residual_ = residual; }

  /// What decides bits: where the factors were made. They are made again on the next solve after load().
  void save(ByteWriter& out) const;
  void load(ByteReader& in);

 private:
  void attach(System& system);
  bool refactor(System& system, double t, const double* y, double g);
  bool solve_linear(double g);
  std::string iterate(System& system, const ErrorNorm& norm, double t, const double* c, double g, double* u);

  Work& work_;
  std::unique_ptr<Jacobian> jacobian_;
  SparseFactor factor_;
  uint64_t structure_ = 0;
  std::vector<double> step_;  ///< compact
  AlignedBuffer rates_, change_, start_;
  double residual_ = 0;
  double gained_ = 0;  ///< operations spent on iterations beyond those of fresh factors
  bool factored_ = false, fresh_ = false;
  double factored_g_ = 0, factored_t_ = 0;
  std::vector<double> factored_y_;  ///< padded: the state of the Jacobian in use
};

}  // namespace tunica
