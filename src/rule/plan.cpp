// SPDX-License-Identifier: MIT
#include "rule/plan.h"

#include <algorithm>
#include <map>
#include <set>

#include "rule/lower.h"

namespace tunica {

namespace {

using Over = Pass::Over;

bool is_cell_sum(Op op) {
  return op == Op::gather || op == Op::edge_sum || op == Op::edge_minimum || op == Op::edge_maximum ||
         op == Op::wall_sum;
}

Code code_of(Op op) { return static_cast<Code>(static_cast<int>(op) - static_cast<int>(Op::neg)); }

/// Gathers that share weight and round, done together: from a row of packed values, or (row -1) from the columns.
struct Group {
  int level;
  NodeId weight;
  std::vector<NodeId> gathers;
  int row = -1;
};

class Planner {
 public:
  Planner(Equations& equations, const std::vector<Output>& outputs, const std::vector<bool>& is_state)
      : lowering_(equations, is_state), graph_(equations.graph), equations_(equations), outputs_(outputs) {}

  Plan run() {
    for (Output& output : outputs_) {
      output.value = lowering_.lower(output.value);
      visit(output.value);
    }
    find_levels();
    find_groups();
    find_kept();
    for (int l = 0; l <= last_; ++l) {
      emit_cells(l);
      emit_sides(l, Over::edges);
      emit_sides(l, Over::walls);
    }
    emit_fixed();
    for (const Output& output : outputs_)
      if (output.column < 0) plan_.values.push_back(kept_value(output.value));
    return std::move(plan_);
  }

 private:
  // === Which nodes there are, in an order that puts operands first
  void visit(NodeId id) {
    if (id == no_node || seen_.count(id)) return;
    seen_.insert(id);
    const Node n = graph_[id];
    for (const NodeId x : {n.a, n.b, n.c}) {
      visit(x);
      if (x != no_node) ++uses_[x];
    }
    reached_.push_back(id);
    if (n.domain == Domain::scalar) {
      scalar_slot_[id] = static_cast<int>(plan_.scalars.size());
      plan_.scalars.push_back(id);
    }
  }

  /// Everything as late as its readers allow, so that little has to be kept from one pass to the next.
  void find_levels() {
    for (const NodeId id : reached_) last_ = std::max(last_, lowering_.level(id));
    for (const NodeId id : reached_) level_[id] = last_;
    for (auto at = reached_.rbegin(); at != reached_.rend(); ++at) {
      const Node& n = graph_[*at];
      const int read = level_[*at] - (is_cell_sum(n.op) ? 1 : 0);
      for (const NodeId x : {n.a, n.b, n.c}) {
        if (x == no_node) continue;
        const bool fixed = graph_[x].domain == Domain::side && lowering_.is_fixed(x);
        level_[x] = std::min(level_[x], fixed ? level_[x] : read);
      }
    }
  }

  int level(NodeId id) const { return level_.at(id); }

  void find_groups() {
    for (const NodeId id : reached_) {
      const Node& n = graph_[id];
      if (n.op != Op::gather) continue;
      auto open = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
        return g.level == level(id) && g.weight == n.b && g.gathers.size() < 4;
      });
      if (open == groups_.end()) open = groups_.insert(groups_.end(), {level(id), n.b, {}});
      open->gathers.push_back(id);
      group_of_[id] = static_cast<int>(open - groups_.begin());
    }
    for (Group& g : groups_) {
      const bool columns =
          std::none_of(g.gathers.begin(), g.gathers.end(), [&](NodeId id) { return computed(graph_[id].a); });
      if (g.gathers.size() == 1 || (g.gathers.size() == 2 && columns)) continue;
      g.row = static_cast<int>(plan_.row_width.size());
      plan_.row_width.push_back(g.gathers.size() > 2 ? 4 : 2);
    }
  }

