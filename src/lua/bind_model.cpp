// SPDX-License-Identifier: MIT
// The functions behind lua/tunica/model.lua: equations bound to a tissue, and stepped.
#include "lua/bind_model.h"

#include <time.h>

#include <cmath>
#include <optional>

#include "lua/guard.h"
#include "rule/reference.h"
#include "solve/integrator.h"

namespace tunica::lua {

/// Equations bound to a tissue and a method.
struct Machine {
  std::shared_ptr<System> system;
  std::unique_ptr<Integrator> integrator;
  std::optional<Failure> failure;
  double seconds = 0;  ///< of computing, this process
  double cell_steps = 0;
};

template <>
struct TypeName<Machine> {
  static constexpr const char* value = "tunica.machine";
};

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

// === Machine

/// machine(rules, method, dt, threads, signed columns)
int machine(lua_State* L) {
  return guard(L, [&] {
    Rules& r = object_at<Rules>(L, 1);
    auto m = std::make_unique<Machine>();
    SystemOptions options;
    options.cancel = &host(L).cancel;
    auto stepper = make_stepper(check_string(L, 2, "a method"), {});
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

/// derive(machine, parameters, checked): writes the derived columns for the state the tissue holds. Errors: as of
/// advance, if they are to be checked and one is not finite.
int derive(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const Entering entering(L);
    const std::vector<double> parameters = parameter_values(L, 2, m.system->equations());
    const Locked locked(m.system->tissue());
    m.failure.reset();
    try {
      m.integrator->derive(parameters, lua_toboolean(L, 3));
    } catch (const StepFailed& failed) {
      m.failure = failed.failure;
      throw;
    }
    return 0;
  });
}

/// check_lowering(rules, machine, parameters, cell indices count): compares the passes with the graphs they came from
/// on some cells. Errors: they differ, which is a fault of the program.
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
        fail(
            "internal: the rate of {} in cell {} is {} evaluated directly and {} by the compiled passes; please report "
            "this model",
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

/// machine_state(machine) -> names of the columns that rates change
int state(lua_State* L) {
  return guard(L, [&] {
    const Machine& m = object_at<Machine>(L, 1);
    lua_newtable(L);
    int count = 0;
    for (const System::StateColumn& column : m.system->state()) {
      lua_pushstring(L, column.name.c_str());
      lua_rawseti(L, -2, ++count);
    }
    return 1;
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
  register_rules(L);
  const luaL_Reg functions[] = {{"machine", machine},
                                {"advance", advance},
                                {"failure", failure},
                                {"derive", derive},
                                {"check_lowering", check_lowering},
                                {"machine_time", time},
                                {"machine_cost", cost},
                                {"machine_state", state},
                                {"machine_save", save},
                                {"machine_load", load},
                                {"tissue_save", tissue_save},
                                {"with_lock", with_lock},
                                {"tissue_load", tissue_load},
                                {"upvalues", upvalues},
                                {"set_upvalue", set_upvalue},
                                {nullptr, nullptr}};
  add_functions(L, functions);
  open_bytecode_functions(L);
}

}  // namespace tunica::lua
