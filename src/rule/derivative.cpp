// SPDX-License-Identifier: MIT
#include "rule/derivative.h"

#include <algorithm>
#include <set>
#include <utility>

namespace tunica {

namespace {

using Partials = std::map<std::pair<int, Site>, NodeId>;

NodeId choose(Graph& g, NodeId condition, double yes, double no) {
  return g.select(condition, g.constant(yes), g.constant(no));
}

/// d(node) / d(first operand)
NodeId by_first(Graph& g, NodeId id, const Node& n) {
  const NodeId one = g.constant(1);
  switch (n.op) {
    case Op::neg:
      return g.constant(-1);
    case Op::exp:
      return id;
    case Op::log:
      return g.binary(Op::div, one, n.a);
    case Op::sqrt:
      return g.binary(Op::div, g.constant(0.5), id);
    case Op::sin:
      return g.unary(Op::cos, n.a);
    case Op::cos:
      return g.unary(Op::neg, g.unary(Op::sin, n.a));
    case Op::tanh: {  // 4 e / (1 + e)^2 with e = exp(-2 |x|): 1 - tanh(x)^2 loses its digits for large |x|
      const NodeId e = g.unary(Op::exp, g.binary(Op::mul, g.constant(-2), g.unary(Op::abs, n.a)));
      const NodeId sum = g.binary(Op::add, one, e);
      return g.binary(Op::div, g.binary(Op::mul, g.constant(4), e), g.binary(Op::mul, sum, sum));
    }
    case Op::abs:
      return choose(g, g.binary(Op::less, n.a, g.constant(0)), -1, 1);
    case Op::add:
    case Op::sub:
      return one;
    case Op::mul:
      return n.b;
    case Op::div:
      return g.binary(Op::div, one, n.b);
    case Op::pow:  // b a^(b - 1)
      return g.binary(Op::mul, n.b, g.binary(Op::pow, n.a, g.binary(Op::sub, n.b, one)));
    case Op::min:
      return choose(g, g.binary(Op::less, n.a, n.b), 1, 0);
    case Op::max:
      return choose(g, g.binary(Op::less, n.b, n.a), 1, 0);
    default:  // comparisons, and what select decides by
      return g.constant(0);
  }
}

/// d(node) / d(second operand)
NodeId by_second(Graph& g, NodeId id, const Node& n) {
  switch (n.op) {
    case Op::add:
      return g.constant(1);
    case Op::sub:
      return g.constant(-1);
    case Op::mul:
      return n.a;
    case Op::div:  // -(a / b) / b
      return g.unary(Op::neg, g.binary(Op::div, id, n.b));
    case Op::pow:
      return g.binary(Op::mul, id, g.unary(Op::log, n.a));
    case Op::min:
      return choose(g, g.binary(Op::less, n.a, n.b), 0, 1);
    case Op::max:
      return choose(g, g.binary(Op::less, n.b, n.a), 0, 1);
    case Op::select:
      return choose(g, n.a, 1, 0);
    default:
      return g.constant(0);
  }
}

/// d(select) / d(third operand)
NodeId by_third(Graph& g, const Node& n) { return choose(g, n.a, 0, 1); }

/// Forward differentiation of a graph, node by node; the rules are those of apply() in graph.h.
class Differentiator {
 public:
  Differentiator(Equations& equations, const std::vector<int>& state) : e_(equations), g_(equations.graph) {
    for (const int slot : state) {
      variable_of_column_[slot] = static_cast<int>(result_.variables.size());
      result_.variables.push_back({.kind = e_.columns[slot].kind, .column = slot, .value = no_node, .partials = {}});
    }
    result_.states = static_cast<int>(state.size());
    for (const Equations::Derivation& d : e_.derivations)
      if (d.materialise)
        for (const Target& target : d.traced) materialised_[target.column] = target.value;
  }

  Derivative run() {
    for (int k = 0; k < result_.states; ++k) {
      Partials sum;
      for (const Target& rate : e_.rates) {
        if (rate.column != result_.variables[k].column) continue;
        add(sum, of(rate.value));
        note_kinks(rate.value, rate.where);
      }
      result_.variables[k].partials = listed(sum);
    }
    find_linear();
    for (const DirectRule& rule : e_.direct_rates) result_.missing.push_back(rule.where);
    for (const DirectRule& rule : e_.direct_derivations) result_.missing.push_back(rule.where);
    return std::move(result_);
  }

