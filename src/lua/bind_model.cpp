// SPDX-License-Identifier: MIT
// The functions behind lua/tunica/model.lua: rules are traced into equations, equations bound to a tissue, and stepped.
#include <time.h>

#include <cmath>
#include <optional>
#include <set>

#include "lua/bind_tissue.h"
#include "lua/symbol.h"
#include "rule/reference.h"
#include "solve/integrator.h"

namespace tunica::lua {

namespace {

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_seconds() {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Rules of a model, traced or to be run directly, before they are bound.
struct Rules {
  std::shared_ptr<Tissue> tissue;
  std::shared_ptr<Equations> equations = std::make_shared<Equations>();
  Tracer tracer{equations, tissue};
  struct Traced {
    std::string what;  ///< "derive", "rate" or "flux"
    Kind kind;
    std::vector<Target> targets;
  };
  std::vector<Traced> traced;
  std::set<std::pair<Kind, std::string>> derived;  ///< columns that some rule derives
};

/// Equations bound to a tissue and a method.
struct Machine {
  std::shared_ptr<System> system;
  std::unique_ptr<Integrator> integrator;
  std::optional<Failure> failure;
  double seconds = 0;    ///< of computing, this process
  double cell_steps = 0;
};

template <class T>
struct TypeName;
template <>
struct TypeName<Rules> {
  static constexpr const char* value = "tunica.rules";
};
template <>
struct TypeName<Machine> {
  static constexpr const char* value = "tunica.machine";
};

template <class T>
T& object_at(lua_State* L, int at) {
  if (lua_type(L, at) == LUA_TUSERDATA && lua_getmetatable(L, at)) {
    luaL_getmetatable(L, TypeName<T>::value);
    const bool same = lua_rawequal(L, -1, -2);
    lua_pop(L, 2);
    if (same) return **static_cast<T**>(lua_touserdata(L, at));
  }
  fail("expected {}, got {}", TypeName<T>::value, describe(L, at));
}

template <class T>
int collect(lua_State* L) {
  T** slot = static_cast<T**>(lua_touserdata(L, 1));
  delete *slot;
  *slot = nullptr;
  return 0;
}

template <class T>
void push_object(lua_State* L, std::unique_ptr<T> object) {
  T** slot = static_cast<T**>(lua_newuserdata(L, sizeof(T*)));
  *slot = object.release();
  if (luaL_newmetatable(L, TypeName<T>::value)) {
    lua_pushcfunction(L, collect<T>);
    lua_setfield(L, -2, "__gc");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
  }
  lua_setmetatable(L, -2);
}

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

// === Rules

/// What makes a set of rules impossible, as opposed to a rule that cannot be traced.
class Contradiction : public Error {
 public:
  using Error::Error;
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

int slot_of(Rules& r, Kind kind, const std::string& name) {
  const Column& column = r.tissue->column(kind, name);
  if (column.geometric) fail("'{}' is kept by the tissue; rules cannot change it", name);
  return r.equations->column_slot(kind, name);
}

void keep_derived(Rules& r, Kind kind, const Assignments& written, const std::string& where, Rules::Traced& traced) {
  Equations& e = *r.equations;
  if (written.empty()) fail("the rule sets nothing; a derive rule sets columns: c.e = ...");
  if (e.derivations.empty() || e.derivations.back().direct >= 0 || e.derivations.back().materialise) e.derivations.emplace_back();
  for (const auto& [name, node] : written) {
    NodeId value = node;
    if (kind != Kind::cell && e.graph[node].domain == Domain::cell) value = e.graph.own(node);
    if (!r.tissue->find_column(kind, name)) r.tissue->add_column(kind, {.name = name, .initial = 0});
    const int slot = slot_of(r, kind, name);
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
  if (r.derived.count({kind, name})) throw Contradiction(fmt::format("{}: '{}' is derived, so it cannot have a rate as well", where, name));
}

void keep_rates(Rules& r, Kind kind, const Assignments& written, const std::string& where, Rules::Traced& traced) {
  if (written.empty()) fail("the rule sets nothing; a rate rule sets fields of its second argument: d.auxin = ...");
  for (const auto& [name, node] : written) {
    NodeId value = node;
    if (kind != Kind::cell && r.equations->graph[node].domain == Domain::cell) value = r.equations->graph.own(node);
    const int slot = slot_of(r, kind, name);
    refuse_derived(r, kind, name, where);
    traced.targets.push_back({slot, value, where});
    r.equations->rates.push_back({slot, value, where});
  }
}

void keep_flux(Rules& r, const std::string& name, NodeId node, const std::string& where, Rules::Traced& traced) {
  Graph& g = r.equations->graph;
  const int slot = slot_of(r, Kind::cell, name);
  refuse_derived(r, Kind::cell, name, where);
  NodeId rate = g.unary(Op::neg, g.reduce(Op::flux_sum, node));
  if (r.tissue->has_geometry()) rate = g.binary(Op::div, rate, g.column(Kind::cell, r.equations->column_slot(Kind::cell, "area")));
  traced.targets.push_back({slot, node, where});
  r.equations->rates.push_back({slot, rate, where});
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
      r.traced.push_back(traced);
      lua_pushboolean(L, 1);
      return 1;
    } catch (const Contradiction&) {
      throw;
    } catch (const ScriptError& error) {
      lua_settop(L, top);
      error.push(L);
    } catch (const Error& error) {
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
void add_returned_rates(lua_State* L, const std::vector<std::string>& names, const std::vector<double*>& rates, const Tissue& tissue, Kind kind) {
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

/// direct(rules, "derive" | "rate", kind, sweep, where, columns): sweep(time) derives in place, or returns a table of lists.
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
      if (what == "derive" && !r.tissue->find_column(kind, names.back())) r.tissue->add_column(kind, {.name = names.back(), .initial = 0});
      rule.columns.push_back(slot_of(r, kind, names.back()));
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
      if (e.derivations.empty() || e.derivations.back().direct >= 0 || e.derivations.back().materialise) e.derivations.emplace_back();
      e.derivations.back().direct = static_cast<int>(e.direct_derivations.size());
      e.direct_derivations.push_back(std::move(rule));
    } else {
      e.direct_rates.push_back(std::move(rule));
    }
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

// === Machine

/// machine(rules, method, dt, threads, signed columns)
int machine(lua_State* L) {
  return guard(L, [&] {
    Rules& r = object_at<Rules>(L, 1);
    auto m = std::make_unique<Machine>();
    SystemOptions options;
    options.cancel = &host(L).cancel;
    auto stepper = make_stepper(check_string(L, 2, "a method"));
    const double dt = check_number(L, 3, "dt");
    options.threads = static_cast<int>(check_integer(L, 4, "threads", 1, 256));
    m->system = std::make_shared<System>(r.equations, r.tissue, options);
    m->integrator = std::make_unique<Integrator>(m->system, std::move(stepper), dt);
    std::vector<std::string> names;
    for (size_t i = 1; i <= lua_objlen(L, 5); ++i) {
      lua_rawgeti(L, 5, static_cast<int>(i));
      names.push_back(check_string(L, -1, "a column's name"));
      lua_pop(L, 1);
    }
    m->integrator->allow_negative(std::move(names));
    push_object(L, std::move(m));
    return 1;
  });
}

/// advance(machine, parameters, to, pause | nil, seconds | nil) -> "done" | "paused" | "out of time" | "interrupted"
int advance(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const Entering entering(L);
    const std::vector<double> parameters = parameter_values(L, 2, m.system->equations());
    const double to = check_number(L, 3, "a time");
    std::optional<double> pause;
    if (!lua_isnoneornil(L, 4)) pause = check_number(L, 4, "a time");
    std::function<bool()> out_of_time;
    if (!lua_isnoneornil(L, 5)) {
      const double end = wall_seconds() + check_number(L, 5, "seconds");
      out_of_time = [end] { return wall_seconds() >= end; };
    }
    const uint64_t steps = m.integrator->steps();
    const double begun = thread_seconds();
    const auto account = [&] {
      m.seconds += thread_seconds() - begun;
      m.cell_steps += static_cast<double>(m.integrator->steps() - steps) * m.system->tissue().cells();
    };
    m.failure.reset();
    Integrator::Status status;
    try {
      status = m.integrator->advance(to, pause, out_of_time, &host(L).cancel, parameters);
    } catch (const StepFailed& failed) {
      account();
      m.failure = failed.failure;
      throw;
    }
    account();
    static constexpr const char* names[] = {"done", "paused", "out of time", "interrupted"};
    lua_pushstring(L, names[static_cast<int>(status)]);
    return 1;
  });
}

/// failure(machine) -> nil or { kind, time, column, element, id, value, message }
int failure(lua_State* L) {
  return guard(L, [&] {
    const Machine& m = object_at<Machine>(L, 1);
    if (!m.failure) return 0;
    const Failure& f = *m.failure;
    lua_createtable(L, 0, 7);
    const auto text = [&](const char* key, const std::string& value) {
      lua_pushlstring(L, value.data(), value.size());
      lua_setfield(L, -2, key);
    };
    const auto number = [&](const char* key, double value) {
      lua_pushnumber(L, value);
      lua_setfield(L, -2, key);
    };
    text("kind", f.kind);
    text("column", f.column);
    text("element", name_of(f.element));
    text("message", f.message);
    number("time", f.time);
    number("id", f.id);
    number("value", f.value);
    return 1;
  });
}

/// derive(machine, parameters): writes the derived columns for the state the tissue holds.
int derive(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const Entering entering(L);
    m.system->prepare(parameter_values(L, 2, m.system->equations()));
    AlignedBuffer y;
    y.resize(m.system->state_size());
    m.system->read_state(y.data());
    const Locked locked(m.system->tissue());
    m.system->derive(m.integrator->time(), y.data());
    return 0;
  });
}

/// check_lowering(rules, machine, parameters, cell indices count): compares the passes with the graphs they came from on
/// some cells. Errors: they differ, which is a fault of the program.
int check_lowering(lua_State* L) {
  return guard(L, [&] {
    Rules& r = object_at<Rules>(L, 1);
    Machine& m = object_at<Machine>(L, 2);
    const Entering entering(L);
    System& s = *m.system;
    const Equations& e = s.equations();
    if (!e.direct_rates.empty() || !e.direct_derivations.empty() || s.tissue().cells() == 0) return 0;
    const std::vector<double> parameters = parameter_values(L, 3, e);
    s.prepare(parameters);
    AlignedBuffer y, rates;
    y.resize(s.state_size());
    rates.resize(s.state_size());
    s.read_state(y.data());
    s.rates(m.integrator->time(), y.data(), rates.data());
    const Reference reference(e, *r.tissue, parameters, m.integrator->time());
    const Index cells = s.tissue().cells(), stride = std::max<Index>(1, cells / 16);
    for (const System::StateColumn& column : s.state()) {
      if (column.kind != Kind::cell) continue;
      for (Index cell = 0; cell < cells; cell += stride) {
        Measured sum{0, 0};
        for (const Target& t : e.rates) {
          if (t.column != column.column) continue;
          const Measured x = reference.at_cell(t.value, cell);
          sum = {sum.value + x.value, sum.magnitude + x.magnitude};
        }
        const double computed = rates.data()[column.offset + cell];
        if (!std::isfinite(sum.value) || !(std::fabs(computed - sum.value) > 1e-10 * sum.magnitude + 1e-300)) continue;
        fail("internal: the rate of {} in cell {} is {} evaluated directly and {} by the compiled passes; please report this model",
             column.name, s.tissue().id(Kind::cell, cell), sum.value, computed);
      }
    }
    return 0;
  });
}

int time(lua_State* L) {
  return guard(L, [&] {
    const Machine& m = object_at<Machine>(L, 1);
    lua_pushnumber(L, m.integrator->time());
    lua_pushnumber(L, static_cast<double>(m.integrator->steps()));
    return 2;
  });
}

/// cost(machine) -> seconds of computing in this process, cell-steps taken in them, form of the sums
int cost(lua_State* L) {
  return guard(L, [&] {
    const Machine& m = object_at<Machine>(L, 1);
    lua_pushnumber(L, m.seconds);
    lua_pushnumber(L, m.cell_steps);
    const Plan& plan = m.system->plan();
    lua_pushstring(L, plan.uses_wall_form ? "walls" : plan.uses_edges ? "half-edges" : "separated");
    return 3;
  });
}

int save(lua_State* L) {
  return guard(L, [&] {
    const Machine& m = object_at<Machine>(L, 1);
    ByteWriter out;
    m.integrator->save(out);
    lua_pushlstring(L, out.bytes().data(), out.bytes().size());
    return 1;
  });
}

int load(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const std::string bytes = check_string(L, 2, "a saved state");
    ByteReader in(bytes);
    m.integrator->load(in);
    return 0;
  });
}

