// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "rule/system.h"

namespace tunica {

/// The measure of errors that all adaptive methods share: sqrt(mean over elements of (e_i / w_i)^2) with w_i =
/// tolerance * (|y_i| + s_k), s_k the root mean square of state column k at the start of the step (1 if it is all
/// zero). The padding of the state vector does not count. Sums have a fixed order.
class ErrorNorm {
 public:
  explicit ErrorNorm(double tolerance) : tolerance_(tolerance) {}
  /// Takes the scales s_k from the state at the start of a step. `y` must stay until the norm has been used.
  void scale(const System& system, const double* y);
  /// Not a number if any error is.
  double operator()(const double* error) const {
    return of([error](size_t i) { return error[i]; });
  }
  /// The same of errors computed on the way: error_of(i) for place i of the state vector.
  template <class ErrorOf>
  double of(ErrorOf&& error_of) const;

  double tolerance() const { return tolerance_; }
  double column_scale(size_t k) const { return columns_[k].scale; }

 private:
  static constexpr size_t lanes = 8;
  struct Range {
    size_t offset, count;
    double scale;
  };
  double tolerance_;
  const double* y_ = nullptr;
  std::vector<Range> columns_;
  size_t count_ = 0;
};

template <class ErrorOf>
double ErrorNorm::of(ErrorOf&& error_of) const {
  double sums[lanes] = {}, rest = 0;
  const auto square = [&](size_t i, double scale) {
    const double ratio = error_of(i) / (__builtin_fabs(y_[i]) + scale);
    return ratio * ratio;
  };
  for (const Range& c : columns_) {
    const size_t whole = c.offset + c.count / lanes * lanes, end = c.offset + c.count;
    for (size_t i = c.offset; i < whole; i += lanes)
      for (size_t lane = 0; lane < lanes; ++lane) sums[lane] += square(i + lane, c.scale);
    for (size_t i = whole; i < end; ++i) rest += square(i, c.scale);
  }
  for (const double sum : sums) rest += sum;
  return count_ == 0 ? 0 : __builtin_sqrt(rest / static_cast<double>(count_)) / tolerance_;
}

}  // namespace tunica
