// SPDX-License-Identifier: MIT
#pragma once

// Included by sources compiled for one instruction set: plain data only.

namespace tunica {

/// Sample places on a ring, as arrays of `count` values (a multiple of 4): sine and cosine of half the angle, distance
/// from the axis, height.
struct RingView {
  const double *sine, *cosine, *radius, *height;
  int count;
};

/// One source: half-angle, distance from the axis (>= 0), height. `nearest`: least square of a distance.
struct Source {
  double sine, cosine, x, y, nearest;
};

/// Distances in space from a source to every sample: d^2 = (x - R)^2 + (y - Y)^2 + 4 x R sin^2(half the difference of
/// angles), which keeps its digits where d is small. All sets give the same bits.
struct PairKernels {
  void (*distances)(const RingView&, const Source&, double* d);
  /// h[k] += weight[k] / d for 1 or 2 fields.
  void (*reciprocal[2])(const RingView&, const Source&, const double* weight, double* const* h);
};

/// Those for this machine.
const PairKernels& pair_kernels();

namespace sse2 {
const PairKernels& pair_kernels();
}
namespace avx2 {
const PairKernels& pair_kernels();
}

}  // namespace tunica
