// SPDX-License-Identifier: MIT
#pragma once

#include "rule/equations.h"
#include "tissue/tissue.h"

namespace tunica {

/// Writes equations in C++ nearly as in a script.
struct Writer {
  Equations& e;
  NodeId k(double v) { return e.graph.constant(v); }
  NodeId P(const char* name) { return e.graph.parameter(e.parameter_slot(name)); }
  NodeId cell(const char* name) { return e.graph.column(Kind::cell, e.column_slot(Kind::cell, name)); }
  NodeId wall(const char* name) { return e.graph.column(Kind::wall, e.column_slot(Kind::wall, name)); }
  NodeId side(const char* name) { return e.graph.column(Kind::side, e.column_slot(Kind::side, name)); }
  NodeId own(NodeId x) { return e.graph.own(x); }
  NodeId across(NodeId x) { return e.graph.across(x); }
  NodeId add(NodeId a, NodeId b) { return e.graph.binary(Op::add, a, b); }
  NodeId sub(NodeId a, NodeId b) { return e.graph.binary(Op::sub, a, b); }
  NodeId mul(NodeId a, NodeId b) { return e.graph.binary(Op::mul, a, b); }
  NodeId div(NodeId a, NodeId b) { return e.graph.binary(Op::div, a, b); }
  NodeId max(NodeId a, NodeId b) { return e.graph.binary(Op::max, a, b); }
  NodeId pow(NodeId a, NodeId b) { return e.graph.binary(Op::pow, a, b); }
  NodeId neg(NodeId a) { return e.graph.unary(Op::neg, a); }
  NodeId sum(NodeId a) { return e.graph.reduce(Op::sum, a); }
  NodeId flux(NodeId a) { return e.graph.reduce(Op::flux_sum, a); }
  void rate(const char* column, NodeId value) { e.rates.push_back({e.column_slot(Kind::cell, column), value, column}); }
};

/// da/dt, dh/dt of the activator-inhibitor model (thesis 9.12, 9.13).
inline void activator_inhibitor(Equations& e) {
  Writer w{e};
  const NodeId a = w.cell("a"), h = w.cell("h"), a2 = w.mul(a, a);
  const auto spread = [&](NodeId x) { return w.sum(w.sub(w.across(x), w.own(x))); };
  w.rate("a", w.add(w.sub(w.add(w.div(w.mul(w.P("ra"), a2), w.add(w.k(1), h)), w.P("sa")), w.mul(w.P("ma"), a)),
                    w.mul(w.P("Da"), spread(a))));
  w.rate("h", w.add(w.sub(w.add(w.mul(w.P("rh"), a2), w.P("sh")), w.mul(w.P("mh"), h)), w.mul(w.P("Dh"), spread(h))));
}

/// dA/dt, dP/dt of auxin transport on a cellular tissue (thesis 5.7-5.9), the exchange as a flux through walls.
inline void auxin_transport(Equations& e) {
  Writer w{e};
  const NodeId A = w.cell("auxin"), p = w.cell("pin"), l = w.wall("length"), area = w.cell("area");
  const NodeId power = w.pow(w.P("b"), A);
  const NodeId share = w.div(p, w.sum(w.mul(l, w.across(power))));
  const auto seen = [&](bool own, NodeId x) { return own ? w.own(x) : w.across(x); };
  const auto carried = [&](bool from_own) {
    const NodeId from = seen(from_own, A), to = seen(!from_own, A);
    return w.div(w.mul(w.mul(seen(from_own, share), seen(!from_own, power)), w.mul(from, from)),
                 w.add(w.k(1), w.mul(w.P("kT"), w.mul(to, to))));
  };
  const NodeId f = w.mul(
      l, w.add(w.mul(w.P("D"), w.sub(w.own(A), w.across(A))), w.mul(w.P("T"), w.sub(carried(true), carried(false)))));
  w.rate("auxin", w.div(w.neg(w.flux(f)), area));
  w.rate("auxin", w.sub(w.div(w.P("rho"), w.add(w.k(1), w.mul(w.P("kI"), A))), w.mul(w.P("mu"), A)));
  w.rate("pin",
         w.sub(w.div(w.add(w.P("rP0"), w.mul(w.P("rP"), A)), w.add(w.k(1), w.mul(w.P("kP"), p))), w.mul(w.P("mP"), p)));
}

/// Transport that only runs towards the richer cell, and does not separate: exchange l T (a max(b - a, 0) - b max(a -
/// b, 0)).
inline void upwind(Equations& e) {
  Writer w{e};
  const NodeId x = w.own(w.cell("u")), y = w.across(w.cell("u"));
  const auto up = [&](NodeId from, NodeId to) { return w.mul(from, w.max(w.sub(to, from), w.k(0))); };
  w.rate("u",
         w.div(w.neg(w.flux(w.mul(w.wall("length"), w.mul(w.P("T"), w.sub(up(x, y), up(y, x)))))), w.cell("area")));
  w.rate("u", w.sub(w.P("rho"), w.mul(w.P("mu"), w.cell("u"))));
}

}  // namespace tunica
