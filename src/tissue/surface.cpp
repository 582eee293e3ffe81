// SPDX-License-Identifier: MIT
#include "tissue/surface.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"
#include "tissue/polygon.h"
#include "tissue/topology.h"

namespace tunica {

namespace {

/// What is wrong with a cell after the move, or nullptr.
const char* problem_of(const Tissue& tissue, Index cell, const std::vector<Vec3>& polygon, const Vec3& outward) {
  for (const Vec3& p : polygon)
    if (!p.allFinite()) return "would have a junction at no finite place";
  const Frame frame(polygon);
  const std::vector<Vec2> flat = frame.flat(polygon);
  if (!(tissue.area(cell) > 0) || !(signed_area(flat) > 0)) return "would have no positive area";
  if (!(frame.normal.dot(outward) > 0)) return "would turn over";
  if (!is_simple(flat)) return "would cross itself";
  return nullptr;
}

/// Outward on each cell of a tissue that has been moved, by one of its corners; zero where that is at no finite place,
/// since a surface cannot be asked about that.
std::vector<Vec3> outward_of_cells(Tissue& tissue, const Surface& surface) {
  const LockWhile surface_may_be_a_script(tissue);
  std::vector<Vec3> outward;
  outward.reserve(static_cast<size_t>(tissue.cells()));
  bool finite = true;
  for (Index c = 0; c < tissue.cells(); ++c) {
    outward.push_back(tissue.position(tissue.start(tissue.first_side(c))));
    finite = finite && outward.back().allFinite();
  }
  if (finite) {
    surface.facing_all(outward);
    return outward;
  }
  for (Vec3& place : outward) place = place.allFinite() ? surface.facing(place) : Vec3(Vec3::Zero());
  return outward;
}

/// What is wrong with the first impossible cell among those that are not plain; empty: nothing.
std::string problem_of(Tissue& tissue, const Surface* surface, const std::vector<Vec3>& outward,
                       const std::vector<Index>& doubtful) {
  const LockWhile surface_may_be_a_script(tissue);
  for (const Index c : doubtful) {
    const Vec3 place = tissue.centroid(c);
    const Vec3 out = !surface            ? outward[static_cast<size_t>(c)]
                     : place.allFinite() ? surface->normal(place)
                                         : Vec3(Vec3::Zero());
    if (const char* problem = problem_of(tissue, c, tissue.polygon(c), out))
      return fmt::format("cell {} {} (near {:.4g}, {:.4g}, {:.4g})", tissue.id(Kind::cell, c), problem, place.x(),
                         place.y(), place.z());
  }
  return "";
}

}  // namespace

void move_junctions(Tissue& tissue, std::vector<Vec3> positions, const Surface* surface) {
  if (tissue.locked()) fail("a tissue cannot move while rules run");
  if (!tissue.has_geometry()) fail("a tissue without geometry (line, ring, grid, cylinder) cannot be moved");
  if (positions.size() != static_cast<size_t>(tissue.junctions()))
    fail("{} positions for {} junctions", positions.size(), tissue.junctions());
  if (surface && !surface->has_outside()) surface = nullptr;
  std::vector<Vec3> outward;
  for (Index c = 0; c < tissue.cells() && !surface; ++c) outward.push_back(tissue.normal(c));
  tissue.swap_positions(positions);  // and back, if this is not possible
  const auto go_back = [&] {
    tissue.swap_positions(positions);
    tissue.refresh_geometry();
  };
  std::string problem;
  try {
    if (surface) outward = outward_of_cells(tissue, *surface);
    std::vector<Index> doubtful;
    tissue.refresh_geometry(outward, doubtful);
    problem = problem_of(tissue, surface, outward, doubtful);
  } catch (...) {
    go_back();
    throw;
  }
  if (problem.empty()) return;
  go_back();
  fail("this movement is not possible: {}; the tissue stays as it was", problem);
}

void Surface::advance_all(std::span<Vec3> points, double t, double dt) const {
  for (Vec3& p : points) p = advance(p, t, dt);
}

void Surface::facing_all(std::span<Vec3> points) const {
  for (Vec3& p : points) p = facing(p);
}

std::vector<Vec3> advanced(Tissue& tissue, const Surface& surface, double t, double dt) {
  if (!std::isfinite(t) || !std::isfinite(dt))
    fail("time and time step of growth must be finite, not {} and {}", t, dt);
  if (!tissue.has_geometry()) fail("a tissue without geometry (line, ring, grid, cylinder) cannot grow by moving");
  if (tissue.locked()) fail("a tissue cannot grow while rules run");
  const LockWhile surface_may_be_a_script(tissue);
  std::vector<Vec3> positions;
  positions.reserve(static_cast<size_t>(tissue.junctions()));
  for (Index j = 0; j < tissue.junctions(); ++j) positions.push_back(tissue.position(j));
  surface.advance_all(positions, t, dt);
  return positions;
}

void grow(Tissue& tissue, const Surface& surface, double t, double dt) {
  move_junctions(tissue, advanced(tissue, surface, t, dt), &surface);
}

}  // namespace tunica
