// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

#include "base/error.h"
#include "tissue/builders.h"
#include "tissue/polygon.h"
#include "tissue/topology.h"

namespace tunica {

namespace {

using Face = std::vector<Index>;

void check_face(const std::vector<Vec3>& points, const Face& face, size_t number) {
  for (const Index corner : face)
    if (corner < 0 || static_cast<size_t>(corner) >= points.size())
      fail("polygon {} has a corner number {}, but there are {} points", number, corner, points.size());
  Face sorted = face;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    fail("polygon {} comes to the same corner twice", number);
  if (face.size() < 3) fail("polygon {} has {} different corners; a cell needs at least 3", number, face.size());
  std::vector<Vec3> outline;
  for (const Index corner : face) outline.push_back(points[static_cast<size_t>(corner)]);
  for (const Vec3& p : outline)
    if (!p.allFinite()) fail("polygon {} has a corner at ({}, {}, {})", number, p.x(), p.y(), p.z());
  const std::vector<Vec2> flat = Frame(outline).flat(outline);
  if (!is_simple(flat)) fail("polygon {} crosses or touches itself", number);
  if (!(signed_area(flat) > 0)) fail("polygon {} has no area, or runs clockwise", number);
}

uint64_t key(Index a, Index b) { return (static_cast<uint64_t>(a) << 32) | static_cast<uint32_t>(b); }

}  // namespace

Tissue assemble(const std::vector<Vec3>& points, const std::vector<Face>& cells, uint64_t seed,
                const CancelFlag* cancel) {
  for (size_t i = 0; i < cells.size(); ++i) {
    poll(cancel);
    check_face(points, cells[i], i + 1);
  }
  Tissue tissue(true, seed);
  TissueEditor editor(tissue);
  std::vector<Index> junction(points.size(), none);  // points that no cell uses stay out
  std::unordered_map<uint64_t, Index> side_from_to;
  for (size_t i = 0; i < cells.size(); ++i) {
    poll(cancel);
    const Index cell = editor.add_cell();
    const Face& face = cells[i];
    for (size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k], b = face[(k + 1) % face.size()];
      const auto taken = side_from_to.find(key(a, b));
      if (taken != side_from_to.end()) {
        const Vec3 &p = points[static_cast<size_t>(a)], &q = points[static_cast<size_t>(b)];
        fail(
            "polygons {} and {} lie on the same side of the wall from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}): they "
            "overlap, "
            "or one is turned over",
            tissue.cell_of(taken->second) + 1, i + 1, p.x(), p.y(), q.x(), q.y());
      }
      Index& start = junction[static_cast<size_t>(a)];
      if (start == none) start = editor.add_junction(points[static_cast<size_t>(a)]);
      const auto facing = side_from_to.find(key(b, a));
      const Index wall = facing == side_from_to.end() ? editor.add_wall() : tissue.wall_of(facing->second);
      side_from_to[key(a, b)] = editor.add_side(cell, wall, start);
    }
  }
  editor.separate_fans();
  tissue.refresh_geometry();
  return tissue;
}

// === From points

namespace {

/// Numbers points so that those nearer than the tolerance to an earlier one share its number.
class Welder {
 public:
  explicit Welder(double tolerance) : tolerance_(tolerance) {}

  Index number(const Vec3& p) {
    const std::array<int64_t, 3> box = box_of(p);
    for (int64_t x = box[0] - 1; x <= box[0] + 1; ++x)
      for (int64_t y = box[1] - 1; y <= box[1] + 1; ++y)
        for (int64_t z = box[2] - 1; z <= box[2] + 1; ++z) {
          const auto found = in_box_.find({x, y, z});
          if (found == in_box_.end()) continue;
          for (const Index i : found->second)
            if ((points[static_cast<size_t>(i)] - p).norm() <= tolerance_) return i;
        }
    in_box_[box].push_back(static_cast<Index>(points.size()));
    points.push_back(p);
    return static_cast<Index>(points.size()) - 1;
  }

  std::vector<Vec3> points;

 private:
  std::array<int64_t, 3> box_of(const Vec3& p) const {
    std::array<int64_t, 3> box;
    for (int i = 0; i < 3; ++i) box[static_cast<size_t>(i)] = static_cast<int64_t>(std::floor(p[i] / (2 * tolerance_)));
    return box;
  }
  double tolerance_;
  std::map<std::array<int64_t, 3>, std::vector<Index>> in_box_;
};

void check_corner(const Vec3& p, double tolerance, size_t polygon) {
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e15 * tolerance)
    fail("polygon {} has a corner at ({}, {}, {}), too far for a tolerance of {}", polygon, p.x(), p.y(), p.z(),
         tolerance);
}

}  // namespace

