// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "rule/jacobian.h"
#include "solve/sparse_factor.h"

namespace tunica {

/// Factors of I - g J_kk for each state column k by itself: diffusion within a column is what makes models stiff, and
/// its blocks are far cheaper to factorise than the whole.
class BlockPreconditioner {
 public:
  /// To be called for a new pattern.
  void analyse(const Jacobian& jacobian);
  /// False if a block is singular.
  bool factor(const Jacobian& jacobian, double g);
  /// z = M^-1 r
  void solve(const double* r, double* z);

 private:
  struct Block {
    int first;                    ///< unknown
    SparseRows rows;              ///< of this block alone
    std::vector<int32_t> source;  ///< of each value, in the whole matrix
    SparseFactor factor;
  };
  std::vector<Block> blocks_;
};

}  // namespace tunica
