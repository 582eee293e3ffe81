// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tissue/tissue.h"

namespace tunica {

/// The shapes of a tissue's cells. A cell's number of sides n is its number of neighbours. Interior cells have no
/// border wall; everything here but the first two is about interior cells (0 where there are none).
struct CellStatistics {
  Index cells = 0;
  Index interior = 0;
  std::vector<double> shares;  ///< shares[n]: fraction of cells with n sides; sums to 1
  double mean_sides = 0;
  double variance_sides = 0;  ///< of the population
  double mean_area = 0;
  double area_cv = 0;                 ///< standard deviation (of the population) / mean
  std::vector<double> area_by_sides;  ///< mean area of cells with n sides / mean area; 0 where none
  double lewis_slope = 0;             ///< least squares slope of area / mean area on n, over cells (Lewis 1928)
  double sharp_cells = 0;             ///< fraction of cells with an interior angle below 45 degrees
  std::vector<double> least_angle;    ///< fraction of cells whose least angle is in 0-10, 10-20, ... 170-180 degrees
  double mean_least_angle = 0;        ///< degrees
  Index four_way = 0;                 ///< junctions where more than three walls meet (in the whole tissue)
};

/// Errors: the tissue has no geometry. Angles are those at junctions of three or more walls, between chords to the next
/// such junctions, so points that only trace a wall do not count.
CellStatistics cell_statistics(const Tissue& tissue);

struct Peaks {
  std::vector<Index> cells;
  double mean_distance = 0;  ///< from a peak to the nearest other (centroids); 0 with fewer than two or no geometry
  double distance_cv = 0;    ///< standard deviation / mean of those distances
};

/// Cells whose value is strictly greater than that of every neighbour and greater than `above` (default: the column's
/// mean). A value that is not a number is no peak and spoils none: it is ignored. Errors: unknown column.
Peaks find_peaks(const Tissue& tissue, std::string_view column);
Peaks find_peaks(const Tissue& tissue, std::string_view column, double above);

/// A condition on cells: the value of a column lies between two bounds, both included.
struct Within {
  std::string column;
  double low, high;
};
/// Two cells that share a wall, both with a value above `above` and within all bounds.
struct Pair {
  Index first, second;
};
/// Of all such pairs the one whose lower value is highest (of equal ones that of the least identities), the cell with the
/// higher value first; indices are none if there is no pair. Thesis 5.5.1. Errors: unknown column.
Pair find_pair(const Tissue& tissue, std::string_view column, double above, const std::vector<Within>& bounds);

/// How far neighbouring cells alternate, -1 .. 1: with u = a cell's value minus the mean of its neighbours',
/// -2 sum u_a u_b / sum (u_a^2 + u_b^2) over the walls between two cells. 1 for a checkerboard on a grid (0.5 is the
/// most that hexagons allow), 0.2 to 0.7 for noise, the more the fewer the neighbours; negative where values are
/// smooth, 0 where all are equal. Alternation from cell to cell is the sign of a step too long, not of a pattern.
/// @param values  one per cell
double checkerboard_index(const Tissue& tissue, const double* values);
/// Whether this index is beyond what noise gives on such a tissue.
bool alternates(const Tissue& tissue, double index);

}  // namespace tunica
