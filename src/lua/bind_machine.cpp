// SPDX-License-Identifier: MIT
// Equations bound to a tissue and a method, and stepped: what lua/tunica/model.lua runs.
#include "lua/bind_machine.h"

#include <time.h>

#include <cmath>

#include "lua/guard.h"
#include "rule/reference.h"

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

// === Machine

/// Reads method, dt | nil, tolerance | nil.
Solution solution_at(lua_State* L, int first) {
  const MethodInfo& method = find_method(check_string(L, first, "a method"));
  const bool dt = !lua_isnoneornil(L, first + 1), tolerance = !lua_isnoneornil(L, first + 2);
  const bool fixed = method.steps == Stepper::Steps::fixed;
  if (fixed && !dt) fail("the method {} needs a time step: dt", method.name);
  return {method.name, dt ? check_number(L, first + 1, "dt") : Integrator::unlimited,
          tolerance ? check_number(L, first + 2, "tolerance") : StepperOptions{}.tolerance,
          fixed || (method.either && dt && !tolerance)};
}

void make_integrator(Machine& m) {
  const Solution& s = m.solution;
  auto stepper = make_stepper(s.method, {.tolerance = s.tolerance, .fixed_steps = s.fixed_steps});
  m.integrator = std::make_unique<Integrator>(m.system, std::move(stepper), s.dt, s.tolerance);
  m.integrator->allow_negative(m.signed_columns);
  m.before = {};
}

/// methods_of_solution() -> list of { name, title, order, stability, implicit, adaptive, either }
int methods_of_solution(lua_State* L) {
  return guard(L, [&] {
    lua_newtable(L);
    int i = 0;
    for (const MethodInfo& m : methods()) {
      lua_createtable(L, 0, 7);
      lua_pushstring(L, m.name);
      lua_setfield(L, -2, "name");
      lua_pushstring(L, m.title);
      lua_setfield(L, -2, "title");
      lua_pushinteger(L, m.order);
      lua_setfield(L, -2, "order");
      lua_pushnumber(L, m.steps == Stepper::Steps::fixed ? m.make({})->stability() : 0);
      lua_setfield(L, -2, "stability");
      for (const auto& [key, value] :
           {std::pair{"implicit", m.implicit}, {"adaptive", m.steps != Stepper::Steps::fixed}, {"either", m.either}}) {
        lua_pushboolean(L, value);
        lua_setfield(L, -2, key);
      }
      lua_rawseti(L, -2, ++i);
    }
    return 1;
  });
}

/// machine(rules, method, dt | nil, tolerance | nil, threads, signed columns)
int machine(lua_State* L) {
  return guard(L, [&] {
    Rules& r = object_at<Rules>(L, 1);
    auto m = std::make_unique<Machine>();
    SystemOptions options;
    options.cancel = &host(L).cancel;
    m->solution = solution_at(L, 2);
    options.threads = static_cast<int>(check_integer(L, 5, "threads", 1, 256));
    m->system = std::make_shared<System>(r.equations, r.tissue, options);
    for (size_t i = 1; i <= lua_objlen(L, 6); ++i) {
      lua_rawgeti(L, 6, static_cast<int>(i));
      m->signed_columns.push_back(check_string(L, -1, "a column's name"));
      lua_pop(L, 1);
    }
    make_integrator(*m);
    push_object(L, std::move(m));
    return 1;
  });
}

/// machine_method(machine, method, dt | nil, tolerance | nil): from here on with another method.
int machine_method(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    Machine changed{.system = m.system, .solution = solution_at(L, 2), .signed_columns = m.signed_columns};
    make_integrator(changed);
    changed.integrator->continue_from(m.integrator->time(), m.integrator->steps());
    m.solution = changed.solution;
    m.integrator = std::move(changed.integrator);
    m.before = {};
    return 0;
  });
}

/// Runs `work` (steps of the integrator), keeping account of time and failures. Returns its status as text.
template <class Steps>
int run(lua_State* L, Machine& m, Steps&& work) {
  const Entering entering(L);
  const uint64_t steps = m.integrator->steps();
  const double begun = thread_seconds();
  const auto account = [&] {
    const double taken = static_cast<double>(m.integrator->steps()) - static_cast<double>(steps);
    m.seconds += thread_seconds() - begun;
    m.cell_steps += taken * m.system->tissue().cells();
    m.steps += m.integrator->steps() - steps;
  };
  m.failure.reset();
  Integrator::Status status;
  try {
    status = work();
  } catch (const StepFailed& failed) {
    account();
    m.failure = failed.failure;
    throw;
  }
  account();
  static constexpr const char* names[] = {"done", "paused", "out of time", "interrupted"};
  lua_pushstring(L, names[static_cast<int>(status)]);
  return 1;
}

