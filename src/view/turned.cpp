// SPDX-License-Identifier: MIT
#include "view/turned.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace tunica {
namespace {

/// Integral of d(arc) / x along a straight piece from radius `from` to `to`.
double height_of_piece(double length, double from, double to, double least) {
  from = std::max(from, least), to = std::max(to, least);
  if (std::abs(to - from) < 1e-9 * std::max(from, to)) return length / (0.5 * (from + to));
  return length * std::log(to / from) / (to - from);
}

constexpr double lowest = -20;

}  // namespace

Turned::Turned(const std::vector<Vec2>& profile) {
  for (const Vec2& p : profile) {
    if (!p.allFinite()) fail("a point of the profile is not finite: ({}, {})", p.x(), p.y());
    if (p.x() < 0) fail("a profile lies at distances x >= 0 from the axis, came the point ({}, {})", p.x(), p.y());
    if (!points_.empty() && (p - points_.back()).norm() == 0) continue;
    arcs_.push_back(points_.empty() ? 0 : arcs_.back() + (p - points_.back()).norm());
    points_.push_back(p);
  }
  if (points_.size() < 2) fail("a profile needs at least two different points, came {}", points_.size());
  const size_t last = points_.size() - 1;
  for (size_t i = 0; i <= last; ++i)
    tangents_.push_back((points_[std::min(i + 1, last)] - points_[i > 0 ? i - 1 : 0]).normalized());
  // At the tip of a dome the profile and its mirror image meet in a smooth top.
  if (points_[0].x() == 0 && tangents_[0].x() > 0.7) tangents_[0] = Vec2(1, 0);
  double widest = 0;
  for (const Vec2& p : points_) widest = std::max(widest, p.x());
  if (widest == 0) fail("a profile must leave the axis somewhere; all of its points have x = 0");
  heights_.push_back(0);
  for (size_t i = 0; i < last; ++i)
    heights_.push_back(heights_.back() +
                       height_of_piece(arcs_[i + 1] - arcs_[i], points_[i].x(), points_[i + 1].x(), 1e-12 * widest));
  // Zero at the end and not at the tip, where all heights but its own are infinitely far away.
  const double zero = heights_.back();
  for (double& h : heights_) h = std::max(h - zero, lowest);
}

size_t Turned::segment(double arc) const {
  const auto after = std::upper_bound(arcs_.begin(), arcs_.end(), arc) - arcs_.begin();
  return static_cast<size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, static_cast<std::ptrdiff_t>(arcs_.size()) - 2));
}

Vec2 Turned::at(double arc) const {
  if (arc <= 0) return points_.front();
  const size_t i = segment(arc);
  const double t = (arc - arcs_[i]) / (arcs_[i + 1] - arcs_[i]);
  Vec2 p = points_[i] + t * (points_[i + 1] - points_[i]);
  p.x() = std::max(p.x(), 0.0);
  return p;
}

Vec2 Turned::tangent(double arc) const {
  if (arc <= 0) return tangents_.front();
  if (arc >= length()) return (points_.back() - points_[points_.size() - 2]).normalized();
  const size_t i = segment(arc);
  const double t = (arc - arcs_[i]) / (arcs_[i + 1] - arcs_[i]);
  const Vec2 mean = (1 - t) * tangents_[i] + t * tangents_[i + 1];
  return mean.norm() > 1e-9 ? mean.normalized() : tangents_[i];
}

Vec3 Turned::place(double theta, double arc) const {
  const Vec2 p = at(arc);
  return {p.x() * std::cos(theta), p.y(), p.x() * std::sin(theta)};
}

Vec3 Turned::normal(double theta, double arc) const {
  const Vec2 t = tangent(arc);
  return {-t.y() * std::cos(theta), t.x(), -t.y() * std::sin(theta)};
}

Vec3 Turned::along(double theta, double arc) const {
  const Vec2 t = tangent(arc);
  return {t.x() * std::cos(theta), t.y(), t.x() * std::sin(theta)};
}

double Turned::closest(double radius, double y) const {
  const Vec2 p(radius, y);
  double best = INFINITY, arc = 0;
  const size_t last = points_.size() - 2;
  for (size_t i = 0; i <= last; ++i) {
    const Vec2 d = points_[i + 1] - points_[i];
    double t = (p - points_[i]).dot(d) / d.squaredNorm();
    t = std::clamp(t, 0.0, i == last ? INFINITY : 1.0);
    const double distance = (points_[i] + t * d - p).squaredNorm();
    if (distance < best) best = distance, arc = arcs_[i] + t * (arcs_[i + 1] - arcs_[i]);
  }
  return arc;
}

double Turned::map_height(double arc) const {
  if (arc <= 0) return heights_.front();
  const size_t i = segment(arc);
  const double x = points_[i].x(), here = at(arc).x();
  const double least = 1e-12 * std::max({x, here, length()});
  return std::max(lowest, heights_[i + 1] - height_of_piece(arcs_[i + 1] - arc, here, points_[i + 1].x(), least));
}

double Turned::arc_at_map_height(double height, double low, double high) const {
  if (low > high) std::swap(low, high);
  for (int k = 0; k < 45; ++k) {
    const double middle = 0.5 * (low + high);
    (map_height(middle) < height ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace tunica
