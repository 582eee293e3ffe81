// SPDX-License-Identifier: MIT
// The name of a pattern, by rules that are written out beside it.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "field/pattern_parts.h"

namespace tunica::pattern {

namespace {

// Angles here are of the pattern with the whorl turned to one primordium: divergence times jugacy.
constexpr double orderly = 30 * degree;          // greatest sd
constexpr double orderly_folded = 20 * degree;   // the same, without regard to hand: half the range
constexpr Index per_reversal = 5;                // divergences at least, for each change of hand
constexpr double opposite = 176 * degree;        // from here on whorls alternate
constexpr double above = 4 * degree;             // up to here they stand one above the other
constexpr double nearly = 150 * degree;          // from here on, one speaks of spiro-distichous
constexpr double nearly_by_pair = 142 * degree;  // so, too, from here on at the contact pair (1, 2)
constexpr double slack = 1.5 * degree;           // by which the mean may miss an allowable interval
constexpr double least_share = .15;              // of a contact pair that may give the name

double in_degrees(double angle) { return angle / degree; }

template <class... Args>
void say(Pattern& p, fmt::format_string<Args...> format, Args&&... args) {
  p.evidence.push_back(fmt::format(format, std::forward<Args>(args)...));
}

void give(Pattern& p, PatternKind kind, int order = 0, ParastichyPair pair = {}) {
  p.kind = kind;
  p.order = order;
  p.name = name_of(kind, order, p.jugacy, pair);
}

double mean_of(const Pattern& p) { return p.folded ? p.folded_mean : p.mean; }
double sd_of(const Pattern& p) { return p.folded ? p.folded_sd : p.sd; }

/// Standard error of the mean; errors of places cancel in all but the first and last angle.
double error_of(const Pattern& p) {
  return sd_of(p) / std::sqrt(2.) / std::max<double>(1, static_cast<double>(p.divergences.size()));
}

void say_figures(bool timed, Pattern& p) {
  if (p.jugacy > 1) {
    say(p, "whorls of {}: {} whorls, even to {:.2f} degrees rms{}{}", p.jugacy, p.whorls, in_degrees(p.intra),
        timed ? fmt::format(", each within {:.2f} of a plastochron", p.spread) : ", times unknown",
        p.missing > 0 ? fmt::format(", {} partners missing", p.missing) : "");
  } else {
    say(p, "one at a time: no grouping into whorls is clearly better");
  }
  if (p.swaps > 0)
    say(p, "order of birth mended by {} exchanges: raw divergence {:.2f} (sd {:.2f}) degrees", p.swaps,
        in_degrees(p.raw_mean), in_degrees(p.raw_sd));
  say(p, "divergence {:.2f} (sd {:.2f}) degrees over {}", in_degrees(p.mean), in_degrees(p.sd), p.divergences.size());
  if (p.reversals > 0)
    say(p, "the hand changes {} times; folded divergence {:.2f} (sd {:.2f}) degrees", p.reversals,
        in_degrees(p.folded_mean), in_degrees(p.folded_sd));
}

bool fits(const Pattern& p, ParastichyPair pair, AllowableInterval& interval) {
  if (pair.m % p.jugacy || pair.n % p.jugacy || std::gcd(pair.m, pair.n) != p.jugacy) return false;
  if (pair.n == p.jugacy) return false;  // alternating whorls: told by the angle
  interval = allowable_interval(pair.m, pair.n, sequence_of(pair.m, pair.n).limit, p.jugacy);
  return interval.holds(mean_of(p), slack / p.jugacy + 3 * error_of(p));
}

/// The most frequent contact pair that the angle allows.
bool choose_pair(const std::vector<std::pair<ParastichyPair, Index>>& contacts, Pattern& p) {
  Index all = 0;
  for (const auto& [pair, count] : contacts) all += count;
  for (const auto& [pair, count] : contacts) {
    if (count < least_share * all) break;
    if (!fits(p, pair, p.interval)) continue;
    p.named_by = pair;
    return true;
  }
  p.interval = {};
  return false;
}

/// A pair (1, k) belongs to several sequences; the next pair that the angle allows tells which.
Sequence sequence_at(ParastichyPair pair, double angle, int jugacy) {
  int m = pair.m / jugacy, n = pair.n / jugacy;
  while (m == 1 && n < 1000 && !allowable_interval(n, n + 1, angle * jugacy).holds(angle * jugacy)) ++n;
  return sequence_of(m * jugacy, n * jugacy, jugacy);
}

void name_by_pair(Pattern& p) {
  const double whole = mean_of(p) * p.jugacy;
  const Sequence s = sequence_at(p.named_by, mean_of(p), p.jugacy);
  say(p, "contact pair ({},{}), allowable interval {:.2f} to {:.2f} degrees", p.named_by.m, p.named_by.n,
      in_degrees(p.interval.low), in_degrees(p.interval.high));
  const bool lowest = p.named_by.n == 2 * p.jugacy;
  if (s.kind == PatternKind::fibonacci && (whole >= nearly || (lowest && whole >= nearly_by_pair))) {
    give(p, PatternKind::spiro_distichous);
    say(p, "lowest pairs, {:.2f} degrees{}: nearly alternating", in_degrees(whole),
        p.jugacy > 1 ? " times jugacy" : "");
    return;
  }
  give(p, s.kind, s.order, p.named_by);
  p.limit = s.limit;
  const std::vector<int> terms = s.terms(4);
  say(p, "({},{}) is of the sequence <{}, ...>, limit {:.2f} degrees", p.named_by.m, p.named_by.n,
      fmt::join(terms, ", "), in_degrees(s.limit));
}

/// Where no pair helps: the commonest pattern of such an angle.
void name_by_angle(Pattern& p) {
  const double whole = mean_of(p) * p.jugacy / degree;
  struct Range {
    double low, high;
    int m, n;
  };
  const Range ranges[] = {{125, 146, 1, 2},   {95, 104, 1, 3},  {75.5, 80, 1, 4}, {62.5, 65.5, 1, 5}, {53, 56, 1, 6},
                          {46.2, 48.5, 1, 7}, {40.5, 43, 1, 8}, {105, 108, 3, 7}, {81, 83.5, 4, 9},   {66, 68, 5, 11}};
  if (whole >= nearly / degree) {
    give(p, PatternKind::spiro_distichous);
    say(p, "by the angle alone, {:.2f} degrees{}: an anomalous spiral cannot be excluded without a contact pair", whole,
        p.jugacy > 1 ? " times jugacy" : "");
    return;
  }
  for (const Range& range : ranges) {
    if (whole < range.low || whole > range.high) continue;
    const Sequence s = sequence_of(range.m * p.jugacy, range.n * p.jugacy, p.jugacy);
    give(p, s.kind, s.order);
    if (s.kind == PatternKind::other) p.name = name_of(s.kind, 0, p.jugacy, {s.first * p.jugacy, s.second * p.jugacy});
    p.limit = s.limit;
    say(p, "by the angle alone, the commonest pattern from {:.4g} to {:.4g} degrees{}; limit {:.2f}", range.low,
        range.high, p.jugacy > 1 ? " times jugacy" : "", in_degrees(s.limit));
    return;
  }
  give(p, PatternKind::other);
  say(p, "the angle is that of no common pattern");
}

bool enough(const Pattern& p) { return p.primordia >= 6 && (p.jugacy == 1 || p.whorls >= 3); }

}  // namespace

void name_pattern(const std::vector<std::pair<ParastichyPair, Index>>& contacts, bool timed, Pattern& p) {
  give(p, PatternKind::too_few);
  if (!enough(p)) {
    say(p, "{} primordia{}; a name takes 6{}", p.primordia, p.jugacy > 1 ? fmt::format(" in {} whorls", p.whorls) : "",
        p.jugacy > 1 ? " in 3 whorls" : "");
    return;
  }
  say_figures(timed, p);
  const double limit = orderly / p.jugacy;
  p.folded = p.reversals > 0 && p.sd > limit && p.folded_sd <= orderly_folded / p.jugacy &&
             per_reversal * p.reversals <= static_cast<Index>(p.divergences.size());
  if (sd_of(p) > limit) {
    give(p, PatternKind::none);
    say(p, "divergences scatter by more than {:.3g} degrees", in_degrees(limit));
    return;
  }
  const double whole = mean_of(p) * p.jugacy;
  p.visible = visible_pairs(mean_of(p), p.jugacy, std::max(1e-3 * degree, 3 * error_of(p)));
  if (whole >= opposite || whole <= above) {
    give(p, whole >= opposite ? PatternKind::alternating : PatternKind::superposed);
    p.limit = whole >= opposite ? turn / 2 / p.jugacy : 0;
    say(p, "{:.2f} degrees is within {:.3g} of {}", in_degrees(mean_of(p)), in_degrees(above / p.jugacy),
        whole >= opposite ? "half way between those before" : "those before");
    return;
  }
  if (choose_pair(contacts, p)) return name_by_pair(p);
  if (!contacts.empty())
    say(p, "the contact pair ({},{}) is impossible at this angle", p.contact.m, p.contact.n);
  else
    say(p, "no contact pair: places unknown");
  name_by_angle(p);
}

}  // namespace tunica::pattern
