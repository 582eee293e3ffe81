// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "rule/jacobian.h"

namespace tunica {

/// The Jacobian by finite differences, for rules that could not be traced. A rate is taken to read nothing further away
/// than some rings of neighbours: first one, and more as long as a random direction shows that it does not suffice.
/// Unknowns that no rate reads together are moved at once, so that the number of evaluations does not grow with the
/// tissue.
class Differences {
 public:
  explicit Differences(System& system) : system_(system) {}

  /// For a new structure. Fills the pattern of `j`. Errors: a rate that reads beyond four rings, or jumps.
  void prepare(const std::vector<int32_t>& offsets, SparseRows& j);
  /// The entries, exact to about 1e-7 of the largest of their row.
  void evaluate(double t, const double* y, SparseRows& j);

 private:
  void build(SparseRows& j);
  void find_reach(SparseRows& j);
  void colour(const SparseRows& j);
  bool holds(double t, const double* y, const SparseRows& j);
  std::vector<std::vector<int32_t>> cells_within_reach() const;

  System& system_;
  std::vector<int32_t> offsets_;
  int reach_ = 1;
  struct Entry {
    int32_t row, place;
  };
  std::vector<std::vector<int32_t>> unknowns_;  ///< of each colour
  std::vector<std::vector<Entry>> entries_;     ///< of each colour
  std::vector<int32_t> place_;                  ///< of each unknown in the padded state
  AlignedBuffer moved_, base_, rates_;
};

}  // namespace tunica
