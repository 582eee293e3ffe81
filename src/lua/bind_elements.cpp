// SPDX-License-Identifier: MIT
// What a handle knows of its place in the tissue: identity, neighbourhood, navigation.
#include "lua/bind_tissue.h"
#include "tissue/topology.h"

namespace tunica::lua {
namespace {

// === Identity. These answer for elements that are gone, too.

int element_id(lua_State* L) {
  return guard(L, [&] {
    Kind kind;
    Id id;
    Tissue* tissue;
    if (!peek_handle(L, 1, kind, id, tissue)) fail("expected an element of a tissue, came {}", describe(L, 1));
    lua_pushnumber(L, id);
    return 1;
  });
}

int element_alive(lua_State* L) {
  return guard(L, [&] {
    Kind kind;
    Id id;
    Tissue* tissue;
    if (!peek_handle(L, 1, kind, id, tissue)) fail("expected an element of a tissue, came {}", describe(L, 1));
    lua_pushboolean(L, tissue->find(kind, id) != none);
    return 1;
  });
}

int kind_of_value(lua_State* L) {
  return guard(L, [&] {
    Kind kind;
    Id id;
    Tissue* tissue;
    if (is_tissue(L, 1))
      lua_pushliteral(L, "tissue");
    else if (peek_handle(L, 1, kind, id, tissue))
      lua_pushstring(L, name_of(kind));
    else
      lua_pushnil(L);
    return 1;
  });
}

/// The tissue of a handle (or the tissue itself); its environment holds it.
int tissue_of(lua_State* L) {
  return guard(L, [&] {
    if (!is_tissue(L, 1)) {
      Kind kind;
      Id id;
      Tissue* tissue;
      if (!peek_handle(L, 1, kind, id, tissue)) fail("expected an element of a tissue, came {}", describe(L, 1));
    }
    lua_getfenv(L, 1);
    lua_rawgeti(L, -1, 1);
    return 1;
  });
}

int tissue_data(lua_State* L) {
  return guard(L, [&] {
    tissue_at(L, 1);
    lua_getfenv(L, 1);
    lua_getfield(L, -1, "data");
    return 1;
  });
}

int find(lua_State* L) {
  return guard(L, [&] {
    const Tissue& tissue = tissue_at(L, 1);
    const Kind kind = check_kind(L, 2);
    const auto id = static_cast<Id>(check_integer(L, 3, "an identity", 0, UINT32_MAX));
    push_element(L, 1, kind, tissue.find(kind, id));
    return 1;
  });
}

/// handle(tissue, kind, identity) -> the element, which may be gone
int handle(lua_State* L) {
  return guard(L, [&] {
    tissue_at(L, 1);
    push_identity(L, 1, check_kind(L, 2), static_cast<Id>(check_integer(L, 3, "an identity", 0, UINT32_MAX)));
    return 1;
  });
}

int count(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, tissue_at(L, 1).count(check_kind(L, 2)));
    return 1;
  });
}

// === Cells

int valence(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    lua_pushnumber(L, static_cast<double>(tissue.neighbours(cell).size()));
    return 1;
  });
}

int side_count(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    lua_pushnumber(L, tissue.side_count(cell));
    return 1;
  });
}

int on_border(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, index] = check_element(L, 1);
    if (kind == Kind::cell)
      lua_pushboolean(L, tissue.on_border(index));
    else if (kind == Kind::junction)
      lua_pushboolean(L, static_cast<int>(sides_at(tissue, index).size()) != degree(tissue, index));
    else
      lua_pushboolean(L, tissue.wall_side(kind == Kind::wall ? index : tissue.wall_of(index), 1) == none);
    return 1;
  });
}

template <Index (*around)(const Tissue&, Index, Index)>
int turn(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    push_element(L, 1, Kind::cell, around(tissue, cell, check_element(L, 2, Kind::cell, tissue)));
    return 1;
  });
}

int side_to(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    push_element(L, 1, Kind::side, side_between(tissue, cell, check_element(L, 2, Kind::cell, tissue)));
    return 1;
  });
}

int wall_to(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, cell] = check_element(L, 1, Kind::cell);
    const Index side = side_between(tissue, cell, check_element(L, 2, Kind::cell, tissue));
    push_element(L, 1, Kind::wall, side == none ? none : tissue.wall_of(side));
    return 1;
  });
}

// === Walls and sides

