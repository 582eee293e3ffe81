// SPDX-License-Identifier: MIT
#include "rule/lower.h"

#include <algorithm>

#include "rule/separate.h"

namespace tunica {

NodeId Lowering::lower(NodeId id) {
  if (const auto known = lowered_.find(id); known != lowered_.end()) return known->second;
  const Node n = graph_[id];
  const auto child = [&](NodeId x) { return x == no_node ? no_node : lower(x); };
  NodeId result = id;
  if (n.op == Op::own) {
    result = graph_.own(lower(n.a));
  } else if (n.op == Op::across) {
    result = graph_.across(lower(n.a));
  } else if (is_unary(n.op)) {
    result = graph_.unary(n.op, child(n.a));
  } else if (is_binary(n.op)) {
    const NodeId a = child(n.a), b = child(n.b);
    result = graph_.binary(n.op, a, b);
  } else if (n.op == Op::select) {
    const NodeId a = child(n.a), b = child(n.b), c = child(n.c);
    result = graph_.select(a, b, c);
  } else if (n.op == Op::sum || n.op == Op::flux_sum || n.op == Op::minimum || n.op == Op::maximum) {
    result = lower_sum(n);
  }
  lowered_[id] = result;
  return result;
}

NodeId Lowering::lower_sum(const Node& node) {
  const NodeId body = lower(node.a);
  if (node.op == Op::minimum || node.op == Op::maximum)
    return graph_.intern(
        {.op = node.op == Op::minimum ? Op::edge_minimum : Op::edge_maximum, .domain = Domain::cell, .a = body});
  std::vector<Monomial> terms;
  if (separate(graph_, body, terms)) return sum_of(terms);
  // A flux has the same size seen from both cells: once per wall is enough.
  return graph_.intern(
      {.op = node.op == Op::flux_sum ? Op::wall_sum : Op::edge_sum, .domain = Domain::cell, .a = body});
}

NodeId Lowering::sum_of(const std::vector<Monomial>& terms) {
  struct Gathered {
    NodeId gather, own;
  };
  std::vector<Gathered> gathered;
  for (const Monomial& m : terms) {
    NodeId gather;
    if (m.neighbour != no_node)
      gather = graph_.intern({.op = Op::gather,
                              .domain = Domain::cell,
                              .a = m.neighbour,
                              .b = m.weight,
                              .value = m.difference ? 1.0 : 0.0});
    else if (m.weight != no_node)
      gather = graph_.intern({.op = Op::edge_sum, .domain = Domain::cell, .a = m.weight});
    else
      gather = graph_.column(Kind::cell, -1);  // the number of neighbours
    const NodeId own = m.own == no_node ? graph_.constant(1) : m.own;
    const auto same =
        std::find_if(gathered.begin(), gathered.end(), [&](const Gathered& g) { return g.gather == gather; });
    if (same == gathered.end())
      gathered.push_back({gather, own});
    else
      same->own = graph_.binary(Op::add, same->own, own);
  }
  NodeId total = no_node;
  for (const Gathered& g : gathered) {
    const NodeId term = graph_.binary(Op::mul, g.own, g.gather);
    total = total == no_node ? term : graph_.binary(Op::add, total, term);
  }
  return total;
}

int Lowering::level(NodeId id) {
  if (id == no_node) return 0;
  const Node n = graph_[id];
  if (n.domain == Domain::scalar || is_leaf(n.op)) return 0;
  if (const auto known = levels_.find(id); known != levels_.end()) return known->second;
  int result = std::max({level(n.a), level(n.b), level(n.c)});
  const bool sum = n.op == Op::gather || n.op == Op::edge_sum || n.op == Op::edge_minimum || n.op == Op::edge_maximum ||
                   n.op == Op::wall_sum;
  // A sum of fixed weights needs no round of its own.
  const bool fixed = n.op != Op::gather && n.op != Op::wall_sum && is_fixed(n.a);
  if (sum && !fixed) ++result;
  levels_[id] = result;
  return result;
}

bool Lowering::is_fixed(NodeId id) {
  const Node n = graph_[id];
  switch (n.op) {
    case Op::time:
    case Op::own:
    case Op::across:
      return false;
    case Op::constant:
    case Op::parameter:
      return true;
    case Op::wall_column:
    case Op::side_column:
      return !is_state_[n.slot];
    case Op::mirrored:
      return is_fixed(n.a);
    default:
      break;
  }
  if (n.domain == Domain::cell) return false;
  for (const NodeId x : {n.a, n.b, n.c})
    if (x != no_node && !is_fixed(x)) return false;
  return true;
}

}  // namespace tunica
