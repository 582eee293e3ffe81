// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tissue/tissue.h"
#include "view/scene.h"
#include "view/tissue_scene.h"

namespace tunica {

/// Settings with the values they name looked up.
struct Paint {
  const ViewSettings& settings;
  std::vector<double> values;  ///< per cell; empty: plain
  double min, max;
  std::vector<double> sides;  ///< per side; empty: no bands
  double sides_max;
  Colour outline;

  Colour of(Index cell) const {
    if (values.empty()) return settings.plain;
    return settings.palette.at((values[static_cast<size_t>(cell)] - min) / (max - min));
  }
};

enum class Layout { polygons, squares, bars, surface };
/// Errors: bars for more than one row; a surface of cells without rows.
Layout layout_of(const Tissue& tissue, const ViewSettings& settings);

/// Cells as shapes in the picture's world, whether the tissue has them or they are made up from rows and columns.
struct Outlines {
  std::vector<Vec3> points;
  std::vector<uint32_t> corners;                     ///< of all cells, cell by cell
  std::vector<uint32_t> first;                       ///< of each cell's corners; one more at the end
  std::vector<Index> side_of;                        ///< per corner: the side from it to the next, or none
  std::vector<std::pair<uint32_t, uint32_t>> walls;  ///< each wall once, to be lined
  std::vector<Vec3> centres;
  double diameter = 1;  ///< of the mean cell
};
Outlines polygon_outlines(const Tissue& tissue);
Outlines square_outlines(const Tissue& tissue);

void add_cells(const Tissue& tissue, const Paint& paint, const Outlines& outlines, Scene& scene);
void add_bars(const Tissue& tissue, const Paint& paint, Scene& scene);
void add_surface(const Tissue& tissue, const Paint& paint, Scene& scene);

/// Markers and labels of cells at their centres; `cell_pixels` is about the size of a cell in the picture.
void add_marks(const Paint& paint, const std::vector<Vec3>& centres, double cell_pixels, Scene& scene);

/// Row and column of a cell of a tissue without geometry.
struct GridPlace {
  double row, column;
  bool operator==(const GridPlace&) const = default;
};
GridPlace place_of(const Tissue& tissue, Index cell);

}  // namespace tunica