 private:
  // === Sums of partials
  /// to += factor * from. Where the partial is a side's, a cell's factor is seen from its sides.
  void add(Partials& to, const Partials& from, NodeId factor = no_node) {
    for (const auto& [key, value] : from) {
      NodeId term = factor == no_node ? value : times(factor, value);
      if (key.second != Site::own && g_[term].domain == Domain::cell) term = g_.own(term);
      const auto at = to.find(key);
      if (at != to.end()) term = g_.binary(Op::add, at->second, term);
      if (g_.is_constant(term, 0))
        to.erase(key);
      else
        to[key] = term;
    }
  }

  NodeId times(NodeId factor, NodeId value) {
    if (g_.is_constant(factor, 0) || g_.is_constant(value, 0)) return g_.constant(0);
    return g_.binary(Op::mul, factor, value);
  }

  static std::vector<Partial> listed(const Partials& partials) {
    std::vector<Partial> list;
    for (const auto& [key, value] : partials) list.push_back({key.first, key.second, value});
    return list;
  }

  // === Nodes
  const Partials& of(NodeId id) {
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    Partials result = compute(id);
    return known_[id] = std::move(result);
  }

  Partials compute(NodeId id) {
    const Node n = g_[id];
    switch (n.op) {
      case Op::constant:
      case Op::parameter:
      case Op::time:
        return {};
      case Op::cell_column:
        return of_column(n.slot, Site::own);
      case Op::side_column:
        return of_column(n.slot, Site::here);
      case Op::wall_column:
        return of_column(n.slot, Site::wall);
      case Op::mirrored: {
        const Node& side = g_[n.a];
        return of_column(side.slot, Site::there);
      }
      case Op::own:
      case Op::across:
        return seen(n);
      case Op::sum:
      case Op::flux_sum:
        return summed(of(n.a), no_node);
      case Op::minimum:
      case Op::maximum:
        return summed(of(n.a), chosen_sides(n.a, id));
      default:
        return elementwise(id, n);
    }
  }

  Partials of_column(int slot, Site site) {
    if (const auto at = variable_of_column_.find(slot); at != variable_of_column_.end())
      return {{{at->second, site}, g_.constant(1)}};
    if (const auto at = materialised_.find(slot); at != materialised_.end())
      return {{{intermediate(e_.columns[slot].kind, slot, at->second), site}, g_.constant(1)}};
    return {};
  }

  /// A cell's value seen from a side: an intermediate if it depends on the cell's neighbours.
  Partials seen(const Node& n) {
    const Site site = n.op == Op::own ? Site::own : Site::across;
    const Partials inner = of(n.a);
    const bool local =
        std::all_of(inner.begin(), inner.end(), [](const auto& p) { return p.first.second == Site::own; });
    if (!local) return {{{intermediate(Kind::cell, -1, n.a), site}, g_.constant(1)}};
    Partials result;
    for (const auto& [key, value] : inner)
      result[{key.first, site}] = site == Site::own ? g_.own(value) : g_.across(value);
    return result;
  }

  int intermediate(Kind kind, int column, NodeId value) {
    const auto [at, fresh] = intermediate_.try_emplace(value, static_cast<int>(result_.variables.size()));
    if (!fresh) return at->second;
    const int variable = at->second;
    result_.variables.push_back({.kind = kind, .column = column, .value = value, .partials = {}});
    const std::vector<Partial> partials = listed(of(value));
    result_.variables[variable].partials = partials;
    result_.order.push_back(variable);  // after those found while differentiating it
    return variable;
  }

  /// Over the sides of a cell: what stands at the cell itself adds up; `mask` chooses among the sides.
  Partials summed(const Partials& body, NodeId mask) {
    Partials result;
    for (const auto& [key, value] : body) {
      const NodeId chosen = mask == no_node ? value : g_.binary(Op::mul, mask, value);
      result[key] = key.second == Site::own ? g_.reduce(Op::sum, chosen) : chosen;
    }
    return result;
  }

