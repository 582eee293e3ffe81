// SPDX-License-Identifier: MIT
// Division: which cells, where the wall goes, how it is laid.
#include <algorithm>
#include <deque>

#include "lua/bind_tissue.h"
#include "lua/surfaces.h"
#include "shape/apex_tissue.h"
#include "tissue/division.h"

namespace tunica::lua {
namespace {

/// The numbers among the `count` values from stack index `from` on: plain numbers, or tables of numbers.
std::vector<double> numbers_from(lua_State* L, int from, int count, const char* what) {
  std::vector<double> numbers;
  for (int at = from; at < from + count && !lua_isnil(L, at); ++at) {
    if (lua_type(L, at) != LUA_TTABLE) {
      numbers.push_back(check_number(L, at, what));
      continue;
    }
    for (int i = 1; i <= static_cast<int>(lua_objlen(L, at)) && i <= 6; ++i) {
      lua_rawgeti(L, at, i);
      numbers.push_back(check_number(L, -1, what));
      lua_pop(L, 1);
    }
  }
  return numbers;
}

/// Calls the function at stack index `function` with a handle to the cell; leaves `results` values on the stack.
void call_with_cell(lua_State* L, int function, Index cell, int results) {
  if (!lua_checkstack(L, results + 6)) fail("too many nested calls");
  lua_pushvalue(L, function);
  push_element(L, 1, Kind::cell, cell);
  call(L, 1, results);
}

/// The wall that a script's function returns: x1, y1, x2, y2, or x1, y1, z1, x2, y2, z2, or two points.
Cut cut_by_function(lua_State* L, int function, Tissue& tissue, Index cell) {
  const Locked lock(tissue);
  const int top = lua_gettop(L);
  call_with_cell(L, function, cell, 6);
  const char* what = "what a division rule returns";
  const std::vector<double> n = numbers_from(L, top + 1, 6, what);
  lua_settop(L, top);
  const double z = tissue.centroid(cell).z();
  if (n.size() == 4) return cut_between(tissue, cell, {n[0], n[1], z}, {n[2], n[3], z});
  if (n.size() == 6) return cut_between(tissue, cell, {n[0], n[1], n[2]}, {n[3], n[4], n[5]});
  fail(
      "a division rule returns the ends of the wall: x1, y1, x2, y2, or x1, y1, z1, x2, y2, z2, or two points; "
      "for cell {} came {} numbers",
      tissue.id(Kind::cell, cell), n.size());
}

/// A direction that a script's function returns for each cell: x, y[, z], or a table.
Cut along_function(lua_State* L, int function, Tissue& tissue, Index cell) {
  const Locked lock(tissue);
  const int top = lua_gettop(L);
  call_with_cell(L, function, cell, 3);
  std::vector<double> n = numbers_from(L, top + 1, 3, "what a direction function returns");
  lua_settop(L, top);
  if (n.size() == 2) n.push_back(0);
  if (n.size() != 3)
    fail("a direction is x, y or x, y, z; for cell {} came {} numbers", tissue.id(Kind::cell, cell), n.size());
  return along({n[0], n[1], n[2]})(tissue, cell);
}

/// Stack: `rule` is a name or a function; `direction`, after it, a vector, a function or nil.
DivisionRule rule_at(lua_State* L, int rule, Tissue& tissue) {
  const int direction = rule + 1;
  if (lua_type(L, rule) == LUA_TFUNCTION)
    return [=, &tissue](const Tissue&, Index cell) { return cut_by_function(L, rule, tissue, cell); };
  const std::string name = check_string(L, rule, "'rule'");
  if (name != "along") return division_rule(name);
  if (lua_type(L, direction) == LUA_TFUNCTION)
    return [=, &tissue](const Tissue&, Index cell) { return along_function(L, direction, tissue, cell); };
  if (lua_isnil(L, direction)) fail("the rule 'along' needs a direction: direction = {{ x, y }}");
  std::vector<double> n = numbers_from(L, direction, 1, "'direction'");
  if (n.size() == 2) n.push_back(0);
  if (n.size() != 3) fail("'direction' must be {{ x, y }} or {{ x, y, z }}, came {}", describe(L, direction));
  return along({n[0], n[1], n[2]});
}

/// Stack: gap (nil: by the default fraction), pinch.
DivisionSettings settings_at(lua_State* L, int gap) {
  DivisionSettings settings;
  if (!lua_isnil(L, gap)) settings.gap = check_number(L, gap, "'gap'");
  if (!lua_isnil(L, gap + 1)) settings.pinch = check_number(L, gap + 1, "'pinch'");
  return settings;
}

void require_divisible(const Tissue& tissue) {
  require_changeable(tissue);
  if (!tissue.has_geometry())
    fail("cells without geometry cannot be divided: build the tissue with geometry, as a sheet");
}

/// divide_cell(cell, rule, direction, gap, pinch, surface or nil) -> first, second
int divide_cell(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 6);
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    require_divisible(tissue);
    const Entering entering(L);
    const auto surface = optional_surface_at(L, 6);
    const Division done = divide(tissue, cell, rule_at(L, 2, tissue), settings_at(L, 4), surface.get());
    push_element(L, 1, Kind::cell, done.first);
    push_element(L, 1, Kind::cell, done.second);
    return 2;
  });
}

