// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "view/colour.h"

namespace tunica {

/// A colour map: numbers in [0, 1] to colours, with equal steps looking equally large.
struct Palette {
  enum class Type { sequential, diverging, cyclic };

  std::string name;
  Type type = Type::sequential;
  std::vector<Colour> colours;          ///< 256, evenly spaced from 0 to 1
  Colour missing{.72f, .72f, .72f, 1};  ///< for cells without a value (NaN); far from every colour of the map

  /// The colour at `t`; values outside [0, 1] take the nearest end, NaN takes `missing`.
  Colour at(double t) const;
};

/// The names `palette` accepts, sorted.
std::vector<std::string> palette_names();

/// A palette by name: viridis, magma, inferno, cividis (S. van der Walt, N. Smith, E. Firing; J. Nunez, C. Anderton,
/// R. Renslow; CC0), greens (black to bright green, as auxin is drawn in the thesis), greys, diverging, cyclic.
/// Errors: unknown name (names the nearest).
const Palette& palette(std::string_view name);

/// A palette through the given colours (at least two), evenly spaced, even to the eye in between.
Palette palette_through(const std::vector<Colour>& colours);

}  // namespace tunica
