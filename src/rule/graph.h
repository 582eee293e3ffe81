// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "tissue/column.h"

namespace tunica {

using NodeId = int32_t;
inline constexpr NodeId no_node = -1;

/// Where a value lives. A scalar is the same everywhere (constants, parameters, time); a side value belongs to a wall
/// seen from one of its cells.
enum class Domain : uint8_t { scalar, cell, side };

enum class Op : uint8_t {
  // leaves
  constant,
  parameter,
  time,
  cell_column,
  wall_column,
  side_column,
  // a cell's value seen from one of its sides (own), or from a neighbour's (across); a side's value seen from across
  own,
  across,
  mirrored,
  // arithmetic, element by element
  neg,
  exp,
  log,
  sqrt,
  sin,
  cos,
  tanh,
  abs,
  add,
  sub,
  mul,
  div,
  pow,
  min,
  max,
  less,
  less_equal,
  equal,
  select,
  // over the sides of a cell that have a neighbour: side values to one cell value
  sum,
  flux_sum,
  minimum,
  maximum,
  // only after lowering: sums with the neighbour's factor gathered (b: weight, value: 1 for differences)
  gather,
  edge_sum,
  edge_minimum,
  edge_maximum,
  wall_sum,
};

bool is_leaf(Op op);
bool is_unary(Op op);
bool is_binary(Op op);
const char* name_of(Op op);

struct Node {
  Op op;
  Domain domain;
  NodeId a = no_node, b = no_node, c = no_node;
  int32_t slot = 0;  ///< of a column or parameter
  double value = 0;  ///< of a constant; 1 marks a gather of differences
};

/// An expression graph: every node once (equal nodes are the same node), operands before the nodes that use them.
/// Built by tracing a rule, or by a host directly. Arithmetic on values of neighbours alone is kept as one value of the
/// neighbour (`across` and `own` are moved outwards), which later lets it be computed once per cell.
class Graph {
 public:
  NodeId constant(double value);
  NodeId parameter(int slot);
  NodeId time();
  NodeId column(Kind kind, int slot);  ///< kind: cell, wall or side

  NodeId own(NodeId cell_value);       ///< cell or scalar -> side
  NodeId across(NodeId cell_value);    ///< cell or scalar -> side
  NodeId mirrored(NodeId side_value);  ///< the same expression seen from the other cell

  NodeId unary(Op op, NodeId a);
  NodeId binary(Op op, NodeId a, NodeId b);
  NodeId select(NodeId condition, NodeId yes, NodeId no);
  /// sum, flux_sum, minimum or maximum over the sides that have a neighbour. Side or lower -> cell.
  NodeId reduce(Op op, NodeId side_value);
  /// Any node as it is (used by lowering).
  NodeId intern(const Node& node);

  const Node& operator[](NodeId id) const { return nodes_[static_cast<size_t>(id)]; }
  size_t size() const { return nodes_.size(); }
  bool is_constant(NodeId id, double value) const;
  /// Readable form, for messages and tests.
  std::string text(NodeId id) const;

 private:
  struct Hash {
    size_t operator()(const Node& n) const;
  };
  struct Same {
    bool operator()(const Node& x, const Node& y) const;
  };
  NodeId elementwise(Node node);
  NodeId power(NodeId base, NodeId exponent);
  NodeId fold(const Node& node);
  NodeId promote(NodeId id, Domain domain);

  std::vector<Node> nodes_;
  std::unordered_map<Node, NodeId, Hash, Same> ids_;
};

/// The value of an elementwise operation; the definition that every evaluator follows, NaN-safe: min, max, comparisons
/// and select give NaN when what decides is NaN.
double apply(Op op, double a, double b, double c);

}  // namespace tunica
