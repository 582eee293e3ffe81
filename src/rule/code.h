// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace tunica {

/// Instructions of an evaluation pass.
enum class Code : uint8_t {
  // elementwise: same order as Op::neg .. Op::select, then the fused ones (rounded after each operation)
  neg,
  exp,
  log,
  sqrt,
  sin,
  cos,
  tanh,
  abs,
  add,
  sub,
  mul,
  div,
  pow,
  min,
  max,
  less,
  less_equal,
  equal,
  select,
  multiply_add,       ///< a * b + c
  multiply_subtract,  ///< a * b - c
  subtract_multiply,  ///< c - a * b
  subtract_max,       ///< max(a - b, c)
  copy,
  elementwise_count,
  // cell passes
  pack,    ///< up to four values per cell into row `row`
  gather,  ///< weighted sums of row `row` over neighbours into up to four registers
  edge_sum,
  edge_minimum,
  edge_maximum,
  wall_sum,  ///< a value per half-edge or wall to one per cell
  rate,      ///< the derivative of state column `column`
  // edge and wall passes
  fetch_own,
  fetch_across,
  fetch_wall,
  fetch_side,
  fetch_mirrored,
  scatter,  ///< to `column` of sides (edge pass) or walls (wall pass)
};

}  // namespace tunica
