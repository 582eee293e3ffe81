// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "rule/equations.h"
#include "tissue/tissue.h"

namespace tunica {

/// A value with the size of the terms it was made of, against which rounding is to be judged.
struct Measured {
  double value;
  double magnitude;
};

/// Evaluates one node at one place by walking its graph, straight from the definitions: slow, and independent of
/// lowering and kernels, which are checked against it. Reads the tissue's columns.
class Reference {
 public:
  Reference(const Equations& equations, const Tissue& tissue, const std::vector<double>& parameters, double time)
      : equations_(equations), tissue_(tissue), parameters_(parameters), time_(time) {}

  Measured at_cell(NodeId id, Index cell) const { return evaluate(id, cell, none); }
  /// The side must have a neighbour.
  Measured at_side(NodeId id, Index side) const { return evaluate(id, none, side); }

 private:
  Measured evaluate(NodeId id, Index cell, Index side) const;
  Measured reduce(const Node& node, Index cell) const;
  Measured column(Kind kind, int slot, Index index) const;

  const Equations& equations_;
  const Tissue& tissue_;
  const std::vector<double>& parameters_;
  double time_;
};

}  // namespace tunica
