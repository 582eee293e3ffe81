// SPDX-License-Identifier: MIT
#include "view/triangulate.h"

#include <Eigen/Geometry>
#include <cmath>

namespace tunica {
namespace {

using Vec2 = Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
double turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - b); }

/// Corners projected along the largest component of the vector area, so that they run counter-clockwise.
std::vector<Vec2> flatten(std::span<const Vector3d> corners) {
  Vector3d area = Vector3d::Zero();
  for (size_t i = 0; i < corners.size(); ++i)
    area += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  int axis;
  area.cwiseAbs().maxCoeff(&axis);
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (area[axis] < 0) std::swap(u, v);
  std::vector<Vec2> flat;
  for (const Vector3d& corner : corners) flat.emplace_back(corner[u] - corners[0][u], corner[v] - corners[0][v]);
  return flat;
}

/// No right turn, and once around only (a pentagram never turns right either).
bool is_convex(const std::vector<Vec2>& p) {
  const size_t n = p.size();
  int sign_changes = 0;
  double previous = p[0].x() - p[n - 1].x();
  for (size_t i = 0; i < n; ++i) {
    const Vec2 &a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
    if (turn(a, b, c) < 0) return false;
    const double step = b.x() - a.x();
    if (step != 0) {
      if (previous != 0 && (step > 0) != (previous > 0)) ++sign_changes;
      previous = step;
    }
  }
  return sign_changes <= 2;
}

bool inside(const Vec2& q, const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, q - a) >= 0 && cross(c - b, q - b) >= 0 && cross(a - c, q - c) >= 0;
}

/// Can the corner `i` of the rest be cut off? Corners at the same place as the ear's own do not block it.
bool is_ear(const std::vector<Vec2>& p, const std::vector<uint32_t>& rest, size_t i) {
  const size_t n = rest.size();
  const Vec2 &a = p[rest[(i + n - 1) % n]], &b = p[rest[i]], &c = p[rest[(i + 1) % n]];
  if (turn(a, b, c) <= 0) return false;
  for (size_t k = 0; k + 3 < n; ++k) {
    const Vec2& q = p[rest[(i + 2 + k) % n]];
    if (q == a || q == b || q == c) continue;
    if (inside(q, a, b, c)) return false;
  }
  return true;
}

/// Where no ear is left (only degenerate or crossing input): the flattest corner, which costs least cover.
size_t flattest(const std::vector<Vec2>& p, const std::vector<uint32_t>& rest) {
  const size_t n = rest.size();
  size_t best = 0;
  double least = INFINITY;
  for (size_t i = 0; i < n; ++i) {
    const double area = std::abs(turn(p[rest[(i + n - 1) % n]], p[rest[i]], p[rest[(i + 1) % n]]));
    if (area < least) least = area, best = i;
  }
  return best;
}

}  // namespace

std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vector3d> corners) {
  std::vector<std::array<uint32_t, 3>> triangles;
  const auto count = static_cast<uint32_t>(corners.size());
  if (count < 3) return triangles;
  triangles.reserve(count - 2);
  if (count == 3) return {{0, 1, 2}};
  const std::vector<Vec2> flat = flatten(corners);
  if (is_convex(flat)) {
    for (uint32_t i = 1; i + 1 < count; ++i) triangles.push_back({0, i, i + 1});
    return triangles;
  }
  std::vector<uint32_t> rest(count);
  for (uint32_t i = 0; i < count; ++i) rest[i] = i;
  size_t from = 0;
  while (rest.size() > 3) {
    const size_t n = rest.size();
    size_t ear = n;
    // Going on from the last cut instead of starting anew keeps the triangles from all meeting in one corner.
    for (size_t k = 0; k < n && ear == n; ++k)
      if (is_ear(flat, rest, (from + k) % n)) ear = (from + k) % n;
    if (ear == n) ear = flattest(flat, rest);
    triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
    from = ear + 1;
  }
  triangles.push_back({rest[0], rest[1], rest[2]});
  return triangles;
}

}  // namespace tunica
