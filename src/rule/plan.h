// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "rule/code.h"
#include "rule/equations.h"

namespace tunica {

/// Where an instruction finds or puts a block of values.
enum class Storage : uint8_t {
  nowhere,
  scalar,     ///< one number for all: constants, parameters, time and what follows from them
  reg,        ///< a block-long buffer
  column,     ///< of cells (state, or kept by the tissue); slot -1: number of neighbours
  cell_temp,  ///< a value per cell kept between passes
  edge_temp,  ///< a value per half-edge (side with a neighbour), in the layout's order
  wall_temp,  ///< a value per wall between two cells, in the layout's order
};

struct Operand {
  Storage place = Storage::nowhere;
  int32_t index = 0;
};

struct Instruction {
  Code code;
  Operand dst, a, b, c;
  int row = -1;
  int column = -1;
  bool fused = false;            ///< rate: it is a * b + c rather than a
  bool is_rate = false;          ///< scatter: to the rate of `column` rather than to the column
  std::vector<Operand> values;   ///< pack: sources; gather: destinations
  std::vector<Operand> sources;  ///< gather without a row: one or two columns or temps
  std::vector<bool> difference;  ///< gather: neighbour minus own
  int weight = -1;               ///< gather: edge temp, or -1
};

struct Pass {
  enum class Over : uint8_t { cells, edges, walls } over;
  std::vector<Instruction> code;
  int registers = 0;
};

/// A graph lowered to passes over cells, half-edges and walls. Within a pass every block of elements is independent;
/// values that neighbours read are complete before the pass that reads them.
struct Plan {
  std::vector<Pass> once;  ///< weights that depend on nothing that changes while the structure stands
  std::vector<Pass> passes;
  std::vector<int> row_width;   ///< 1, 2 or 4 values per cell
  std::vector<NodeId> scalars;  ///< evaluated first, in this order
  std::vector<Operand> values;  ///< of the outputs without a column: scalar, column, cell_temp or edge_temp
  int cell_temps = 0, edge_temps = 0, wall_temps = 0;
  bool uses_wall_form = false, uses_edges = false;  ///< some sum did not separate
};

/// What a plan is to compute: a rate, a column, or (column -1) a value to be kept where Plan::values says.
struct Output {
  int column;
  NodeId value;
  bool is_rate;  ///< else the value is stored in the column itself
};

/// Lowers `outputs`. Sums over neighbours are separated into own x weight x neighbour factors where algebra allows, so
/// that what depends on a neighbour alone is computed once per cell; the rest runs over half-edges, fluxes over walls.
/// `is_state(column)`: whether a column changes from step to step. The graph gains the lowered nodes.
Plan lower(Equations& equations, const std::vector<Output>& outputs, const std::vector<bool>& is_state);

}  // namespace tunica
