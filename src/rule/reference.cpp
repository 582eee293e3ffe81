// SPDX-License-Identifier: MIT
#include "rule/reference.h"

#include <cmath>

namespace tunica {

Measured Reference::column(Kind kind, int slot, Index index) const {
  double value = 0;
  if (slot < 0) {
    const Index start = tissue_.first_side(index);
    Index s = start;
    if (s != none) do {
        value += tissue_.neighbour(s) != none;
        s = tissue_.next(s);
      } while (s != start);
  } else {
    value = tissue_.find_column(kind, equations_.columns[slot].name)->values[index];
  }
  return {value, std::fabs(value)};
}

Measured Reference::reduce(const Node& n, Index cell) const {
  Measured total{0, 0};
  bool any = false;
  const Index start = tissue_.first_side(cell);
  Index s = start;
  if (s != none) do {
      if (tissue_.neighbour(s) != none) {
        const Measured x = evaluate(n.a, none, s);
        if (n.op == Op::sum || n.op == Op::flux_sum)
          total = {total.value + x.value, total.magnitude + x.magnitude};
        else if (!any)
          total = x;
        else
          total = {apply(n.op == Op::minimum ? Op::min : Op::max, total.value, x.value, 0),
                   std::max(total.magnitude, x.magnitude)};
        any = true;
      }
      s = tissue_.next(s);
    } while (s != start);
  return total;
}

Measured Reference::evaluate(NodeId id, Index cell, Index side) const {
  const Node& n = equations_.graph[id];
  switch (n.op) {
    case Op::constant:
      return {n.value, std::fabs(n.value)};
    case Op::parameter:
      return {parameters_.at(n.slot), std::fabs(parameters_.at(n.slot))};
    case Op::time:
      return {time_, std::fabs(time_)};
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
  const auto operand = [&](NodeId x) { return x == no_node ? Measured{0, 0} : evaluate(x, cell, side); };
  const Measured a = operand(n.a), b = operand(n.b), c = operand(n.c);
  const double value = apply(n.op, a.value, b.value, c.value);
  double magnitude = std::fabs(value);
  const auto relative = [](const Measured& m) { return m.value == 0 ? 1.0 : m.magnitude / std::fabs(m.value); };
  if (n.op == Op::add || n.op == Op::sub) magnitude = a.magnitude + b.magnitude;
  if (n.op == Op::mul || n.op == Op::div) magnitude *= std::max(relative(a), relative(b));
  if (n.op == Op::mul && value == 0) magnitude = a.magnitude * b.magnitude;
  if (is_unary(n.op)) magnitude *= n.op == Op::exp ? 1 + a.magnitude : relative(a);
  if (n.op == Op::pow) magnitude *= (1 + b.magnitude) * std::max(relative(a), relative(b));
  if (n.op == Op::min || n.op == Op::max) magnitude = std::max(a.magnitude, b.magnitude);
  if (n.op == Op::select) magnitude = std::max(b.magnitude, c.magnitude);
  return {value, magnitude};
}

}  // namespace tunica
