// SPDX-License-Identifier: MIT
// Steady states, and what a method that chooses has chosen.
#include <cmath>

#include "lua/bind_machine.h"
#include "lua/guard.h"
#include "rule/complex_step.h"
#include "solve/spectral_radius.h"
#include "solve/steady.h"

namespace tunica::lua {

namespace {

void set(lua_State* L, const char* key, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, key);
}

/// steady(machine, parameters, tolerance, whether to look at the stability) -> { how, iterations, residual, growth |
/// nil, stable | nil }; the tissue's columns then hold the steady state. Errors: they stay what they were.
int steady(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const Entering entering(L);
    System& system = *m.system;
    system.prepare(parameter_values(L, 2, system.equations()));
    const SteadyOptions options{.tolerance = check_number(L, 3, "a tolerance"),
                                .stability = lua_toboolean(L, 4) != 0,
                                .cancel = &host(L).cancel};
    AlignedBuffer y;
    y.resize(system.state_size());
    system.read_state(y.data());
    const Locked locked(system.tissue());
    const std::vector<double> before(y.data(), y.data() + y.size());
    Steady found;
    try {
      found = find_steady(system, m.integrator->time(), y.data(), options);
    } catch (...) {
      system.write_state(before.data());  // rules that run as they are have seen what was tried
      throw;
    }
    system.write_state(y.data());
    lua_createtable(L, 0, 6);
    lua_pushstring(L, found.how.c_str());
    lua_setfield(L, -2, "how");
    set(L, "iterations", found.iterations);
    set(L, "residual", found.residual);
    if (options.stability && found.stability_known) {
      set(L, "growth", found.growth);
      lua_pushboolean(L, found.stable);
      lua_setfield(L, -2, "stable");
    }
    return 1;
  });
}

/// machine_spectral_radius(machine, parameters, accuracy, most iterations) -> of the rates' derivative at the present
/// state
int spectral_radius_now(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const Entering entering(L);
    System& s = *m.system;
    const Locked locked(s.tissue());
    s.prepare(parameter_values(L, 2, s.equations()));
    AlignedBuffer y, rates, vector;
    y.resize(s.state_size());
    rates.resize(s.state_size());
    s.read_state(y.data());
    const double time = m.integrator->time();
    s.rates(time, y.data(), rates.data());
    const int most = static_cast<int>(check_integer(L, 4, "iterations", 1, 1000000));
    lua_pushnumber(
        L, spectral_radius(s, time, y.data(), rates.data(), vector, check_number(L, 3, "accuracy"), most).radius);
    return 1;
  });
}

/// machine_choice(machine) -> method chosen, why; nothing for methods that do not choose
int choice(lua_State* L) {
  return guard(L, [&] {
    const Stepper& stepper = object_at<Machine>(L, 1).integrator->stepper();
    const std::string name = stepper.choice();
    if (name.empty()) return 0;
    lua_pushstring(L, name.c_str());
    lua_pushstring(L, stepper.why().c_str());
    return 2;
  });
}

/// smoothness(machine) -> list of operations that bend, list of places of rules without a derivative
int smoothness(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    const Jacobian jacobian(*object_at<Machine>(L, 1).system);
    for (const auto* list : {&jacobian.kinks(), &jacobian.missing()}) {
      lua_newtable(L);
      int i = 0;
      for (const std::string& text : *list) {
        lua_pushstring(L, text.c_str());
        lua_rawseti(L, -2, ++i);
      }
    }
    return 2;
  });
}

/// check_jacobian(machine, parameters, rows) -> largest error of entries of the exact Jacobian in so many rows of each
/// column against complex steps, relative to the largest entry of its row; and the number of entries.
int check_jacobian(lua_State* L) {
  return guard(L, [&] {
    Machine& m = object_at<Machine>(L, 1);
    const Entering entering(L);
    System& s = *m.system;
    const std::vector<double> parameters = parameter_values(L, 2, s.equations());
    const auto rows = static_cast<Index>(check_integer(L, 3, "rows", 1, 1 << 20));
    s.prepare(parameters);
    Jacobian jacobian(s);
    if (!jacobian.missing().empty()) fail("{}: this rule has no derivative", jacobian.missing().front());
    jacobian.prepare();
    AlignedBuffer y;
    y.resize(s.state_size());
    s.read_state(y.data());
    const double t = m.integrator->time();
    jacobian.evaluate(t, y.data());
    ComplexStep reference(s.equations(), s.tissue(), parameters, t);
    const SparseRows& j = jacobian.matrix();
    double worst = 0;
    for (size_t k = 0; k < s.state().size(); ++k) {
      const System::StateColumn& of = s.state()[k];
      for (Index i = 0; i < of.count; i += std::max<Index>(1, of.count / rows)) {
        if (of.kind == Kind::side && s.tissue().neighbour(i) == none) continue;
        if (of.kind == Kind::wall && s.tissue().wall_side(i, 1) == none) continue;
        const int row = jacobian.offsets()[k] + i;
        double largest = 0, error = 0;
        for (int32_t at = j.begin[row]; at < j.begin[row + 1]; ++at) {
          const auto& offsets = jacobian.offsets();
          size_t by = 0;
          while (j.column[at] >= offsets[by + 1]) ++by;
          const double exact = reference.derivative(of.column, i, s.state()[by].column, j.column[at] - offsets[by]);
          largest = std::max(largest, std::fabs(exact));
          const double difference = std::fabs(exact - j.value[at]);
          if (!(difference <= error)) error = difference;
        }
        const double relative = error == 0 ? 0 : error / largest;
        if (!(relative <= worst)) worst = relative;
      }
    }
    lua_pushnumber(L, worst);
    lua_pushnumber(L, static_cast<double>(j.value.size()));
    return 2;
  });
}

}  // namespace

void register_steady(lua_State* L) {
  const luaL_Reg functions[] = {
      {"steady", steady},         {"machine_choice", choice},         {"machine_spectral_radius", spectral_radius_now},
      {"smoothness", smoothness}, {"check_jacobian", check_jacobian}, {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
