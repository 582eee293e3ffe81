// SPDX-License-Identifier: MIT
// Tissues without geometry: bars for a row of cells, a surface through the places that a function gives.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "view/legend.h"
#include "view/text.h"
#include "view/tissue_scene_parts.h"

namespace tunica {
namespace {

bool has_rows(const Tissue& tissue) {
  return tissue.find_column(Kind::cell, "row") && tissue.find_column(Kind::cell, "column");
}

bool one_row(const Tissue& tissue) {
  for (Index c = 1; c < tissue.cells(); ++c)
    if (place_of(tissue, c).row != place_of(tissue, 0).row) return false;
  return true;
}

/// Vertical axis of bars: values from `low` to `high` take the world's height from 0 to `top`.
void add_axis(const Paint& paint, double low, double high, double left, double right, double top, Scene& scene) {
  const Colour ink = ink_for(scene.background);
  const double font = std::clamp(std::min(scene.width, scene.height) / 25.0, 9.0, 72.0);
  scene.font_size = static_cast<float>(font);
  double widest = 0;
  scene.lines.push_back({{left, 0, 0}, {left, top, 0}, ink, 1.2f});
  const double zero = std::clamp((0 - low) / (high - low), 0.0, 1.0) * top;
  scene.lines.push_back({{left, zero, 0}, {right, zero, 0}, ink, 1.2f});
  const double tick_length = 0.006 * (right - left);
  for (const Tick& tick : ticks_between(low, high, 4)) {
    const double y = (tick.value - low) / (high - low) * top;
    scene.lines.push_back({{left - tick_length, y, 0}, {left, y, 0}, ink, 1.2f});
    Label label{{left - tick_length, y, 0}, tick.text, ink};
    label.across = Label::Across::right;
    label.right = static_cast<float>(-0.3 * font);
    scene.labels.push_back(label);
    widest = std::max(widest, text_width(tick.text, font));
  }
  const Field& colour = paint.settings.colour;
  const std::string title = colour.title.empty() ? colour.column : colour.title;
  if (!title.empty()) {
    Label label{{left, top, 0}, title, ink};
    label.across = Label::Across::left;
    label.along = Label::Along::bottom;
    label.down = static_cast<float>(-0.7 * font);
    scene.labels.push_back(label);
    scene.pad_top = static_cast<float>(1.5 * font);
  }
  scene.pad_left = static_cast<float>(widest + 0.5 * font);
}

struct Bar {
  double left, right, foot, head;
};

/// What a cell holds at its two ends, as bands inside the bar; the bar's own colour stays visible between.
void add_bar_sides(const Tissue& tissue, const Paint& paint, Index cell, const Bar& bar, Scene& scene) {
  const Index first = tissue.first_side(cell);
  if (paint.sides.empty() || !(paint.sides_max > 0) || first == none) return;
  const double column = place_of(tissue, cell).column;
  Index side = first;
  do {
    const Index other = tissue.neighbour(side);
    const double offset = other == none ? 0 : place_of(tissue, other).column - column;
    const bool rightwards = std::abs(offset) > 1 ? offset < 0 : offset > 0;
    const double share = std::clamp(paint.sides[static_cast<size_t>(side)] / paint.sides_max, 0.0, 1.0);
    const double width = 0.4 * (bar.right - bar.left) * share;
    if (width > 0 && offset != 0) {
      const double from = rightwards ? bar.right - width : bar.left, to = from + width;
      const Vec3 corners[] = {{from, bar.foot, 0}, {to, bar.foot, 0}, {to, bar.head, 0}, {from, bar.head, 0}};
      scene.add(scene.bands, corners, paint.settings.sides_colour);
    }
    side = tissue.next(side);
  } while (side != first);
}

using Cells = std::map<std::pair<double, double>, Index>;

/// Four triangles around the middle of four cells: colours run evenly, with no diagonal to be seen.
void add_quad(const std::array<Index, 4>& cells, Scene& scene) {
  Vec3 middle = Vec3::Zero();
  Colour mean{0, 0, 0, 0};
  for (const Index cell : cells) {
    const Colour& colour = scene.point_colours[static_cast<size_t>(cell)];
    middle += scene.points[static_cast<size_t>(cell)] / 4;
    mean.r += colour.r / 4, mean.g += colour.g / 4, mean.b += colour.b / 4, mean.a += colour.a / 4;
  }
  const auto centre = static_cast<uint32_t>(scene.points.size());
  scene.points.push_back(middle);
  scene.point_colours.push_back(mean);
  for (size_t k = 0; k < 4; ++k) {
    Polygon face{static_cast<uint32_t>(scene.indices.size()), 3};
    face.smooth = true;
    scene.polygons.push_back(face);
    for (const auto corner : {static_cast<uint32_t>(cells[k]), static_cast<uint32_t>(cells[(k + 1) % 4]), centre})
      scene.indices.push_back(corner);
  }
}

/// Faces between four cells around a corner of the graph.
void add_faces(const Tissue& tissue, const Cells& by_place, Scene& scene) {
  const auto at = [&](double row, double column) {
    const auto found = by_place.find({row, column});
    return found == by_place.end() ? none : found->second;
  };
  for (const auto& [place, cell] : by_place) {
    poll(scene.cancel);
    const Index first = tissue.first_side(cell);
    if (first == none) continue;
    // The next column may be the first one again, where the graph is closed around.
    double next_column = place.second + 1;
    if (at(place.first, next_column) == none) {
      Index side = first;
      do {
        const Index other = tissue.neighbour(side);
        const GridPlace there = place_of(tissue, other == none ? cell : other);
        if (there.row == place.first && there.column < place.second - 1) next_column = there.column;
        side = tissue.next(side);
      } while (side != first);
    }
    const Index right = at(place.first, next_column), up = at(place.first + 1, place.second);
    const Index across = at(place.first + 1, next_column);
    if (right == none || up == none || across == none) continue;
    add_quad({cell, right, across, up}, scene);
  }
}

}  // namespace

Layout layout_of(const Tissue& tissue, const ViewSettings& s) {
  if (tissue.has_geometry()) {
    if (s.bars && *s.bars) fail("'bars' are for a line or ring of cells; this tissue has cells with shapes");
    return Layout::polygons;
  }
  if (!has_rows(tissue)) fail("cannot show a tissue without geometry whose cells have no 'row' and 'column'");
  if (!s.place.empty()) return Layout::surface;
  const bool row = one_row(tissue);
  if (s.bars && *s.bars && !row) fail("'bars' are for a line or ring of cells; this tissue has several rows");
  return row && s.bars.value_or(!s.colour.values.empty() || !s.colour.column.empty()) ? Layout::bars : Layout::squares;
}

void add_bars(const Tissue& tissue, const Paint& paint, Scene& scene) {
  if (paint.values.empty()) fail("bars need 'colour': the column that they show");
  scene.bars.clear();  // the axis tells what the colours mean
  const double low = std::min(paint.min, 0.0), high = std::max(paint.max, 0.0);
  double left = INFINITY, right = -INFINITY;
  for (Index c = 0; c < tissue.cells(); ++c) {
    const double x = place_of(tissue, c).column;
    left = std::min(left, x - 0.5), right = std::max(right, x + 0.5);
  }
  const double margin = 0.3;
  left -= margin, right += margin;
  // The world is given the shape of the paper, so that the axes fill it.
  add_axis(paint, low, high, left, right, 1, scene);
  const double head = scene.title.empty() ? 0.06 : 0.06 + 1.9 * scene.font_size / scene.height;
  const double paper = (scene.height * (1 - head) - scene.pad_top) /
                       (scene.width * 0.95 - scene.pad_left - (scene.keys.empty() ? 0 : 8 * scene.font_size));
  const double top = std::max(0.05, paper) * (right - left);
  for (Line& line : scene.lines) line.from.y() *= top, line.to.y() *= top;
  for (Label& label : scene.labels) label.at.y() *= top;
  const double zero = (0 - low) / (high - low) * top;
  std::vector<Vec3> heads;
  for (Index c = 0; c < tissue.cells(); ++c) {
    poll(scene.cancel);
    const double value = paint.values[static_cast<size_t>(c)], x = place_of(tissue, c).column;
    const double shown = std::isnan(value) ? 0 : std::clamp(value, low, high);
    const double y = (shown - low) / (high - low) * top;
    const Bar bar{x - 0.41, x + 0.41, std::min(y, zero), std::max(y, zero)};
    heads.emplace_back(x, bar.head, 0);
    const Vec3 corners[] = {
        {bar.left, bar.foot, 0}, {bar.right, bar.foot, 0}, {bar.right, bar.head, 0}, {bar.left, bar.head, 0}};
    Polygon& polygon = scene.add(scene.polygons, corners, paint.of(c));
    const double width = 0.9 * scene.width / (right - left);
    polygon.outline = Colour{.1f, .1f, .1f, 1};
    polygon.width = static_cast<float>(paint.settings.outline_width.value_or(width < 6 ? 0 : 0.8));
    add_bar_sides(tissue, paint, c, bar, scene);
  }
  add_marks(paint, heads, 0.9 * scene.width / (right - left), scene);
}

void add_surface(const Tissue& tissue, const Paint& paint, Scene& scene) {
  const ViewSettings& s = paint.settings;
  Cells by_place;
  for (Index c = 0; c < tissue.cells(); ++c) {
    const GridPlace place = place_of(tissue, c);
    by_place[{place.row, place.column}] = c;
    scene.points.push_back(s.place[static_cast<size_t>(c)]);
    scene.point_colours.push_back(s.wireframe ? s.background : paint.of(c));
  }
  add_faces(tissue, by_place, scene);
  // Of a wireframe upon a transparent ground nothing can be hidden: there is no colour to hide it with.
  for (Polygon& face : scene.polygons) face.fill = s.wireframe ? s.background : white;
  if (s.wireframe && s.background.a == 0) scene.polygons.clear();
  scene.light.on = !s.wireframe;
  if (s.wireframe && scene.bars.size() == 1 && !s.colour.given()) scene.bars.clear();
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
  for (const Vec3& p : scene.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (!s.camera) {
    // Seen from a little above, with z upwards, as apices are drawn.
    scene.camera.direction = Vec3(0, 0.85, -0.55);
    scene.camera.up = Vec3(0, 0, 1);
    scene.camera.perspective = true;
  }
  const auto rows = std::max(1.0, std::sqrt(static_cast<double>(tissue.cells())));
  const double cell_pixels = 0.85 * std::min(scene.width, scene.height) / rows;
  const double automatic = s.wireframe ? 1.1 : cell_pixels < 5 ? 0 : std::clamp(0.03 * cell_pixels, 0.4, 0.9);
  const auto width = static_cast<float>(s.outline_width.value_or(automatic));
  for (Index w = 0; w < tissue.walls() && width > 0; ++w) {
    const Index a = tissue.cell_of(tissue.wall_side(w, 0)), side = tissue.wall_side(w, 1);
    if (side == none) continue;
    Colour colour = paint.outline;
    if (s.wireframe && s.colour.given()) colour = mix(paint.of(a), paint.of(tissue.cell_of(side)), 0.5);
    scene.lines.push_back(
        {scene.points[static_cast<size_t>(a)], scene.points[static_cast<size_t>(tissue.cell_of(side))], colour, width});
  }
  add_marks(paint, s.place, cell_pixels, scene);
}

}  // namespace tunica
