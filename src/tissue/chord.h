// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tissue/division.h"
#include "tissue/polygon.h"

namespace tunica {

/// A cell seen along its normal: its polygon in the mean plane, centroid at the origin. What division rules work on.
struct FlatCell {
  Id id;
  std::vector<Index> sides;  ///< in cyclic order
  std::vector<Vec2> points;  ///< where sides[i] starts
  Frame frame;
  double area;
  bool star_shaped;      ///< seen from the centroid, the outline runs ahead all around
  bool centroid_inside;  ///< properly: not on the outline

  /// Errors: Indivisible, the cell has no positive area.
  FlatCell(const Tissue& tissue, Index cell);
  size_t size() const { return points.size(); }
  const Vec2& from(size_t side) const { return points[side]; }
  Vec2 along(size_t side) const { return points[side + 1 < size() ? side + 1 : 0] - points[side]; }

 private:
  FlatCell(const Tissue& tissue, Index cell, const std::vector<Vec3>& corners);
};

/// Where a line through the origin crosses a side: at r times the direction.
struct Hit {
  size_t side;
  double r;
};
/// All crossings of the line through the origin along `direction`, in order along it; an even number.
std::vector<Hit> hits_along(const FlatCell& cell, const Vec2& direction);

/// The cut whose ends are where a line along `direction` crosses two sides.
Cut cut_at(const FlatCell& cell, const Vec2& direction, size_t side_a, size_t side_b);
/// Area of the piece from the crossing of side a, counter-clockwise, to that of side b, as fraction of the cell.
double share_beyond(const FlatCell& cell, const Vec2& direction, size_t side_a, size_t side_b);

/// A wall on a line through the centroid, and its length.
struct Chord {
  Cut cut;
  double length;
};
/// The walls of the rules errera() and along(), see there; with lengths in the mean plane. Errors: Indivisible.
Chord shortest_chord(const FlatCell& cell);
Chord chord_along(const FlatCell& cell, const Vec2& direction);

/// Real roots in (low, high) of the polynomial c[0] + c[1] x + ..., in order. Roots of even order may be missed.
std::vector<double> roots_between(const std::vector<double>& c, double low, double high);

}  // namespace tunica
