// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "base/reserved.h"

namespace tunica {

enum class Kind : uint8_t { cell, wall, side, junction };
inline constexpr int kinds = 4;
const char* name_of(Kind kind);

/// What the two parts get when an element divides (a cell by division; a wall or side when a junction is put into it).
enum class Inherit : uint8_t {
  copy,   ///< both get the value (concentrations)
  split,  ///< in proportion to area (cells) or length (walls, sides): the sum is kept (amounts)
  reset,  ///< both get the column's initial value
  rule,   ///< a function decides
};

/// A named state of every element of one kind. Addresses of its values never change.
struct Column {
  /// (mother's value, first part's share of area or length) -> values of the two parts
  using Rule = std::function<std::pair<double, double>(double mother, double share)>;

  std::string name;
  double initial = 0;  ///< of new elements, and of a wall laid by division
  Inherit inherit = Inherit::copy;
  Rule rule;                     ///< only for Inherit::rule
  bool geometric = false;        ///< kept by the tissue (area, length, ...); not for models to write
  ReservedArray<double> values;  ///< one per element, indexed like the elements
};

}  // namespace tunica
