// SPDX-License-Identifier: MIT
// State of the elements: declaring columns, filling and summing them; random numbers keyed by element.
#include <cmath>

#include "base/random.h"
#include "lua/bind_tissue.h"

namespace tunica::lua {
namespace {

/// A value that a script's function returned, from the top of the stack, which is popped.
double pop_finite(lua_State* L, const std::string& whose) {
  if (lua_type(L, -1) != LUA_TNUMBER || !std::isfinite(lua_tonumber(L, -1)))
    fail("{} must return a finite number, returned {}", whose, describe(L, -1));
  const double value = lua_tonumber(L, -1);
  lua_pop(L, 1);
  return value;
}

/// columns(tissue, kind) -> names of all, names of those that a model may write
int columns(lua_State* L) {
  return guard(L, [&] {
    const Tissue& tissue = tissue_at(L, 1);
    const Kind kind = check_kind(L, 2);
    lua_newtable(L);
    lua_newtable(L);
    const int all = lua_gettop(L) - 1, writable = all + 1;
    for (const auto& column : tissue.columns(kind))
      for (const int list : {all, writable}) {
        if (list == writable && column->geometric) continue;
        lua_pushstring(L, column->name.c_str());
        lua_rawseti(L, list, static_cast<int>(lua_objlen(L, list)) + 1);
      }
    return 2;
  });
}

/// What the kernel keeps of a column's rule. The function itself stays in Lua, with the tissue's value, so that Lua's
/// collector sees it; it is looked up at each call.
struct RuleCall {
  Host* of;
  std::string name;  ///< key of the function in the tissue's table of rules
  const Tissue* tissue;
};

std::pair<double, double> run_rule(const RuleCall& rule, double mother, double share) {
  lua_State* L = rule.of->active;
  if (!L) fail("the rule of column '{}' can only run in an operation called from Lua", rule.name);
  if (!lua_checkstack(L, 8)) fail("too many nested calls");
  const int top = lua_gettop(L);
  if (!push_rules(L, rule.tissue)) fail("the rule of column '{}' is gone: its tissue is closed", rule.name);
  lua_getfield(L, -1, rule.name.c_str());
  lua_pushnumber(L, mother);
  lua_pushnumber(L, share);
  call(L, 2, 2);
  const std::string whose = "the divide rule of " + rule.name;
  const double second = pop_finite(L, whose);
  const double first = pop_finite(L, whose);
  lua_settop(L, top);
  return {first, second};
}

Inherit check_inherit(lua_State* L, int at) {
  if (lua_type(L, at) == LUA_TFUNCTION) return Inherit::rule;
  const std::string name = check_string(L, at, "'divide'");
  const std::vector<std::string> names = {"copy", "split", "reset"};
  for (size_t i = 0; i < names.size(); ++i)
    if (name == names[i]) return static_cast<Inherit>(i);
  fail("'divide' must be 'copy', 'split', 'reset' or a function, came '{}'{}", name, did_you_mean(name, names));
}

/// The initial values that a function of the element (at `function`) gives; the elements in order of index.
std::vector<double> initial_values(lua_State* L, Tissue& tissue, Kind kind, const std::string& name, int function) {
  std::vector<double> values;
  values.reserve(static_cast<size_t>(tissue.count(kind)));
  const Locked lock(tissue);
  for (Index i = 0; i < tissue.count(kind); ++i) {
    lua_pushvalue(L, function);
    push_element(L, 1, kind, i);
    call(L, 1, 1);
    values.push_back(pop_finite(L, fmt::format("the initial value of '{}', a function,", name)));
  }
  return values;
}

void attach_rule(lua_State* L, const Tissue& tissue, Kind kind, Column& column, int function) {
  const std::string key = fmt::format("{}.{}", name_of(kind), column.name);
  if (!push_rules(L, &tissue)) fail("the tissue is closed");
  lua_pushvalue(L, function);
  lua_setfield(L, -2, key.c_str());
  lua_pop(L, 1);
  column.rule = [rule = RuleCall{&host(L), key, &tissue}](double mother, double share) {
    return run_rule(rule, mother, share);
  };
}

/// add_column(tissue, kind, name, number or function(element), inherit name or function(mother, share))
int add_column(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 5);
    Tissue& tissue = tissue_at(L, 1);
    const Kind kind = check_kind(L, 2);
    Column column;
    column.name = check_string(L, 3, "the name of a column");
    if (host(L).rules > 0) fail("a rule cannot declare columns");
    if (tissue.find_column(kind, column.name)) fail("a {} has '{}' already", name_of(kind), column.name);
    const bool by_function = lua_type(L, 4) == LUA_TFUNCTION;
    if (!by_function) column.initial = check_number(L, 4, "the initial value");
    if (!lua_isnil(L, 5)) column.inherit = check_inherit(L, 5);
    if (column.inherit == Inherit::reset && by_function)
      fail("column '{}': 'reset' needs an initial value that is a number, not a function", column.name);
    std::vector<double> values;
    if (by_function) values = initial_values(L, tissue, kind, column.name, 4);
    if (column.inherit == Inherit::rule) attach_rule(L, tissue, kind, column, 5);
    Column& added = tissue.add_column(kind, std::move(column));
    for (size_t i = 0; i < values.size(); ++i) added.values[i] = values[i];
    return 0;
  });
}

