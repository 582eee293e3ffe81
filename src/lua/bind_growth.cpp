// SPDX-License-Identifier: MIT
// Growth and deformation; what the shapes and the pattern of a tissue come to; files.
#include "base/files.h"
#include "lua/bind_tissue.h"
#include "shape/plane.h"
#include "tissue/ply.h"
#include "tissue/statistics.h"

namespace tunica::lua {
namespace {

/// Reads { x, y[, z] } at a stack index.
Vec3 vector_at(lua_State* L, int at, const char* what) {
  check_table(L, at, what);
  const auto size = static_cast<int>(lua_objlen(L, at));
  if (size != 2 && size != 3) fail("{} must be {{ x, y }} or {{ x, y, z }}, came {} numbers", what, size);
  Vec3 v = Vec3::Zero();
  for (int axis = 0; axis < size; ++axis) {
    lua_rawgeti(L, at, axis + 1);
    v[axis] = check_number(L, -1, what);
    lua_pop(L, 1);
  }
  return v;
}

Tissue& growing_at(lua_State* L, int at) {
  Tissue& tissue = tissue_at(L, at);
  require_changeable(tissue);
  if (!tissue.has_geometry()) fail("a tissue without geometry cannot grow: build one with geometry, as a sheet");
  return tissue;
}

/// Calls the function at stack index `function` with a place and what else is on the stack above it; takes two or three
/// numbers from it.
Vec3 call_for_vector(lua_State* L, int function, const Vec3& p, const double* t, const char* what) {
  if (!lua_checkstack(L, 8)) fail("too many nested calls");
  lua_pushvalue(L, function);
  for (const double x : {p.x(), p.y(), p.z()}) lua_pushnumber(L, x);
  if (t) lua_pushnumber(L, *t);
  call(L, t ? 4 : 3, 3);
  Vec3 result(check_number(L, -3, what), check_number(L, -2, what), t ? 0 : p.z());
  if (!lua_isnil(L, -1)) result.z() = check_number(L, -1, what);
  lua_pop(L, 3);
  return result;
}

/// grow_uniform(tissue, duration, rate, centre)
int grow_uniform(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = growing_at(L, 1);
    const UniformGrowth growth(check_number(L, 3, "'rate'"), vector_at(L, 4, "'centre'"));
    grow(tissue, growth, 0, check_number(L, 2, "'time'"));
    return 0;
  });
}

/// grow_anisotropic(tissue, duration, rate along, rate across, direction, centre)
int grow_anisotropic(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = growing_at(L, 1);
    const AnisotropicGrowth growth(check_number(L, 3, "'rates'"), check_number(L, 4, "'rates'"),
                                   vector_at(L, 5, "'direction'"), vector_at(L, 6, "'centre'"));
    grow(tissue, growth, 0, check_number(L, 2, "'time'"));
    return 0;
  });
}

/// grow_field(tissue, duration, velocity(x, y, z, t) -> vx, vy[, vz], start, substeps)
int grow_field(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = growing_at(L, 1);
    check_function(L, 3, "'velocity'");
    const auto velocity = [&](const Vec3& p, double t) {
      return call_for_vector(L, 3, p, &t, "a component of the velocity that the function returns");
    };
    const VelocityField field(velocity, static_cast<int>(check_integer(L, 5, "'substeps'", 1, 1000)));
    const double start = check_number(L, 4, "'from'"), duration = check_number(L, 2, "'time'");
    const Entering entering(L);
    // The field is asked before anything moves, but the script's function must not change the structure meanwhile;
    // grow() itself refuses a locked tissue, so the places are worked out first.
    std::vector<Vec3> places;
    {
      const Locked lock(tissue);
      for (Index j = 0; j < tissue.junctions(); ++j)
        places.push_back(field.advance(tissue.position(j), start, duration));
    }
    move_junctions(tissue, places);
    return 0;
  });
}

/// deform(tissue, function(x, y, z) -> x, y[, z])
int deform(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = growing_at(L, 1);
    check_function(L, 2, "the deformation");
    std::vector<Vec3> places;
    {
      const Locked lock(tissue);
      for (Index j = 0; j < tissue.junctions(); ++j)
        places.push_back(call_for_vector(L, 2, tissue.position(j), nullptr, "a coordinate that the function returns"));
    }
    move_junctions(tissue, places);
    return 0;
  });
}

// === Statistics

void set_number(lua_State* L, const char* name, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, name);
}

/// A list, the first of `values` at index `first`.
void set_list(lua_State* L, const char* name, const std::vector<double>& values, int first) {
  lua_newtable(L);
  for (size_t i = 0; i < values.size(); ++i) {
    lua_pushnumber(L, values[i]);
    lua_rawseti(L, -2, static_cast<int>(i) + first);
  }
  lua_setfield(L, -2, name);
}

