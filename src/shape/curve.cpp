// SPDX-License-Identifier: MIT
#include "shape/curve.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace tunica {

namespace {

/// Value and derivative of a polynomial with these coefficients.
double polynomial(const double* c, int degree, double s, double* slope = nullptr) {
  double value = c[degree], d = 0;
  for (int k = degree - 1; k >= 0; --k) {
    d = d * s + value;
    value = value * s + c[k];
  }
  if (slope) *slope = d;
  return value;
}

/// The s in [0, 1] at which an increasing polynomial has this value: Newton's method, kept within a shrinking bracket.
double solve(const double* c, int degree, double value) {
  double low = 0, high = 1;
  const double rise = polynomial(c, degree, 1) - c[0];
  double s = rise > 0 ? std::clamp((value - c[0]) / rise, 0., 1.) : 0;
  for (int i = 0; i < 100; ++i) {
    double slope;
    const double error = polynomial(c, degree, s, &slope) - value;
    if (error == 0) return s;
    (error < 0 ? low : high) = s;
    double next = slope > 0 ? s - error / slope : -1;
    if (!(next > low && next < high)) {
      if (std::abs(next - s) < 1e-16) return s;
      next = (low + high) / 2;
    }
    if (next == s || high - low < 1e-16) return next;
    if (std::abs(next - s) < 1e-15) return next;
    s = next;
  }
  return s;
}

}  // namespace

Curve::Curve(std::vector<Vec2> points, int degree) : points_(std::move(points)), degree_(degree) {
  if (degree < 1 || degree > most_degree)
    fail("the degree of a function curve must be from 1 to {}, not {}", most_degree, degree);
  check();
  least_ = greatest_ = points_[0].y();
  least_at_ = first();
  before_.push_back(0);
  if (points_.size() == 1) return;
  degree_ = std::min(degree_, static_cast<int>(points_.size()) - 1);
  const BSpline spline(points_, degree_, Ends::clamped);
  for (size_t i = 0; i + 1 < spline.breaks().size(); ++i) add_piece(spline, spline.breaks()[i], spline.breaks()[i + 1]);
  breaks_.push_back(last());
  greatest_ = std::max(greatest_, points_.back().y());
  if (points_.back().y() < least_) least_ = points_.back().y(), least_at_ = last();
}

void Curve::check() const {
  if (points_.empty()) fail("a curve needs at least one point {{ x, y }}");
  size_t above = 1;
  for (size_t i = 0; i < points_.size(); ++i) {
    const Vec2& p = points_[i];
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e100)
      fail("point {} of the curve must be finite, not ({}, {})", i + 1, p.x(), p.y());
    if (i == 0) continue;
    const Vec2& q = points_[i - 1];
    if (p.x() < q.x())
      fail(
          "x must not decrease along a function curve: point {} ({:.6g}, {:.6g}) lies left of point {} ({:.6g}, "
          "{:.6g})",
          i + 1, p.x(), p.y(), i, q.x(), q.y());
    above = p.x() == q.x() ? above + 1 : 1;
    if (above > static_cast<size_t>(degree_) && p.y() != q.y())
      fail("a function has one value at each x: {} points of the curve lie above each other at x = {:.6g}", above,
           p.x());
  }
  if (points_.size() > 1 && !(last() > first()))
    fail("all {} points of the curve lie at x = {:.6g}; it needs a width", points_.size(), first());
}

void Curve::add_piece(const BSpline& spline, double from, double to) {
  const double width = to - from;
  std::vector<double> x, y, integral(static_cast<size_t>(2 * degree_) + 1, 0.);
  double scale = 1;
  for (int order = 0; order <= degree_; ++order) {
    const Vec2 d = order == 0 ? spline.at(from) : spline.derivative(from, order);
    x.push_back(d.x() * scale);
    y.push_back(d.y() * scale);
    scale *= width / (order + 1);
  }
  if (!(polynomial(x.data(), degree_, 1) > x[0])) return;  // upright or a point: of no width
  // The end value of the piece before stands for the start of this one, so that there are no gaps of rounding.
  for (int i = 0; i <= degree_; ++i)
    for (int j = 1; j <= degree_; ++j)
      integral[static_cast<size_t>(i + j)] += y[static_cast<size_t>(i)] * x[static_cast<size_t>(j)] * j / (i + j);
  breaks_.push_back(breaks_.empty() ? first() : x[0]);
  x_.insert(x_.end(), x.begin(), x.end());
  y_.insert(y_.end(), y.begin(), y.end());
  integral_.insert(integral_.end(), integral.begin(), integral.end());
  before_.push_back(before_.back() + polynomial(integral.data(), 2 * degree_, 1));
  for (int i = 0; i <= 32; ++i) {
    const double value = polynomial(y.data(), degree_, i / 32.);
    if (value < least_) least_ = value, least_at_ = polynomial(x.data(), degree_, i / 32.);
    greatest_ = std::max(greatest_, value);
  }
}

Curve::Place Curve::find(double x) const {
  const auto at = std::upper_bound(breaks_.begin(), breaks_.end() - 1, x);
  const auto piece = static_cast<size_t>(std::max<long>(at - breaks_.begin(), 1) - 1);
  return {piece, solve(x_of(piece), degree_, x)};
}

double Curve::operator()(double x) const {
  if (is_constant() || x <= first()) return points_.front().y();
  if (x >= last()) return points_.back().y();
  const Place place = find(x);
  return polynomial(y_of(place.piece), degree_, place.s);
}

double Curve::derivative(double x) const {
  if (is_constant() || x < first() || x >= last()) return 0;
  const Place place = find(x);
  double dx, dy;
  polynomial(x_of(place.piece), degree_, place.s, &dx);
  polynomial(y_of(place.piece), degree_, place.s, &dy);
  if (dx > 1e-12 * (breaks_[place.piece + 1] - breaks_[place.piece])) return dy / dx;
  // At repeated points both vanish: the first powers of s (from here) that do not, decide.
  if (place.s > .5) return dy == 0 ? 0 : std::copysign(HUGE_VAL, dy);
  for (int k = 1; k <= degree_; ++k) {
    const double cx = x_of(place.piece)[k], cy = y_of(place.piece)[k];
    if (cx != 0) return cy / cx;
    if (cy != 0) return std::copysign(HUGE_VAL, cy);
  }
  return 0;
}

double Curve::from_first(double x) const {
  if (x <= first()) return points_.front().y() * (x - first());
  if (x >= last()) return before_.back() + points_.back().y() * (x - last());
  const Place place = find(x);
  const double* c = integral_.data() + place.piece * static_cast<size_t>(2 * degree_ + 1);
  return before_[place.piece] + polynomial(c, 2 * degree_, place.s);
}

double Curve::integral(double from, double to) const {
  if (is_constant()) return points_[0].y() * (to - from);
  if (from == first()) return from_first(to);  // without a difference: exact relative to the value near the start
  return from_first(to) - from_first(from);
}

}  // namespace tunica
