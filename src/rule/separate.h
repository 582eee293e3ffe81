// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "rule/graph.h"

namespace tunica {

/// One term of a neighbour sum: own x sum(weight x neighbour), where the neighbour's factor is a value of the neighbour
/// or the difference between the neighbour's and the cell's own value. Missing factors are no_node.
struct Monomial {
  NodeId own = no_node;        ///< cell or scalar
  NodeId weight = no_node;     ///< side value of wall and side columns only
  NodeId neighbour = no_node;  ///< cell
  bool difference = false;
};

/// Expands a side value into monomials. False if some part does not separate, or there would be too many terms.
/// Differences `n.x - c.x` are kept whole, so that nothing cancels.
bool separate(Graph& graph, NodeId side_value, std::vector<Monomial>& terms);

}  // namespace tunica
