// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <cmath>

#include "tissue/polygon.h"
#include "tissue/tissue.h"

namespace tunica {

namespace {

/// A flat polygon: exact, convex or not. Coordinates relative to a point of the polygon keep the digits far from 0.
Measure measure_flat(std::span<const Vec3> polygon, const Vec3& origin, const Vec3& unit) {
  double twice = 0;
  Vec3 moment = Vec3::Zero();
  Vec3 a = polygon.back() - origin;
  for (const Vec3& q : polygon) {
    const Vec3 b = q - origin;
    const double part = a.cross(b).dot(unit);
    twice += part;
    moment += part * (a + b);
    a = b;
  }
  if (twice == 0) return {0, origin};
  return {twice / 2, origin + moment / (3 * twice)};
}

/// A polygon that is not flat: fans of triangles, as MorphoGraphX measures its cells.
Measure measure_fan(std::span<const Vec3> polygon, const Vec3& average) {
  double twice = 0;
  Vec3 moment = Vec3::Zero();
  Vec3 a = polygon.back() - average;
  for (const Vec3& q : polygon) {
    const Vec3 b = q - average;
    const double part = a.cross(b).norm();
    twice += part;
    moment += part * (a + b);
    a = b;
  }
  if (twice == 0) return {0, average};
  const Vec3 centroid = average + moment / (3 * twice);
  double again = 0;
  a = polygon.back() - centroid;
  for (const Vec3& q : polygon) {
    const Vec3 b = q - centroid;
    again += a.cross(b).norm();
    a = b;
  }
  return {again / 2, centroid};
}

}  // namespace

Measure measure(std::span<const Vec3> polygon) {
  const size_t n = polygon.size();
  const Vec3 origin = polygon[0];
  Vec3 sum = Vec3::Zero();
  double reach = 0;
  bool in_plane = true;
  for (const Vec3& q : polygon) {
    const Vec3 b = q - origin;
    sum += b;
    reach = std::max(reach, b.cwiseAbs().maxCoeff());
    in_plane = in_plane && q.z() == 0;
  }
  const Vec3 average = origin + sum / static_cast<double>(n);
  if (in_plane) return measure_flat(polygon, average, Vec3::UnitZ());
  // Were all within 1e-9 of a plane, no four corners could span so much; most cells on a curved surface do.
  const double volume = (polygon[n / 4] - origin).cross(polygon[n / 2] - origin).dot(polygon[3 * n / 4] - origin);
  if (std::abs(volume) > 1e-7 * reach * reach * reach) return measure_fan(polygon, average);
  Vec3 normal = Vec3::Zero(), a = polygon.back() - origin;
  for (const Vec3& q : polygon) {
    const Vec3 b = q - origin;
    normal += a.cross(b);
    a = b;
  }
  const double norm = normal.norm();
  if (!(norm > 0)) return measure_fan(polygon, average);
  const Vec3 unit = normal / norm;
  double off = 0;
  for (const Vec3& q : polygon) off = std::max(off, std::abs((q - average).dot(unit)));
  return off <= 1e-9 * reach ? measure_flat(polygon, average, unit) : measure_fan(polygon, average);
}

void Tissue::collect_polygon(Index cell, std::vector<Vec3>& points) const {
  points.clear();
  const Index first = first_side(cell);
  Index side = first;
  do {
    points.push_back(position_[side_[side].start]);
    side = side_[side].next;
  } while (side != first);
}

void Tissue::measure_cell(Index cell, std::vector<Vec3>& points) {
  collect_polygon(cell, points);
  const Measure m = measure(points);
  area_->values[cell] = m.area;
  x_->values[cell] = m.centroid.x();
  y_->values[cell] = m.centroid.y();
  z_->values[cell] = m.centroid.z();
}

void Tissue::refresh_geometry() {
  if (!geometry_) return;
  std::vector<Vec3> points;
  for (Index cell = 0; cell < cells(); ++cell) measure_cell(cell, points);
  for (Index wall = 0; wall < walls(); ++wall) {
    const Index side = wall_side(wall, 0);
    length_->values[wall] = (position(end(side)) - position(start(side))).norm();
  }
  ++geometry_version_;
}

void Tissue::refresh_geometry(Index cell) {
  if (!geometry_) return;
  std::vector<Vec3> points;
  measure_cell(cell, points);
  const Index first = first_side(cell);
  Index side = first;
  do {
    const Index from = wall_side(wall_of(side), 0);  // the same difference, whichever side asks: the same bits
    length_->values[side_[side].wall] = (position(end(from)) - position(start(from))).norm();
    side = next(side);
  } while (side != first);
  ++geometry_version_;
}

Vec3 Tissue::normal(Index cell) const {
  if (!geometry_) return Vec3::UnitZ();
  const std::vector<Vec3> points = polygon(cell);
  Vec3 twice = Vec3::Zero();
  for (size_t i = 0; i < points.size(); ++i)
    twice += (points[i] - points[0]).cross(points[(i + 1) % points.size()] - points[0]);
  const double norm = twice.norm();
  return norm > 0 ? Vec3(twice / norm) : Vec3(Vec3::UnitZ());
}

std::vector<Vec3> Tissue::polygon(Index cell) const {
  std::vector<Vec3> points;
  if (geometry_) collect_polygon(cell, points);
  return points;
}

}  // namespace tunica
