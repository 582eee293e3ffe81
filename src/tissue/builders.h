// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/cancel.h"
#include "tissue/tissue.h"

namespace tunica {

// === Tissues without geometry. Cells are numbered row by row. The cyclic order of a cell's neighbours is: next column,
// next row, previous column, previous row (those that exist). Each cell's place is in its columns `row` and `column`,
// counted from 0. Errors: sizes out of range (a wrapped direction needs at least 3 cells; at most 4,000,000 in all).
// All builders poll `cancel`, and raise Cancelled.

/// n cells in a row.
Tissue line(int64_t n, uint64_t seed = 1, const CancelFlag* cancel = nullptr);
/// n cells in a closed row.
Tissue ring(int64_t n, uint64_t seed = 1, const CancelFlag* cancel = nullptr);
enum class Wrap { open, x, both };
/// ny rows of nx square cells. Wrap::x joins first and last column, Wrap::both first and last row too.
Tissue grid(int64_t nx, int64_t ny, Wrap wrap = Wrap::open, uint64_t seed = 1,
            const CancelFlag* cancel = nullptr);
/// `rows` rings of `around` cells; row 0 is the ring at the tip (thesis 5.4).
Tissue cylinder(int64_t around, int64_t rows, uint64_t seed = 1, const CancelFlag* cancel = nullptr);
/// Inserts a ring (row) of cells between rows `at` and at + 1. New cells, and their sides and walls along the row,
/// start with the mean of both rows' values; walls and sides between the rows copy the old ones, which go. Later rows
/// count one up, cells are renumbered row by row. Errors: no such rows; cells that are not the grid they were.
void insert_row(Tissue& graph, int64_t at);
/// Removes the row with the highest number. Errors: there is only one.
void remove_last_row(Tissue& graph);

// === Tissues with geometry, in the plane z = 0 unless points say otherwise

/// ny rows of nx unit squares, the first corner at the origin. Four walls meet in each inner junction.
Tissue squares(int64_t nx, int64_t ny, uint64_t seed = 1, const CancelFlag* cancel = nullptr);
/// ny rows of nx regular hexagons of the given area, every second row set off by half a cell.
Tissue hexagons(int64_t nx, int64_t ny, double area = 1, uint64_t seed = 1, const CancelFlag* cancel = nullptr);
/// A hexagon of regular hexagons: `radius` rings around the one at the origin, 1 + 3 radius (radius + 1) cells.
Tissue hexagon_disk(int64_t radius, double area = 1, uint64_t seed = 1, const CancelFlag* cancel = nullptr);
/// One regular polygon around the origin.
Tissue polygon(int sides, double area, uint64_t seed = 1);
/// Cells from lists of corners. Corners nearer than `tolerance` are one junction; in the plane z = 0 polygons are
/// turned counter-clockwise. Errors: a polygon with fewer than three different corners, crossing itself or without
/// area, two polygons along the same wall on the same side (an overlap), corners that are not finite.
Tissue polygons(const std::vector<std::vector<Vec3>>& cells, double tolerance = 1e-9, uint64_t seed = 1,
                const CancelFlag* cancel = nullptr);
/// Cells from corners given by number, counter-clockwise. Errors: as polygons(); a number out of range.
Tissue assemble(const std::vector<Vec3>& points, const std::vector<std::vector<Index>>& cells, uint64_t seed = 1,
                const CancelFlag* cancel = nullptr);

/// A sheet grown from one octagon by growth and division, as irregular as living tissue.
struct SheetSettings {
  int64_t cells = 200;     ///< the sheet has exactly so many
  uint64_t seed = 1;       ///< of the threshold's variation
  double max_area = 0.75;  ///< area at which a cell divides; the mean comes to about 0.7 of it
  double variation = 0.3;  ///< of that threshold from cell to cell, uniform, relative
  double growth = 0.01;    ///< relative growth of all areas between divisions; small: cells divide one by one
  const CancelFlag* cancel = nullptr;
};
/// Errors: settings out of range; Cancelled.
Tissue sheet(const SheetSettings& settings);

}  // namespace tunica
