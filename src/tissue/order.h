// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tissue/tissue.h"

namespace tunica {

/// Renumbers cells into the given order (place i gets cell order[i]); sides follow in the cycles of the cells, walls
/// and junctions in the order in which those sides meet them. Cycles and where they start stay as they are. Errors:
/// locked; not a permutation.
void renumber(Tissue& tissue, const std::vector<Index>& order);

/// Renumbers along a Hilbert curve, so that neighbours lie near each other in memory: by centroid in the mean plane of
/// all centroids, or by row and column without geometry. Errors: locked.
void renumber_along_curve(Tissue& tissue);

}  // namespace tunica
