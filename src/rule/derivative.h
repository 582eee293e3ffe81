// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rule/equations.h"

namespace tunica {

/// Where, seen from a cell or from one of its sides, a variable stands that a value depends on.
enum class Site : uint8_t {
  own,     ///< the cell
  across,  ///< the neighbour
  here,    ///< the side
  there,   ///< the neighbour's side of the same wall
  wall,
};

/// d(value) / d(variable at a site). For a cell's value: at Site::own a cell value, elsewhere a value per side with a
/// neighbour. For a side's or wall's value: a value per side.
struct Partial {
  int variable;  ///< in Derivative::variables
  Site site;
  NodeId value;
};

/// The exact derivative of the rates, as graphs. What depends on neighbours and is itself read across walls (a cell's
/// share of its transporters, say) is a variable of its own, so that the second ring is a product of two first ones:
/// d rate / d state = direct partials + sum over intermediates of (d rate / d intermediate)(d intermediate / d state).
struct Derivative {
  struct Variable {
    Kind kind;
    int column = -1;                ///< of a state column, or of a wall's derived column
    NodeId value = no_node;         ///< of an intermediate: what it is
    std::vector<Partial> partials;  ///< of the state's rate, or of the intermediate
  };
  std::vector<Variable> variables;  ///< the state columns in order, then the intermediates
  int states = 0;
  std::vector<int> order;  ///< the intermediates, each after those it depends on
  /// No partial depends on the state: the rates are linear in it (but for a constant).
  bool linear = false;
  /// Linear rates of one cell column: d rate / d (the column, raised everywhere alike). Differences between neighbours
  /// drop out before anything is computed, so that a decay however slow keeps its digits.
  NodeId uniform = no_node;
  /// Operations that bend: min, max, abs, where and comparisons, as "max in file:line".
  std::vector<std::string> kinks;
  /// Rules that were not traced and are not in the derivative: their places.
  std::vector<std::string> missing;
};

/// Differentiates the rates by the state columns (slots, in the order of System::state). The graph gains nodes.
Derivative differentiate(Equations& equations, const std::vector<int>& state);

}  // namespace tunica
