// SPDX-License-Identifier: MIT
// Cells drawn as shapes: their fills, walls, bands, markers and labels.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "view/tissue_scene_parts.h"

namespace tunica {
namespace {

/// Rough pixels per world unit: the content fitted into what legends usually leave.
double estimated_scale(const Outlines& outlines, const Scene& scene) {
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
  for (const Vec3& p : outlines.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double size = scene.camera.extent ? 2 * *scene.camera.extent : std::max((high - low).maxCoeff(), 1e-300);
  return 0.85 * std::min(scene.width, scene.height) / size * scene.camera.zoom;
}

/// The strip along a wall, inside the cell: between the wall and its copy drawn in towards the cell's middle, so that
/// the bands of neighbouring walls meet without overlapping, however thick each is.
void add_band(const Vec3& from, const Vec3& to, const Vec3& middle, double thickness, const Colour& colour,
              Scene& scene) {
  const Vec3 along = to - from;
  const double length = along.norm();
  if (length == 0 || thickness <= 0) return;
  const double distance = along.cross(middle - from).norm() / length;
  if (distance == 0) return;
  const double t = std::min(thickness / distance, 0.75);
  const Vec3 corners[] = {from, to, to + t * (middle - to), from + t * (middle - from)};
  scene.add(scene.bands, corners, colour);
}

void add_bands(const Paint& paint, const Outlines& outlines, Scene& scene) {
  const ViewSettings& s = paint.settings;
  if (paint.sides.empty() || !(paint.sides_max > 0)) return;
  const double widest = s.sides_width * outlines.diameter;
  for (size_t cell = 0; cell + 1 < outlines.first.size(); ++cell) {
    poll(scene.cancel);
    const uint32_t first = outlines.first[cell], last = outlines.first[cell + 1];
    for (uint32_t k = first; k < last; ++k) {
      const Index side = outlines.side_of[k];
      if (side == none) continue;
      const double value = paint.sides[static_cast<size_t>(side)] / paint.sides_max;
      if (!(value > 0)) continue;
      const double share = std::min(value, 1.0);
      const Vec3 &from = outlines.points[outlines.corners[k]],
                 &to = outlines.points[outlines.corners[k + 1 < last ? k + 1 : first]];
      const Colour colour =
          s.sides_by_width ? s.sides_colour : mix(paint.of(static_cast<Index>(cell)), s.sides_colour, share);
      add_band(from, to, outlines.centres[cell], s.sides_by_width ? share * widest : 0.6 * widest, colour, scene);
    }
  }
}

/// Which edge of a square (lower, right, upper, left: 0 to 3) faces another square. One far away is met around the
/// back.
uint32_t edge_towards(const GridPlace& from, const GridPlace& to) {
  double right = to.column - from.column, up = to.row - from.row;
  if (std::abs(right) > 1) right = -right;
  if (std::abs(up) > 1) up = -up;
  return up < 0 ? 0 : right > 0 ? 1 : up > 0 ? 2 : 3;
}

Outlines with_diameter(Outlines outlines, double area) {
  outlines.diameter = std::sqrt(area / static_cast<double>(std::max<size_t>(outlines.centres.size(), 1)));
  if (!(outlines.diameter > 0)) outlines.diameter = 1;
  return outlines;
}

}  // namespace

Outlines polygon_outlines(const Tissue& tissue) {
  Outlines o;
  double area = 0;
  for (Index j = 0; j < tissue.junctions(); ++j) o.points.push_back(tissue.position(j));
  for (Index c = 0; c < tissue.cells(); ++c) {
    o.first.push_back(static_cast<uint32_t>(o.corners.size()));
    Index side = tissue.first_side(c);
    do {
      o.corners.push_back(static_cast<uint32_t>(tissue.start(side)));
      o.side_of.push_back(side);
      side = tissue.next(side);
    } while (side != tissue.first_side(c));
    o.centres.push_back(tissue.centroid(c));
    area += tissue.area(c);
  }
  o.first.push_back(static_cast<uint32_t>(o.corners.size()));
  for (Index w = 0; w < tissue.walls(); ++w) {
    const Index side = tissue.wall_side(w, 0);
    o.walls.emplace_back(tissue.start(side), tissue.end(side));
  }
  return with_diameter(std::move(o), area);
}

GridPlace place_of(const Tissue& tissue, Index cell) {
  const auto i = static_cast<size_t>(cell);
  return {tissue.find_column(Kind::cell, "row")->values[i], tissue.find_column(Kind::cell, "column")->values[i]};
}

Outlines square_outlines(const Tissue& tissue) {
  Outlines o;
  for (Index c = 0; c < tissue.cells(); ++c) {
    const GridPlace place = place_of(tissue, c);
    const auto base = static_cast<uint32_t>(o.points.size());
    o.first.push_back(base);
    for (const auto& [dx, dy] : {std::pair{-.5, -.5}, {.5, -.5}, {.5, .5}, {-.5, .5}}) {
      o.corners.push_back(static_cast<uint32_t>(o.points.size()));
      o.points.emplace_back(place.column + dx, place.row + dy, 0);
      o.side_of.push_back(none);
    }
    o.centres.emplace_back(place.column, place.row, 0);
    Index side = tissue.first_side(c);
    if (side == none) continue;
    do {
      if (const Index other = tissue.neighbour(side); other != none)
        o.side_of[base + edge_towards(place, place_of(tissue, other))] = side;
      side = tissue.next(side);
    } while (side != tissue.first_side(c));
  }
  o.first.push_back(static_cast<uint32_t>(o.corners.size()));
  for (uint32_t c = 0; c + 1 < o.first.size(); ++c) {
    const uint32_t base = o.first[c];
    for (uint32_t k = 0; k < 4; ++k) {
      // Lines shared with the next column or row are drawn by that cell (its left or lower edge).
      const Index side = o.side_of[base + k];
      const GridPlace place = place_of(tissue, static_cast<Index>(c));
      const bool shared = side != none && (k == 1 || k == 2) && [&] {
        const GridPlace other = place_of(tissue, tissue.neighbour(side));
        return k == 1 ? other.column > place.column : other.row > place.row;
      }();
      if (!shared) o.walls.emplace_back(base + k, base + (k + 1) % 4);
    }
  }
  o.diameter = 1;
  return o;
}

void add_cells(const Tissue& tissue, const Paint& paint, const Outlines& outlines, Scene& scene) {
  const double cell_pixels = outlines.diameter * estimated_scale(outlines, scene);
  scene.points = outlines.points;
  scene.indices = outlines.corners;
  for (Index c = 0; c < tissue.cells(); ++c) {
    poll(scene.cancel);
    const uint32_t first = outlines.first[static_cast<size_t>(c)];
    scene.polygons.push_back({first, outlines.first[static_cast<size_t>(c) + 1] - first, paint.of(c)});
    scene.polygons.back().smooth = paint.settings.light.value_or(false);
  }
  add_bands(paint, outlines, scene);
  // Lines around cells of a few pixels would hide their colours.
  const double automatic = cell_pixels < 5 ? 0 : std::clamp(0.03 * cell_pixels, 0.5, 1.3);
  const auto width = static_cast<float>(paint.settings.outline_width.value_or(automatic));
  if (width > 0)
    for (const auto& [from, to] : outlines.walls)
      scene.lines.push_back({outlines.points[from], outlines.points[to], paint.outline, width});
  add_marks(paint, outlines.centres, cell_pixels, scene);
}

void add_marks(const Paint& paint, const std::vector<Vec3>& centres, double cell_pixels, Scene& scene) {
  const ViewSettings& s = paint.settings;
  const double size = s.marker_size > 0 ? s.marker_size : std::clamp(0.55 * cell_pixels, 6.0, 28.0);
  for (size_t c = 0; c < s.marked.size(); ++c)
    if (s.marked[c])
      scene.markers.push_back({centres[c], s.marker, s.marker_colour, static_cast<float>(size), {1, 0, 0}});
  for (size_t c = 0; c < s.labels.size(); ++c) {
    poll(scene.cancel);
    if (s.labels[c].empty()) continue;
    const auto letters = static_cast<double>(s.labels[c].size());
    Label label{centres[c], s.labels[c], ink_for(paint.of(static_cast<Index>(c)))};
    label.size = static_cast<float>(std::clamp(std::min(0.36 * cell_pixels, 1.15 * cell_pixels / letters), 6.0, 20.0));
    scene.labels.push_back(label);
  }
}

}  // namespace tunica
