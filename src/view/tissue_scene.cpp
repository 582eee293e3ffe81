// SPDX-License-Identifier: MIT
#include "view/tissue_scene.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "view/tissue_scene_parts.h"

namespace tunica {
namespace {

/// The values of a field, one per element of a kind.
std::vector<double> values_of(const Tissue& tissue, Kind kind, const Field& field) {
  const auto count = static_cast<size_t>(tissue.count(kind));
  if (!field.values.empty()) {
    if (field.values.size() != count)
      fail("a view of {} {}s was given {} values", count, name_of(kind), field.values.size());
    return field.values;
  }
  const Column* column = tissue.find_column(kind, field.column);
  if (!column) {
    std::vector<std::string> names;
    for (const auto& each : tissue.columns(kind)) names.push_back(each->name);
    fail("the {}s have no column '{}' to show{}", name_of(kind), field.column, did_you_mean(field.column, names));
  }
  return {column->values.begin(), column->values.begin() + count};
}

std::string title_of(const Field& field) { return field.title.empty() ? field.column : field.title; }

void check_counts(const Tissue& tissue, const ViewSettings& s) {
  const auto cells = static_cast<size_t>(tissue.cells());
  const auto check = [&](size_t size, const char* what) {
    if (size != 0 && size != cells) fail("a view of {} cells was given {} {}", cells, size, what);
  };
  check(s.marked.size(), "markers");
  check(s.labels.size(), "labels");
  check(s.place.size(), "places");
  for (const Vec3& p : s.place)
    if (!p.allFinite()) fail("the place of a cell is not finite: ({}, {}, {})", p.x(), p.y(), p.z());
  if (!s.place.empty() && tissue.has_geometry()) fail("'place' is for tissues without geometry; this one has its own");
  if (s.wireframe && s.place.empty()) fail("'wireframe' needs 'place': the function that puts cells in space");
}

/// The value that only one in fifty of the positive ones exceeds: a few extreme sides must not hide all others.
double nearly_largest(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !(v > 0) || !std::isfinite(v); });
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Lines between cells: dark, but still to be seen upon cells that are nearly black, and between two bands.
Colour outline_for(const ViewSettings& s) {
  const bool dark = s.colour.given() && to_oklab(s.palette.colours.front()).l < 0.23;
  const Colour on_dark = s.sides.given() ? Colour{.17f, .23f, .17f, 1} : Colour{.36f, .41f, .36f, 1};
  return s.outline.value_or(dark ? on_dark : Colour{.08f, .08f, .08f, 1});
}

void add_legend(const ViewSettings& s, const Paint& paint, Scene& scene) {
  if (!s.legend) return;
  if (!paint.values.empty()) {
    scene.bars.push_back({s.palette.colours, paint.min, paint.max, title_of(s.colour)});
    if (std::any_of(paint.values.begin(), paint.values.end(), [](double v) { return std::isnan(v); }))
      scene.keys.push_back({s.palette.missing, s.missing_title});
  }
  if (!paint.sides.empty()) {
    const std::string title = title_of(s.sides);
    scene.keys.push_back(
        {s.sides_colour, paint.sides_max > 0 ? fmt::format("{} (full: {:.3g})", title, paint.sides_max) : title});
  }
}

}  // namespace

std::pair<double, double> scale_of(const std::vector<double>& values, Palette::Type type) {
  double min = INFINITY, max = -INFINITY;
  for (const double v : values)
    if (std::isfinite(v)) min = std::min(min, v), max = std::max(max, v);
  if (min > max) return {0, 1};
  if (type == Palette::Type::diverging && min < 0 && max > 0) {
    const double most = std::max(-min, max);
    return {-most, most};
  }
  if (type != Palette::Type::cyclic && min > 0 && min < 0.5 * max) min = 0;
  if (type != Palette::Type::cyclic && max < 0 && max > 0.5 * min) max = 0;
  // All the same, or so nearly that the scale's numbers would all read alike.
  const double size = std::max(std::abs(min), std::abs(max));
  if (max - min <= 1e-9 * size || max == min) {
    const double half = size > 0 ? 0.5 * size : 0.5;
    const double middle = (min + max) / 2;
    return {middle - half, middle + half};
  }
  return {min, max};
}

Scene scene_of(const Tissue& tissue, const ViewSettings& s) {
  check_counts(tissue, s);
  if (tissue.cells() == 0) fail("there is nothing to show: the tissue has no cells");
  Paint paint{s, {}, 0, 1, {}, 0, outline_for(s)};
  if (s.colour.given()) {
    paint.values = values_of(tissue, Kind::cell, s.colour);
    const auto [min, max] = scale_of(paint.values, s.palette.type);
    paint.min = s.min.value_or(s.max && *s.max <= min ? *s.max - 1 : min);
    paint.max = s.max.value_or(s.min && *s.min >= max ? *s.min + 1 : max);
    if (!(paint.min < paint.max))
      fail("the range of a view must go from low to high, not from {} to {}", paint.min, paint.max);
  }
  if (s.sides.given()) {
    paint.sides = values_of(tissue, Kind::side, s.sides);
    paint.sides_max = s.sides_max.value_or(nearly_largest(paint.sides));
  }
  Scene scene;
  scene.title = s.title;
  scene.background = s.background;
  scene.cancel = s.cancel;
  add_legend(s, paint, scene);
  const Layout layout = layout_of(tissue, s);
  const bool wide = layout == Layout::bars;
  scene.width = s.width > 0 ? s.width : wide ? 1000 : 900;
  scene.height = s.height > 0 ? s.height : wide ? 400 : 800;
  if (s.camera) scene.camera = *s.camera;
  switch (layout) {
    case Layout::polygons:
      add_cells(tissue, paint, polygon_outlines(tissue), scene);
      break;
    case Layout::squares:
      add_cells(tissue, paint, square_outlines(tissue), scene);
      break;
    case Layout::bars:
      add_bars(tissue, paint, scene);
      break;
    case Layout::surface:
      add_surface(tissue, paint, scene);
      break;
  }
  if (s.light) scene.light.on = *s.light;
  return scene;
}

}  // namespace tunica