int tissue_save(lua_State* L) {
  return guard(L, [&] {
    ByteWriter out;
    tissue_at(L, 1).save(out);
    lua_pushlstring(L, out.bytes().data(), out.bytes().size());
    return 1;
  });
}

int tissue_load(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = tissue_at(L, 1);
    require_changeable(tissue);
    size_t size = 0;
    if (lua_type(L, 2) != LUA_TSTRING) fail("expected a saved tissue, got {}", describe(L, 2));
    const char* bytes = lua_tolstring(L, 2, &size);
    ByteReader in({bytes, size});
    tissue.load(in);
    return 0;
  });
}

/// with_lock(tissue, f, ...): calls f; meanwhile the tissue's structure cannot change.
int with_lock(lua_State* L) {
  return guard(L, [&] {
    const Locked locked(tissue_at(L, 1));
    check_function(L, 2, "a function");
    call(L, lua_gettop(L) - 2, 0);
    return 0;
  });
}

// === Looking into functions

/// upvalues(function) -> list of { name, value, identity }
int upvalues(lua_State* L) {
  return guard(L, [&] {
    check_function(L, 1, "a function");
    lua_newtable(L);
    if (lua_iscfunction(L, 1)) return 1;
    for (int i = 1;; ++i) {
      const char* name = lua_getupvalue(L, 1, i);
      if (!name) break;
      lua_createtable(L, 3, 0);
      lua_insert(L, -2);
      lua_rawseti(L, -2, 2);
      lua_pushstring(L, name);
      lua_rawseti(L, -2, 1);
      lua_pushfstring(L, "%p", lua_upvalueid(L, 1, i));
      lua_rawseti(L, -2, 3);
      lua_rawseti(L, -2, i);
    }
    return 1;
  });
}

