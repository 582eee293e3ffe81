// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

namespace tunica {

/// Places and weights of Gauss-Legendre quadrature on [-1, 1], exact for polynomials up to degree 2N - 1.
template <int N>
struct Gauss {
  std::array<double, N> x, w;

  Gauss() {
    for (int i = 0; i < N; ++i) {
      double z = -std::cos(M_PI * (i + .75) / (N + .5)), slope = 1;
      for (int iteration = 0; iteration < 8; ++iteration) {
        double before = 1, p = z;
        for (int k = 2; k <= N; ++k) {
          const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
          before = p;
          p = next;
        }
        slope = N * (z * p - before) / (z * z - 1);
        z -= p / slope;
      }
      x[static_cast<size_t>(i)] = z;
      w[static_cast<size_t>(i)] = 2 / ((1 - z * z) * slope * slope);
    }
  }
};

/// The integral of f from a to b by one application of N points. With f a polynomial up to degree 2N - 1, exact.
template <int N, class F>
double gauss(const F& f, double a, double b) {
  static const Gauss<N> rule;
  const double half = (b - a) / 2, middle = (a + b) / 2;
  double sum = 0;
  for (size_t i = 0; i < N; ++i) sum += rule.w[i] * f(middle + half * rule.x[i]);
  return half * sum;
}

}  // namespace tunica
