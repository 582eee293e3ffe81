// SPDX-License-Identifier: MIT
// Tissues from nothing, from polygons and from files. Each function takes its numbers in order; a seed that is nil is
// the run's.
#include "lua/bind_tissue.h"
#include "tissue/builders.h"

namespace tunica::lua {
namespace {

constexpr int64_t most_cells = 4'000'000;

uint64_t seed_at(lua_State* L, int at) {
  if (lua_isnoneornil(L, at)) return host(L).seed;
  return static_cast<uint64_t>(check_integer(L, at, "'seed'", 0, int64_t{1} << 53));
}

int64_t cells_at(lua_State* L, int at, const char* what) { return check_integer(L, at, what, 1, most_cells); }

/// Gives a freshly built tissue to Lua.
template <class Build>
int build(lua_State* L, Build&& make) {
  return guard(L, [&] {
    push_tissue(L, std::make_shared<Tissue>(make()));
    return 1;
  });
}

int build_line(lua_State* L) {
  return build(L, [&] { return line(cells_at(L, 1, "'cells'"), seed_at(L, 2), &host(L).cancel); });
}

int build_ring(lua_State* L) {
  return build(L, [&] { return ring(cells_at(L, 1, "'cells'"), seed_at(L, 2), &host(L).cancel); });
}

/// (columns, rows, wrap "none" | "x" | "both", seed)
int build_grid(lua_State* L) {
  return build(L, [&] {
    const std::string name = check_string(L, 3, "'wrap'");
    const Wrap wrap = name == "both" ? Wrap::both : name == "x" ? Wrap::x : Wrap::open;
    return grid(cells_at(L, 1, "'columns'"), cells_at(L, 2, "'rows'"), wrap, seed_at(L, 4), &host(L).cancel);
  });
}

int build_cylinder(lua_State* L) {
  return build(L, [&] {
    return cylinder(cells_at(L, 1, "'around'"), cells_at(L, 2, "'rows'"), seed_at(L, 3), &host(L).cancel);
  });
}

int build_squares(lua_State* L) {
  return build(L, [&] {
    return squares(cells_at(L, 1, "'columns'"), cells_at(L, 2, "'rows'"), seed_at(L, 3), &host(L).cancel);
  });
}

int build_hexagons(lua_State* L) {
  return build(L, [&] {
    return hexagons(cells_at(L, 1, "'columns'"), cells_at(L, 2, "'rows'"), check_number(L, 3, "'area'"), seed_at(L, 4),
                    &host(L).cancel);
  });
}

int build_hexagon_disk(lua_State* L) {
  return build(L, [&] {
    return hexagon_disk(check_integer(L, 1, "'radius'", 0, 2000), check_number(L, 2, "'area'"), seed_at(L, 3),
                        &host(L).cancel);
  });
}

int build_polygon(lua_State* L) {
  return build(L, [&] {
    return polygon(static_cast<int>(check_integer(L, 1, "'sides'", 3, 10000)), check_number(L, 2, "'area'"),
                   seed_at(L, 3));
  });
}

/// (cells, max_area, variation, growth, seed)
int build_sheet(lua_State* L) {
  return build(L, [&] {
    SheetSettings settings;
    settings.cells = cells_at(L, 1, "'cells'");
    settings.max_area = check_number(L, 2, "'max_area'");
    settings.variation = check_number(L, 3, "'variation'");
    settings.growth = check_number(L, 4, "'growth'");
    settings.seed = seed_at(L, 5);
    settings.cancel = &host(L).cancel;
    return sheet(settings);
  });
}

Vec3 point_at_top(lua_State* L, int cell, int corner) {
  const std::string what = fmt::format("a coordinate of corner {} of polygon {}", corner, cell);
  if (lua_type(L, -1) != LUA_TTABLE || lua_objlen(L, -1) < 2 || lua_objlen(L, -1) > 3)
    fail("corner {} of polygon {} must be {{ x, y }} or {{ x, y, z }}, came {}", corner, cell, describe(L, -1));
  Vec3 point = Vec3::Zero();
  for (int axis = 0; axis < static_cast<int>(lua_objlen(L, -1)); ++axis) {
    lua_rawgeti(L, -1, axis + 1);
    point[axis] = check_number(L, -1, what.c_str());
    lua_pop(L, 1);
  }
  return point;
}

/// (list of lists of { x, y[, z] }, tolerance, seed)
int build_polygons(lua_State* L) {
  return build(L, [&] {
    check_table(L, 1, "the list of polygons");
    std::vector<std::vector<Vec3>> cells;
    for (int cell = 1; cell <= static_cast<int>(lua_objlen(L, 1)); ++cell) {
      lua_rawgeti(L, 1, cell);
      check_table(L, -1, fmt::format("polygon {}", cell).c_str());
      auto& corners = cells.emplace_back();
      for (int corner = 1; corner <= static_cast<int>(lua_objlen(L, -1)); ++corner) {
        lua_rawgeti(L, -1, corner);
        corners.push_back(point_at_top(L, cell, corner));
        lua_pop(L, 1);
      }
      lua_pop(L, 1);
    }
    return polygons(cells, check_number(L, 2, "'tolerance'"), seed_at(L, 3), &host(L).cancel);
  });
}

}  // namespace

void register_builders(lua_State* L) {
  const luaL_Reg functions[] = {{"build_line", build_line},
                                {"build_ring", build_ring},
                                {"build_grid", build_grid},
                                {"build_cylinder", build_cylinder},
                                {"build_squares", build_squares},
                                {"build_hexagons", build_hexagons},
                                {"build_hexagon_disk", build_hexagon_disk},
                                {"build_polygon", build_polygon},
                                {"build_polygons", build_polygons},
                                {"build_sheet", build_sheet},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
