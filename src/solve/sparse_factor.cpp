// SPDX-License-Identifier: MIT
#include "solve/sparse_factor.h"

#include <klu.h>

#include <cmath>

namespace tunica {

/// The library's objects. Rows of our matrix are columns of the one it sees, so it solves with the transpose.
struct SparseFactor::Klu {
  klu_common common;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  std::vector<int32_t> begin, column;

  Klu() {
    klu_defaults(&common);
    common.ordering = 0;  // approximate minimum degree: half the fill of the other choice on tissues
  }
  ~Klu() { release(); }
  Klu(const Klu&) = delete;
  void release() {
    if (numeric) klu_free_numeric(&numeric, &common);
    if (symbolic) klu_free_symbolic(&symbolic, &common);
  }
};

SparseFactor::SparseFactor() : klu_(std::make_unique<Klu>()) {}
SparseFactor::~SparseFactor() = default;
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;
SparseFactor& SparseFactor::operator=(SparseFactor&&) noexcept = default;

void SparseFactor::analyse(const SparseRows& j) {
  ready_ = false;
  klu_->release();
  klu_->begin = j.begin;
  klu_->column = j.column;
  if (j.rows() == 0) return;
  klu_->symbolic = klu_analyze(j.rows(), klu_->begin.data(), klu_->column.data(), &klu_->common);
  if (!klu_->symbolic) fail("internal: the pattern of a Jacobian of {} unknowns could not be analysed", j.rows());
}

bool SparseFactor::factor(const SparseRows& j, double d, double g) {
  ready_ = false;
  if (klu_->numeric) klu_free_numeric(&klu_->numeric, &klu_->common);
  if (j.rows() == 0) return ready_ = true;
  values_.resize(j.value.size());
  double sum = 0;
  for (int row = 0; row < j.rows(); ++row)
    for (int32_t k = j.begin[row]; k < j.begin[row + 1]; ++k) {
      values_[k] = (j.column[k] == row ? d : 0.0) - g * j.value[k];
      sum += std::fabs(values_[k]);
    }
  if (!std::isfinite(sum)) return false;
  klu_->numeric = klu_factor(klu_->begin.data(), klu_->column.data(), values_.data(), klu_->symbolic, &klu_->common);
  if (!klu_->numeric || klu_->common.status != KLU_OK) return false;
  klu_flops(klu_->symbolic, klu_->numeric, &klu_->common);
  klu_rcond(klu_->symbolic, klu_->numeric, &klu_->common);
  factor_work_ = klu_->common.flops;
  solve_work_ = 2.0 * (static_cast<double>(klu_->numeric->lnz) + static_cast<double>(klu_->numeric->unz));
  pivot_ratio_ = klu_->common.rcond;
  return ready_ = pivot_ratio_ > 0;
}

void SparseFactor::solve(double* b) {
  if (!ready_) fail("internal: a matrix is solved before it is factorised");
  if (!klu_->numeric) return;
  klu_tsolve(klu_->symbolic, klu_->numeric, klu_->symbolic->n, 1, b, &klu_->common);
}

}  // namespace tunica
