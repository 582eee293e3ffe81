// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tissue/tissue.h"
#include "view/palette.h"
#include "view/scene.h"

namespace tunica {

/// Numbers to show: a column by name, or values given (one per element, in the order of indices).
struct Field {
  std::string column;
  std::vector<double> values;
  std::string title;  ///< in the legend; else the column's name
  bool given() const { return !column.empty() || !values.empty(); }
};

/// How a tissue is shown. Everything has a default that suits most figures.
struct ViewSettings {
  int width = 0, height = 0;  ///< pixels; 0: chosen by the layout
  std::string title;
  Colour background = white;

  Field colour;                    ///< of cells. NaN is shown in the palette's own colour for it
  std::optional<double> min, max;  ///< ends of the colour scale; else those of the values (0 if they start near it)
  Palette palette = tunica::palette("viridis");
  std::string missing_title = "no value";  ///< what the legend calls cells whose colour is NaN
  Colour plain{.87f, .92f, .82f, 1};  ///< of cells when there is no `colour`

  Field sides;                      ///< of sides: bands along walls, inside the cell they belong to
  std::optional<double> sides_max;  ///< value of the widest band; else the largest but for outliers
  Colour sides_colour = parse_colour("red");
  bool sides_by_width = true;  ///< thickness shows the value; else intensity of colour
  double sides_width = 0.2;    ///< widest band, relative to the mean cell's diameter

  std::optional<Colour> outline;        ///< of cells; else what goes with the palette
  std::optional<double> outline_width;  ///< pixels; 0: none; else by the cells' size in the picture
  bool legend = true;

  std::vector<char> marked;  ///< cells with a marker: empty, or one flag per cell
  Marker::Shape marker = Marker::Shape::ring;
  Colour marker_colour = parse_colour("red");
  double marker_size = 0;           ///< pixels; 0: by the cells' size
  std::vector<std::string> labels;  ///< on cells: empty, or one per cell

  std::optional<bool> bars;  ///< bars for a single row of cells (default), or squares
  std::vector<Vec3> place;   ///< of each cell, in space: neighbouring cells span a surface (no own geometry)
  bool wireframe = false;    ///< with `place`: lines between neighbours instead of a coloured surface
  std::optional<Camera> camera;
  const CancelFlag* cancel = nullptr;  ///< polled while the scene is made and drawn
  std::optional<bool> light;  ///< a lamp for what is not flat; else only for surfaces by `place`
};

/// The scene that shows a tissue: polygons of a tissue with geometry; squares by row and column for a grid or cylinder;
/// bars for a line or ring (thesis figs. 5.2, 5.4, 5.7); a surface through `place` (fig. 3.4).
/// Errors: unknown columns (names the nearest); a number of values, labels or places other than that of the elements;
/// settings that do not fit the tissue; places that are not finite.
Scene scene_of(const Tissue& tissue, const ViewSettings& settings);

/// The ends of a colour scale for values: NaN and infinities are left out; 0 is an end where the values start near it;
/// a diverging palette is centred on 0 where they have both signs.
std::pair<double, double> scale_of(const std::vector<double>& values, Palette::Type type);

}  // namespace tunica
