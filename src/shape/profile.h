// SPDX-License-Identifier: MIT
#pragma once

#include "shape/arc_length.h"

namespace tunica {

/// The profile of a surface of revolution: a planar curve from the tip down, (x, y) = (distance from the axis, height),
/// by arc length a from its start (thesis 3.3). It may start away from the axis; the surface then has a hole at the
/// tip. Beyond its end it goes straight on (downwards, if it ends towards the axis). Places are exact to 1e-10 of its
/// length.
class Profile {
 public:
  /// Errors: a curve that crosses the axis (x < 0), that rises (it must start at its top), that turns back on itself,
  /// or whose length is not positive.
  explicit Profile(BSpline curve);
  /// A part of a sphere around a point of the axis, from the tip until it falls by `slope` (radians, above 0, at most
  /// pi/2), then straight, until `length` in all. Exact.
  static Profile cap(double radius, double slope, double length);
  /// From one point straight to another. Exact.
  static Profile line(const Vec2& from, const Vec2& to) { return Profile(BSpline({from, to}, 1, Ends::clamped)); }

  double length() const { return arc_.length(); }
  Vec2 at(double a) const;       ///< a below 0: the start
  Vec2 tangent(double a) const;  ///< unit, in the sense of growing a; at a corner that of what follows
  /// The area of the surface from its start to a: the integral of 2 pi x da.
  double area(double a) const;
  /// The first a with x(a) = r. Errors: r beyond the widest place, or within the hole.
  double arc_at_radius(double r) const;
  /// The a of the point nearest to p, the smallest of several.
  double closest(const Vec2& p) const;

  /// Arc lengths from 0 to length(): between two of them the profile is smooth.
  std::vector<double> breaks() const;
  double hole() const { return start_.x(); }  ///< radius of the hole at the tip; 0: none
  bool has_hole() const { return hole() > 0; }
  double widest() const { return widest_; }  ///< largest x on the curve, its continuation not counted
  /// The control points, of a profile made from a curve.
  const std::optional<BSpline>& curve() const { return arc_.curve(); }

 private:
  explicit Profile(ArcLength arc);
  double ring(double u) const;  ///< of the area, per u
  double area_between(double from, double to) const;
  void measure_area();
  void check() const;

  ArcLength arc_;
  std::vector<double> areas_;  ///< from the start to each panel of arc_, and to the end of the last
  Vec2 start_, end_, onward_;  ///< onward: direction beyond the end
  double widest_ = 0;
};

}  // namespace tunica
