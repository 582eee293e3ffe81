// SPDX-License-Identifier: MIT
#include "tissue/order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tissue/polygon.h"
#include "tissue/topology.h"

namespace tunica {

void renumber(Tissue& tissue, const std::vector<Index>& order) {
  TissueEditor editor(tissue);
  editor.renumber(Kind::cell, order);
  std::vector<Index> sides;
  for (Index cell = 0; cell < tissue.cells(); ++cell) {
    const Index first = tissue.first_side(cell);
    if (first == none) continue;
    Index side = first;
    do sides.push_back(side);
    while ((side = tissue.next(side)) != first);
  }
  editor.renumber(Kind::side, sides);
  std::vector<Index> walls, junctions;
  std::vector<char> wall_seen(static_cast<size_t>(tissue.walls())),
      junction_seen(static_cast<size_t>(tissue.junctions()));
  for (Index side = 0; side < tissue.sides(); ++side) {
    char& wall = wall_seen[static_cast<size_t>(tissue.wall_of(side))];
    if (!wall) walls.push_back(tissue.wall_of(side));
    wall = 1;
    if (!tissue.has_geometry()) continue;
    char& junction = junction_seen[static_cast<size_t>(tissue.start(side))];
    if (!junction) junctions.push_back(tissue.start(side));
    junction = 1;
  }
  editor.renumber(Kind::wall, walls);
  editor.renumber(Kind::junction, junctions);
}

namespace {

/// Place of (x, y), 16 bits each, along the Hilbert curve.
uint64_t along_hilbert(uint32_t x, uint32_t y) {
  uint64_t place = 0;
  for (uint32_t s = 1u << 15; s > 0; s >>= 1) {
    const uint32_t rx = (x & s) ? 1 : 0, ry = (y & s) ? 1 : 0;
    place += static_cast<uint64_t>(s) * s * ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx == 1) {
        x = 0xffff - x;
        y = 0xffff - y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

/// Where each cell lies in a plane; cells of a curved tissue are seen along the mean normal.
std::vector<Vec2> places(const Tissue& tissue) {
  std::vector<Vec2> result;
  if (!tissue.has_geometry()) {
    const Column* row = tissue.find_column(Kind::cell, "row");
    const Column* column = tissue.find_column(Kind::cell, "column");
    for (size_t c = 0; c < static_cast<size_t>(tissue.cells()); ++c)
      result.emplace_back(column->values[c], row->values[c]);
    return result;
  }
  Vec3 mean = Vec3::Zero();
  for (Index c = 0; c < tissue.cells(); ++c) {
    // A cell in the plane, at z = 0, need not be asked.
    mean += tissue.centroid(c).z() == 0 ? Vec3(0, 0, tissue.area(c)) : Vec3(tissue.area(c) * tissue.normal(c));
  }
  const double norm = mean.norm();
  const Vec3 n = norm > 0 ? Vec3(mean / norm) : Vec3(Vec3::UnitZ());
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Vec3 u = (Vec3::Unit(least) - n[least] * n).normalized(),
             v(n.y() * u.z() - n.z() * u.y(), n.z() * u.x() - n.x() * u.z(), n.x() * u.y() - n.y() * u.x());
  for (Index c = 0; c < tissue.cells(); ++c) result.emplace_back(tissue.centroid(c).dot(u), tissue.centroid(c).dot(v));
  return result;
}

}  // namespace

void renumber_along_curve(Tissue& tissue) {
  const std::vector<Vec2> at = places(tissue);
  if (at.empty()) return;
  Vec2 low = at[0], high = at[0];
  for (const Vec2& p : at) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = std::max((high - low).maxCoeff(), 1e-300);
  std::vector<std::pair<uint64_t, Index>> keyed;
  for (size_t c = 0; c < at.size(); ++c) {
    const Vec2 p = (at[c] - low) / extent * 65535;
    keyed.emplace_back(along_hilbert(static_cast<uint32_t>(p.x()), static_cast<uint32_t>(p.y())),
                       static_cast<Index>(c));
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<Index> order;
  for (const auto& [place, cell] : keyed) order.push_back(cell);
  renumber(tissue, order);
}

}  // namespace tunica
