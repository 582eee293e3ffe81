// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "rule/jacobian.h"

namespace tunica {

/// Factors of d I - g J for a sparse J whose pattern holds the diagonal (KLU, minimum-degree order). Factors and
/// solutions depend on the values alone, not on what was factorised before.
class SparseFactor {
 public:
  SparseFactor();
  ~SparseFactor();
  SparseFactor(SparseFactor&&) noexcept;
  SparseFactor& operator=(SparseFactor&&) noexcept;

  /// To be called for a new pattern.
  void analyse(const SparseRows& j);
  /// False if the matrix is singular, or not a number.
  bool factor(const SparseRows& j, double d, double g);
  /// b := (d I - g J)^-1 b
  void solve(double* b);

  bool ready() const { return ready_; }
  /// Multiplications and additions of a factorisation and of a solution: what keeping a factor saves and costs.
  double factor_work() const { return factor_work_; }
  double solve_work() const { return solve_work_; }
  /// Of its growth: the ratio of the smallest to the largest pivot.
  double pivot_ratio() const { return pivot_ratio_; }

 private:
  struct Klu;
  std::unique_ptr<Klu> klu_;
  std::vector<double> values_;
  bool ready_ = false;
  double factor_work_ = 0, solve_work_ = 0, pivot_ratio_ = 0;
};

}  // namespace tunica
