// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "tissue/tissue.h"

namespace tunica {

/// A segmented surface: triangles, counter-clockwise seen from outside, each of a cell (label > 0) or of none.
struct LabelledMesh {
  struct Triangle {
    std::array<Index, 3> corners;
    int64_t label;
  };
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

/// The tissue of the cells of a mesh, in order of label, with the cell column `label`.
/// @param traced  keep all mesh points on the walls as junctions; else as few as make possible cells, see PlyWalls
/// Errors: no cells; a cell that is not one disk; triangles on the same side of an edge.
Tissue cells_of(const LabelledMesh& mesh, bool traced, uint64_t seed);

}  // namespace tunica
