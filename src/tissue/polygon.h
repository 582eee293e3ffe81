// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "tissue/tissue.h"

namespace tunica {

using Vec2 = Eigen::Vector2d;

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Area of a plane polygon, positive if it runs counter-clockwise.
double signed_area(const std::vector<Vec2>& polygon);
/// Its area centroid. The area must not be 0.
Vec2 centroid_of(const std::vector<Vec2>& polygon);
/// Whether a point is inside (even-odd); points on the line may count as either.
bool contains(const std::vector<Vec2>& polygon, const Vec2& point);
/// Whether no two sides meet except neighbours at their common end, and none has length 0. At least three points.
bool is_simple(const std::vector<Vec2>& polygon);

struct Measure {
  double area;
  Vec3 centroid;
};
/// Area and centroid of a polygon in space, as class Tissue defines them for a cell.
Measure measure(std::span<const Vec3> polygon);

/// The mean plane of a polygon in space: through `origin`, normal to the vector area; (u, v, normal) right-handed.
/// A polygon at z = 0 keeps its x and y, whichever way it runs.
struct Frame {
  Vec3 origin, u, v, normal;
  explicit Frame(const std::vector<Vec3>& polygon);
  Vec2 flat(const Vec3& p) const { return {(p - origin).dot(u), (p - origin).dot(v)}; }
  std::vector<Vec2> flat(const std::vector<Vec3>& points) const;
};

/// Whether a polygon in space is a possible cell that faces outward beyond doubt: seen along its normal it turns left
/// at each corner and goes around once, and the normal is within 60 degrees of `outward`, the surface's anywhere on the
/// cell (any length). Most cells are, and this costs a third of looking at all that may be wrong. False: not certain.
bool is_plain_cell(std::span<const Vec3> polygon, const Vec3& outward);

/// Whether a polygon in space is a possible cell: finite, of positive area, not crossing itself in its mean plane.
bool is_possible_cell(const std::vector<Vec3>& polygon);

}  // namespace tunica
