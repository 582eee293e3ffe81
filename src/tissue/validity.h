// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tissue/tissue.h"

namespace tunica {

/// Checks every invariant of a tissue, O(size): references in range; identities and indices each other's inverse;
/// next and previous each other's inverse, each cell one cycle of its own sides, at least three with geometry; a wall's
/// two sides in two different cells and running opposite ways; without geometry no border walls; every junction met by
/// one fan of sides, at least two walls; V - E + F = 2 - 2g - b with whole g >= 0 for each connected part (b border
/// lines, g handles); columns as long as the elements; positions finite; areas positive; no polygon that crosses
/// itself.
/// @return one sentence for each problem, naming element and invariant, at most `most`; empty if all is well
std::vector<std::string> find_problems(const Tissue& tissue, size_t most = 20);

/// The same without what depends on where junctions lie (areas, polygons).
std::vector<std::string> find_structural_problems(const Tissue& tissue, size_t most = 20);

/// Errors: the first problem that find_problems() names.
void validate(const Tissue& tissue);

/// The part of the check that concerns these cells and what they touch, in time proportional to them.
/// Errors: the first problem.
void validate_near(const Tissue& tissue, const std::vector<Index>& cells);

/// A connected part of a tissue with geometry.
struct Component {
  Index cells = 0, walls = 0, junctions = 0;
  int borders = 0;                                                             ///< closed border lines
  long euler() const { return static_cast<long>(junctions) - walls + cells; }  ///< 1 for a disk, 0 for a tube
};
/// The connected parts, in order of their lowest cell. The structure must be valid.
std::vector<Component> components(const Tissue& tissue);

}  // namespace tunica