  Operand kept_value(NodeId id) const {
    const Domain domain = graph_[id].domain;
    if (domain == Domain::side) return {Storage::edge_temp, edge_temp_.at(id)};
    return computed(id) ? Operand{Storage::cell_temp, kept_.at(id)} : leaf(id);
  }

  bool computed(NodeId id) const {  // by a cell pass, as opposed to read from a column or a scalar
    const Node& n = graph_[id];
    return n.domain == Domain::cell && !is_leaf(n.op);
  }

  // === Cell values that later passes read are kept per cell; side values that cell passes read, per half-edge or wall
  void find_kept() {
    const auto keep = [&](NodeId id) {
      if (id != no_node && computed(id) && !kept_.count(id)) kept_[id] = plan_.cell_temps++;
    };
    for (const NodeId id : reached_) {
      const Node n = graph_[id];
      if (n.op == Op::own || n.op == Op::across) {
        // own and across at the root of a gather's weight or a sum are read by side passes
        keep(n.a);
      } else if (n.domain == Domain::cell && !is_cell_sum(n.op)) {
        for (const NodeId x : {n.a, n.b, n.c})
          if (x != no_node && computed(x) && level(x) < level(id)) keep(x);
      }
      if (n.op == Op::gather && (groups_[group_of_[id]].row < 0 || level(n.a) < level(id) - 1)) keep(n.a);
      if (n.op == Op::gather && n.b != no_node) edge_root(n.b);
      if (n.op == Op::edge_sum || n.op == Op::edge_minimum || n.op == Op::edge_maximum) edge_root(n.a);
      if (n.op == Op::wall_sum) {
        if (wall_temp_.try_emplace(n.a, plan_.wall_temps).second) plan_.wall_temps += 2;  // the negatives follow
        plan_.uses_wall_form = true;
      }
    }
    for (const Output& output : outputs_) {
      if (output.column >= 0) {  // written in the last pass, and read in an earlier one
        if (computed(output.value) && level(output.value) < last_) keep(output.value);
        continue;
      }
      graph_[output.value].domain == Domain::side ? edge_root(output.value) : keep(output.value);
    }
  }

  void edge_root(NodeId id) {
    if (!edge_temp_.count(id)) edge_temp_[id] = plan_.edge_temps++;
    if (!lowering_.is_fixed(id)) plan_.uses_edges = true;
  }

  // === Emission
  struct Emitter {
    Pass pass;
    std::map<NodeId, Operand> where;  // values at hand in this pass
    int next = 0;                     // virtual registers
    bool fixed = false;               // computes what is computed once
    Operand fresh() { return {Storage::reg, next++}; }
  };

  Operand leaf(NodeId id) const {
    const Node& n = graph_[id];
    if (n.domain == Domain::scalar) return {Storage::scalar, scalar_slot_.at(id)};
    if (n.op == Op::cell_column) return {Storage::column, n.slot};
    fail("internal: {} is no leaf of a cell pass", name_of(n.op));
  }

  Operand cell_value(Emitter& e, NodeId id, int now) {
    if (id == no_node) return {};
    if (!computed(id)) return leaf(id);
    if (const auto known = e.where.find(id); known != e.where.end()) return known->second;
    if (level(id) < now) return {Storage::cell_temp, kept_.at(id)};
    const Operand result = compute(e, id, now);
    e.where[id] = result;
    if (kept_.count(id))
      e.pass.code.push_back({.code = Code::copy, .dst = {Storage::cell_temp, kept_[id]}, .a = result});
    return result;
  }

