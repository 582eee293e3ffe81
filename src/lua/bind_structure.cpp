// SPDX-License-Identifier: MIT
// Structural changes other than division: removal, rows, graphs, numbering; and whether all is well.
#include "lua/bind_tissue.h"
#include "tissue/builders.h"
#include "tissue/order.h"
#include "tissue/topology.h"
#include "tissue/validity.h"

namespace tunica::lua {
namespace {

Tissue& changeable_at(lua_State* L, int at) {
  Tissue& tissue = tissue_at(L, at);
  require_changeable(tissue);
  return tissue;
}

Element changeable_cell_at(lua_State* L, int at) {
  const Element cell = check_element(L, at, Kind::cell);
  require_changeable(cell.tissue);
  return cell;
}

int remove(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = changeable_cell_at(L, 1);
    if (tissue.cells() == 1) fail("the last cell of a tissue cannot be removed");
    remove_cell(tissue, cell);
    return 0;
  });
}

int insert_row_at(lua_State* L) {
  return guard(L, [&] {
    insert_row(changeable_at(L, 1), check_integer(L, 2, "'after'", 0, INT32_MAX));
    return 0;
  });
}

int remove_row(lua_State* L) {
  return guard(L, [&] {
    remove_last_row(changeable_at(L, 1));
    return 0;
  });
}

int add_lone_cell(lua_State* L) {
  return guard(L, [&] {
    push_element(L, 1, Kind::cell, add_cell(changeable_at(L, 1)));
    return 1;
  });
}

/// after and before, one of them nil, as a Place
Place place_at(lua_State* L, int after, const Tissue& tissue) {
  const bool has_after = !lua_isnoneornil(L, after), has_before = !lua_isnoneornil(L, after + 1);
  if (has_after && has_before) fail("a neighbour comes after one or before one, not both");
  if (has_after) return {Place::after, check_element(L, after, Kind::cell, tissue)};
  if (has_before) return {Place::before, check_element(L, after + 1, Kind::cell, tissue)};
  return {};
}

/// join(cell, other, after, before, other_after, other_before) -> wall
int join_cells(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = changeable_cell_at(L, 1);
    const Index other = check_element(L, 2, Kind::cell, tissue);
    const Place here = place_at(L, 3, tissue), there = place_at(L, 5, tissue);
    push_element(L, 1, Kind::wall, join(tissue, cell, other, here, there));
    return 1;
  });
}

int separate_cells(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = changeable_cell_at(L, 1);
    separate(tissue, cell, check_element(L, 2, Kind::cell, tissue));
    return 0;
  });
}

/// set_neighbours(cell, list of cells)
int replace_neighbours(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = changeable_cell_at(L, 1);
    check_table(L, 2, "the list of neighbours");
    std::vector<Index> list;
    for (int i = 1; i <= static_cast<int>(lua_objlen(L, 2)); ++i) {
      lua_rawgeti(L, 2, i);
      list.push_back(check_element(L, -1, Kind::cell, tissue));
      lua_pop(L, 1);
    }
    set_neighbours(tissue, cell, list);
    return 0;
  });
}

int renumber_cells(lua_State* L) {
  return guard(L, [&] {
    renumber_along_curve(changeable_at(L, 1));
    return 0;
  });
}

/// problems(tissue) -> list of sentences
int problems(lua_State* L) {
  return guard(L, [&] {
    const std::vector<std::string> found = find_problems(tissue_at(L, 1));
    lua_createtable(L, static_cast<int>(found.size()), 0);
    for (size_t i = 0; i < found.size(); ++i) {
      lua_pushstring(L, found[i].c_str());
      lua_rawseti(L, -2, static_cast<int>(i) + 1);
    }
    return 1;
  });
}

int tissue_hash(lua_State* L) {
  return guard(L, [&] {
    lua_pushstring(L, tissue_at(L, 1).hash().c_str());
    return 1;
  });
}

int tissue_seed(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, static_cast<double>(tissue_at(L, 1).seed()));
    return 1;
  });
}

int has_geometry(lua_State* L) {
  return guard(L, [&] {
    lua_pushboolean(L, tissue_at(L, 1).has_geometry());
    return 1;
  });
}

}  // namespace

void register_structure(lua_State* L) {
  const luaL_Reg functions[] = {{"remove_cell", remove},
                                {"insert_row", insert_row_at},
                                {"remove_row", remove_row},
                                {"add_cell", add_lone_cell},
                                {"join", join_cells},
                                {"separate", separate_cells},
                                {"set_neighbours", replace_neighbours},
                                {"renumber", renumber_cells},
                                {"problems", problems},
                                {"tissue_hash", tissue_hash},
                                {"tissue_seed", tissue_seed},
                                {"has_geometry", has_geometry},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
