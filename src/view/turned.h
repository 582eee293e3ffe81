// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tissue/polygon.h"
#include "view/scene.h"

namespace tunica {

/// A surface of revolution about the y axis, from samples of its profile: the point (theta, a) is
/// (x(a) cos theta, y(a), x(a) sin theta), a being the length along the profile from its start (thesis 3.1).
/// Angles are in radians. Before its start the profile stays there; beyond its end it goes straight on.
class Turned {
 public:
  /// `profile`: (x, y) from the tip outwards, x >= 0. Errors: fewer than two different points; not finite; x < 0.
  explicit Turned(const std::vector<Vec2>& profile);

  double length() const { return arcs_.back(); }
  Vec2 at(double arc) const;
  Vec2 tangent(double arc) const;  ///< unit, in the direction of growing arc
  Vec3 place(double theta, double arc) const;
  Vec3 normal(double theta, double arc) const;  ///< unit, outwards
  Vec3 along(double theta, double arc) const;   ///< unit, down the meridian
  /// The arc of the profile point closest to a point at distance `radius` from the axis.
  double closest(double radius, double y) const;
  /// The height of a place in the map of the surface that keeps angles: d(height) = d(arc) / x. On a disc it is the
  /// logarithm of the radius, on a cylinder the arc over the radius. 0 at the profile's end; less than -20 is cut off
  /// (the tip is at -infinity).
  double map_height(double arc) const;
  /// The arc between `low` and `high` (either way round) where map_height has a value, or the nearer end.
  double arc_at_map_height(double height, double low, double high) const;

 private:
  size_t segment(double arc) const;

  std::vector<Vec2> points_, tangents_;
  std::vector<double> arcs_, heights_;
};

}  // namespace tunica