/// advance(machine, parameters, to, pause | nil, seconds | nil) -> "done" | "paused" | "out of time" | "interrupted"
int advance(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const std::vector<double> parameters = parameter_values(L, 2, m.system->equations());
    const double to = check_number(L, 3, "a time");
    std::optional<double> pause;
    if (!lua_isnoneornil(L, 4)) pause = check_number(L, 4, "a time");
    std::function<bool()> out_of_time;
    if (!lua_isnoneornil(L, 5)) {
      const double end = wall_seconds() + check_number(L, 5, "seconds");
      out_of_time = [end] { return wall_seconds() >= end; };
    }
    return run(L, m, [&] { return m.integrator->advance(to, pause, out_of_time, &host(L).cancel, parameters); });
  });
}

// Looking into the last step, for events whose time is to be found.

/// look(machine, parameters): before looking into the last step at the start of a run. Structure and columns may
/// differ.
int look(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    Machine& m = object_at<Machine>(L, 1);
    m.integrator->look(parameter_values(L, 2, m.system->equations()));
    return 0;
  });
}

/// last_step(machine) -> its begin and end, or nothing
int last_step(lua_State* L) {
  return guard(L, [&] {
    const auto step = object_at<Machine>(L, 1).integrator->last_step();
    if (!step) return 0;
    lua_pushnumber(L, step->begin);
    lua_pushnumber(L, step->end);
    return 2;
  });
}

/// show(machine, time): the tissue then holds the state at this time within the last step.
int show(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    Machine& m = object_at<Machine>(L, 1);
    const Locked locked(m.system->tissue());
    m.integrator->show(check_number(L, 2, "a time"));
    return 0;
  });
}

/// retake(machine, time): the last step anew, from its start to this time.
int retake(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const double time = check_number(L, 2, "a time");
    return run(L, m, [&] { return m.integrator->retake(time); });
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

/// machine_state(machine) -> names of the columns that rates change, and the kind of element of each
int state(lua_State* L) {
  return guard(L, [&] {
    const Machine& m = object_at<Machine>(L, 1);
    lua_newtable(L);
    lua_newtable(L);
    int count = 0;
    for (const System::StateColumn& column : m.system->state()) {
      lua_pushstring(L, column.name.c_str());
      lua_rawseti(L, -3, ++count);
      lua_pushstring(L, name_of(column.kind));
      lua_rawseti(L, -2, count);
    }
    return 2;
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

/// machine_time(machine) -> time, steps, how near times are the same, whether the time is within the last step
int time(lua_State* L) {
  return guard(L, [&] {
    const Machine& m = object_at<Machine>(L, 1);
    lua_pushnumber(L, m.integrator->time());
    lua_pushnumber(L, static_cast<double>(m.integrator->steps()));
    lua_pushnumber(L, m.integrator->slack());
    lua_pushboolean(L, m.integrator->inside_last_step());
    return 4;
  });
}

/// take_cost(machine) -> table of costs since it was last called; form of the sums
int take_cost(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const Work now = m.integrator->work(), before = m.before;
    lua_createtable(L, 0, 9);
    const auto number = [&](const char* key, double value) {
      lua_pushnumber(L, value);
      lua_setfield(L, -2, key);
    };
    const auto count = [&](const char* key, uint64_t Work::*member) {
      number(key, static_cast<double>(now.*member - before.*member));
    };
    number("seconds", m.seconds);
    number("cell_steps", m.cell_steps);
    number("steps", static_cast<double>(static_cast<int64_t>(m.steps)));
    count("rejected", &Work::rejected);
    count("evaluations", &Work::evaluations);
    count("jacobians", &Work::jacobians);
    count("factorizations", &Work::factorizations);
    count("newton_iterations", &Work::newton_iterations);
    count("linear_iterations", &Work::linear_iterations);
    m.seconds = m.cell_steps = 0;
    m.steps = 0;
    m.before = now;
    const Plan& plan = m.system->plan();
    lua_pushstring(L, plan.uses_wall_form ? "walls" : plan.uses_edges ? "half-edges" : "separated");
    return 2;
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
    Machine fresh{.system = m.system, .solution = m.solution, .signed_columns = m.signed_columns};
    make_integrator(fresh);  // so that nothing is left of what the method kept before
    fresh.integrator->load(in);
    m.integrator = std::move(fresh.integrator);
    m.before = {};
    return 0;
  });
}

/// rules_changed(machine): what its method keeps between steps is to be forgotten.
int rules_changed(lua_State* L) {
  return guard(L, [&] {
    object_at<Machine>(L, 1).integrator->rules_changed();
    return 0;
  });
}

}  // namespace

void register_machine(lua_State* L) {
  const luaL_Reg functions[] = {{"machine", machine},
                                {"advance", advance},
                                {"failure", failure},
                                {"derive", derive},
                                {"machine_state", state},
                                {"check_lowering", check_lowering},
                                {"machine_time", time},
                                {"take_cost", take_cost},
                                {"methods_of_solution", methods_of_solution},
                                {"machine_method", machine_method},
                                {"rules_changed", rules_changed},
                                {"look", look},
                                {"last_step", last_step},
                                {"show", show},
                                {"retake", retake},
                                {"machine_save", save},
                                {"machine_load", load},
                                {nullptr, nullptr}};
  add_functions(L, functions);
  register_steady(L);
}

}  // namespace tunica::lua