  Operand compute(Emitter& e, NodeId id, int now) {
    const Node n = graph_[id];
    if (n.op == Op::gather) {
      gather(e, group_of_.at(id));
      return e.where.at(id);
    }
    Instruction i{.code = code_of(n.op)};
    if (is_cell_sum(n.op)) {
      i.code = n.op == Op::edge_sum       ? Code::edge_sum
               : n.op == Op::edge_minimum ? Code::edge_minimum
               : n.op == Op::edge_maximum ? Code::edge_maximum
                                          : Code::wall_sum;
      i.a = n.op == Op::wall_sum ? Operand{Storage::wall_temp, wall_temp_.at(n.a)}
                                 : Operand{Storage::edge_temp, edge_temp_.at(n.a)};
    } else if (!fuse(e, n, level(id), i, [&](NodeId x) { return cell_value(e, x, now); })) {
      i.a = cell_value(e, n.a, now);
      i.b = cell_value(e, n.b, now);
      i.c = cell_value(e, n.c, now);
    }
    i.dst = e.fresh();
    e.pass.code.push_back(i);
    return i.dst;
  }

  /// a*b+c, max(a-b, c) and their like in one sweep, when the inner value is needed nowhere else.
  template <class Value>
  bool fuse(const Emitter& e, const Node& n, int at_level, Instruction& i, Value value) {
    const auto needed_here_only = [&](NodeId x, Op op) {
      return x != no_node && graph_[x].op == op && graph_[x].domain != Domain::scalar && uses_.at(x) == 1 &&
             !e.where.count(x) && !kept_.count(x) && !edge_temp_.count(x) && !wall_temp_.count(x) &&
             level(x) == at_level;
    };
    const auto product = [&](NodeId x) { return needed_here_only(x, Op::mul); };
    NodeId inner, other;
    if (n.op == Op::add && product(n.a)) {
      i.code = Code::multiply_add, inner = n.a, other = n.b;
    } else if (n.op == Op::add && product(n.b)) {
      i.code = Code::multiply_add, inner = n.b, other = n.a;
    } else if (n.op == Op::sub && product(n.a)) {
      i.code = Code::multiply_subtract, inner = n.a, other = n.b;
    } else if (n.op == Op::sub && product(n.b)) {
      i.code = Code::subtract_multiply, inner = n.b, other = n.a;
    } else if (n.op == Op::max && needed_here_only(n.a, Op::sub)) {
      i.code = Code::subtract_max, inner = n.a, other = n.b;
    } else {
      return false;
    }
    i.a = value(graph_[inner].a);
    i.b = value(graph_[inner].b);
    i.c = value(other);
    return true;
  }

  void gather(Emitter& e, int index) {
    const Group& g = groups_[index];
    Instruction i{.code = Code::gather, .row = g.row};
    i.weight = g.weight == no_node ? -1 : edge_temp_.at(g.weight);
    for (const NodeId id : g.gathers) {
      const NodeId value = graph_[id].a;
      if (g.row < 0) i.sources.push_back(computed(value) ? Operand{Storage::cell_temp, kept_.at(value)} : leaf(value));
      const Operand dst = e.fresh();
      i.values.push_back(dst);
      i.difference.push_back(graph_[id].value != 0);
      e.where[id] = dst;
    }
    e.pass.code.push_back(i);
    for (const NodeId id : g.gathers)
      if (kept_.count(id))
        e.pass.code.push_back({.code = Code::copy, .dst = {Storage::cell_temp, kept_[id]}, .a = e.where[id]});
  }

  void emit_cells(int now) {
    Emitter e;
    e.pass.over = Over::cells;
    for (const auto& [id, temp] : kept_)
      if (level(id) == now) cell_value(e, id, now);
    for (const Output& o : outputs_) {
      if (o.column < 0 || equations_.columns[o.column].kind != Kind::cell || now != last_) continue;
      const Operand a = cell_value(e, o.value, now);
      if (o.is_rate)
        emit_rate(e, o, a);
      else
        e.pass.code.push_back({.code = Code::copy, .dst = {Storage::column, o.column}, .a = a});
    }
    for (const Group& g : groups_) {
      if (g.row < 0 || g.level - 1 != now) continue;
      Instruction pack{.code = Code::pack, .row = g.row};
      for (const NodeId id : g.gathers) pack.values.push_back(cell_value(e, graph_[id].a, now));
      e.pass.code.push_back(pack);
    }
    finish(e);
  }