/// cells(wall), sides(wall): one or two values.
template <Kind wanted>
int of_wall(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, wall] = check_element(L, 1, Kind::wall);
    for (int which = 0; which < 2; ++which) {
      const Index side = tissue.wall_side(wall, which);
      push_element(L, 1, wanted, side == none || wanted == Kind::side ? side : tissue.cell_of(side));
    }
    return 2;
  });
}

int junctions_of_wall(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, wall] = check_element(L, 1, Kind::wall);
    if (!tissue.has_geometry()) fail("a tissue without geometry has no junctions");
    const Index side = tissue.wall_side(wall, 0);
    push_element(L, 1, Kind::junction, tissue.start(side));
    push_element(L, 1, Kind::junction, tissue.end(side));
    return 2;
  });
}

enum class Step { cell, neighbour, wall, opposite, next, previous, from, to };

template <Step step>
int of_side(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, side] = check_element(L, 1, Kind::side);
    if constexpr (step == Step::from || step == Step::to)
      if (!tissue.has_geometry()) fail("a tissue without geometry has no junctions");
    if constexpr (step == Step::cell) push_element(L, 1, Kind::cell, tissue.cell_of(side));
    if constexpr (step == Step::neighbour) push_element(L, 1, Kind::cell, tissue.neighbour(side));
    if constexpr (step == Step::wall) push_element(L, 1, Kind::wall, tissue.wall_of(side));
    if constexpr (step == Step::opposite) push_element(L, 1, Kind::side, tissue.opposite(side));
    if constexpr (step == Step::next) push_element(L, 1, Kind::side, tissue.next(side));
    if constexpr (step == Step::previous) push_element(L, 1, Kind::side, tissue.previous(side));
    if constexpr (step == Step::from) push_element(L, 1, Kind::junction, tissue.start(side));
    if constexpr (step == Step::to) push_element(L, 1, Kind::junction, tissue.end(side));
    return 1;
  });
}

// === Junctions

template <int axis>
int coordinate(lua_State* L) {
  return guard(L, [&] {
    const auto [tissue, kind, junction] = check_element(L, 1, Kind::junction);
    lua_pushnumber(L, tissue.position(junction)[axis]);
    return 1;
  });
}

int where(lua_State* L) {
  push_where(L);
  return 1;
}

int describe_value(lua_State* L) {
  return guard(L, [&] {
    lua_pushstring(L, describe(L, 1).c_str());
    return 1;
  });
}

/// did_you_mean(name, list) -> "; did you mean 'x'?" or ""
int hint(lua_State* L) {
  return guard(L, [&] {
    const std::string name = check_string(L, 1, "the name");
    check_table(L, 2, "the list of names");
    std::vector<std::string> names;
    for (int i = 1; i <= static_cast<int>(lua_objlen(L, 2)); ++i) {
      lua_rawgeti(L, 2, i);
      if (lua_type(L, -1) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -1));
      lua_pop(L, 1);
    }
    lua_pushstring(L, did_you_mean(name, names).c_str());
    return 1;
  });
}

}  // namespace

void register_elements(lua_State* L) {
  const luaL_Reg functions[] = {{"id", element_id},
                                {"alive", element_alive},
                                {"kind", kind_of_value},
                                {"tissue_of", tissue_of},
                                {"data", tissue_data},
                                {"find", find},
                                {"handle", handle},
                                {"count", count},
                                {"valence", valence},
                                {"side_count", side_count},
                                {"border", on_border},
                                {"next_to", turn<next_to>},
                                {"previous_to", turn<previous_to>},
                                {"side_to", side_to},
                                {"wall_to", wall_to},
                                {"wall_cells", of_wall<Kind::cell>},
                                {"wall_sides", of_wall<Kind::side>},
                                {"wall_junctions", junctions_of_wall},
                                {"side_cell", of_side<Step::cell>},
                                {"side_neighbour", of_side<Step::neighbour>},
                                {"side_wall", of_side<Step::wall>},
                                {"side_opposite", of_side<Step::opposite>},
                                {"side_next", of_side<Step::next>},
                                {"side_previous", of_side<Step::previous>},
                                {"side_from", of_side<Step::from>},
                                {"side_to_junction", of_side<Step::to>},
                                {"junction_x", coordinate<0>},
                                {"junction_y", coordinate<1>},
                                {"junction_z", coordinate<2>},
                                {"where", where},
                                {"describe", describe_value},
                                {"did_you_mean", hint},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
