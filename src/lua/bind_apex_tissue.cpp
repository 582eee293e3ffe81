// SPDX-License-Identifier: MIT
// Cells on an apex: building them, where they are, removal of those that have gone far.
#include "lua/bind_tissue.h"
#include "lua/surfaces.h"
#include "shape/apex_tissue.h"

namespace tunica::lua {
namespace {

/// The apex at a stack index, or below the surface there. @param owner  keeps it alive
const Apex& apex_below_at(lua_State* L, int at, std::shared_ptr<Surface>& owner) {
  owner = surface_at(L, at);
  const Apex* apex = apex_below(*owner);
  if (!apex) fail("'on' must be an apex (tunica.apex, or tunica.bulges on one), came another surface");
  return *apex;
}

/// build_apex_tissue(apex, to or 0, cells or 0, max_area, variation, growth, seed or nil)
int build(lua_State* L) {
  return guard(L, [&] {
    std::shared_ptr<Surface> owner;
    const Apex& apex = apex_below_at(L, 1, owner);
    ApexTissueSettings s;
    s.to = check_number(L, 2, "'to'");
    s.cells = check_integer(L, 3, "'cells'", 0, 1'000'000);
    s.max_area = check_number(L, 4, "'max_area'");
    s.variation = check_number(L, 5, "'variation'");
    s.growth = check_number(L, 6, "'growth'");
    s.seed = lua_isnoneornil(L, 7) ? host(L).seed
                                   : static_cast<uint64_t>(check_integer(L, 7, "'seed'", 0, int64_t{1} << 53));
    s.cancel = &host(L).cancel;
    push_tissue(L, std::make_shared<Tissue>(apex_tissue(apex, s)));
    return 1;
  });
}

/// is_on_apex(surface) -> whether it is an apex or bulges out of one
int is_on_apex(lua_State* L) {
  return guard(L, [&] {
    lua_pushboolean(L, apex_below(*surface_at(L, 1)) != nullptr);
    return 1;
  });
}

/// locate(tissue, surface)
int locate_all(lua_State* L) {
  return guard(L, [&] {
    std::shared_ptr<Surface> owner;
    Tissue& tissue = tissue_at(L, 1);
    locate(tissue, apex_below_at(L, 2, owner));
    return 0;
  });
}

/// follow(tissue, surface): columns theta and a, primordium and closeness, as far as the tissue has them
int follow_all(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    Tissue& tissue = tissue_at(L, 1);
    follow(tissue, *surface_at(L, 2));
    return 0;
  });
}

/// follow_around(surface, cell, ...): of the cells and their neighbours
int follow_some(lua_State* L) {
  return guard(L, [&] {
    const Entering entering(L);
    const auto surface = surface_at(L, 1);
    for (int at = 2; at <= lua_gettop(L); ++at) {
      const auto [tissue, kind, cell] = check_element(L, at, Kind::cell);
      std::vector<Id> cells = {tissue.id(Kind::cell, cell)};
      for (const Index n : tissue.neighbours(cell)) cells.push_back(tissue.id(Kind::cell, n));
      follow(tissue, *surface, cells);
    }
    return 0;
  });
}

/// remove_beyond(tissue, surface, arc length) -> number of cells removed
int remove_far(lua_State* L) {
  return guard(L, [&] {
    std::shared_ptr<Surface> owner;
    Tissue& tissue = tissue_at(L, 1);
    require_changeable(tissue);
    lua_pushnumber(
        L, static_cast<double>(remove_beyond(tissue, apex_below_at(L, 2, owner), check_number(L, 3, "'beyond'"))));
    return 1;
  });
}

}  // namespace

void register_apex_tissue(lua_State* L) {
  const luaL_Reg functions[] = {
      {"build_apex_tissue", build},   {"is_on_apex", is_on_apex},    {"locate", locate_all}, {"follow", follow_all},
      {"follow_around", follow_some}, {"remove_beyond", remove_far}, {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
