// SPDX-License-Identifier: MIT
#include "rule/graph.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace tunica {

bool is_leaf(Op op) { return op <= Op::side_column; }
bool is_unary(Op op) { return op >= Op::neg && op <= Op::abs; }
bool is_binary(Op op) { return op >= Op::add && op <= Op::equal; }

const char* name_of(Op op) {
  static constexpr const char* names[] = {
      "constant", "parameter",  "time",         "cell",         "wall",    "side",     "own",     "across",
      "mirrored", "neg",        "exp",          "log",          "sqrt",    "sin",      "cos",     "tanh",
      "abs",      "add",        "sub",          "mul",          "div",     "pow",      "min",     "max",
      "less",     "less_equal", "equal",        "select",       "sum",     "flux_sum", "minimum", "maximum",
      "gather",   "edge_sum",   "edge_minimum", "edge_maximum", "wall_sum"};
  return names[static_cast<int>(op)];
}

double apply(Op op, double a, double b, double c) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
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
      return std::fabs(a);
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      return a / b;
    case Op::pow:
      return std::pow(a, b);
    case Op::min:
      return std::isnan(a) ? a : (a < b ? a : b);
    case Op::max:
      return std::isnan(a) ? a : (a > b ? a : b);
    case Op::less:
      return std::isnan(a) || std::isnan(b) ? nan : (a < b ? 1.0 : 0.0);
    case Op::less_equal:
      return std::isnan(a) || std::isnan(b) ? nan : (a <= b ? 1.0 : 0.0);
    case Op::equal:
      return std::isnan(a) || std::isnan(b) ? nan : (a == b ? 1.0 : 0.0);
    case Op::select:
      return std::isnan(a) ? nan : (a != 0.0 ? b : c);
    default:
      fail("internal: {} is not elementwise", name_of(op));
  }
}

size_t Graph::Hash::operator()(const Node& n) const {
  uint64_t h = (static_cast<uint64_t>(n.op) << 8) | static_cast<uint64_t>(n.domain);
  for (const uint64_t part :
       {static_cast<uint64_t>(static_cast<uint32_t>(n.a)), static_cast<uint64_t>(static_cast<uint32_t>(n.b)),
        static_cast<uint64_t>(static_cast<uint32_t>(n.c)), static_cast<uint64_t>(static_cast<uint32_t>(n.slot)),
        std::bit_cast<uint64_t>(n.value)}) {
    h = (h ^ part) * 0x9E3779B97F4A7C15ull;
    h ^= h >> 29;
  }
  return h;
}

bool Graph::Same::operator()(const Node& x, const Node& y) const {
  return x.op == y.op && x.domain == y.domain && x.a == y.a && x.b == y.b && x.c == y.c && x.slot == y.slot &&
         std::bit_cast<uint64_t>(x.value) == std::bit_cast<uint64_t>(y.value);
}

NodeId Graph::intern(const Node& node) {
  const auto [place, fresh] = ids_.try_emplace(node, static_cast<NodeId>(nodes_.size()));
  if (fresh) {
    if (nodes_.size() > 1'000'000) fail("the rule is too large: more than a million operations");
    nodes_.push_back(node);
  }
  return place->second;
}

NodeId Graph::constant(double value) { return intern({.op = Op::constant, .domain = Domain::scalar, .value = value}); }
NodeId Graph::parameter(int slot) { return intern({.op = Op::parameter, .domain = Domain::scalar, .slot = slot}); }
NodeId Graph::time() { return intern({.op = Op::time, .domain = Domain::scalar}); }

NodeId Graph::column(Kind kind, int slot) {
  switch (kind) {
    case Kind::cell:
      return intern({.op = Op::cell_column, .domain = Domain::cell, .slot = slot});
    case Kind::wall:
      return intern({.op = Op::wall_column, .domain = Domain::side, .slot = slot});
    case Kind::side:
      return intern({.op = Op::side_column, .domain = Domain::side, .slot = slot});
    default:
      fail("internal: rules have no junction columns");
  }
}

bool Graph::is_constant(NodeId id, double value) const {
  return nodes_[id].op == Op::constant && nodes_[id].value == value;
}

NodeId Graph::own(NodeId id) {
  return nodes_[id].domain == Domain::scalar ? id : intern({.op = Op::own, .domain = Domain::side, .a = id});
}

NodeId Graph::across(NodeId id) {
  return nodes_[id].domain == Domain::scalar ? id : intern({.op = Op::across, .domain = Domain::side, .a = id});
}

NodeId Graph::mirrored(NodeId id) {
  const Node n = nodes_[id];
  if (n.domain != Domain::side) fail("internal: only side values can be mirrored");
  if (n.op == Op::own) return across(n.a);
  if (n.op == Op::across) return own(n.a);
  if (n.op == Op::mirrored) return n.a;
  if (n.op == Op::wall_column) return id;
  if (n.op == Op::side_column) return intern({.op = Op::mirrored, .domain = Domain::side, .a = id});
  const auto turn = [&](NodeId x) { return x == no_node || nodes_[x].domain == Domain::scalar ? x : mirrored(x); };
  return elementwise({.op = n.op, .domain = n.domain, .a = turn(n.a), .b = turn(n.b), .c = turn(n.c)});
}

