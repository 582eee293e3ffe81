// SPDX-License-Identifier: MIT
#include "tissue/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "base/error.h"
#include "tissue/builders.h"
#include "tissue/polygon.h"

namespace tunica {

namespace {

uint64_t key(Index a, Index b) { return (static_cast<uint64_t>(a) << 32) | static_cast<uint32_t>(b); }

using Loop = std::vector<Index>;

/// The outline of one cell: the edges of its triangles that run once, joined to a cycle of points.
Loop outline_of(int64_t label, const std::vector<std::array<Index, 3>>& triangles) {
  std::unordered_map<uint64_t, int> runs;
  for (const auto& t : triangles)
    for (size_t k = 0; k < 3; ++k)
      if (++runs[key(t[k], t[(k + 1) % 3])] > 1)
        fail("cell {}: two of its triangles lie on the same side of an edge", label);
  std::unordered_map<Index, Index> after;
  size_t length = 0;
  Index first = none;
  for (const auto& t : triangles)
    for (size_t k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      if (runs.count(key(b, a))) continue;
      if (!after.emplace(a, b).second) fail("cell {} touches itself in a point", label);
      if (first == none || a < first) first = a;
      ++length;
    }
  Loop loop;
  for (Index at = first; loop.size() <= length;) {
    loop.push_back(at);
    const auto next = after.find(at);
    if (next == after.end()) fail("cell {} has an outline that does not close", label);
    at = next->second;
    if (at == first) break;
  }
  if (loop.size() != length) fail("cell {} is not one disk of triangles: its outline is more than one line", label);
  return loop;
}

/// V - E + F of a cell's triangles; 1 for a disk.
long euler_of(const std::vector<std::array<Index, 3>>& triangles, size_t outline) {
  Loop corners;
  for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::sort(corners.begin(), corners.end());
  const long points = std::unique(corners.begin(), corners.end()) - corners.begin();
  const long faces = static_cast<long>(triangles.size());
  return points - (3 * faces + static_cast<long>(outline)) / 2 + faces;
}

/// Which points of the outlines are kept as junctions when walls are to be straight.
class Straightener {
 public:
  Straightener(const LabelledMesh& mesh, const std::vector<Loop>& loops) : mesh_(mesh), loops_(loops) {
    kept_.assign(mesh.points.size(), 0);
    std::unordered_map<uint64_t, int> edges;
    for (const Loop& loop : loops)
      for (size_t i = 0; i < loop.size(); ++i) ++edges[edge(loop[i], loop[(i + 1) % loop.size()])];
    std::vector<int> walls(mesh.points.size(), 0);
    for (const Loop& loop : loops)
      for (size_t i = 0; i < loop.size(); ++i) {
        const Index a = loop[i], b = loop[(i + 1) % loop.size()];
        if (edges[edge(a, b)] == 2 && a > b) continue;  // seen from the other side
        ++walls[static_cast<size_t>(a)];
        ++walls[static_cast<size_t>(b)];
      }
    for (size_t i = 0; i < walls.size(); ++i) kept_[i] = walls[i] > 2;
    for (const Loop& loop : loops) bend_border(loop, edges);
  }

  std::vector<Loop> straight() {
    // Adding a point to one cell changes its neighbours, so until nothing changes. Each round adds a point or ends.
    for (bool changed = true; changed;) {
      changed = false;
      for (const Loop& loop : loops_) changed = improve(loop) || changed;
      changed = part_twins() || changed;
    }
    std::vector<Loop> result;
    for (const Loop& loop : loops_) result.push_back(kept_of(loop));
    return result;
  }

 private:
  Loop kept_of(const Loop& loop) const {
    Loop result;
    for (const Index p : loop)
      if (kept_[static_cast<size_t>(p)]) result.push_back(p);
    return result;
  }

  bool is_possible(const Loop& loop) const {
    std::vector<Vec3> outline, whole;
    for (const Index p : kept_of(loop)) outline.push_back(point(p));
    for (const Index p : loop) whole.push_back(point(p));
    return is_possible_cell(outline) && Frame(outline).normal.dot(Frame(whole).normal) > 0;
  }

  /// A border wall may run around a corner of the tissue: it keeps the points that are far from a straight line.
  void bend_border(const Loop& loop, const std::unordered_map<uint64_t, int>& edges) {
    std::vector<Vec3> whole;
    for (const Index p : loop) whole.push_back(point(p));
    const double far = .1 * std::sqrt(std::abs(measure(whole).area));
    for (bool changed = true; changed;) {
      changed = false;
      for (const Loop& wall : walls_of(loop)) {
        if (edges.at(edge(wall[0], wall[1])) != 1) continue;
        const auto [p, distance] = farthest_on(wall);
        if (p == none || distance <= far) continue;
        kept_[static_cast<size_t>(p)] = 1;
        changed = true;
      }
    }
  }

