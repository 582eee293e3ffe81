// SPDX-License-Identifier: MIT
#include "solve/biconjugate_gradient.h"

#include <algorithm>
#include <cmath>

namespace tunica {

namespace {

using Vector = std::vector<double>;

double dot(const Vector& x, const Vector& y) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

/// out = (d I - g J) v, and out_t = (d I - g J)^T w, in one pass over J.
void multiply_both(const SparseRows& j, double d, double g, const Vector& v, Vector& out, const Vector& w,
                   Vector& out_t) {
  for (size_t i = 0; i < w.size(); ++i) out_t[i] = d * w[i];
  for (int row = 0; row < j.rows(); ++row) {
    double sum = 0;
    for (int32_t k = j.begin[row]; k < j.begin[row + 1]; ++k) {
      sum += j.value[k] * v[j.column[k]];
      out_t[j.column[k]] -= g * j.value[k] * w[row];
    }
    out[row] = d * v[row] - g * sum;
  }
}

}  // namespace

LinearOutcome biconjugate_gradient(const SparseRows& j, double d, double g, double tolerance, Vector& b) {
  const size_t n = b.size();
  Vector x(n, 0.0), r = b, shadow = b, p = b, p_shadow = b, q(n), q_shadow(n);
  double rho = dot(shadow, r);
  if (!std::isfinite(rho)) return {false, 0};
  if (rho == 0) return {true, 0};
  const double goal = tolerance * tolerance * rho;
  for (uint64_t i = 0; i < std::max<size_t>(n, 1000); ++i) {
    if (dot(r, r) <= goal) {
      b = x;
      return {true, i};
    }
    multiply_both(j, d, g, p, q, p_shadow, q_shadow);
    const double alpha = rho / dot(p_shadow, q);
    if (!std::isfinite(alpha) || alpha == 0) return {false, i};
    for (size_t k = 0; k < n; ++k) {
      x[k] += alpha * p[k];
      r[k] -= alpha * q[k];
      shadow[k] -= alpha * q_shadow[k];
    }
    const double next = dot(shadow, r), beta = next / rho;
    if (!std::isfinite(beta)) return {false, i};
    rho = next;
    for (size_t k = 0; k < n; ++k) {
      p[k] = r[k] + beta * p[k];
      p_shadow[k] = shadow[k] + beta * p_shadow[k];
    }
  }
  return {false, std::max<size_t>(n, 1000)};
}

}  // namespace tunica
