// SPDX-License-Identifier: MIT
#include "rule/separate.h"

namespace tunica {

namespace {

constexpr size_t most_terms = 12;

NodeId times(Graph& g, NodeId x, NodeId y) {
  if (x == no_node) return y;
  if (y == no_node) return x;
  return g.binary(Op::mul, x, y);
}

NodeId over(Graph& g, NodeId x, NodeId y) {
  if (y == no_node) return x;
  return g.binary(Op::div, x == no_node ? g.constant(1) : x, y);
}

bool edges_only(const Graph& g, NodeId id) {
  const Node n = g[id];
  if (n.domain == Domain::scalar) return true;
  if (n.op == Op::wall_column || n.op == Op::side_column) return true;
  if (n.op == Op::own || n.op == Op::across || n.domain == Domain::cell) return false;
  for (const NodeId x : {n.a, n.b, n.c})
    if (x != no_node && !edges_only(g, x)) return false;
  return true;
}

/// n.x - c.x with the same x.
bool is_difference(const Graph& g, NodeId id) {
  const Node& n = g[id];
  if (n.op != Op::sub) return false;
  const Node &a = g[n.a], &b = g[n.b];
  return a.op == Op::across && b.op == Op::own && a.a == b.a;
}

bool multiply(Graph& g, const Monomial& x, const Monomial& y, std::vector<Monomial>& terms) {
  if ((x.difference && y.neighbour != no_node) || (y.difference && x.neighbour != no_node)) return false;
  terms.push_back({times(g, x.own, y.own), times(g, x.weight, y.weight), times(g, x.neighbour, y.neighbour),
                   x.difference || y.difference});
  return terms.size() <= most_terms;
}

bool divide(Graph& g, const std::vector<Monomial>& above, const Monomial& below, std::vector<Monomial>& terms) {
  if (below.difference) return false;
  for (const Monomial& m : above) {
    if (m.difference && below.neighbour != no_node) return false;
    terms.push_back({over(g, m.own, below.own), over(g, m.weight, below.weight), over(g, m.neighbour, below.neighbour),
                     m.difference});
  }
  return terms.size() <= most_terms;
}

}  // namespace

bool separate(Graph& g, NodeId id, std::vector<Monomial>& terms) {
  const Node n = g[id];
  if (n.domain != Domain::side) {
    terms.push_back({.own = id});
    return true;
  }
  if (n.op == Op::own) {
    terms.push_back({.own = n.a});
    return true;
  }
  if (n.op == Op::across) {
    terms.push_back({.neighbour = n.a});
    return true;
  }
  if (edges_only(g, id)) {
    terms.push_back({.weight = id});
    return true;
  }
  if (is_difference(g, id)) {
    terms.push_back({.neighbour = g[n.a].a, .difference = true});
    return true;
  }
  std::vector<Monomial> a, b;
  switch (n.op) {
    case Op::neg:
    case Op::sub: {
      if (n.op == Op::sub) {
        // c.x - n.x: minus the difference
        const Node x = g[n.a], y = g[n.b];
        if (x.op == Op::own && y.op == Op::across && x.a == y.a) {
          terms.push_back({.own = g.constant(-1), .neighbour = x.a, .difference = true});
          return true;
        }
        if (!separate(g, n.a, terms)) return false;
      }
      if (!separate(g, n.op == Op::neg ? n.a : n.b, b)) return false;
      for (Monomial& m : b) {
        m.own = m.own == no_node ? g.constant(-1) : g.unary(Op::neg, m.own);
        terms.push_back(m);
      }
      return terms.size() <= most_terms;
    }
    case Op::add:
      return separate(g, n.a, terms) && separate(g, n.b, terms) && terms.size() <= most_terms;
    case Op::mul:
      if (!separate(g, n.a, a) || !separate(g, n.b, b)) return false;
      for (const Monomial& x : a)
        for (const Monomial& y : b)
          if (!multiply(g, x, y, terms)) return false;
      return true;
    case Op::div:
      return separate(g, n.a, a) && separate(g, n.b, b) && b.size() == 1 && divide(g, a, b[0], terms);
    default:
      return false;
  }
}

}  // namespace tunica
