// SPDX-License-Identifier: MIT
// Compiled once per instruction set with TUNICA_ISA (namespace) set; nothing here calls inline library code. The loops are
// written to be vectorised as they stand: no contraction, no reordering, so that all sets give the same bits.

#include "field/pair_kernels.h"

namespace tunica::TUNICA_ISA {
namespace {

inline double square_of_distance(const RingView& r, const Source& s, int i) {
  const double u = r.sine[i] * s.cosine - r.cosine[i] * s.sine;
  const double radius = r.radius[i], dx = s.x - radius, dy = s.y - r.height[i];
  const double d2 = dx * dx + dy * dy + 4.0 * s.x * radius * (u * u);
  return d2 > s.nearest ? d2 : s.nearest;
}

void distances(const RingView& r, const Source& s, double* __restrict d) {
  for (int i = 0; i < r.count; ++i) d[i] = __builtin_sqrt(square_of_distance(r, s, i));
}

void reciprocal_one(const RingView& r, const Source& s, const double* weight, double* const* h) {
  double* __restrict h0 = h[0];
  const double w0 = weight[0];
  for (int i = 0; i < r.count; ++i) h0[i] += w0 / __builtin_sqrt(square_of_distance(r, s, i));
}

void reciprocal_two(const RingView& r, const Source& s, const double* weight, double* const* h) {
  double *__restrict h0 = h[0], *__restrict h1 = h[1];
  const double w0 = weight[0], w1 = weight[1];
  for (int i = 0; i < r.count; ++i) {
    const double near = 1.0 / __builtin_sqrt(square_of_distance(r, s, i));
    h0[i] += w0 * near;
    h1[i] += w1 * near;
  }
}

}  // namespace

const PairKernels& pair_kernels() {
  static const PairKernels set{distances, {reciprocal_one, reciprocal_two}};
  return set;
}

}  // namespace tunica::TUNICA_ISA