bool chosen(lua_State* L, int function, Tissue& tissue, Index cell) {
  const Locked lock(tissue);
  call_with_cell(L, function, cell, 1);
  const bool yes = lua_toboolean(L, -1);
  lua_pop(L, 1);
  return yes;
}

/// Divides the cells that the function at stack index `where` chooses, in order of identity; and, with a threshold,
/// only those above it, and then their daughters in turn.
int64_t divide_where(lua_State* L, Tissue& tissue, int where, const Threshold* threshold, int64_t most_cells,
                     const DivisionRule& rule, const DivisionSettings& settings, const Surface* surface) {
  std::deque<Id> waiting;
  for (Index i = 0; i < tissue.cells(); ++i) waiting.push_back(tissue.id(Kind::cell, i));
  std::sort(waiting.begin(), waiting.end());
  int64_t divisions = 0;
  Undivided undivided;
  for (; !waiting.empty() && tissue.cells() < most_cells; waiting.pop_front()) {
    poll(&host(L).cancel);
    const Index cell = tissue.find(Kind::cell, waiting.front());
    if (cell == none || (threshold && !(tissue.area(cell) > threshold_of(tissue, cell, *threshold)))) continue;
    if (!chosen(L, where, tissue, cell)) continue;
    try {
      const Division done = divide(tissue, cell, rule, settings, surface);
      ++divisions;
      if (!threshold) continue;
      for (const Index daughter : {done.first, done.second}) waiting.push_back(tissue.id(Kind::cell, daughter));
    } catch (const Indivisible& error) {
      undivided.add(waiting.front(), error);
    }
  }
  undivided.report(divisions);
  return divisions;
}

int64_t divide_and_follow(lua_State* L, Tissue& tissue, const Threshold& threshold, const DivisionRule& rule,
                          const DivisionSettings& settings, const Surface* surface) {
  std::vector<Id> changed;
  const auto update = [&] {
    if (surface && !changed.empty()) follow(tissue, *surface, changed);
  };
  try {
    const int64_t divisions = divide_above(tissue, threshold, rule, settings, surface, &host(L).cancel, &changed);
    update();
    return divisions;
  } catch (...) {  // others were divided
    update();
    throw;
  }
}

/// divide_cells(tissue, above, variation, where, max_cells, rule, direction, gap, pinch, surface or nil) -> number of
/// divisions
int divide_cells(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 10);
    Tissue& tissue = tissue_at(L, 1);
    require_divisible(tissue);
    const Entering entering(L);
    const DivisionRule rule = rule_at(L, 6, tissue);
    const DivisionSettings settings = settings_at(L, 8);
    const auto surface = optional_surface_at(L, 10);
    Threshold threshold;
    if (!lua_isnil(L, 2)) threshold.area = check_number(L, 2, "'above'");
    if (!(threshold.area > 0)) fail("'above' must be an area greater than 0, came {}", threshold.area);
    threshold.variation = check_number(L, 3, "'variation'");
    threshold.most_cells = check_integer(L, 5, "'max_cells'", 1, int64_t{1} << 24);
    int64_t divisions = 0;
    if (lua_isnil(L, 4)) {
      if (lua_isnil(L, 2)) fail("say which cells divide: above = area, or where = function(c) ... end");
      divisions = divide_and_follow(L, tissue, threshold, rule, settings, surface.get());
    } else {
      check_function(L, 4, "'where'");
      try {
        divisions = divide_where(L, tissue, 4, lua_isnil(L, 2) ? nullptr : &threshold, threshold.most_cells, rule,
                                 settings, surface.get());
      } catch (...) {
        if (surface) follow(tissue, *surface);
        throw;
      }
      if (surface && divisions > 0) follow(tissue, *surface);
    }
    lua_pushnumber(L, static_cast<double>(divisions));
    return 1;
  });
}

/// threshold(cell, above, variation) -> area above which the cell divides
int threshold_of_cell(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    Threshold threshold;
    threshold.area = check_number(L, 2, "'above'");
    threshold.variation = check_number(L, 3, "'variation'");
    lua_pushnumber(L, threshold_of(tissue, cell, threshold));
    return 1;
  });
}

}  // namespace

void register_division(lua_State* L) {
  const luaL_Reg functions[] = {{"divide_cell", divide_cell},
                                {"divide_cells", divide_cells},
                                {"threshold", threshold_of_cell},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
