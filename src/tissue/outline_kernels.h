// SPDX-License-Identifier: MIT
#pragma once

// Included by sources compiled for one instruction set: plain data only.

namespace tunica {

/// The outlines of four cells side by side. Behind the last corner of each its first is repeated, to the end.
struct FourOutlines {
  static constexpr int most = 15;  ///< corners
  int count;                       ///< corners of the one with most
  int corners[4];
  alignas(32) double x[most + 1][4], y[most + 1][4], z[most + 1][4];
};

struct FourMeasures {
  alignas(32) double area[4], x[4], y[4], z[4];  ///< x, y, z: centroid
};

/// All sets give the bits that one cell alone gets.
struct OutlineKernels {
  /// Measures as of cells that are not flat; returns which certainly are not, as bits 0 to 3.
  int (*measure)(const FourOutlines&, FourMeasures&);
  /// Which are plain cells, see is_plain_cell(). @param outward  x, y, z of each
  int (*plain)(const FourOutlines&, const double (*outward)[4]);
};

/// Those for this machine.
const OutlineKernels& outline_kernels();

namespace sse2 {
const OutlineKernels& outline_kernels();
}
namespace avx2 {
const OutlineKernels& outline_kernels();
}

}  // namespace tunica