Tissue polygons(const std::vector<std::vector<Vec3>>& cells, double tolerance, uint64_t seed,
                const CancelFlag* cancel) {
  if (!(tolerance > 0) || !std::isfinite(tolerance)) fail("the tolerance must be positive, not {}", tolerance);
  Welder welder(tolerance);
  std::vector<Face> faces;
  for (size_t i = 0; i < cells.size(); ++i) {
    poll(cancel);
    Face face;
    bool in_plane = true;
    for (const Vec3& p : cells[i]) {
      check_corner(p, tolerance, i + 1);
      in_plane = in_plane && p.z() == 0;
      const Index corner = welder.number(p);
      if (face.empty() || face.back() != corner) face.push_back(corner);
    }
    while (face.size() > 1 && face.front() == face.back())
      face.pop_back();  // a closed list names the first point again
    std::vector<Vec2> flat;
    for (const Index corner : face) flat.push_back(welder.points[static_cast<size_t>(corner)].head<2>());
    if (in_plane && face.size() >= 3 && signed_area(flat) < 0) std::reverse(face.begin() + 1, face.end());
    faces.push_back(std::move(face));
  }
  return assemble(welder.points, faces, seed, cancel);
}

// === Regular patches

namespace {

void require_cells(int64_t cells) {
  if (cells > 2'000'000) fail("a patch can have at most 2000000 cells, not {}", cells);
}

void require_size(int64_t n, int64_t least, const char* what) {
  if (n < least || n > 2'000'000) fail("{} must be between {} and 2000000, not {}", what, least, n);
}

/// Hexagons with a corner on top. Centres and corners are integers on a lattice of half a cell's width by half its
/// side, so that corners of neighbours agree exactly.
class HexagonLattice {
 public:
  explicit HexagonLattice(double area) {
    if (!(area > 0) || !std::isfinite(area)) fail("the area of a cell must be positive, not {}", area);
    side_ = std::sqrt(2 * area / (3 * std::numbers::sqrt3));
  }
  void add(int64_t x, int64_t y) {
    constexpr int64_t corners[6][2] = {{1, -1}, {1, 1}, {0, 2}, {-1, 1}, {-1, -1}, {0, -2}};
    Face face;
    for (const auto& [dx, dy] : corners) face.push_back(corner(x + dx, y + dy));
    faces_.push_back(std::move(face));
  }
  Tissue build(uint64_t seed, const CancelFlag* cancel) const { return assemble(points_, faces_, seed, cancel); }

 private:
  Index corner(int64_t x, int64_t y) {
    const auto [at, is_new] = number_.try_emplace({x, y}, static_cast<Index>(points_.size()));
    if (is_new)
      points_.emplace_back(static_cast<double>(x) * side_ * std::numbers::sqrt3 / 2, static_cast<double>(y) * side_ / 2,
                           0);
    return at->second;
  }
  double side_;
  std::vector<Vec3> points_;
  std::vector<Face> faces_;
  std::map<std::pair<int64_t, int64_t>, Index> number_;
};

}  // namespace

Tissue squares(int64_t nx, int64_t ny, uint64_t seed, const CancelFlag* cancel) {
  require_size(nx, 1, "the number of columns");
  require_size(ny, 1, "the number of rows");
  require_cells(nx * ny);
  std::vector<Vec3> points;
  for (int64_t y = 0; y <= ny; ++y)
    for (int64_t x = 0; x <= nx; ++x) points.emplace_back(static_cast<double>(x), static_cast<double>(y), 0);
  std::vector<Face> faces;
  const auto corner = [&](int64_t x, int64_t y) { return static_cast<Index>(y * (nx + 1) + x); };
  for (int64_t y = 0; y < ny; ++y)
    for (int64_t x = 0; x < nx; ++x)  // the side to the next column comes first, as in grid()
      faces.push_back({corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1), corner(x, y)});
  return assemble(points, faces, seed, cancel);
}

Tissue hexagons(int64_t nx, int64_t ny, double area, uint64_t seed, const CancelFlag* cancel) {
  require_size(nx, 1, "the number of columns");
  require_size(ny, 1, "the number of rows");
  require_cells(nx * ny);
  HexagonLattice lattice(area);
  for (int64_t y = 0; y < ny; ++y) {
    poll(cancel);
    for (int64_t x = 0; x < nx; ++x) lattice.add(2 * x + y % 2, 3 * y);
  }
  return lattice.build(seed, cancel);
}

Tissue hexagon_disk(int64_t radius, double area, uint64_t seed, const CancelFlag* cancel) {
  require_size(radius, 0, "the number of rings of hexagons");
  require_cells(1 + 3 * radius * (radius + 1));
  HexagonLattice lattice(area);
  for (int64_t r = -radius; r <= radius; ++r) {
    poll(cancel);
    for (int64_t q = -radius; q <= radius; ++q)
      if (std::abs(q + r) <= radius) lattice.add(2 * q + r, 3 * r);
  }
  return lattice.build(seed, cancel);
}

Tissue polygon(int sides, double area, uint64_t seed) {
  if (sides < 3 || sides > 1000) fail("a polygon has between 3 and 1000 sides, not {}", sides);
  if (!(area > 0) || !std::isfinite(area)) fail("the area of a cell must be positive, not {}", area);
  const double turn = 2 * std::numbers::pi / sides, radius = std::sqrt(2 * area / (sides * std::sin(turn)));
  std::vector<Vec3> points;
  Face face;
  for (int i = 0; i < sides; ++i) {
    points.emplace_back(radius * std::cos(turn * (i + .5)), radius * std::sin(turn * (i + .5)), 0);
    face.push_back(i);
  }
  return assemble(points, {face}, seed);
}

}  // namespace tunica
