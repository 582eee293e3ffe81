// SPDX-License-Identifier: MIT
#include "shape/bspline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"

namespace tunica {

namespace {

using Local = std::array<Vec2, BSpline::most_degree + 1>;  ///< the control points that count at one place

void check_degree(size_t points, int degree) {
  if (degree < 1 || degree > BSpline::most_degree)
    fail("the degree of a B-spline must be from 1 to {}, not {}", BSpline::most_degree, degree);
  if (points > BSpline::most_points) fail("a B-spline has at most {} points, not {}", BSpline::most_points, points);
  if (points < static_cast<size_t>(degree) + 1)
    fail("a B-spline of degree {} needs at least {} points, not {}", degree, degree + 1, points);
}

std::vector<Vec2> with_wrap(std::vector<Vec2> points, int degree, Ends ends) {
  if (ends != Ends::closed) return points;
  if (points.size() < 3) fail("a closed curve needs at least 3 points, not {}", points.size());
  if (degree >= 1 && degree <= BSpline::most_degree)
    for (int i = 0; i < degree; ++i) points.push_back(points[static_cast<size_t>(i)]);
  return points;
}

std::vector<double> uniform_knots(size_t points, int degree, Ends ends) {
  check_degree(points, degree);
  std::vector<double> knots(points + static_cast<size_t>(degree) + 1);
  const double last = static_cast<double>(points) - degree;
  for (size_t i = 0; i < knots.size(); ++i) {
    const double at = static_cast<double>(i) - degree;
    knots[i] = ends == Ends::clamped ? std::clamp(at, 0., last) : at;
  }
  return knots;
}

/// One level of de Boor's algorithm: `points` has `degree` + 1 entries, the first of them number k - degree.
void de_boor_level(Local& points, const double* knots, size_t k, int degree, int level, double u) {
  for (int j = degree; j >= level; --j) {
    const size_t i = k - static_cast<size_t>(degree - j);
    const double low = knots[i], high = knots[i + static_cast<size_t>(degree - level + 1)];
    const double share = (u - low) / (high - low);
    auto& p = points[static_cast<size_t>(j)];
    p = (1 - share) * points[static_cast<size_t>(j) - 1] + share * p;
  }
}

}  // namespace

BSpline::BSpline(std::vector<Vec2> points, int degree, Ends ends)
    : points_(with_wrap(std::move(points), degree, ends)),
      degree_(degree),
      knots_(uniform_knots(points_.size(), degree, ends)) {
  check();
}

BSpline::BSpline(std::vector<Vec2> points, int degree, std::vector<double> knots)
    : points_(std::move(points)), degree_(degree), knots_(std::move(knots)) {
  check_degree(points_.size(), degree);
  const size_t needed = points_.size() + static_cast<size_t>(degree) + 1;
  if (knots_.size() != needed)
    fail("{} points of degree {} need {} knots, not {}", points_.size(), degree, needed, knots_.size());
  check();
}

void BSpline::check() {
  for (size_t i = 0; i < points_.size(); ++i) {
    if (!points_[i].allFinite())
      fail("point {} of the curve must be finite, not ({}, {})", i + 1, points_[i].x(), points_[i].y());
    size_ = std::max(size_, (points_[i] - points_[0]).cwiseAbs().maxCoeff());
  }
  if (!(size_ > 0)) fail("all {} points of the curve are in one place", points_.size());
  if (size_ > 1e100) fail("the curve is too large: its points are up to {:.3g} apart", size_);
  for (size_t i = 0; i < knots_.size(); ++i)
    if (!std::isfinite(knots_[i]) || (i > 0 && knots_[i] < knots_[i - 1]))
      fail("knots must be finite and not decrease; knot {} is {}", i + 1, knots_[i]);
  if (!(begin() < end())) fail("the knots of a B-spline must span more than the one place {}", begin());
  const auto p = static_cast<size_t>(degree_);
  for (size_t i = 1; i + p + 1 < knots_.size(); ++i)
    if (knots_[i] == knots_[i + p] && knots_[i] > begin() && knots_[i] < end())
      fail("the knot {} is given more than {} times: the curve would break there", knots_[i], degree_);
  for (size_t i = p; i <= points_.size(); ++i)
    if (breaks_.empty() || knots_[i] > breaks_.back()) breaks_.push_back(knots_[i]);
}

size_t BSpline::span(double u) const {
  const auto first = knots_.begin() + degree_, last = knots_.begin() + static_cast<long>(points_.size());
  auto at = std::upper_bound(first, last, u);
  if (at == last) at = std::lower_bound(first, last, *last);  // the end belongs to the last span that is not empty
  return static_cast<size_t>(std::max(at - knots_.begin(), long{degree_} + 1)) - 1;
}

Vec2 BSpline::at(double u) const {
  Vec2 point, slope;
  evaluate(u, point, slope);
  return point;
}

void BSpline::evaluate(double u, Vec2& point, Vec2& derivative) const {
  u = std::clamp(u, begin(), end());
  const size_t k = span(u);
  const auto p = static_cast<size_t>(degree_);
  Local d;
  std::copy_n(points_.begin() + static_cast<long>(k - p), p + 1, d.begin());
  for (int level = 1; level < degree_; ++level) de_boor_level(d, knots_.data(), k, degree_, level, u);
  derivative = degree_ / (knots_[k + 1] - knots_[k]) * (d[p] - d[p - 1]);
  de_boor_level(d, knots_.data(), k, degree_, degree_, u);
  point = d[p];
}

Vec2 BSpline::derivative(double u, int order) const {
  u = std::clamp(u, begin(), end());
  return derivative_in(span(u), u, order);
}

Vec2 BSpline::derivative_in(size_t k, double u, int order) const {
  if (order > degree_) return Vec2::Zero();
  Local d;
  std::copy_n(points_.begin() + static_cast<long>(k) - degree_, degree_ + 1, d.begin());
  // Control points of the derivative, then de Boor at the lower degree, on the same knots.
  for (int o = 0; o < order; ++o) {
    const int degree = degree_ - o;
    for (int j = 0; j < degree; ++j) {
      const size_t i = k - static_cast<size_t>(degree - j) + 1;
      const auto at = static_cast<size_t>(j);
      d[at] = degree / (knots_[i + static_cast<size_t>(degree)] - knots_[i]) * (d[at + 1] - d[at]);
    }
  }
  const int left = degree_ - order;
  for (int level = 1; level <= left; ++level) de_boor_level(d, knots_.data(), k, left, level, u);
  return d[static_cast<size_t>(left)];
}

/// The direction at u within a span; where the curve all but stops, that in which it leaves or reaches the nearer end
/// of the span. False: it does not move in it.
bool BSpline::direction_in(size_t k, double u, Vec2& direction) const {
  const double step = knots_[k + 1] - knots_[k];
  double scale = 1e-8 * size_ / step, sign = 1;
  direction = derivative_in(k, u, 1);
  const bool reaches = u - knots_[k] > step / 2;
  for (int order = 2; order <= degree_ && !(direction.norm() > scale); ++order) {
    if (reaches) sign = -sign;  // seen from below, even derivatives count the other way
    direction = sign * derivative_in(k, reaches ? knots_[k + 1] : knots_[k], order);
    scale /= step;
  }
  if (!(direction.norm() > scale)) return false;
  direction.normalize();
  return true;
}

Vec2 BSpline::direction(double u) const {
  u = std::clamp(u, begin(), end());
  Vec2 direction;
  size_t k = span(u);
  if (direction_in(k, u, direction)) return direction;
  while (k > static_cast<size_t>(degree_)) {
    --k;
    if (knots_[k] < knots_[k + 1] && direction_in(k, knots_[k + 1], direction)) return direction;
  }
  return Vec2::UnitX();
}

}  // namespace tunica