int statistics(lua_State* L) {
  return guard(L, [&] {
    const CellStatistics s = cell_statistics(tissue_at(L, 1));
    lua_newtable(L);
    set_number(L, "cells", s.cells);
    set_number(L, "interior", s.interior);
    set_list(L, "shares", s.shares, 0);
    set_number(L, "mean_sides", s.mean_sides);
    set_number(L, "variance_sides", s.variance_sides);
    set_number(L, "mean_area", s.mean_area);
    set_number(L, "area_cv", s.area_cv);
    set_list(L, "area_by_sides", s.area_by_sides, 0);
    set_number(L, "lewis_slope", s.lewis_slope);
    set_number(L, "sharp_cells", s.sharp_cells);
    set_list(L, "least_angle", s.least_angle, 1);
    set_number(L, "mean_least_angle", s.mean_least_angle);
    set_number(L, "four_way", s.four_way);
    return 1;
  });
}

/// peaks(tissue, column, above or nil) -> list of cells, mean distance, its coefficient of variation
int peaks(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 3);
    const Tissue& tissue = tissue_at(L, 1);
    const std::string column = check_string(L, 2, "the name of a column");
    const Peaks found =
        lua_isnil(L, 3) ? find_peaks(tissue, column) : find_peaks(tissue, column, check_number(L, 3, "'above'"));
    lua_createtable(L, static_cast<int>(found.cells.size()), 0);
    int at = 0;
    for (const Index cell : found.cells) {
      push_element(L, 1, Kind::cell, cell);
      lua_rawseti(L, -2, ++at);
    }
    lua_pushnumber(L, found.mean_distance);
    lua_pushnumber(L, found.distance_cv);
    return 3;
  });
}

/// checkerboard(tissue, column) -> index, whether it is beyond that of noise
int checkerboard_of(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = tissue_at(L, 1);
    const Column& column = tissue.column(Kind::cell, check_string(L, 2, "a column"));
    const double index = checkerboard_index(tissue, column.values.data());
    lua_pushnumber(L, index);
    lua_pushboolean(L, alternates(tissue, index));
    return 2;
  });
}

/// find_pair(tissue, column, above, flat list of column, low, high) -> the two cells, or nothing
int find_pair_of_cells(lua_State* L) {
  return guard(L, [&] {
    const Tissue& tissue = tissue_at(L, 1);
    const std::string column = check_string(L, 2, "'column'");
    check_table(L, 4, "the bounds");
    std::vector<Within> bounds;
    for (int i = 1; i + 2 <= static_cast<int>(lua_objlen(L, 4)); i += 3) {
      for (int k = 0; k < 3; ++k) lua_rawgeti(L, 4, i + k);
      bounds.push_back({check_string(L, -3, "a column"), check_number(L, -2, "a bound"), check_number(L, -1, "a bound")});
      lua_pop(L, 3);
    }
    const Pair pair = find_pair(tissue, column, check_number(L, 3, "'above'"), bounds);
    if (pair.first == none) return 0;
    push_element(L, 1, Kind::cell, pair.first);
    push_element(L, 1, Kind::cell, pair.second);
    return 2;
  });
}

int count_peaks(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 3);
    const Tissue& tissue = tissue_at(L, 1);
    const std::string column = check_string(L, 2, "the name of a column");
    const Peaks found =
        lua_isnil(L, 3) ? find_peaks(tissue, column) : find_peaks(tissue, column, check_number(L, 3, "'above'"));
    lua_pushnumber(L, static_cast<double>(found.cells.size()));
    return 1;
  });
}

/// load_tissue(path, walls "straight" | "traced", seed or nil)
int load_tissue(lua_State* L) {
  return guard(L, [&] {
    const std::string path = check_string(L, 1, "'file'"), walls = check_string(L, 2, "'walls'");
    if (path.empty() || path.size() > 4096 || path.find('\0') != std::string::npos)
      fail("'file' must be a path, came {}", describe(L, 1));
    const uint64_t seed = lua_isnoneornil(L, 3)
                              ? host(L).seed
                              : static_cast<uint64_t>(check_integer(L, 3, "'seed'", 0, int64_t{1} << 53));
    const PlyWalls how = walls == "traced" ? PlyWalls::traced : PlyWalls::straight;
    try {
      push_tissue(L, std::make_shared<Tissue>(read_ply(read_file(path), how, seed)));
    } catch (const Error& error) {
      const std::string what = error.what();
      fail("{}", what.find(path) == std::string::npos ? path + ": " + what : what);
    }
    return 1;
  });
}

}  // namespace

void register_growth(lua_State* L) {
  const luaL_Reg functions[] = {{"grow_uniform", grow_uniform}, {"grow_anisotropic", grow_anisotropic},
                                {"grow_field", grow_field},     {"deform", deform},
                                {"find_pair", find_pair_of_cells},
                                {"statistics", statistics},     {"peaks", peaks},
                                {"count_peaks", count_peaks},   {"checkerboard", checkerboard_of},
                                {"load_tissue", load_tissue},   {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
