// SPDX-License-Identifier: MIT
// Rules of a model: traced into equations, or kept as functions to be run directly.
#include "lua/bind_model.h"
#include "lua/guard.h"
#include "rule/reference.h"

namespace tunica::lua {

std::vector<double> parameter_values(lua_State* L, int at, const Equations& equations) {
  check_table(L, at, "the parameters");
  std::vector<double> values;
  for (const std::string& name : equations.parameters) {
    lua_getfield(L, at, name.c_str());
    if (lua_type(L, -1) != LUA_TNUMBER) fail("parameter {} must be a number, it is {}", name, describe(L, -1));
    values.push_back(lua_tonumber(L, -1));
    lua_pop(L, 1);
  }
  return values;
}

namespace {

/// What makes a set of rules impossible, as opposed to a rule that cannot be traced.
class Contradiction : public Placed {
 public:
  using Placed::Placed;
};

bool reads(const Graph& g, NodeId id, Op op, int slot, std::set<NodeId>& seen) {
  if (id == no_node || !seen.insert(id).second) return false;
  const Node& n = g[id];
  if (n.op == op && n.slot == slot) return true;
  return reads(g, n.a, op, slot, seen) || reads(g, n.b, op, slot, seen) || reads(g, n.c, op, slot, seen);
}

int rules(lua_State* L) {
  return guard(L, [&] {
    auto object = std::make_unique<Rules>();
    object->tissue = check_tissue(L, 1);
    object->tracer.tissue = object->tissue;
    push_object(L, std::move(object));
    return 1;
  });
}

int slot_of(Rules& r, Kind kind, const std::string& name, const std::string& where) {
  try {
    if (r.tissue->column(kind, name).geometric) fail("'{}' is kept by the tissue; rules cannot change it", name);
  } catch (const Error& error) {
    throw Contradiction(fmt::format("{}: {}", where, error.what()));
  }
  return r.equations->column_slot(kind, name);
}

void keep_derived(Rules& r, Kind kind, const Assignments& written, const std::string& where, Rules::Traced& traced) {
  Equations& e = *r.equations;
  if (written.empty()) fail("the rule sets nothing; a derive rule sets columns: c.e = ...");
  if (e.derivations.empty() || e.derivations.back().direct >= 0 || e.derivations.back().materialise)
    e.derivations.emplace_back();
  for (const auto& [name, node] : written) {
    NodeId value = node;
    if (kind != Kind::cell && e.graph[node].domain == Domain::cell) value = e.graph.own(node);
    if (!r.tissue->find_column(kind, name)) r.tissue->add_column(kind, {.name = name, .initial = 0});
    const int slot = slot_of(r, kind, name, where);
    const Op leaf = kind == Kind::cell ? Op::cell_column : kind == Kind::wall ? Op::wall_column : Op::side_column;
    std::set<NodeId> seen;
    if (reads(e.graph, value, leaf, slot, seen))
      throw Contradiction(fmt::format("{}: the derived column '{}' refers to itself", where, name));
    // A wall's expression is seen from its first side; read from the other it would be turned round.
    if (kind != Kind::wall) r.tracer.derived[{kind, name}] = value;
    r.derived.insert({kind, name});
    traced.targets.push_back({slot, value, where});
    e.derivations.back().traced.push_back({slot, value, where});
  }
  if (kind == Kind::wall) e.derivations.back().materialise = true;
}

void refuse_derived(const Rules& r, Kind kind, const std::string& name, const std::string& where) {
  if (r.derived.count({kind, name}))
    throw Contradiction(fmt::format("{}: '{}' is derived, so it cannot have a rate as well", where, name));
}

void keep_rates(Rules& r, Kind kind, const Assignments& written, const std::string& where, Rules::Traced& traced) {
  if (written.empty()) fail("the rule sets nothing; a rate rule sets fields of its second argument: d.auxin = ...");
  for (const auto& [name, node] : written) {
    NodeId value = node;
    if (kind != Kind::cell && r.equations->graph[node].domain == Domain::cell) value = r.equations->graph.own(node);
    const int slot = slot_of(r, kind, name, where);
    refuse_derived(r, kind, name, where);
    traced.targets.push_back({slot, value, where});
    r.equations->rates.push_back({slot, value, where});
  }
}

void keep_flux(Rules& r, const std::string& name, NodeId node, const std::string& where, Rules::Traced& traced) {
  Graph& g = r.equations->graph;
  const int slot = slot_of(r, Kind::cell, name, where);
  refuse_derived(r, Kind::cell, name, where);
  NodeId rate = g.unary(Op::neg, g.reduce(Op::flux_sum, node));
  if (r.tissue->has_geometry())
    rate = g.binary(Op::div, rate, g.column(Kind::cell, r.equations->column_slot(Kind::cell, "area")));
  traced.targets.push_back({slot, node, where});
  r.equations->rates.push_back({slot, rate, where});
}

void refuse_fault(const Tracer& tracer) {
  if (!tracer.fault.empty()) throw Contradiction(tracer.fault);
}

/// trace(rules, what, kind, function, where, column) -> true, or false and the reason.
int trace(lua_State* L) {
  return guard(L, [&] {
    Rules& r = object_at<Rules>(L, 1);
    const std::string what = check_string(L, 2, "the sort of rule");
    const Kind kind = check_kind(L, 3);
    check_function(L, 4, "a rule");
    const std::string where = check_string(L, 5, "where");
    Rules::Traced traced{what, kind, {}};
    const int top = lua_gettop(L);
    const size_t rates = r.equations->rates.size();
    const auto derived = r.tracer.derived;
    const auto derivations = r.equations->derivations;
    try {
      lua_pushvalue(L, 4);
      if (what == "derive")
        keep_derived(r, kind, r.tracer.trace_derive(L, kind), where, traced);
      else if (what == "rate")
        keep_rates(r, kind, r.tracer.trace_rate(L, kind), where, traced);
      else
        keep_flux(r, check_string(L, 6, "a column's name"), r.tracer.trace_flux(L).at(0).second, where, traced);
      refuse_fault(r.tracer);
      r.traced.push_back(traced);
      lua_pushboolean(L, 1);
      return 1;
    } catch (const Contradiction&) {
      throw;
    } catch (const ScriptError& error) {
      lua_settop(L, top);
      error.push(L);
      refuse_fault(r.tracer);
    } catch (const Error& error) {
      refuse_fault(r.tracer);
      lua_settop(L, top);
      lua_pushstring(L, error.what());
    }
    r.equations->rates.resize(rates);
    r.equations->derivations = derivations;
    r.tracer.derived = derived;
    lua_pushboolean(L, 0);
    lua_insert(L, -2);
    return 2;
  });
}

/// A reference to a Lua function, held as long as the equations.
struct Held {
  lua_State* L;
  int reference;
  Held(lua_State* state, int at) : L(state) {
    lua_pushvalue(state, at);
    reference = luaL_ref(state, LUA_REGISTRYINDEX);
  }
};

/// From the table on top of the stack: per column, values by identity.
void add_returned_rates(lua_State* L, const std::vector<std::string>& names, const std::vector<double*>& rates,
                        const Tissue& tissue, Kind kind) {
  for (size_t k = 0; k < names.size(); ++k) {
    lua_getfield(L, -1, names[k].c_str());
    if (!lua_istable(L, -1)) fail("internal: no rates of {}", names[k]);
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
      const Index at = tissue.find(kind, static_cast<Id>(lua_tonumber(L, -2)));
      if (at != none) rates[k][at] += lua_tonumber(L, -1);
    }
    lua_pop(L, 1);
  }
}

/// direct(rules, "derive" | "rate", kind, sweep, where, columns): sweep(time) derives in place, or returns a table of
/// lists.
int direct(lua_State* L) {
  return guard(L, [&] {
    Rules& r = object_at<Rules>(L, 1);
    const std::string what = check_string(L, 2, "the sort of rule");
    const Kind kind = check_kind(L, 3);
    check_function(L, 4, "a sweep");
    check_table(L, 6, "the columns");
    DirectRule rule{.where = check_string(L, 5, "where")};
    std::vector<std::string> names;
    for (size_t i = 1; i <= lua_objlen(L, 6); ++i) {
      lua_rawgeti(L, 6, static_cast<int>(i));
      names.push_back(check_string(L, -1, "a column's name"));
      lua_pop(L, 1);
      if (what == "derive" && !r.tissue->find_column(kind, names.back()))
        r.tissue->add_column(kind, {.name = names.back(), .initial = 0});
      rule.columns.push_back(slot_of(r, kind, names.back(), rule.where));
      if (what == "derive") {
        r.tracer.derived.erase({kind, names.back()});
        r.derived.insert({kind, names.back()});
      } else {
        refuse_derived(r, kind, names.back(), rule.where);
      }
    }
    const Held held(L, 4);
    const std::weak_ptr<Tissue> tissue = r.tissue;
    rule.evaluate = [held, names, tissue, kind](double time, const std::vector<double*>& rates) {
      lua_State* at_work = host(held.L).active ? host(held.L).active : held.L;
      lua_rawgeti(at_work, LUA_REGISTRYINDEX, held.reference);
      lua_pushnumber(at_work, time);
      call(at_work, 1, 1);
      if (!rates.empty()) add_returned_rates(at_work, names, rates, *tissue.lock(), kind);
      lua_pop(at_work, 1);
    };
    Equations& e = *r.equations;
    if (what == "derive") {
      if (e.derivations.empty() || e.derivations.back().direct >= 0 || e.derivations.back().materialise)
        e.derivations.emplace_back();
      e.derivations.back().direct = static_cast<int>(e.direct_derivations.size());
      e.direct_derivations.push_back(std::move(rule));
    } else {
      e.direct_rates.push_back(std::move(rule));
    }
    return 0;
  });
}

/// call_rule(f, ...) -> what f returns; meanwhile nothing can be set that belongs to the tissue.
int call_rule(lua_State* L) {
  return guard(L, [&] {
    check_function(L, 1, "a rule");
    const InRule in_rule(L);
    call(L, lua_gettop(L) - 1, LUA_MULTRET);
    return lua_gettop(L);
  });
}

/// in_rule(): whether a rule is being called, with symbols or as it is.
int in_rule(lua_State* L) {
  return guard(L, [&] {
    lua_pushboolean(L, host(L).rules > 0 || active_tracer(L));
    return 1;
  });
}

/// check_settable(element, name). Errors: rules cannot set this of such an element.
int check_settable(lua_State* L) {
  return guard(L, [&] {
    const Element element = check_element(L, 1);
    require_settable(L, element.tissue, element.kind, check_string(L, 2, "a column's name"));
    return 0;
  });
}

/// put(element, column, number): sets what a rule derived; not finite ones are found where all derived columns are.
int put(lua_State* L) {
  return guard(L, [&] {
    const Element element = check_element(L, 1);
    Column& column = element.tissue.column(element.kind, check_string(L, 2, "a column's name"));
    if (column.geometric) fail("'{}' is kept by the tissue; rules cannot change it", column.name);
    if (lua_type(L, 3) != LUA_TNUMBER) fail("expected a number, got {}", describe(L, 3));
    column.values[static_cast<size_t>(element.index)] = lua_tonumber(L, 3);
    return 0;
  });
}

/// reference(rules, parameters, time, rule, element handle) -> column, value, magnitude, ... of each target there.
int reference(lua_State* L) {
  return guard(L, [&] {
    Rules& r = object_at<Rules>(L, 1);
    const std::vector<double> parameters = parameter_values(L, 2, *r.equations);
    const double time = check_number(L, 3, "a time");
    const auto which = static_cast<size_t>(check_integer(L, 4, "a rule", 1, static_cast<int64_t>(r.traced.size())) - 1);
    const Element element = check_element(L, 5);
    const Reference reference(*r.equations, *r.tissue, parameters, time);
    lua_newtable(L);
    for (const Target& target : r.traced[which].targets) {
      Measured m{};
      const bool cell = element.kind == Kind::cell;
      const Index side = element.kind == Kind::wall ? r.tissue->wall_side(element.index, 0) : element.index;
      m = cell ? reference.at_cell(target.value, element.index) : reference.at_side(target.value, side);
      lua_createtable(L, 2, 0);
      lua_pushnumber(L, m.value);
      lua_rawseti(L, -2, 1);
      lua_pushnumber(L, m.magnitude);
      lua_rawseti(L, -2, 2);
      lua_setfield(L, -2, r.equations->columns[target.column].name.c_str());
    }
    return 1;
  });
}

}  // namespace

void register_rules(lua_State* L) {
  const luaL_Reg functions[] = {{"rules", rules},     {"trace", trace},
                                {"direct", direct},   {"call_rule", call_rule},
                                {"in_rule", in_rule}, {"check_settable", check_settable},
                                {"put", put},         {"reference", reference},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
