// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "tissue/tissue.h"

namespace tunica {

/// How the walls of a segmented mesh are taken over.
enum class PlyWalls {
  straight,  ///< between junctions of three or more walls (and the border); every wall one straight line
  traced,    ///< with every point of the mesh on them as a junction of two walls; areas are those of the mesh
};

/// Reads a cell mesh of MorphoGraphX (ascii PLY: triangles with labels; a cell is all triangles of one label > 0).
/// The tissue has a cell column `label`. Where straight walls would leave a cell fewer than three junctions, or two
/// walls between the same ends, or an impossible polygon, further points of the outline are kept; so are points of
/// border walls farther from a straight line than a tenth of the cell's size (square root of area). Hostile files cost
/// no more time and memory than their size. Errors, with the line: not such a file, cut, indices out of range, numbers
/// that are none; with the label: a cell that is not one disk of triangles, or is turned over.
Tissue read_ply(std::string_view text, PlyWalls walls = PlyWalls::straight, uint64_t seed = 1);

/// The cell graph that MorphoGraphX writes beside a mesh.
struct CellGraph {
  std::vector<int64_t> labels;
  std::vector<Vec3> centres;
  std::vector<double> areas;
  std::vector<std::pair<int64_t, int64_t>> edges;  ///< labels of neighbours, lower first, sorted, each pair once
};
/// Errors: as read_ply.
CellGraph read_cell_graph(std::string_view text);

}  // namespace tunica
