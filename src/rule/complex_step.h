// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <vector>

#include "rule/equations.h"
#include "tissue/tissue.h"

namespace tunica {

/// Derivatives by complex steps in extended precision, straight from the definitions: d f = Im f(x + i h) / h without
/// subtraction. Slow, and independent of symbolic differentiation, lowering and kernels, which are checked against it.
/// Reads the tissue's columns. Rules that were not traced are left out.
class ComplexStep {
 public:
  ComplexStep(const Equations& equations, const Tissue& tissue, std::vector<double> parameters, double time);

  /// d(rate of column `of` in element `row`) / d(value of column `by` in element `col`); columns are slots.
  double derivative(int of, Index row, int by, Index col);

 private:
  using Number = std::complex<long double>;
  Number evaluate(NodeId id, Index cell, Index side) const;
  Number reduce(const Node& node, Index cell) const;
  Number column(Kind kind, int slot, Index index) const;

  const Equations& equations_;
  const Tissue& tissue_;
  std::vector<double> parameters_;
  double time_;
  std::vector<NodeId> materialised_;  ///< per column: the value of a wall's derived column, or no_node
  int stepped_column_ = -1;
  Index stepped_element_ = 0;
};

}  // namespace tunica
