// SPDX-License-Identifier: MIT
#include "tissue/polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tunica {

double signed_area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return twice / 2;
}

Vec2 centroid_of(const std::vector<Vec2>& polygon) {
  double twice = 0;
  Vec2 moment = Vec2::Zero();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    twice += cross(a, b);
    moment += cross(a, b) * (a + b);
  }
  return polygon[0] + moment / (3 * twice);
}

bool contains(const std::vector<Vec2>& polygon, const Vec2& point) {
  bool inside = false;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

namespace {

/// All turns to one side and once around: simple without looking at pairs. Most cells are.
bool is_convex(const std::vector<Vec2>& p) {
  const size_t n = p.size();
  int turning = 0, rises = 0;
  bool rising = p[0].y() < p[1].y();
  for (size_t i = 0; i < n; ++i) {
    const Vec2 a = p[(i + 1) % n] - p[i], b = p[(i + 2) % n] - p[(i + 1) % n];
    const double turn = cross(a, b);
    if (turn == 0) return false;
    if (turning == 0) turning = turn > 0 ? 1 : -1;
    if ((turn > 0) != (turning > 0)) return false;
    const bool now = p[(i + 1) % n].y() < p[(i + 2) % n].y();
    if (now != rising) ++rises;
    rising = now;
  }
  return rises <= 2;  // a star turns one way too, but rises and falls more than once
}

double side_of(const Vec2& a, const Vec2& b, const Vec2& p) { return cross(b - a, p - a); }

bool in_box(const Vec2& a, const Vec2& b, const Vec2& p) {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) && p.y() >= std::min(a.y(), b.y()) &&
         p.y() <= std::max(a.y(), b.y());
}

/// Whether segments a-b and c-d have a point in common.
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double s1 = side_of(a, b, c), s2 = side_of(a, b, d), s3 = side_of(c, d, a), s4 = side_of(c, d, b);
  if (((s1 > 0 && s2 < 0) || (s1 < 0 && s2 > 0)) && ((s3 > 0 && s4 < 0) || (s3 < 0 && s4 > 0))) return true;
  return (s1 == 0 && in_box(a, b, c)) || (s2 == 0 && in_box(a, b, d)) || (s3 == 0 && in_box(c, d, a)) ||
         (s4 == 0 && in_box(c, d, b));
}

}  // namespace

bool is_simple(const std::vector<Vec2>& polygon) {
  const size_t n = polygon.size();
  if (n < 3) return false;
  for (const Vec2& p : polygon)
    if (!std::isfinite(p.x()) || !std::isfinite(p.y())) return false;
  if (is_convex(polygon)) return true;
  for (size_t i = 0; i < n; ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[(i + 2) % n];
    if (a == b) return false;
    if (side_of(a, b, c) == 0 && (b - a).dot(c - b) < 0) return false;  // turns back on itself
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (meet(a, b, polygon[j], polygon[(j + 1) % n])) return false;
    }
  }
  return true;
}

Frame::Frame(const std::vector<Vec3>& polygon)
    : origin(polygon[0]), u(Vec3::UnitX()), v(Vec3::UnitY()), normal(Vec3::UnitZ()) {
  Vec3 twice = Vec3::Zero();
  bool in_plane = true;
  for (size_t i = 0; i < polygon.size(); ++i) {
    twice += (polygon[i] - origin).cross(polygon[(i + 1) % polygon.size()] - origin);
    in_plane = in_plane && polygon[i].z() == 0;
  }
  const double norm = twice.norm();
  if (in_plane || !(norm > 0)) return;
  normal = twice / norm;
  // The axis least along the normal gives a well-conditioned first direction.
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  u = (Vec3::Unit(least) - normal[least] * normal).normalized();
  v = normal.cross(u);
}

std::vector<Vec2> Frame::flat(const std::vector<Vec3>& points) const {
  std::vector<Vec2> result;
  result.reserve(points.size());
  for (const Vec3& p : points) result.push_back(flat(p));
  return result;
}

bool is_possible_cell(const std::vector<Vec3>& polygon) {
  if (polygon.size() < 3) return false;
  for (const Vec3& p : polygon)
    if (!p.allFinite()) return false;
  const std::vector<Vec2> flat = Frame(polygon).flat(polygon);
  return signed_area(flat) > 0 && is_simple(flat);
}

}  // namespace tunica
