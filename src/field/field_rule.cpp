// SPDX-License-Identifier: MIT
#include "field/field_rule.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace tunica {

namespace {

void collect(const Graph& g, NodeId id, std::vector<bool>& needed) {
  if (id == no_node || needed[static_cast<size_t>(id)]) return;
  needed[static_cast<size_t>(id)] = true;
  for (const NodeId x : {g[id].a, g[id].b, g[id].c}) collect(g, x, needed);
}

bool elementwise(Op op) { return op >= Op::neg && op <= Op::select; }

}  // namespace

TracedField::TracedField(const Graph& graph, NodeId root) : graph_(graph), root_(root) {
  std::vector<bool> needed(graph_.size());
  collect(graph_, root_, needed);
  values_.resize(graph_.size());
  block_of_.assign(graph_.size(), -1);
  for (NodeId id = 0; id < static_cast<NodeId>(graph_.size()); ++id) {
    if (!needed[static_cast<size_t>(id)]) continue;
    const Op op = graph_[id].op;
    if (!is_leaf(op) && op != Op::own && !elementwise(op)) fail("internal: {} in the rule of a field", name_of(op));
    (of_pairs(id) ? pairs_ : single_).push_back(id);
  }
  for (const NodeId id : pairs_)
    if (graph_[id].op != Op::side_column) {
      block_of_[static_cast<size_t>(id)] = static_cast<int>(blocks_.size());
      blocks_.emplace_back().resize(block_size);
    }
  distances_.resize(block_size);
  reciprocal_ = of_pairs(root_) && find_reciprocal(root_);
}

/// w / d, and such a quotient times or divided by what does not depend on d.
bool TracedField::find_reciprocal(NodeId id) const {
  const Node& n = graph_[id];
  if (n.op == Op::div && graph_[n.b].op == Op::side_column) return !of_pairs(n.a);
  if (n.op == Op::div) return !of_pairs(n.b) && of_pairs(n.a) && find_reciprocal(n.a);
  if (n.op != Op::mul || of_pairs(n.a) == of_pairs(n.b)) return false;
  return find_reciprocal(of_pairs(n.a) ? n.a : n.b);
}

double TracedField::weight(NodeId id) const {
  const Node& n = graph_[id];
  if (n.op == Op::div && graph_[n.b].op == Op::side_column) return value(n.a);
  if (n.op == Op::div) return weight(n.a) / value(n.b);
  return of_pairs(n.a) ? weight(n.a) * value(n.b) : value(n.a) * weight(n.b);
}

/// 1 - exp(x) keeps its digits near 0: what a long-range inhibitor is at small ages.
double TracedField::compute(const Node& n) const {
  const auto x = [&](NodeId id) { return id == no_node ? 0.0 : value(id); };
  if (n.op == Op::sub && graph_.is_constant(n.a, 1) && graph_[n.b].op == Op::exp) return -std::expm1(x(graph_[n.b].a));
  if (n.op == Op::sub && graph_.is_constant(n.b, 1) && graph_[n.a].op == Op::exp) return std::expm1(x(graph_[n.a].a));
  return apply(n.op, x(n.a), x(n.b), x(n.c));
}

void TracedField::prepare(double age, double t) {
  for (const NodeId id : single_) {
    const Node& n = graph_[id];
    double& v = values_[static_cast<size_t>(id)];
    switch (n.op) {
      case Op::constant:
        v = n.value;
        break;
      case Op::parameter:
        v = parameters_.at(static_cast<size_t>(n.slot));
        break;
      case Op::time:
        v = t;
        break;
      case Op::cell_column:
        v = age;
        break;
      case Op::own:
        v = value(n.a);
        break;
      default:
        v = compute(n);
    }
  }
}

std::optional<double> TracedField::reciprocal(double age, double t) {
  if (!reciprocal_) return {};
  prepare(age, t);
  return weight(root_);
}

void TracedField::add(double age, double t, const double* d, int count, double* h) {
  prepare(age, t);
  if (!of_pairs(root_)) {
    for (int i = 0; i < count; ++i) h[i] += value(root_);
    return;
  }
  const Kernels& k = kernels();
  for (int from = 0; from < count; from += block_size) {
    const int size = std::min(block_size, count - from);
    std::copy(d + from, d + from + size, distances_.data());
    std::fill(distances_.data() + size, distances_.data() + block_size, 1.0);
    const auto block = [&](NodeId id) -> const double* {
      return graph_[id].op == Op::side_column ? distances_.data()
                                              : blocks_[static_cast<size_t>(block_of_[static_cast<size_t>(id)])].data();
    };
    for (const NodeId id : pairs_) {
      const Node& n = graph_[id];
      if (n.op == Op::side_column) continue;
      Operands o{.dst = const_cast<double*>(block(id)), .count = size};
      int mask = 0;
      const auto operand = [&](NodeId x, const double*& pointer, double& number, int bit) {
        if (x == no_node || !of_pairs(x)) {
          number = x == no_node ? 0.0 : value(x);
          mask |= bit;
        } else {
          pointer = block(x);
        }
      };
      operand(n.a, o.a, o.sa, 1);
      operand(n.b, o.b, o.sb, 2);
      operand(n.c, o.c, o.sc, 4);
      k.elementwise[static_cast<int>(n.op) - static_cast<int>(Op::neg)][mask](o);
    }
    const double* result = block(root_);
    for (int i = 0; i < size; ++i) h[from + i] += result[i];
  }
}

double TracedField::at(double d, double age, double t) {
  const double distances[4] = {d, d, d, d};
  double h[4] = {0, 0, 0, 0};
  add(age, t, distances, 4, h);
  return h[0];
}

}  // namespace tunica
