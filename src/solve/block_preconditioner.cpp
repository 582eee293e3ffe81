// SPDX-License-Identifier: MIT
#include "solve/block_preconditioner.h"

#include <algorithm>

namespace tunica {

void BlockPreconditioner::analyse(const Jacobian& jacobian) {
  blocks_.clear();
  const SparseRows& j = jacobian.matrix();
  const std::vector<int32_t>& offsets = jacobian.offsets();
  for (size_t k = 0; k + 1 < offsets.size(); ++k) {
    Block& block = blocks_.emplace_back();
    block.first = offsets[k];
    block.rows.begin.assign(1, 0);
    for (int row = offsets[k]; row < offsets[k + 1]; ++row) {
      for (int32_t at = j.begin[row]; at < j.begin[row + 1]; ++at) {
        if (j.column[at] < offsets[k] || j.column[at] >= offsets[k + 1]) continue;
        block.rows.column.push_back(j.column[at] - offsets[k]);
        block.source.push_back(at);
      }
      block.rows.begin.push_back(static_cast<int32_t>(block.rows.column.size()));
    }
    block.rows.value.resize(block.rows.column.size());
    block.factor.analyse(block.rows);
  }
}

bool BlockPreconditioner::factor(const Jacobian& jacobian, double g) {
  for (Block& block : blocks_) {
    for (size_t k = 0; k < block.source.size(); ++k) block.rows.value[k] = jacobian.matrix().value[block.source[k]];
    if (!block.factor.factor(block.rows, 1, g)) return false;
  }
  return true;
}

void BlockPreconditioner::solve(const double* r, double* z) {
  for (Block& block : blocks_) {
    std::copy(r + block.first, r + block.first + block.rows.rows(), z + block.first);
    block.factor.solve(z + block.first);
  }
}

}  // namespace tunica
