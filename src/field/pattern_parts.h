// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <vector>

#include "field/pattern.h"

/// What the parts of read_pattern share; not for others.
namespace tunica::pattern {

inline constexpr double turn = 2 * std::numbers::pi;
inline constexpr double degree = turn / 360;

/// The representative of an angle in (-period / 2, period / 2].
double wrap(double angle, double period = turn);

struct Circular {
  double mean = 0;  ///< (-period / 2, period / 2]
  double sd = 0;    ///< rms of the wrapped deviations from it
};
Circular circular(const std::vector<double>& angles, double period = turn);

Figures figures(std::vector<double> values);

/// Mean plastochron of single primordia around each: over up to 16 on either side.
std::vector<double> local_plastochrons(const std::vector<PatternItem>& items);

/// The order of birth mended to follow one generative spiral.
struct Spiral {
  std::vector<Index> sequence;
  Index swaps = 0;
  std::vector<double> divergences;  ///< (-pi, pi]
};

/// Walks along the primordia, taking next that one of the 4 oldest left which fits a constant divergence. The order is
/// changed only where that explains the angles far better than the order of birth does.
/// @param plastochron  local ones: primordia born more than 1.5 of them apart are not exchanged; empty: times unknown
Spiral best_spiral(const std::vector<PatternItem>& items, const std::vector<double>& plastochron);

/// Primordia grouped into whorls of one size.
struct Whorls {
  int jugacy = 1;
  std::vector<Index> begin;  ///< first primordium of each whorl, and the number of primordia
  Index complete = 0;
  Index missing = 0;                ///< partners, but for the first and last whorl
  double intra = 0;                 ///< rms deviation of gaps from turn / jugacy in complete whorls
  double spread = 0;                ///< greatest duration of a complete whorl / mean plastochron of whorls
  double usual_spread = 0;          ///< median, by local plastochrons
  std::vector<double> divergences;  ///< (-turn / 2 j, turn / 2 j]
  std::vector<double> times;        ///< mean of each whorl; empty: unknown
};

/// The grouping of least cost: what members lack in even spacing and in simultaneity, and partners that are missing. So
/// a missing partner costs its whorl, not all that follow.
Whorls group(const std::vector<PatternItem>& items, int jugacy, const std::vector<double>& plastochron);

/// The jugacy for which times and angles speak, 1 if none of the others does clearly.
Whorls find_whorls(const std::vector<PatternItem>& items, const Spiral& spiral, const std::vector<double>& plastochron);

/// Sets contact and its share from the places; returns the pairs with their numbers, most frequent first.
std::vector<std::pair<ParastichyPair, Index>> find_contacts(const std::vector<PatternItem>& items, Pattern& pattern);

/// Sets hand and reversals, turns angles so that they are positive towards the hand, and computes their figures.
void measure_divergences(Pattern& pattern);

/// Sets kind, name, evidence and what goes with them.
void name_pattern(const std::vector<std::pair<ParastichyPair, Index>>& contacts, bool timed, Pattern& pattern);

}  // namespace tunica::pattern
