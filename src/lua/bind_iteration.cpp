// SPDX-License-Identifier: MIT
// Going through the elements of a tissue, of a cell, of a junction.
#include <algorithm>

#include "lua/bind_tissue.h"
#include "tissue/topology.h"

namespace tunica::lua {
namespace {

// === Iteration over all elements of a kind: a snapshot of identities in ascending order (the order of birth, which no
// renumbering changes); elements that are gone when their turn comes are left out.

struct Snapshot {
  std::vector<Id> ids;
  size_t at = 0;
  Kind kind = Kind::cell;
};

int collect_snapshot(lua_State* L) {
  static_cast<Snapshot*>(lua_touserdata(L, 1))->~Snapshot();
  return 0;
}

int next_of_snapshot(lua_State* L) {
  return guard(L, [&] {
    auto* snapshot = static_cast<Snapshot*>(lua_touserdata(L, lua_upvalueindex(1)));
    const Tissue& tissue = tissue_at(L, lua_upvalueindex(2));
    Index index = none;
    while (index == none && snapshot->at < snapshot->ids.size())
      index = tissue.find(snapshot->kind, snapshot->ids[snapshot->at++]);
    push_element(L, lua_upvalueindex(2), snapshot->kind, index);
    return 1;
  });
}

int each(lua_State* L) {
  return guard(L, [&] {
    const Tissue& tissue = tissue_at(L, 1);
    const Kind kind = check_kind(L, 2);
    auto* snapshot = new (lua_newuserdata(L, sizeof(Snapshot))) Snapshot;
    if (luaL_newmetatable(L, "tunica.snapshot")) {
      lua_pushcfunction(L, collect_snapshot);
      lua_setfield(L, -2, "__gc");
    }
    lua_setmetatable(L, -2);
    snapshot->kind = kind;
    snapshot->ids.reserve(static_cast<size_t>(tissue.count(kind)));
    for (Index i = 0; i < tissue.count(kind); ++i) snapshot->ids.push_back(tissue.id(kind, i));
    std::sort(snapshot->ids.begin(), snapshot->ids.end());
    lua_pushvalue(L, 1);
    lua_pushcclosure(L, next_of_snapshot, 2);
    return 1;
  });
}

/// element(tissue, kind, n) -> the n-th of the tissue, as it is stored now
int element_at(lua_State* L) {
  return guard(L, [&] {
    const Tissue& tissue = tissue_at(L, 1);
    const Kind kind = check_kind(L, 2);
    const auto n = check_integer(L, 3, "a number", 1, tissue.count(kind));
    push_element(L, 1, kind, static_cast<Index>(n - 1));
    return 1;
  });
}

// === Iteration around a cell or junction: the handles are made at the start and kept in a table.

int next_of_list(lua_State* L) {
  const int width = static_cast<int>(lua_tointeger(L, lua_upvalueindex(3)));
  const int at = static_cast<int>(lua_tointeger(L, lua_upvalueindex(2)));
  lua_pushinteger(L, at + width);
  lua_replace(L, lua_upvalueindex(2));
  for (int i = 1; i <= width; ++i) lua_rawgeti(L, lua_upvalueindex(1), at + i);
  return width;
}

/// Turns the table on top of the stack into an iterator that gives `width` of its values at a time.
void list_to_iterator(lua_State* L, int width) {
  lua_pushinteger(L, 0);
  lua_pushinteger(L, width);
  lua_pushcclosure(L, next_of_list, 3);
}

std::vector<Index> sides_of(const Tissue& tissue, Index cell) {
  std::vector<Index> sides;
  const Index first = tissue.first_side(cell);
  if (first == none) return sides;
  for (Index side = first;;) {
    sides.push_back(side);
    side = tissue.next(side);
    if (side == first) return sides;
  }
}

int neighbours(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    lua_newtable(L);
    const int list = lua_gettop(L);
    std::vector<Index> seen;
    for (const Index side : sides_of(tissue, cell)) {
      const Index other = tissue.neighbour(side);
      if (other == none || std::find(seen.begin(), seen.end(), other) != seen.end()) continue;
      seen.push_back(other);
      const int at = 2 * static_cast<int>(seen.size()) - 1;
      push_element(L, 1, Kind::cell, other);
      lua_rawseti(L, list, at);
      push_element(L, 1, Kind::wall, tissue.wall_of(side));
      lua_rawseti(L, list, at + 1);
    }
    list_to_iterator(L, 2);
    return 1;
  });
}

/// sides(cell), walls(cell), junctions(cell): in cyclic order.
template <Kind wanted>
int around_cell(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    lua_newtable(L);
    int at = 0;
    for (const Index side : sides_of(tissue, cell)) {
      const Index index = wanted == Kind::side   ? side
                          : wanted == Kind::wall ? tissue.wall_of(side)
                                                 : tissue.start(side);
      push_element(L, 1, wanted, index);
      lua_rawseti(L, -2, ++at);
    }
    list_to_iterator(L, 1);
    return 1;
  });
}

int junctions_of_cell(lua_State* L) {
  return guard(L, [&] {
    if (!check_element(L, 1, Kind::cell).tissue.has_geometry()) fail("a tissue without geometry has no junctions");
    return around_cell<Kind::junction>(L);
  });
}

int cells_of_junction(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, junction] = check_element(L, 1, Kind::junction);
    lua_newtable(L);
    int at = 0;
    for (const Index side : sides_at(tissue, junction)) {
      push_element(L, 1, Kind::cell, tissue.cell_of(side));
      lua_rawseti(L, -2, ++at);
    }
    list_to_iterator(L, 1);
    return 1;
  });
}

}  // namespace

void register_iteration(lua_State* L) {
  const luaL_Reg functions[] = {{"each", each},
                                {"element", element_at},
                                {"neighbours", neighbours},
                                {"cell_sides", around_cell<Kind::side>},
                                {"cell_walls", around_cell<Kind::wall>},
                                {"cell_junctions", junctions_of_cell},
                                {"junction_cells", cells_of_junction},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
