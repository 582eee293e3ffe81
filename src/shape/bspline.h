// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tissue/polygon.h"

namespace tunica {

/// How a B-spline treats its ends.
enum class Ends {
  open,     ///< uniform knots: the curve ends short of its control points, unless the outermost are repeated
  clamped,  ///< it starts in the first control point and ends in the last
  closed,   ///< uniform knots, without ends
};

/// A planar B-spline curve of any degree, parameter u from begin() to end(), knot after knot. A control point that is
/// given several times draws the curve to it; as often as the degree, the curve goes through it.
class BSpline {
 public:
  static constexpr int most_degree = 24;
  static constexpr size_t most_points = 100000;

  /// Knots 0, 1, 2 ... Errors: fewer points than the degree needs (degree + 1, closed 3), degree not 1 .. 24, a
  /// coordinate that is not finite, all points in one place.
  BSpline(std::vector<Vec2> points, int degree, Ends ends);
  /// Knots as given: as many as points, and degree + 1 more. Errors: also knots that decrease, are not finite, or are
  /// so often repeated within that the curve would break.
  BSpline(std::vector<Vec2> points, int degree, std::vector<double> knots);

  int degree() const { return degree_; }
  const std::vector<double>& knots() const { return knots_; }
  /// The control points; of a closed curve with the first `degree` of them again at the end.
  const std::vector<Vec2>& points() const { return points_; }
  double begin() const { return knots_[static_cast<size_t>(degree_)]; }
  double end() const { return knots_[points_.size()]; }
  /// The different knots from begin() to end(): between two of them the curve is a polynomial.
  const std::vector<double>& breaks() const { return breaks_; }
  /// Largest distance of a coordinate from that of the first point, for tolerances.
  double size() const { return size_; }

  Vec2 at(double u) const;  ///< outside begin() .. end(): the nearer end (as everywhere)
  /// Derivative by u, from the right; at end() from the left.
  Vec2 derivative(double u, int order = 1) const;
  /// Point and first derivative at once.
  void evaluate(double u, Vec2& point, Vec2& derivative) const;
  /// Unit tangent, also where the derivative vanishes (repeated control points): the limit, from the side as above, or
  /// from the other where the curve stands still on that side.
  Vec2 direction(double u) const;

 private:
  void check();
  size_t span(double u) const;
  Vec2 derivative_in(size_t span, double u, int order) const;
  bool direction_in(size_t span, double u, Vec2& direction) const;
  std::vector<Vec2> points_;
  int degree_;
  std::vector<double> knots_, breaks_;
  double size_ = 0;
};

}  // namespace tunica
