// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "shape/bspline.h"

namespace tunica {

/// A planar curve by arc length a, from 0 at its start to length() at its end: any B-spline, open or closed, or a part
/// of a circle that goes on straight. Places are exact to 1e-10 of its length. Cheap to move.
class ArcLength {
 public:
  /// A part of a circle from (0, 0), there level and turning down, until its slope is `slope`; then straight.
  struct Cap {
    double radius, slope;
  };
  /// The curve is smooth between two of these places, and Gauss's rule of 12 points gives its length there.
  struct Panel {
    double u, a;  ///< parameter, arc length since the start
  };
  struct Sample {
    double u, a;
    Vec2 point;
  };
  struct Nearest {
    double a, distance;
  };

  /// Errors: a curve without length.
  explicit ArcLength(BSpline curve);
  ArcLength(const Cap& cap, double length);

  double length() const { return panels_.back().a; }
  double size() const { return size_; }  ///< of a B-spline as there; else the length: for tolerances
  Vec2 at(double a) const { return point_at(parameter(a)); }
  /// Unit, in the sense of growing a; at a corner that of what follows.
  Vec2 tangent(double a) const { return direction(parameter(a)); }
  /// The place of the curve nearest to p, the smallest a of several.
  Nearest nearest(const Vec2& p) const;
  /// The area between the curve and the straight line from its end to its start, positive where the curve runs
  /// counter-clockwise around it; exact.
  double area() const;

  /// The parameter at an arc length, which is taken to be from 0 to length().
  double parameter(double a) const;
  double arc(double u) const;
  void evaluate(double u, Vec2& point, Vec2& derivative) const;
  Vec2 point_at(double u) const;
  Vec2 direction(double u) const;
  double begin() const { return panels_.front().u; }
  double end() const { return panels_.back().u; }
  const std::optional<BSpline>& curve() const { return curve_; }
  /// The starts of the panels, and the end of the last.
  const std::vector<Panel>& panels() const { return panels_; }
  size_t panel_at(double a) const;
  /// Evenly in each panel, and the places where x is largest or least.
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  void measure(const std::vector<double>& breaks);
  void add_panels(double from, double to, int depth);
  void take_samples();
  double length_between(double from, double to) const;
  double speed(double u) const;
  std::optional<double> nearest_between(const Vec2& p, double low, double high) const;

  std::optional<BSpline> curve_;
  Cap cap_{};
  std::vector<Panel> panels_;
  std::vector<Sample> samples_;
  double size_ = 1;
};

}  // namespace tunica