  /// The last product and sum of a rate are computed while the state is advanced, where nothing else needs them.
  void emit_rate(Emitter& e, const Output& o, Operand a) {
    std::vector<Instruction>& code = e.pass.code;
    const bool last = !code.empty() && code.back().code == Code::multiply_add &&
                      code.back().dst.place == Storage::reg && code.back().dst.index == a.index &&
                      a.place == Storage::reg && uses_[o.value] == 0;
    if (!last) return code.push_back({.code = Code::rate, .a = a, .column = o.column});
    Instruction i = code.back();
    code.pop_back();
    e.where.erase(o.value);
    code.push_back({.code = Code::rate, .a = i.a, .b = i.b, .c = i.c, .column = o.column, .fused = true});
  }

  Operand side_value(Emitter& e, NodeId id) {
    if (id == no_node) return {};
    const Node n = graph_[id];
    if (n.domain == Domain::scalar) return {Storage::scalar, scalar_slot_.at(id)};
    if (const auto known = e.where.find(id); known != e.where.end()) return known->second;
    if (!e.fixed && lowering_.is_fixed(id)) return fixed_value(id, e.pass.over);
    Instruction i{.code = code_of(n.op)};
    if (n.op == Op::own || n.op == Op::across) {
      i.code = n.op == Op::own ? Code::fetch_own : Code::fetch_across;
      i.a = computed(n.a) ? Operand{Storage::cell_temp, kept_.at(n.a)} : leaf(n.a);
    } else if (n.op == Op::wall_column || n.op == Op::side_column) {
      i.code = n.op == Op::wall_column ? Code::fetch_wall : Code::fetch_side;
      i.column = n.slot;
    } else if (n.op == Op::mirrored) {
      i.code = Code::fetch_mirrored;
      i.column = graph_[n.a].slot;
    } else if (!fuse(e, n, level(id), i, [&](NodeId x) { return side_value(e, x); })) {
      i.a = side_value(e, n.a);
      i.b = side_value(e, n.b);
      i.c = side_value(e, n.c);
    }
    i.dst = e.fresh();
    e.pass.code.push_back(i);
    e.where[id] = i.dst;
    return i.dst;
  }

  /// What does not change while the structure stands is computed once, per half-edge or wall.
  Operand fixed_value(NodeId id, Over over) {
    if (over == Over::edges) {
      edge_temp_.try_emplace(id, plan_.edge_temps).second ? ++plan_.edge_temps : 0;
      return {Storage::edge_temp, edge_temp_[id]};
    }
    fixed_wall_temp_.try_emplace(id, plan_.wall_temps).second ? ++plan_.wall_temps : 0;
    return {Storage::wall_temp, fixed_wall_temp_[id]};
  }

  void emit_sides(int now, Over over) {
    Emitter e;
    e.pass.over = over;
    const auto temps = over == Over::edges ? edge_temp_ : wall_temp_;  // fixed values may join meanwhile
    for (const auto& [id, temp] : temps) {
      if (level(id) != now || (over == Over::edges && lowering_.is_fixed(id))) continue;
      const Operand a = side_value(e, id);
      const Storage place = over == Over::edges ? Storage::edge_temp : Storage::wall_temp;
      e.pass.code.push_back({.code = Code::copy, .dst = {place, temp}, .a = a});
      if (over == Over::walls) e.pass.code.push_back({.code = Code::neg, .dst = {place, temp + 1}, .a = a});
    }
    const Kind kind = over == Over::edges ? Kind::side : Kind::wall;
    for (const Output& o : outputs_) {
      if (o.column < 0 || equations_.columns[o.column].kind != kind || now != last_) continue;
      const Operand a = side_value(e, o.value);
      e.pass.code.push_back({.code = Code::scatter, .a = a, .column = o.column, .is_rate = o.is_rate});
    }
    finish(e);
  }

