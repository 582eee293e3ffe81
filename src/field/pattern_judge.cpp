// SPDX-License-Identifier: MIT
// A pattern in words, and against what was expected.
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "field/pattern_parts.h"

namespace tunica {

namespace {

using pattern::degree;
using pattern::turn;

std::string counted(Index n, const char* noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

std::string angles_of(const Pattern& p) {
  std::string text = fmt::format("divergence {:.2f} (sd {:.2f}) degrees", p.mean / degree, p.sd / degree);
  if (p.folded)
    text = fmt::format("divergence {:.2f} (sd {:.2f}) degrees without regard to hand", p.folded_mean / degree,
                       p.folded_sd / degree);
  if (p.limit > 0) text += fmt::format(", limit {:.2f}", p.limit / degree);
  if (p.contact.n > 0) text += fmt::format(", contact pair ({},{})", p.contact.m, p.contact.n);
  return text;
}

/// Gathers what is not met.
class Complaints {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    text_ += (text_.empty() ? "" : "; ") + fmt::format(format, std::forward<Args>(args)...);
  }
  bool none() const { return text_.empty(); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void check_expected(const ExpectedPattern& e) {
  if (e.jugacy < 1 || e.jugacy > 100) fail("a jugacy must be from 1 to 100, came {}", e.jugacy);
  if (!(e.angle >= 0 && e.angle <= turn / 2 / e.jugacy + 1e-9))
    fail("the divergence expected at jugacy {} must be from 0 to {:.6g} degrees, came {:.6g}", e.jugacy,
         180. / e.jugacy, e.angle / degree);
  if (e.pair.n > 0) sequence_of(e.pair.m, e.pair.n, e.jugacy);
}

/// The interval of the lenient rule. Half way between, where that of every pair is useless, it is 4 degrees wide.
AllowableInterval lenient_interval(ParastichyPair pair, const ExpectedPattern& e) {
  if (e.angle * e.jugacy > 179.99 * degree) return {176 * degree / e.jugacy, turn / 2 / e.jugacy, true};
  return allowable_interval(pair.m, pair.n, e.angle, e.jugacy);
}

void judge_lenient(const Pattern& p, const ExpectedPattern& e, Complaints& out) {
  ParastichyPair pair = e.pair.n > 0 ? e.pair : p.named_by.n > 0 ? p.named_by : p.contact;
  const bool half_way = e.angle * e.jugacy > 179.99 * degree;
  AllowableInterval interval;
  double half = 0;
  if (pair.n == 0 && !half_way) {
    const auto visible = visible_pairs(e.angle, e.jugacy, 5 * degree / e.jugacy);
    pair = visible.back();
  }
  if (!half_way && pair.n > 0 && std::gcd(pair.m, pair.n) != e.jugacy) {
    out.add("lenient: pair ({},{}) is not of jugacy {}", pair.m, pair.n, e.jugacy);
    return;
  }
  interval = lenient_interval(pair, e);
  half = (interval.high - interval.low) / 2 / degree;
  if (!interval.opposed)
    out.add("lenient: at {:.2f} degrees, ({},{}) is no visible opposed pair", e.angle / degree, pair.m, pair.n);
  else if (!interval.holds(p.mean, 1e-9))
    out.add("lenient: mean {:.2f} is not from {:.2f} to {:.2f} degrees", p.mean / degree, interval.low / degree,
            interval.high / degree);
  if (!(p.sd / degree < std::max(1.5, half + 1)))
    out.add("lenient: sd {:.2f} is not below {:.2f} degrees", p.sd / degree, std::max(1.5, half + 1));
  if (!(p.intra < 2.5 * degree)) out.add("lenient: intra {:.2f} is not below 2.5 degrees", p.intra / degree);
  if (!(p.spread < .5)) out.add("lenient: spread {:.2f} is not below 0.5", p.spread);
}

/// The sequence whose limit is nearest to the angle expected, of those with a name and <3, 7>, <3, 8>, <4, 9>, <5, 11>.
Sequence sequence_expected(const ExpectedPattern& e) {
  if (e.pair.n > 0) return sequence_of(e.pair.m, e.pair.n, e.jugacy);
  const std::pair<int, int> seeds[] = {{1, 1}, {1, 2}, {1, 3}, {1, 4}, {1, 5}, {1, 6}, {1, 7}, {1, 8},
                                       {2, 5}, {2, 7}, {2, 9}, {3, 7}, {3, 8}, {4, 9}, {5, 11}};
  Sequence best;
  double least = 1e300;
  for (const auto& [m, n] : seeds) {
    const Sequence s = sequence_of(m * e.jugacy, n * e.jugacy, e.jugacy);
    if (std::fabs(s.limit - e.angle) >= least) continue;
    least = std::fabs(s.limit - e.angle);
    best = s;
  }
  return best;
}

void judge_hold(const Pattern& p, const ExpectedPattern& e, Complaints& out) {
  const Sequence s = sequence_expected(e);
  const bool wide = e.jugacy > 1 || (s.kind == PatternKind::accessory && s.order == 1);
  const double within = wide ? 4 : s.kind == PatternKind::fibonacci ? 8 : 3;
  const double off = std::fabs(p.mean - e.angle) / degree;
  if (!(off < within)) out.add("hold: mean {:.2f} is not within {} degrees", p.mean / degree, within);
  if (!(p.sd < 4 * degree)) out.add("hold: sd {:.2f} is not below 4 degrees", p.sd / degree);
  if (!(p.intra < 12 * degree)) out.add("hold: intra {:.2f} is not below 12 degrees", p.intra / degree);
  if (p.contact.n == 0 || s.kind == PatternKind::alternating) return;
  if (std::gcd(p.contact.m, p.contact.n) == e.jugacy) {
    const Sequence found = sequence_of(p.contact.m, p.contact.n);
    if (found.first == s.first && found.second == s.second) return;
  }
  const std::vector<int> terms = s.terms(4);
  out.add("hold: contact pair ({},{}) is not of <{}, ...>", p.contact.m, p.contact.n, fmt::join(terms, ", "));
}

}  // namespace

std::string describe(const Pattern& p) {
  const std::string hand = p.hand == 0 || p.kind == PatternKind::alternating ? ""
                           : p.hand > 0                                      ? ", angles rising"
                                                                             : ", angles falling";
  std::string text = p.kind == PatternKind::too_few
                         ? fmt::format("too few for a name: {}", counted(p.primordia, "primordium"))
                     : p.kind == PatternKind::none ? "no order: " + counted(p.primordia, "primordium")
                                                   : p.name + ": " + counted(p.primordia, "primordium");
  if (const auto at = text.find("primordiums"); at != std::string::npos) text.replace(at, 11, "primordia");
  if (p.jugacy > 1) text += " in " + counted(p.whorls, "whorl");
  if (!p.divergences.empty()) text += ", " + angles_of(p);
  if (p.kind != PatternKind::too_few && p.kind != PatternKind::none) text += hand;
  std::string more;
  const auto add = [&](const std::string& part) { more += (more.empty() ? "\n" : ", ") + part; };
  if (p.swaps > 0)
    add(fmt::format("{} in the order of birth (raw sd {:.2f})", counted(p.swaps, "exchange"), p.raw_sd / degree));
  if (p.reversals > 0) add(counted(p.reversals, "change") + " of hand");
  if (p.jugacy > 1) add(fmt::format("whorls even to {:.2f} degrees", p.intra / degree));
  if (p.jugacy > 1 && p.missing > 0) add(fmt::format("{} missing", counted(p.missing, "partner")));
  if (p.named_by.n > 0)
    add(fmt::format("allowable {:.2f} to {:.2f}", p.interval.low / degree, p.interval.high / degree));
  if (p.plastochron.count > 0) add(fmt::format("plastochron {:.4g} (sd {:.2g})", p.plastochron.mean, p.plastochron.sd));
  if (p.plastochron_ratio.count > 0 && std::fabs(p.plastochron_ratio.mean - 1) > 1e-6)
    add(fmt::format("plastochron ratio {:.4f}", p.plastochron_ratio.mean));
  return text + more;
}

Judgement judge(const Pattern& p, const ExpectedPattern& e) {
  check_expected(e);
  Judgement result;
  if (p.jugacy != e.jugacy || p.divergences.empty()) {
    result.why = p.divergences.empty() ? "too few primordia for a divergence"
                                       : fmt::format("jugacy {} in place of {}", p.jugacy, e.jugacy);
    return result;
  }
  Complaints lenient, strict, hold;
  judge_lenient(p, e, lenient);
  if (!(std::fabs(p.mean - e.angle) <= degree))
    strict.add("strict: mean {:.2f} is not within 1 degree of {:.2f}", p.mean / degree, e.angle / degree);
  if (p.swaps > 0) strict.add("strict: {} exchanges in the order of birth", p.swaps);
  judge_hold(p, e, hold);
  result.lenient = lenient.none();
  result.strict = lenient.none() && strict.none();
  result.hold = hold.none();
  for (const Complaints* list : {&lenient, &strict, &hold})
    if (!list->none()) result.why += (result.why.empty() ? "" : "; ") + list->text();
  return result;
}

}  // namespace tunica
