// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "tissue/outline_kernels.h"
#include "tissue/polygon.h"
#include "tissue/tissue.h"

namespace tunica {

namespace {

inline double root(double x) { return std::sqrt(x); }
inline double magnitude(double x) { return std::abs(x); }
inline double greater(double a, double b) { return a > b ? a : b; }
inline double choose(bool mask, double yes, double no) { return mask ? yes : no; }

#include "tissue/outline.inl"

/// One outline.
struct Outline {
  std::span<const Vec3> polygon;
  int count = static_cast<int>(polygon.size());
  Point<double> at(int i) const {
    const Vec3& p = polygon[static_cast<size_t>(i)];
    return {p.x(), p.y(), p.z()};
  }
  Point<double> corner(int i) const { return at(i < count ? i : 0); }
  Point<double> quarter(int quarters) const { return at(quarters * count / 4); }
  Point<double> last() const { return at(count - 1); }
  bool has(int i) const { return i < count; }
};

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

/// Whether all corners are within 1e-9 of their reach of one plane; then its unit normal is set.
bool is_flat(std::span<const Vec3> polygon, const Vec3& average, Vec3& unit) {
  const Vec3& origin = polygon[0];
  Vec3 normal = Vec3::Zero(), a = polygon.back() - origin;
  double reach = 0, off = 0;
  for (const Vec3& q : polygon) {
    const Vec3 b = q - origin;
    normal += a.cross(b);
    reach = std::max(reach, b.cwiseAbs().maxCoeff());
    a = b;
  }
  const double norm = normal.norm();
  if (!(norm > 0)) return false;
  unit = normal / norm;
  for (const Vec3& q : polygon) off = std::max(off, std::abs((q - average).dot(unit)));
  return off <= 1e-9 * reach;
}

}  // namespace

Measure measure(std::span<const Vec3> polygon) {
  const Outline outline{polygon};
  const auto [middle, in_plane, not_flat] = spread<double, bool>(outline, static_cast<double>(polygon.size()));
  const Vec3 average(middle.x, middle.y, middle.z);
  if (in_plane) return measure_flat(polygon, average, Vec3::UnitZ());
  Vec3 unit;
  if (!not_flat && is_flat(polygon, average, unit)) return measure_flat(polygon, average, unit);
  const auto [area, centroid] = measure_fan<double>(outline, middle);
  return {area, {centroid.x, centroid.y, centroid.z}};
}

bool is_plain_cell(std::span<const Vec3> polygon, const Vec3& outward) {
  return polygon.size() >= 3 && is_plain<bool>(Outline{polygon}, Point<double>{outward.x(), outward.y(), outward.z()});
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

/// The outlines of cells from `first` on, the last repeated if there are fewer than four; false: too many corners.
bool Tissue::collect_outlines(Index first, FourOutlines& o) const {
  Index at[4], begin[4];
  for (int k = 0; k < 4; ++k) {
    at[k] = begin[k] = cell_side_[std::min(first + k, cells() - 1)];
    o.corners[k] = 0;
  }
  // Around all four at once: each step waits for memory, and so they wait together.
  int i = 0;
  for (int open = 4; open > 0; ++i) {
    if (i == FourOutlines::most) return false;
    for (int k = 0; k < 4; ++k) {
      const Side& side = side_[at[k]];
      const Vec3& p = position_[side.start];
      o.x[i][k] = p.x(), o.y[i][k] = p.y(), o.z[i][k] = p.z();
      if (o.corners[k] > 0) continue;  // around already, and back at its first corner
      at[k] = side.next;
      if (at[k] == begin[k]) o.corners[k] = i + 1, --open;
    }
  }
  o.count = i;
  for (int k = 0; k < 4; ++k) o.x[i][k] = o.x[0][k], o.y[i][k] = o.y[0][k], o.z[i][k] = o.z[0][k];
  return true;
}

void Tissue::measure_walls() {
  for (Index wall = 0; wall < walls(); ++wall) {
    const Index side = wall_side(wall, 0);
    length_->values[wall] = (position(end(side)) - position(start(side))).norm();
  }
}

void Tissue::refresh_geometry() {
  if (geometry_) measure_all(nullptr, nullptr);
}

void Tissue::refresh_geometry(const std::vector<Vec3>& outward, std::vector<Index>& doubtful) {
  if (geometry_) measure_all(&outward, &doubtful);
}

void Tissue::measure_all(const std::vector<Vec3>* outward, std::vector<Index>* doubtful) {
  const OutlineKernels& kernels = outline_kernels();
  FourOutlines outlines;
  FourMeasures m;
  std::vector<Vec3> points;
  alignas(32) double facing[3][4];
  for (Index first = 0; first < cells(); first += 4) {
    const bool together = collect_outlines(first, outlines);
    const int certain = together ? kernels.measure(outlines, m) : 0;
    for (int k = 0; outward && k < 4; ++k) {
      const Vec3& out = (*outward)[static_cast<size_t>(std::min(first + k, cells() - 1))];
      for (int axis = 0; axis < 3; ++axis) facing[axis][k] = out[axis];
    }
    const int plain = together && outward ? kernels.plain(outlines, facing) : 0;
    for (int k = 0; k < 4 && first + k < cells(); ++k) {
      const Index cell = first + k;
      if (certain & 1 << k)
        area_->values[cell] = m.area[k], x_->values[cell] = m.x[k], y_->values[cell] = m.y[k],
        z_->values[cell] = m.z[k];
      else
        measure_cell(cell, points);
      if (outward && !(plain & 1 << k && area(cell) > 0)) doubtful->push_back(cell);
    }
  }
  measure_walls();
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
