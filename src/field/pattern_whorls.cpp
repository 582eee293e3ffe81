// SPDX-License-Identifier: MIT
// Jugacy. Angles modulo a turn / j cannot tell it, so a grouping is judged by the spacing and the times within whorls.
#include <algorithm>
#include <bitset>
#include <cmath>
#include <complex>

#include "field/pattern_parts.h"

namespace tunica::pattern {

namespace {

constexpr int largest_jugacy = 12;                                        // of those looked for
constexpr double missing_whorl = .8, missing_partner = .2, cut_off = .3;  // costs; random angles cost 1 a primordium
constexpr double even = 4.8 * degree, even_share = .07;  // rms deviation of gaps in what counts as a whorl
constexpr double mostly_complete = .7;
constexpr double loose = 40 * degree;  // times 1 / j: sd of divergences between whorls
constexpr double clearly_better = .7;
constexpr double together = .25, apart = .6;  // usual spread, of that of evenly spaced times
constexpr double per_swap = 40 * degree;      // what exchanges in a spiral count for, times their share

/// Costs of whorls that begin with one primordium, member by member.
class Group {
 public:
  Group(const std::vector<PatternItem>& items, size_t first, int jugacy, double plastochron)
      : items_(items), first_(first), j_(jugacy), plastochron_(plastochron) {}

  void add() {
    const double angle = items_[first_ + size_].angle;
    sum_ += std::polar(1., j_ * wrap(angle));
    const double place = std::remainder(angle - items_[first_].angle, turn) * j_ / turn;
    const auto slot = static_cast<size_t>((static_cast<int>(std::lround(place)) % j_ + j_) % j_);
    twice_ += taken_[slot] ? 1 : 0;
    taken_.set(slot);
    ++size_;
  }
  double cost() const {
    const auto g = static_cast<double>(size_);
    double cost = g - std::norm(sum_) / g + twice_;
    if (plastochron_ > 0) cost += (items_[first_ + size_ - 1].time - items_[first_].time) / plastochron_;
    if (size_ == static_cast<size_t>(j_)) return cost;
    if (first_ == 0 || first_ + size_ == items_.size()) return cost + cut_off;
    return cost + missing_whorl + missing_partner * (j_ - g);
  }

