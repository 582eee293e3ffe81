// SPDX-License-Identifier: MIT
#pragma once

#include "shape/bspline.h"

namespace tunica {

/// A function of one variable drawn as a clamped B-spline (x(u), y(u)) with x never decreasing, as the function editors
/// of L-Studio draw them. Outside the curve the values of its ends hold. For y at x, u is found to rounding.
class Curve {
 public:
  static constexpr int most_degree = 5;

  /// @param degree  lowered to what the points allow; one point makes a constant. Errors: no points; a point that is
  /// not
  ///                finite or lies left of the one before; more than `degree` points above each other (a jump); all of
  ///                them above each other; degree not 1 .. 5.
  explicit Curve(std::vector<Vec2> points, int degree = 3);
  static Curve constant(double value) { return Curve({{0, value}}); }
  /// Straight from point to point.
  static Curve linear(std::vector<Vec2> points) { return Curve(std::move(points), 1); }

  double operator()(double x) const;
  /// dy/dx, from the right; 0 outside; infinite where the curve is upright.
  double derivative(double x) const;
  /// The integral from `from` to `to`, exact to rounding, outside the curve too.
  double integral(double from, double to) const;

  const std::vector<Vec2>& points() const { return points_; }
  int degree() const { return degree_; }
  bool is_constant() const { return breaks_.empty(); }
  double first() const { return points_.front().x(); }  ///< where the curve starts
  double last() const { return points_.back().x(); }
  /// x at the knots, increasing: between two of them the curve is smooth. Empty if constant.
  const std::vector<double>& breaks() const { return breaks_; }
  double least() const { return least_; }  ///< the smallest value (to 1e-3 of the range of values, if inside a span)
  double greatest() const { return greatest_; }
  double least_at() const { return least_at_; }  ///< the first x where it is, as far as it is known

 private:
  struct Place {
    size_t piece;
    double s;  ///< 0 .. 1 within it
  };
  void check() const;
  void add_piece(const BSpline& spline, double from, double to);
  Place find(double x) const;
  const double* x_of(size_t piece) const { return x_.data() + piece * static_cast<size_t>(degree_ + 1); }
  const double* y_of(size_t piece) const { return y_.data() + piece * static_cast<size_t>(degree_ + 1); }
  double from_first(double x) const;
  std::vector<Vec2> points_;
  int degree_;
  // One piece between two knots: coefficients of powers of s of x, y, and of the integral of y dx since its start.
  std::vector<double> x_, y_, integral_;
  std::vector<double> breaks_;  ///< x where the pieces start, and the end of the last
  std::vector<double> before_;  ///< the integral from first() to the start of each piece, and to the end
  double least_ = 0, greatest_ = 0, least_at_ = 0;
};

}  // namespace tunica