NodeId Graph::promote(NodeId id, Domain domain) {
  return nodes_[id].domain == Domain::cell && domain == Domain::side ? own(id) : id;
}

/// Interns an elementwise node; operands of own (or across) alone give own (across) of the operation on the cell.
NodeId Graph::elementwise(Node node) {
  Domain domain = Domain::scalar;
  for (const NodeId x : {node.a, node.b, node.c})
    if (x != no_node) domain = std::max(domain, nodes_[x].domain);
  node.domain = domain;
  if (domain != Domain::side) return fold(node);
  bool all_own = true, all_across = true;
  for (NodeId* x : {&node.a, &node.b, &node.c}) {
    if (*x == no_node) continue;
    *x = promote(*x, domain);
    if (nodes_[*x].domain == Domain::scalar) continue;
    all_own = all_own && nodes_[*x].op == Op::own;
    all_across = all_across && nodes_[*x].op == Op::across;
  }
  if (!all_own && !all_across) return fold(node);
  for (NodeId* x : {&node.a, &node.b, &node.c})
    if (*x != no_node && nodes_[*x].domain == Domain::side) *x = nodes_[*x].a;
  const NodeId inner = elementwise(node);
  return all_own ? own(inner) : across(inner);
}

/// Constants are computed, neutral operands dropped.
NodeId Graph::fold(const Node& node) {
  const auto fixed = [&](NodeId x) { return x == no_node || nodes_[x].op == Op::constant; };
  if (fixed(node.a) && fixed(node.b) && fixed(node.c)) {
    const auto value = [&](NodeId x) { return x == no_node ? 0.0 : nodes_[x].value; };
    return constant(apply(node.op, value(node.a), value(node.b), value(node.c)));
  }
  switch (node.op) {
    case Op::add:
      if (is_constant(node.a, 0)) return node.b;
      if (is_constant(node.b, 0)) return node.a;
      break;
    case Op::sub:
      if (is_constant(node.b, 0)) return node.a;
      if (is_constant(node.a, 0)) return unary(Op::neg, node.b);
      break;
    case Op::mul:
      if (is_constant(node.a, 1)) return node.b;
      if (is_constant(node.b, 1)) return node.a;
      if (is_constant(node.a, -1)) return unary(Op::neg, node.b);
      if (is_constant(node.b, -1)) return unary(Op::neg, node.a);
      break;
    case Op::div:
      if (is_constant(node.b, 1)) return node.a;
      break;
    case Op::neg:
      if (nodes_[node.a].op == Op::neg) return nodes_[node.a].a;
      break;
    default:
      break;
  }
  return intern(node);
}

NodeId Graph::unary(Op op, NodeId a) { return elementwise({.op = op, .domain = Domain::scalar, .a = a}); }

NodeId Graph::binary(Op op, NodeId a, NodeId b) {
  if (op == Op::pow) return power(a, b);
  return elementwise({.op = op, .domain = Domain::scalar, .a = a, .b = b});
}

NodeId Graph::select(NodeId condition, NodeId yes, NodeId no) {
  return elementwise({.op = Op::select, .domain = Domain::scalar, .a = condition, .b = yes, .c = no});
}

/// Small whole powers by multiplication, square roots, and powers of a fixed base as exp(x log b).
NodeId Graph::power(NodeId base, NodeId exponent) {
  const Node e = nodes_[exponent];
  if (e.op == Op::constant) {
    const double n = e.value;
    if (n == 0.5) return unary(Op::sqrt, base);
    if (n == std::floor(n) && std::fabs(n) <= 16 && n != 0) {
      NodeId result = no_node, square = base;
      for (auto k = static_cast<unsigned>(std::fabs(n)); k != 0; k >>= 1) {
        if (k & 1) result = result == no_node ? square : binary(Op::mul, result, square);
        if (k > 1) square = binary(Op::mul, square, square);
      }
      return n > 0 ? result : binary(Op::div, constant(1), result);
    }
  }
  if (nodes_[base].domain == Domain::scalar && e.domain != Domain::scalar)
    return unary(Op::exp, binary(Op::mul, unary(Op::log, base), exponent));
  return elementwise({.op = Op::pow, .domain = Domain::scalar, .a = base, .b = exponent});
}

NodeId Graph::reduce(Op op, NodeId side_value) {
  return intern({.op = op, .domain = Domain::cell, .a = promote(side_value, Domain::side)});
}

std::string Graph::text(NodeId id) const {
  const Node& n = nodes_[id];
  switch (n.op) {
    case Op::constant:
      return fmt::format("{}", n.value);
    case Op::parameter:
      return fmt::format("P{}", n.slot);
    case Op::time:
      return "t";
    case Op::cell_column:
    case Op::wall_column:
    case Op::side_column:
      return fmt::format("{}{}", name_of(n.op), n.slot);
    default:
      break;
  }
  std::string s = std::string(name_of(n.op)) + "(" + text(n.a);
  if (n.b != no_node) s += ", " + text(n.b);
  if (n.c != no_node) s += ", " + text(n.c);
  return s + ")";
}

}  // namespace tunica
