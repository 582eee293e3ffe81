// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/aligned.h"
#include "rule/kernels.h"
#include "tissue/tissue.h"

namespace tunica {

/// Length of a buffer for `count` values: whole blocks, and one to spare.
constexpr Index padded_to_blocks(Index count) { return ((count + block_size - 1) / block_size + 1) * block_size; }

/// The neighbourhoods of a tissue as arrays, for one structure. Half-edges are the sides that have a neighbour. Within
/// a block of 256 cells they are sorted by the number of neighbours of their cell, so that sums run over equal counts;
/// within a cell they keep the cyclic order from the cell's first side, which fixes the bits of every sum.
struct Layout {
  explicit Layout(const Tissue& tissue);

  /// The arrays that the inner loops read; valid while this layout lives.
  LayoutView view() const;

  Index cells, blocks, edges, walls;
  Index wall_stride;              ///< walls, padded: from a wall's value to its negative
  std::vector<uint8_t> position;  ///< per cell, in run order: its place within the block
  std::vector<Run> runs;
  std::vector<int32_t> run_begin;                        ///< per block, into runs; one more at the end
  std::vector<int32_t> edge_begin;                       ///< per block, first half-edge; one more at the end
  std::vector<int32_t> own, across, wall, side, mirror;  ///< per half-edge: cell, neighbour, wall, side, side across
  std::vector<int32_t>
      signed_wall;                ///< per half-edge: place of its wall below, + wall_stride on the wall's second side
  std::vector<int32_t> primary;   ///< per wall between two cells: the half-edge of its first side
  AlignedBuffer neighbour_count;  ///< per cell, padded

 private:
  void add_runs(int neighbours, int count);
};

}  // namespace tunica
