// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <vector>

#include "rule/plan.h"

namespace tunica {

/// Rewrites rule graphs so that every sum over neighbours is a gather of neighbours' values, a sum of values per
/// half-edge, or (fluxes) a sum of values per wall; and says in which round of passes each value can be computed.
class Lowering {
 public:
  Lowering(Equations& equations, const std::vector<bool>& is_state)
      : equations_(equations), graph_(equations.graph), is_state_(is_state) {}

  NodeId lower(NodeId id);

  /// Round of a value: cell pass `level(x)` computes cell values, the edge (wall) pass after it side values. A
  /// neighbour's value can be gathered one round after it is computed.
  int level(NodeId id);

  /// Side values of columns that change only between steps: computed once while the structure stands.
  bool is_fixed(NodeId side_value);

  Graph& graph() { return graph_; }
  const std::vector<bool>& is_state() const { return is_state_; }

 private:
  NodeId lower_sum(const Node& node);
  NodeId sum_of(const std::vector<struct Monomial>& terms);

  Equations& equations_;
  Graph& graph_;
  const std::vector<bool>& is_state_;
  std::map<NodeId, NodeId> lowered_;
  std::map<NodeId, int> levels_;
};

}  // namespace tunica
