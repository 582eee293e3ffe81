// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "rule/code.h"

// Included by sources compiled for one instruction set: plain data only, no library code that could be linked in
// elsewhere.

namespace tunica {

inline constexpr int block_size = 256;  ///< cells (or half-edges, walls) handled at a time

/// `cells` cells of a block with the same number of neighbours.
struct Run {
  uint16_t neighbours, cells;
  /// The cells follow each other, and so do their first neighbours, their second neighbours, ...: a stretch of a grid.
  /// Such a run is at least min_consecutive cells long.
  bool consecutive;
};
inline constexpr int min_consecutive = 8;

/// The arrays of a Layout (layout.h).
struct LayoutView {
  const uint8_t* position;
  const Run* runs;
  const int32_t *run_begin, *edge_begin, *across, *signed_wall;
};

/// Blocks of values an elementwise kernel works on: pointers, or the numbers where an operand is scalar.
struct Operands {
  double* dst;
  const double *a, *b, *c;
  double sa, sb, sc;
  int count;  ///< rounded up to whole vectors by the kernel; buffers are padded
};

/// Sums over the neighbours of the cells of one block, from rows of `width` values per cell.
struct GatherArguments {
  const LayoutView* layout;
  int block;
  const double* rows[2];  ///< width values per cell; gather_two: two columns
  const double* weights;  ///< per half-edge of the tissue, or null
  uint32_t difference;    ///< bit j: column j sums neighbour minus own
  int columns;            ///< <= width
  double* out[4];         ///< block buffers
};

/// y_new = y + h * rate over a block, noting non-finite and negative results.
struct AdvanceArguments {
  const double *y, *rate;
  double scalar_rate;  ///< where `rate` is null
  double h;
  double* y_new;
  int count;
};
inline constexpr uint8_t not_finite = 1, negative = 2;

/// The inner loops, one set per instruction set; all sets give the same bits.
struct Kernels {
  const char* name;
  void (*elementwise[static_cast<int>(Code::elementwise_count)][8])(
      const Operands&);                        ///< [.][mask]: bit 0, 1, 2 = a, b, c scalar
  void (*gather[3])(const GatherArguments&);   ///< rows of 1, 2, 4
  void (*gather_two)(const GatherArguments&);  ///< straight from two columns
  void (*pack[3])(double* rows, const double* const* values, int count);
  /// Sum, minimum, maximum of a value per half-edge over the cells of a block.
  void (*edge_sum)(const LayoutView&, int block, const double* values, double* out);
  void (*edge_minimum)(const LayoutView&, int block, const double* values, double* out);
  void (*edge_maximum)(const LayoutView&, int block, const double* values, double* out);
  void (*wall_sum)(const LayoutView&, int block, const double* values, double* out);
  void (*fetch)(double* dst, const double* values, const int32_t* index, int count);
  uint8_t (*advance)(const AdvanceArguments&);
  /// The same with the rate a * b + c, computed on the way; [mask] as above.
  uint8_t (*advance_multiply_add[8])(const AdvanceArguments&, const Operands&);
};

enum class InstructionSet : uint8_t { best, sse2, avx2 };

/// Errors: avx2 asked for on a machine without it.
const Kernels& kernels(InstructionSet set = InstructionSet::best);

namespace sse2 {
const Kernels& kernels();
}
namespace avx2 {
const Kernels& kernels();
}

}  // namespace tunica