 private:
  const std::vector<PatternItem>& items_;
  size_t first_, size_ = 0;
  int j_;
  double plastochron_;  // of whorls
  std::complex<double> sum_ = 0;
  std::bitset<128> taken_;
  int twice_ = 0;
};

std::vector<Index> cheapest(const std::vector<PatternItem>& items, int jugacy, const std::vector<double>& plastochron) {
  const size_t n = items.size();
  std::vector<double> cost(n + 1, 1e300);
  std::vector<size_t> before(n + 1, 0);
  cost[0] = 0;
  for (size_t i = 0; i < n; ++i) {
    Group group(items, i, jugacy, plastochron.empty() ? 0 : plastochron[i] * jugacy);
    for (size_t g = 1; g <= static_cast<size_t>(jugacy) && i + g <= n; ++g) {
      group.add();
      const double sum = cost[i] + group.cost();
      if (sum < cost[i + g]) {
        cost[i + g] = sum;
        before[i + g] = i;
      }
    }
  }
  std::vector<Index> begin = {static_cast<Index>(n)};
  for (size_t i = n; i > 0; i = before[i]) begin.push_back(static_cast<Index>(before[i]));
  std::reverse(begin.begin(), begin.end());
  return begin;
}

/// Sum of the squares of what the gaps between the members of a complete whorl differ from even ones.
double unevenness(const std::vector<PatternItem>& items, size_t first, int jugacy) {
  std::vector<double> angles;
  for (size_t i = first; i < first + static_cast<size_t>(jugacy); ++i) {
    const double a = wrap(items[i].angle);
    angles.push_back(a < 0 ? a + turn : a);
  }
  std::sort(angles.begin(), angles.end());
  angles.push_back(angles.front() + turn);
  double sum = 0;
  for (size_t i = 1; i < angles.size(); ++i) sum += std::pow(angles[i] - angles[i - 1] - turn / jugacy, 2);
  return sum;
}

double phase_of(const std::vector<PatternItem>& items, Index begin, Index end, int jugacy) {
  std::complex<double> sum = 0;
  for (Index i = begin; i < end; ++i) sum += std::polar(1., jugacy * wrap(items[static_cast<size_t>(i)].angle));
  return std::arg(sum) / jugacy;
}

void measure(const std::vector<PatternItem>& items, const std::vector<double>& plastochron, Whorls& w) {
  const size_t count = w.begin.size() - 1;
  const double period = turn / w.jugacy;
  std::vector<double> spreads;
  double squares = 0, longest = 0, last_phase = 0;
  for (size_t k = 0; k < count; ++k) {
    const Index begin = w.begin[k], size = w.begin[k + 1] - begin;
    const double phase = phase_of(items, begin, begin + size, w.jugacy);
    if (k > 0) w.divergences.push_back(wrap(phase - last_phase, period));
    last_phase = phase;
    if (!plastochron.empty()) {
      double sum = 0;
      for (Index i = begin; i < begin + size; ++i) sum += items[static_cast<size_t>(i)].time;
      w.times.push_back(sum / size);
    }
    if (size < w.jugacy) {
      if (k > 0 && k + 1 < count) w.missing += w.jugacy - size;
      continue;
    }
    ++w.complete;
    squares += unevenness(items, static_cast<size_t>(begin), w.jugacy);
    if (plastochron.empty()) continue;
    const double lasted = items[static_cast<size_t>(begin + size - 1)].time - items[static_cast<size_t>(begin)].time;
    longest = std::max(longest, lasted);
    const double local = plastochron[static_cast<size_t>(begin)] * w.jugacy;
    spreads.push_back(local > 0 ? lasted / local : 0);
  }
  if (w.complete > 0) w.intra = std::sqrt(squares / (static_cast<double>(w.complete) * w.jugacy));
  w.usual_spread = figures(spreads).median;
  if (w.times.size() > 1 && w.times.back() > w.times.front())
    w.spread = longest / ((w.times.back() - w.times.front()) / static_cast<double>(w.times.size() - 1));
}

/// Mean size of what a grouping leaves unexplained.
double residual(const Whorls& w) {
  const double sd = circular(w.divergences, turn / w.jugacy).sd;
  return std::sqrt((w.intra * w.intra + sd * sd) / 2);
}

bool acceptable(const Whorls& w, bool timed) {
  const auto count = static_cast<Index>(w.begin.size()) - 1;
  Index inner = count;
  if (count > 0 && w.begin[1] - w.begin[0] < w.jugacy) --inner;
  if (count > 1 && w.begin[static_cast<size_t>(count)] - w.begin[static_cast<size_t>(count) - 1] < w.jugacy) --inner;
  if (count < 2 || w.complete < 1 || w.complete < mostly_complete * inner) return false;
  if (count - 1 + (w.jugacy - 1) * w.complete < 5) return false;  // as many angles as these could fit by chance
  if (w.intra > std::max(even, even_share * turn / w.jugacy)) return false;
  if (circular(w.divergences, turn / w.jugacy).sd * w.jugacy > loose) return false;
  return !timed || w.usual_spread <= apart * (w.jugacy - 1) / w.jugacy;
}

}  // namespace

Whorls group(const std::vector<PatternItem>& items, int jugacy, const std::vector<double>& plastochron) {
  Whorls w;
  w.jugacy = jugacy;
  w.begin = cheapest(items, jugacy, plastochron);
  measure(items, plastochron, w);
  return w;
}

Whorls find_whorls(const std::vector<PatternItem>& items, const Spiral& spiral,
                   const std::vector<double>& plastochron) {
  const bool timed = !plastochron.empty();
  Whorls best = group(items, 1, plastochron);
  const double share = static_cast<double>(spiral.swaps) / static_cast<double>(std::max<size_t>(1, items.size()));
  double least = circular(spiral.divergences).sd + per_swap * share;
  bool by_times = false;
  const int most = std::min<int>(largest_jugacy, static_cast<int>(items.size()) / 2);
  for (int j = 2; j <= most; ++j) {
    Whorls w = group(items, j, plastochron);
    if (!acceptable(w, timed)) continue;
    const double left = residual(w);
    const bool simultaneous = timed && w.usual_spread <= together * (j - 1) / j;
    const bool first_by_times = simultaneous && !by_times;
    if (!first_by_times && left + .3 * degree >= clearly_better * least) continue;
    if (by_times && !simultaneous) continue;
    by_times = simultaneous;
    least = left;
    best = std::move(w);
  }
  return best;
}

}  // namespace tunica::pattern
