// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "field/sequence.h"
#include "tissue/tissue.h"

namespace tunica {

/// A primordium, as far as its pattern goes. Angles in radians, any turn; what is unknown is not a number.
struct PatternItem {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double angle = 0;
  double time = unknown;                         ///< of birth
  Vec3 place = Vec3(unknown, unknown, unknown);  ///< all at one moment; the axis is y
  /// The older ones nearest on either side when it arose, by their places in the list, where that is known; none:
  /// beyond the list.
  std::optional<std::pair<Index, Index>> neighbours;
};

/// What is said of a list of numbers. Standard deviations here are of the population.
struct Figures {
  double mean = 0, sd = 0, median = 0;
  Index count = 0;
};

/// What a list of primordia is. Angles in radians. A whorl is a single primordium where the jugacy is 1.
struct Pattern {
  Index primordia = 0;
  PatternKind kind = PatternKind::too_few;
  int order = 0;  ///< k of accessory and anomalous patterns
  std::string name;
  std::vector<std::string> evidence;  ///< the figures and rules that gave the name, a line each

  int jugacy = 1;
  double intra = 0;        ///< rms deviation from even spacing within complete whorls
  double spread = 0;       ///< greatest time from first to last of a complete whorl / plastochron of whorls
  Index whorls = 0;        ///< complete and incomplete
  Index missing = 0;       ///< partners missing in whorls, but for the first and last whorl
  std::vector<int> whorl;  ///< of each primordium, in the order given, from 0

  std::vector<double> raw;  ///< divergence of each primordium from the one before, in the order given, (-pi, pi]
  double raw_mean = 0, raw_sd = 0;  ///< circular mean (towards the hand, so that it is positive), rms deviation from it
  std::vector<Index> sequence;      ///< the primordia in the order of the best generative spiral (jugacy 1)
  Index swaps = 0;                  ///< pairs of primordia that are in the other order there
  std::vector<double> divergences;  ///< between whorls, re-ordered, positive towards the hand, (-pi, pi] / jugacy
  double mean = 0, sd = 0;          ///< their circular mean, 0..pi / jugacy, and rms deviation from it
  double folded_mean = 0, folded_sd = 0;  ///< of their absolute values
  int hand = 0;                           ///< 1: the angle grows from older to younger, -1: it falls, 0: neither
  Index reversals = 0;                    ///< changes of hand that last for two divergences or more
  bool folded = false;                    ///< the name was given by the folded angles, since the hand changes

  ParastichyPair contact;      ///< the most frequent one over the younger half; 0: places unknown
  double contact_share = 0;    ///< of the primordia there
  ParastichyPair named_by;     ///< the contact pair that gave the name; 0: none fits, or the angle alone decides
  AllowableInterval interval;  ///< of `named_by` at the angle found
  std::vector<ParastichyPair> visible;  ///< visible opposed pairs of the angle found, as far as its error allows
  double limit = 0;                     ///< angle to which the pattern named converges; 0: none

  Figures plastochron;  ///< between successive times of birth; of whorls where jugacy > 1
  Figures
      plastochron_ratio;  ///< distance from the axis of a whorl / that of the next, geometric mean; count 0: unknown
};

struct PatternOptions {
  int jugacy = 0;  ///< 0: to be found
};

/// Reads the pattern of primordia, oldest first (thesis 4.3; Jean 1994). Takes time in proportion to their number.
/// Errors: angles that are no numbers; times that fall; jugacy above 100.
Pattern read_pattern(const std::vector<PatternItem>& items, const PatternOptions& options = {});

/// One or two lines of plain words; angles in degrees.
std::string describe(const Pattern& pattern);

/// What a pattern should be.
struct ExpectedPattern {
  double angle = 0;  ///< divergence between whorls, radians
  int jugacy = 1;
  ParastichyPair pair;  ///< 0: that found
};

/// How a pattern compares with what was expected.
struct Judgement {
  bool lenient = false;  ///< thesis table 4.2: mean in the allowable interval, sd < max(1.5, half its width + 1)
                         ///< degrees, intra < 2.5 degrees, spread < 0.5; spirals may be re-ordered
  bool strict = false;   ///< also the mean within 1 degree of the angle expected, without re-ordering
  bool hold = false;  ///< thesis table 4.1: mean within 3 degrees (Lucas, jugate 4, Fibonacci 8), sd < 4, intra < 12,
                      ///< pair of the sequence expected (where places are known)
  std::string why;    ///< what each rule that is not met asks, and what there is; "" if all are
};

/// Judges a pattern that was read with the jugacy expected; another jugacy fails every rule.
/// Errors: angle not from 0 to half a turn / jugacy; a pair that the jugacy does not divide.
Judgement judge(const Pattern& pattern, const ExpectedPattern& expected);

}  // namespace tunica
