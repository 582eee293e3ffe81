// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace tunica {

/// What a phyllotactic sequence, or a pattern, is called. `other` has no name of its own: it goes by its pair.
enum class PatternKind {
  too_few,           ///< primordia for a name
  none,              ///< the angles follow no order
  superposed,        ///< whorls one above the other (jugacy 1: all primordia in one row)
  alternating,       ///< distichous, decussate, tricussate, whorled: half way between those of the whorl before
  spiro_distichous,  ///< nearly alternating: spiro-distichous, spiro-decussate ...
  fibonacci,         ///< <1, 2, 3, 5, ...>
  accessory,         ///< kth: <1, k + 2, k + 3, ...>; the first is the Lucas sequence
  anomalous,         ///< kth: <2, 2k + 3, 2k + 5, ...>
  other
};

/// A sequence in which each term is the sum of the two before, from its first two terms, times the jugacy.
struct Sequence {
  int first = 1, second = 2;  ///< without the jugacy; without common divisor; second >= 2 first, or 1, 1
  int jugacy = 1;
  PatternKind kind = PatternKind::fibonacci;
  int order = 0;     ///< k of accessory and anomalous ones
  double limit = 0;  ///< divergence angle that its pairs converge to, radians, 0..pi / jugacy
  std::string name;

  /// The first terms, jugacy included. Stops before a term would be greater than a billion.
  std::vector<int> terms(int count) const;
};

/// The sequence that holds m and n as neighbours. Its limit is (u + v g) / (first + second g) of a turn, where u /
/// first and v / second are neighbouring fractions and g the golden ratio; divided by the jugacy. (j, j) is the start
/// of alternating whorls, with the limit of half a turn / j.
/// @param jugacy  greatest common divisor of m and n; 0: taken from them
/// Errors: not positive, above a million; the jugacy does not fit.
Sequence sequence_of(int m, int n, int jugacy = 0);

struct AllowableInterval {
  double low = 0, high = 0;  ///< radians
  bool opposed = true;       ///< false: the angle asked about is not in it
  bool holds(double angle, double tolerance = 0) const {
    return opposed && angle >= low - tolerance && angle <= high + tolerance;
  }
};

/// The divergence angles at which (m, n) can be a visible opposed pair, on the side of `angle` (0 to half a turn /
/// jugacy, or the mirror image): between the neighbouring fractions u / m and v / n of a turn, divided by the jugacy
/// (Jean 1994, ch. 2; at an angle f within, u and v are the whole numbers nearest to m f and n f). Errors: as
/// sequence_of; angle not from 0 to a turn.
AllowableInterval allowable_interval(int m, int n, double angle, int jugacy = 0);

struct ParastichyPair {
  int m = 0, n = 0;  ///< m <= n; 0: unknown
  bool operator==(const ParastichyPair&) const = default;
};

/// The visible opposed pairs of a divergence angle, lowest first, down to intervals not narrower than `narrowest`
/// (radians): the denominators met on the way to the angle in the tree of fractions (Stern, Brocot).
std::vector<ParastichyPair> visible_pairs(double angle, int jugacy, double narrowest);

/// "Fibonacci spiral", "bijugate Lucas spiral", "other (7,10)" ...
std::string name_of(PatternKind kind, int order, int jugacy, ParastichyPair pair);

}  // namespace tunica
