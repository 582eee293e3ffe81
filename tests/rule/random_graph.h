// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.h"
#include "rule/equations_for_tests.h"

namespace tunica {

inline void fill(Tissue& t, Kind kind, const std::string& name, double low, double high) {
  Column& c = t.add_column(kind, {.name = name});
  for (Index i = 0; i < t.count(kind); ++i)
    c.values[i] = low + (high - low) * uniform({7, purpose(name), t.id(kind, i), static_cast<uint32_t>(kind)});
}

/// A random side or cell expression over all kinds of columns and operations.
struct RandomGraph {
  Writer w;
  uint64_t seed;
  uint64_t draws = 0;
  double u() { return uniform({seed, purpose("graph"), draws++}); }
  int pick(int n) { return static_cast<int>(u() * n); }

  NodeId scalar() { return pick(2) ? w.k(0.2 + u()) : w.P(pick(2) ? "p" : "q"); }
  NodeId cell(int depth) {
    if (depth <= 0 || pick(5) == 0)
      return pick(4) == 0 ? scalar() : pick(6) == 0 ? w.cell("area") : w.cell(pick(2) ? "u" : "v");
    if (pick(4) == 0) {
      static constexpr Op sums[] = {Op::sum, Op::sum, Op::sum, Op::minimum, Op::maximum};
      return w.e.graph.reduce(sums[pick(5)], side(depth - 1));
    }
    return combine(cell(depth - 1), pick(3) ? cell(depth - 1) : scalar());
  }
  NodeId side(int depth) {
    if (depth <= 0 || pick(6) == 0) {
      switch (pick(5)) {
        case 0:
          return w.wall(pick(3) ? "length" : "g");
        case 1:
          return w.side(pick(2) ? "s" : "z");
        case 2:
          return w.e.graph.mirrored(w.side(pick(2) ? "s" : "z"));
        case 3:
          return w.own(cell(depth - 2));
        default:
          return w.across(cell(depth - 2));
      }
    }
    if (pick(5) == 0) {
      const NodeId x = cell(depth - 2);
      if (w.e.graph[x].domain == Domain::cell) return w.sub(w.across(x), w.own(x));
    }
    return combine(side(depth - 1), side(depth - 1));
  }
  NodeId combine(NodeId a, NodeId b) {
    Graph& g = w.e.graph;
    switch (pick(14)) {
      case 0:
      case 1:
      case 2:
        return g.binary(Op::add, a, b);
      case 3:
      case 4:
        return g.binary(Op::sub, a, b);
      case 5:
      case 6:
      case 7:
        return g.binary(Op::mul, a, b);
      case 8:
        return g.binary(Op::div, a, g.binary(Op::add, w.k(1), g.unary(Op::abs, b)));
      case 9:
        return g.unary(pick(2) ? Op::tanh : Op::sin, a);
      case 10:
        return g.unary(Op::exp, g.unary(Op::neg, g.unary(Op::abs, a)));
      case 11:
        return g.binary(pick(2) ? Op::min : Op::max, a, b);
      case 12:
        return g.select(g.binary(Op::less, a, b), a, b);
      default:
        return g.binary(Op::pow, g.unary(Op::abs, a), w.k(1.5));
    }
  }
};

/// Rates of cell columns u, v, at times of side column z and wall column g; parameters p, q.
inline void random_equations(Equations& e, uint64_t seed) {
  RandomGraph random{{e}, seed};
  random.w.P("p"), random.w.P("q");
  random.w.rate("u", random.cell(4));
  random.w.rate("v", random.cell(3));
  const auto in_side = [&](NodeId x) { return e.graph[x].domain == Domain::cell ? e.graph.own(x) : x; };
  if (seed % 5 == 1) {  // what neighbours know of their neighbours
    const NodeId x = random.combine(random.cell(1), e.graph.reduce(Op::sum, random.side(2)));
    random.w.rate("u", random.w.sum(random.combine(random.w.own(x), random.w.across(x))));
  }
  if (seed % 3 == 0) e.rates.push_back({e.column_slot(Kind::side, "z"), in_side(random.side(3)), ""});
  if (seed % 4 == 0) e.rates.push_back({e.column_slot(Kind::wall, "g"), in_side(random.side(3)), ""});
}

}  // namespace tunica
