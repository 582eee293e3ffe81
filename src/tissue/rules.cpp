// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "base/error.h"
#include "tissue/chord.h"
#include "tissue/division.h"

namespace tunica {

namespace {

void require_geometry(const Tissue& tissue) {
  if (!tissue.has_geometry()) fail("cells without geometry (line, ring, grid, cylinder) cannot be divided by a wall");
}

struct Nearest {
  size_t side = 0;
  double at = 0;
  double distance = std::numeric_limits<double>::infinity();
};

/// The point of a closed polygon nearest to p.
template <class Vec>
Nearest nearest_on(const std::vector<Vec>& polygon, const Vec& p) {
  Nearest best;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec e = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double square = e.squaredNorm();
    const double at = square > 0 ? std::clamp((p - polygon[i]).dot(e) / square, 0., 1.) : 0;
    const double distance = (polygon[i] + at * e - p).norm();
    if (distance < best.distance) best = {i, at, distance};
  }
  return best;
}

}  // namespace

Cut errera(const Tissue& tissue, Index cell) {
  require_geometry(tissue);
  return shortest_chord(FlatCell(tissue, cell)).cut;
}

Cut closest_wall(const Tissue& tissue, Index cell) {
  require_geometry(tissue);
  const FlatCell flat(tissue, cell);
  const Nearest near = nearest_on(flat.points, Vec2(Vec2::Zero()));
  const Vec2 wall = flat.along(near.side);
  Vec2 direction = flat.from(near.side) + near.at * wall;
  // On the wall itself there is no line to it; at right angles to it is the limit.
  if (near.distance < 1e-9 * std::sqrt(flat.area)) direction = Vec2(-wall.y(), wall.x());
  return chord_along(flat, direction).cut;
}

DivisionRule along(const Vec3& direction) {
  if (!direction.allFinite() || !(direction.norm() > 0))
    fail("the direction of division must have a length, not ({}, {}, {})", direction.x(), direction.y(), direction.z());
  return [unit = Vec3(direction.normalized())](const Tissue& tissue, Index cell) {
    require_geometry(tissue);
    const FlatCell flat(tissue, cell);
    const Vec2 in_plane(unit.dot(flat.frame.u), unit.dot(flat.frame.v));
    if (in_plane.norm() < 1e-6)
      throw Indivisible(fmt::format("the direction of division is at right angles to cell {}", flat.id));
    return chord_along(flat, in_plane).cut;
  };
}

Cut cut_between(const Tissue& tissue, Index cell, const Vec3& p, const Vec3& q) {
  require_geometry(tissue);
  const FlatCell flat(tissue, cell);
  const std::vector<Vec3> polygon = tissue.polygon(cell);
  double width = 0;
  for (const Vec3& corner : polygon) width = std::max(width, 2 * (corner - tissue.centroid(cell)).norm());
  Nearest ends[2];
  for (int i = 0; i < 2; ++i) {
    const Vec3& point = i == 0 ? p : q;
    if (!point.allFinite())
      fail("an end of the dividing wall is not finite: ({}, {}, {})", point.x(), point.y(), point.z());
    ends[i] = nearest_on(polygon, point);
    if (ends[i].distance > width)
      fail("an end of the dividing wall, ({:.4g}, {:.4g}, {:.4g}), is far from cell {}", point.x(), point.y(),
           point.z(), tissue.id(Kind::cell, cell));
  }
  if (ends[0].side == ends[1].side)
    throw Indivisible(fmt::format("both ends of the dividing wall lie on the same wall of cell {}", flat.id));
  return {flat.sides[ends[0].side], ends[0].at, flat.sides[ends[1].side], ends[1].at};
}

DivisionRule division_rule(const std::string& name) {
  if (name == "errera") return errera;
  if (name == "closest_wall") return closest_wall;
  fail("there is no division rule '{}'{}; the rules are 'errera' and 'closest_wall'", name,
       did_you_mean(name, {"errera", "closest_wall"}));
}

}  // namespace tunica