int set_upvalue(lua_State* L) {
  return guard(L, [&] {
    check_function(L, 1, "a function");
    const auto which = static_cast<int>(check_integer(L, 2, "an upvalue", 1, 255));
    if (lua_iscfunction(L, 1)) fail("not a Lua function");
    lua_settop(L, 3);
    if (!lua_setupvalue(L, 1, which)) fail("the function has no upvalue {}", which);
    return 0;
  });
}

/// Leaves the functions that list bytecode in the registry and takes the rest of the library `jit` away again.
void open_bytecode_functions(lua_State* L) {
  lua_pushcfunction(L, luaopen_jit);
  lua_pushliteral(L, LUA_JITLIBNAME);
  lua_call(L, 1, 0);
  luaJIT_setmode(L, 0, LUAJIT_MODE_ENGINE | LUAJIT_MODE_OFF);
  lua_getfield(L, LUA_REGISTRYINDEX, "_PRELOAD");
  lua_getfield(L, -1, "jit.util");
  if (lua_isfunction(L, -1)) {
    lua_call(L, 0, 1);
  } else {
    lua_pop(L, 1);
    lua_getfield(L, LUA_REGISTRYINDEX, "_LOADED");
    lua_getfield(L, -1, "jit.util");
    lua_remove(L, -2);
  }
  lua_setfield(L, -3, "bytecode");
  for (const char* name : {"jit.util", "jit.profile"}) {
    lua_pushnil(L);
    lua_setfield(L, -2, name);
  }
  lua_pop(L, 1);
  lua_getfield(L, LUA_REGISTRYINDEX, "_LOADED");
  for (const char* name : {"jit", "jit.util", "jit.opt"}) {
    lua_pushnil(L);
    lua_setfield(L, -2, name);
  }
  lua_pop(L, 1);
  lua_pushnil(L);
  lua_setglobal(L, "jit");
}

}  // namespace

void register_model(lua_State* L) {
  register_symbols(L);
  const luaL_Reg functions[] = {{"rules", rules}, {"trace", trace}, {"direct", direct}, {"reference", reference}, {"machine", machine},
                                {"advance", advance}, {"failure", failure}, {"derive", derive}, {"check_lowering", check_lowering},
                                {"machine_time", time}, {"machine_cost", cost}, {"machine_save", save}, {"machine_load", load},
                                {"tissue_save", tissue_save}, {"with_lock", with_lock},
                                {"tissue_load", tissue_load}, {"upvalues", upvalues}, {"set_upvalue", set_upvalue}, {nullptr, nullptr}};
  add_functions(L, functions);
  open_bytecode_functions(L);
}

}  // namespace tunica::lua