  bool improve(const Loop& loop) {
    bool changed = false;
    while (!is_possible(loop)) {
      const Index p = farthest(loop);
      if (p == none) break;  // all points are kept; assemble() will say what is wrong
      kept_[static_cast<size_t>(p)] = 1;
      changed = true;
    }
    return changed;
  }

  /// Two walls between the same two junctions would be one line: the longer keeps its farthest point.
  bool part_twins() {
    std::map<std::pair<Index, Index>, Loop> seen;  // ends -> a point of the wall between, or none
    bool changed = false;
    for (const Loop& loop : loops_) {
      for (Loop wall : walls_of(loop)) {
        const bool turned = wall.front() > wall.back();
        if (turned) std::reverse(wall.begin(), wall.end());
        const auto [twin, is_new] = seen.try_emplace({wall.front(), wall.back()}, wall);
        if (is_new || twin->second == wall) continue;
        const Loop& longer = twin->second.size() > wall.size() ? twin->second : wall;
        const Index p = farthest_on(longer).first;
        if (p == none) continue;
        kept_[static_cast<size_t>(p)] = 1;
        changed = true;
      }
    }
    return changed;
  }

  /// The outline cut at the points that are kept: lists of points from one to the next.
  std::vector<Loop> walls_of(const Loop& loop) const {
    std::vector<Loop> walls;
    size_t start = 0;
    while (start < loop.size() && !kept_[static_cast<size_t>(loop[start])]) ++start;
    if (start == loop.size()) return {};
    for (size_t i = 0; i <= loop.size(); ++i) {
      const Index p = loop[(start + i) % loop.size()];
      if (!walls.empty()) walls.back().push_back(p);
      if (kept_[static_cast<size_t>(p)] && i < loop.size()) walls.push_back({p});
    }
    return walls;
  }

  /// The point farthest from the line between a wall's ends, and how far; none if the wall has no inner point.
  std::pair<Index, double> farthest_on(const Loop& wall) const {
    const Vec3 a = point(wall.front()), e = point(wall.back()) - a;
    Index best = none;
    double most = -1;
    for (size_t i = 1; i + 1 < wall.size(); ++i) {
      const Vec3 d = point(wall[i]) - a;
      const double square = e.squaredNorm();
      const double distance = square > 0 ? (d - d.dot(e) / square * e).norm() : d.norm();
      if (distance > most) {
        most = distance;
        best = wall[i];
      }
    }
    return {best, most};
  }

  Index farthest(const Loop& loop) const {
    const std::vector<Loop> walls = walls_of(loop);
    if (walls.empty()) return loop[0];
    std::pair<Index, double> best{none, -1};
    for (const Loop& wall : walls)
      if (const auto here = farthest_on(wall); here.second > best.second) best = here;
    return best.first;
  }

  static uint64_t edge(Index a, Index b) { return key(std::min(a, b), std::max(a, b)); }
  const Vec3& point(Index p) const { return mesh_.points[static_cast<size_t>(p)]; }
  const LabelledMesh& mesh_;
  const std::vector<Loop>& loops_;
  std::vector<char> kept_;
};

/// A flat mesh seen from below would make clockwise cells: turn it over as a whole.
void face_upwards(const LabelledMesh& mesh, std::vector<Loop>& loops) {
  double twice = 0;
  for (const Loop& loop : loops)
    for (size_t i = 0; i < loop.size(); ++i) {
      const Vec3 &p = mesh.points[static_cast<size_t>(loop[i])],
                 &q = mesh.points[static_cast<size_t>(loop[(i + 1) % loop.size()])];
      if (p.z() != 0) return;
      twice += p.x() * q.y() - p.y() * q.x();
    }
  if (twice < 0)
    for (Loop& loop : loops) std::reverse(loop.begin() + 1, loop.end());
}

}  // namespace

Tissue cells_of(const LabelledMesh& mesh, bool traced, uint64_t seed) {
  std::map<int64_t, std::vector<std::array<Index, 3>>> triangles;
  for (const auto& t : mesh.triangles)
    if (t.label > 0) triangles[t.label].push_back(t.corners);
  if (triangles.empty()) fail("the mesh has no triangle with a label: no cells");
  std::vector<Loop> loops;
  std::vector<double> labels;
  for (const auto& [label, own] : triangles) {
    loops.push_back(outline_of(label, own));
    if (euler_of(own, loops.back().size()) != 1) fail("cell {} is not one disk of triangles", label);
    labels.push_back(static_cast<double>(label));
  }
  face_upwards(mesh, loops);
  Tissue tissue = assemble(mesh.points, traced ? loops : Straightener(mesh, loops).straight(), seed);
  Column column;
  column.name = "label";
  Column& label = tissue.add_column(Kind::cell, std::move(column));
  std::copy(labels.begin(), labels.end(), label.values.begin());
  return tissue;
}

}  // namespace tunica
