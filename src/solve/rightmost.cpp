// SPDX-License-Identifier: MIT
#include "solve/rightmost.h"

#include <Spectra/GenEigsRealShiftSolver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "solve/sparse_factor.h"

namespace tunica {

namespace {

constexpr int small = 200;

double rightmost_of_all(const SparseRows& j) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(j.rows(), j.rows());
  for (int row = 0; row < j.rows(); ++row)
    for (int32_t k = j.begin[row]; k < j.begin[row + 1]; ++k) dense(row, j.column[k]) = j.value[k];
  return dense.eigenvalues().real().maxCoeff();
}

/// (J - shift I)^-1, as the library asks for it.
class Inverse {
 public:
  using Scalar = double;
  explicit Inverse(const SparseRows& j) : j_(j) { factor_.analyse(j); }
  Eigen::Index rows() const { return j_.rows(); }
  Eigen::Index cols() const { return j_.rows(); }
  void set_shift(double shift) { works_ = factor_.factor(j_, -shift, -1); }
  bool works() const { return works_; }
  void perform_op(const double* in, double* out) const {
    std::copy(in, in + j_.rows(), out);
    factor_.solve(out);
  }

 private:
  const SparseRows& j_;
  mutable SparseFactor factor_;
  bool works_ = false;
};

}  // namespace

std::optional<double> rightmost_eigenvalue(const SparseRows& j) {
  if (j.rows() == 0) return std::nullopt;
  if (j.rows() <= small) return rightmost_of_all(j);
  double reach = 0;  // no eigenvalue is further from 0
  for (int row = 0; row < j.rows(); ++row) {
    double sum = 0;
    for (int32_t k = j.begin[row]; k < j.begin[row + 1]; ++k) sum += std::fabs(j.value[k]);
    reach = std::max(reach, sum);
  }
  std::optional<double> largest;
  Inverse inverse(j);
  for (const double share : {1e-4, 1e-2, 0.3}) {
    const double shift = share * reach;
    inverse.set_shift(shift);
    if (!inverse.works()) continue;
    Spectra::GenEigsRealShiftSolver<Inverse> solver(inverse, 4, 40, shift);
    const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(j.rows(), 0.5, 1.5).array().sin();
    solver.init(start.data());
    if (solver.compute(Spectra::SortRule::LargestMagn, 300, 1e-8) == 0) continue;
    const Eigen::VectorXcd found = solver.eigenvalues();
    for (Eigen::Index i = 0; i < found.size(); ++i)
      largest = std::max(largest.value_or(found[i].real()), found[i].real());
  }
  return largest;
}

}  // namespace tunica