  void emit_fixed() {
    std::vector<Pass> passes = std::move(plan_.passes);
    plan_.passes.clear();
    for (const Over over : {Over::edges, Over::walls}) {
      Emitter e;
      e.pass.over = over;
      e.fixed = true;
      for (const auto& [id, temp] : over == Over::edges ? edge_temp_ : fixed_wall_temp_) {
        if (!lowering_.is_fixed(id)) continue;
        const Operand a = side_value(e, id);
        e.pass.code.push_back(
            {.code = Code::copy, .dst = {over == Over::edges ? Storage::edge_temp : Storage::wall_temp, temp}, .a = a});
      }
      finish(e);
    }
    plan_.once = std::move(plan_.passes);
    plan_.passes = std::move(passes);
  }

  /// What an instruction computes only to be copied to a temp goes there at once; later readers find it there.
  static void drop_copies(std::vector<Instruction>& code) {
    for (size_t k = 1; k < code.size(); ++k) {
      const Instruction copy = code[k];
      const Instruction& before = code[k - 1];
      const bool to_temp = copy.dst.place == Storage::cell_temp || copy.dst.place == Storage::edge_temp ||
                           copy.dst.place == Storage::wall_temp;
      if (copy.code != Code::copy || !to_temp || copy.a.place != Storage::reg) continue;
      if (before.code >= Code::elementwise_count || before.dst.place != Storage::reg ||
          before.dst.index != copy.a.index)
        continue;
      code[k - 1].dst = copy.dst;
      code.erase(code.begin() + static_cast<long>(k--));
      for (size_t later = k + 1; later < code.size(); ++later)
        each_operand(code[later], [&](Operand& o) {
          if (o.place == Storage::reg && o.index == copy.a.index) o = copy.dst;
        });
    }
  }

  template <class Visit>
  static void each_operand(Instruction& i, Visit visit) {
    for (Operand* o : {&i.a, &i.b, &i.c, &i.dst}) visit(*o);
    for (Operand& o : i.values) visit(o);
  }

  // === Registers: reuse a buffer after its last reader
  void finish(Emitter& e) {
    if (e.pass.code.empty()) return;
    drop_copies(e.pass.code);
    std::map<int, size_t> last;
    for (size_t k = 0; k < e.pass.code.size(); ++k)
      each_operand(e.pass.code[k], [&](Operand& o) {
        if (o.place == Storage::reg) last[o.index] = k;
      });
    std::set<int> free;
    std::map<int, int> physical;
    for (size_t k = 0; k < e.pass.code.size(); ++k) {
      std::vector<int> ended;
      each_operand(e.pass.code[k], [&](Operand& o) {
        if (o.place != Storage::reg) return;
        const int virtual_register = o.index;
        auto [at, fresh] = physical.try_emplace(virtual_register, -1);
        if (fresh) {
          if (free.empty()) free.insert(e.pass.registers++);
          at->second = *free.begin();
          free.erase(free.begin());
        }
        o.index = at->second;
        if (last[virtual_register] == k) ended.push_back(at->second);
      });
      free.insert(ended.begin(), ended.end());
    }
    plan_.passes.push_back(std::move(e.pass));
  }

  Lowering lowering_;
  Graph& graph_;
  Equations& equations_;
  std::vector<Output> outputs_;
  Plan plan_;
  std::set<NodeId> seen_;
  std::vector<NodeId> reached_;
  int last_ = 0;
  std::map<NodeId, int> level_, uses_, scalar_slot_, kept_, edge_temp_, wall_temp_, fixed_wall_temp_, group_of_;
  std::vector<Group> groups_;
};

}  // namespace

Plan lower(Equations& equations, const std::vector<Output>& outputs, const std::vector<bool>& is_state) {
  return Planner(equations, outputs, is_state).run();
}

}  // namespace tunica