/// column_values(tissue, kind, column) -> list of identities, list of values, in order of index
int column_values(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = tissue_at(L, 1);
    const Kind kind = check_kind(L, 2);
    const Column& column = tissue.column(kind, check_string(L, 3, "the name of a column"));
    const Index count = tissue.count(kind);
    lua_createtable(L, count, 0);
    lua_createtable(L, count, 0);
    for (Index i = 0; i < count; ++i) {
      lua_pushnumber(L, tissue.id(kind, i));
      lua_rawseti(L, -3, i + 1);
      lua_pushnumber(L, column.values[static_cast<size_t>(i)]);
      lua_rawseti(L, -2, i + 1);
    }
    return 2;
  });
}

enum class Reduction { sum, mean, least, greatest };

/// reduce(tissue, kind, column); the elements in order of index, so the sum is the same bits for the same tissue.
template <Reduction reduction>
int reduce(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = tissue_at(L, 1);
    const Kind kind = check_kind(L, 2);
    const Column& column = tissue.column(kind, check_string(L, 3, "the name of a column"));
    const auto count = static_cast<size_t>(tissue.count(kind));
    if (count == 0 && reduction != Reduction::sum) fail("the tissue has no {}s", name_of(kind));
    double result = reduction == Reduction::sum || reduction == Reduction::mean ? 0 : column.values[0];
    double lost = 0;  // Neumaier's compensation: sums stay exact to the last bits on 10^6 cells
    for (size_t i = 0; i < count; ++i) {
      const double value = column.values[i];
      if constexpr (reduction == Reduction::least) result = std::fmin(result, value);
      if constexpr (reduction == Reduction::greatest) result = std::fmax(result, value);
      if constexpr (reduction == Reduction::sum || reduction == Reduction::mean) {
        const double next = result + value;
        lost += std::abs(result) >= std::abs(value) ? (result - next) + value : (value - next) + result;
        result = next;
      }
    }
    if (std::isfinite(result)) result += lost;
    lua_pushnumber(L, reduction == Reduction::mean ? result / static_cast<double>(count) : result);
    return 1;
  });
}

/// random_number(handle or nil, "uniform" or "normal", a, b, purpose, draw): uniform in [a, b), or normal of mean a,
/// deviation b. Keyed by the tissue's seed and the element, or by the run's seed: a pure function of its arguments.
int random_number(lua_State* L) {
  return guard(L, [&] {
    RandomKey key{.seed = host(L).seed};
    if (!lua_isnil(L, 1)) {
      const auto [tissue, kind, index] = check_element(L, 1);
      key.seed = tissue.seed();
      key.cell = static_cast<uint64_t>(kind) << 32 | tissue.id(kind, index);
    }
    const bool is_normal = check_string(L, 2, "the distribution") == "normal";
    const double a = check_number(L, 3, "the first limit"), b = check_number(L, 4, "the second limit");
    key.purpose = purpose("script:" + check_string(L, 5, "'purpose'"));
    key.step = static_cast<uint32_t>(check_integer(L, 6, "'draw'", 0, UINT32_MAX));
    const double value = is_normal ? a + b * normal(key) : a + (b - a) * uniform(key);
    lua_pushnumber(L, !is_normal && b > a && value >= b ? std::nextafter(b, a) : value);
    return 1;
  });
}

}  // namespace

void register_columns(lua_State* L) {
  const luaL_Reg functions[] = {{"columns", columns},
                                {"add_column", add_column},
                                {"column_values", column_values},
                                {"sum", reduce<Reduction::sum>},
                                {"mean", reduce<Reduction::mean>},
                                {"min", reduce<Reduction::least>},
                                {"max", reduce<Reduction::greatest>},
                                {"random_number", random_number},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