  /// Per side: its share in being the extreme value; sides that are equal share it.
  NodeId chosen_sides(NodeId body, NodeId extreme) {
    const NodeId mask = g_.binary(Op::equal, body, g_.own(extreme));
    return g_.binary(Op::div, mask, g_.own(g_.reduce(Op::sum, mask)));
  }

  Partials elementwise(NodeId id, const Node& n) {
    Partials result;
    const auto part = [&](NodeId x, auto&& factor) {
      if (x == no_node) return;
      const Partials inner = of(x);
      if (!inner.empty()) add(result, inner, factor());
    };
    part(n.a, [&] { return by_first(g_, id, n); });
    part(n.b, [&] { return by_second(g_, id, n); });
    part(n.c, [&] { return by_third(g_, n); });
    return result;
  }

  // === Linear rates
  void find_linear() {
    result_.linear = result_.kinks.empty();  // a comparison jumps, though its partials are 0
    for (const Derivative::Variable& variable : result_.variables)
      for (const Partial& partial : variable.partials) result_.linear = result_.linear && !changes(partial.value);
    if (!result_.linear || result_.states != 1 || result_.variables[0].kind != Kind::cell) return;
    result_.uniform = g_.constant(0);
    for (const Target& rate : e_.rates) result_.uniform = g_.binary(Op::add, result_.uniform, raised(rate.value));
  }

  /// d(node) when the state column is raised by 1 everywhere.
  NodeId raised(NodeId id) {
    if (id == no_node || !changes(id)) return g_.constant(0);
    const Node n = g_[id];
    switch (n.op) {
      case Op::cell_column:
        return g_.constant(1);
      case Op::own:
        return g_.own(raised(n.a));
      case Op::across:
        return g_.across(raised(n.a));
      case Op::sum:
      case Op::flux_sum: {
        const NodeId body = raised(n.a);
        return g_.is_constant(body, 0) ? body : g_.reduce(Op::sum, body);
      }
      default:
        break;
    }
    NodeId total = g_.constant(0);
    const auto part = [&](NodeId x, NodeId factor) {
      if (x == no_node || !changes(x)) return;
      const NodeId inner = raised(x);
      if (g_.is_constant(inner, 0) || g_.is_constant(factor, 0)) return;
      total = g_.binary(Op::add, total, g_.binary(Op::mul, factor, inner));
    };
    part(n.a, by_first(g_, id, n));
    if (n.b != no_node) part(n.b, by_second(g_, id, n));
    if (n.c != no_node) part(n.c, by_third(g_, n));
    return total;
  }

  // === Where rules bend
  bool changes(NodeId id) {
    if (id == no_node) return false;
    if (const auto known = changes_.find(id); known != changes_.end()) return known->second;
    const Node n = g_[id];
    const bool column = n.op == Op::cell_column || n.op == Op::wall_column || n.op == Op::side_column;
    const bool result = column ? !of_column(n.slot, Site::own).empty() : changes(n.a) || changes(n.b) || changes(n.c);
    return changes_[id] = result;
  }

  void note_kinks(NodeId id, const std::string& where) {
    if (id == no_node || !looked_at_.insert({id, where}).second) return;
    const Node n = g_[id];
    const bool bends =
        n.op == Op::abs || (n.op >= Op::min && n.op <= Op::select) || n.op == Op::minimum || n.op == Op::maximum;
    if (bends && changes(id)) {
      const std::string text = std::string(name_of(n.op)) + " in " + where;
      if (std::find(result_.kinks.begin(), result_.kinks.end(), text) == result_.kinks.end())
        result_.kinks.push_back(text);
    }
    for (const NodeId x : {n.a, n.b, n.c}) note_kinks(x, where);
  }

  Equations& e_;
  Graph& g_;
  Derivative result_;
  std::map<int, int> variable_of_column_;
  std::map<int, NodeId> materialised_;
  std::map<NodeId, int> intermediate_;
  std::map<NodeId, Partials> known_;
  std::map<NodeId, bool> changes_;
  std::set<std::pair<NodeId, std::string>> looked_at_;
};

}  // namespace

Derivative differentiate(Equations& equations, const std::vector<int>& state) {
  return Differentiator(equations, state).run();
}

}  // namespace tunica
