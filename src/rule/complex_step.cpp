// SPDX-License-Identifier: MIT
#include "rule/complex_step.h"

#include <cmath>

namespace tunica {

namespace {

constexpr long double step = 1e-200L;

using Number = std::complex<long double>;

/// The definitions of apply() in graph.h; what decides is the real part.
Number apply(Op op, Number a, Number b, Number c) {
  const auto yes = [](bool v) { return Number(v ? 1 : 0); };
  switch (op) {
    case Op::neg:
      return -a;
    case Op::exp:
      return std::exp(a);
    case Op::log:
      return std::log(a);
    case Op::sqrt:
      return std::sqrt(a);
    case Op::sin:
      return std::sin(a);
    case Op::cos:
      return std::cos(a);
    case Op::tanh:
      return std::tanh(a);
    case Op::abs:
      return a.real() < 0 ? -a : a;
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      return a / b;
    case Op::pow:
      return a == Number(0) ? Number(b == Number(0) ? 1 : 0) : std::exp(b * std::log(a));
    case Op::min:
      return a.real() < b.real() ? a : b;
    case Op::max:
      return a.real() > b.real() ? a : b;
    case Op::less:
      return yes(a.real() < b.real());
    case Op::less_equal:
      return yes(a.real() <= b.real());
    case Op::equal:
      return yes(a.real() == b.real());
    case Op::select:
      return a.real() != 0 ? b : c;
    default:
      fail("internal: {} is no elementwise operation", name_of(op));
  }
}

}  // namespace

ComplexStep::ComplexStep(const Equations& equations, const Tissue& tissue, std::vector<double> parameters, double time)
    : equations_(equations), tissue_(tissue), parameters_(std::move(parameters)), time_(time) {
  materialised_.assign(equations.columns.size(), no_node);
  for (const Equations::Derivation& d : equations.derivations)
    if (d.materialise)
      for (const Target& target : d.traced) materialised_[target.column] = target.value;
}

double ComplexStep::derivative(int of, Index row, int by, Index col) {
  stepped_column_ = by;
  stepped_element_ = col;
  const Kind kind = equations_.columns[of].kind;
  Number sum = 0;
  for (const Target& rate : equations_.rates) {
    if (rate.column != of) continue;
    const Index side = kind == Kind::wall ? tissue_.wall_side(row, 0) : row;
    sum += kind == Kind::cell ? evaluate(rate.value, row, none) : evaluate(rate.value, none, side);
  }
  return static_cast<double>(sum.imag() / step);
}

Number ComplexStep::column(Kind kind, int slot, Index index) const {
  if (materialised_[slot] != no_node && kind == Kind::wall)
    return evaluate(materialised_[slot], none, tissue_.wall_side(index, 0));
  const double value = tissue_.find_column(kind, equations_.columns[slot].name)->values[index];
  return {value, slot == stepped_column_ && index == stepped_element_ ? step : 0};
}

Number ComplexStep::reduce(const Node& n, Index cell) const {
  Number total = 0;
  bool any = false;
  const Index start = tissue_.first_side(cell);
  Index s = start;
  if (s != none) do {
      if (tissue_.neighbour(s) != none) {
        const Number x = evaluate(n.a, none, s);
        const bool adds = n.op == Op::sum || n.op == Op::flux_sum;
        total = adds ? total + x : !any ? x : apply(n.op == Op::minimum ? Op::min : Op::max, total, x, 0);
        any = true;
      }
      s = tissue_.next(s);
    } while (s != start);
  return total;
}

Number ComplexStep::evaluate(NodeId id, Index cell, Index side) const {
  const Node& n = equations_.graph[id];
  switch (n.op) {
    case Op::constant:
      return n.value;
    case Op::parameter:
      return parameters_.at(n.slot);
    case Op::time:
      return time_;
    case Op::cell_column:
      return column(Kind::cell, n.slot, cell);
    case Op::wall_column:
      return column(Kind::wall, n.slot, tissue_.wall_of(side));
    case Op::side_column:
      return column(Kind::side, n.slot, side);
    case Op::own:
      return evaluate(n.a, tissue_.cell_of(side), none);
    case Op::across:
      return evaluate(n.a, tissue_.neighbour(side), none);
    case Op::mirrored:
      return evaluate(n.a, none, tissue_.opposite(side));
    case Op::sum:
    case Op::flux_sum:
    case Op::minimum:
    case Op::maximum:
      return reduce(n, cell);
    default:
      break;
  }
  const auto operand = [&](NodeId x) { return x == no_node ? Number(0) : evaluate(x, cell, side); };
  return apply(n.op, operand(n.a), operand(n.b), operand(n.c));
}

}  // namespace tunica
