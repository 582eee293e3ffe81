// SPDX-License-Identifier: MIT
#include "field/pattern.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/error.h"
#include "field/pattern_parts.h"

namespace tunica {
namespace pattern {

double wrap(double angle, double period) {
  const double w = std::remainder(angle, period);
  return w <= -period / 2 ? w + period : w;
}

Circular circular(const std::vector<double>& angles, double period) {
  Circular result;
  if (angles.empty()) return result;
  std::complex<double> sum = 0;
  for (const double a : angles) sum += std::polar(1., a * turn / period);
  result.mean = wrap(std::arg(sum) * period / turn, period);
  double squares = 0, rest = 0;
  for (const double a : angles) rest += wrap(a - result.mean, period);
  result.mean = wrap(result.mean + rest / static_cast<double>(angles.size()), period);
  for (const double a : angles) squares += std::pow(wrap(a - result.mean, period), 2);
  result.sd = std::sqrt(squares / static_cast<double>(angles.size()));
  return result;
}

Figures figures(std::vector<double> values) {
  Figures f;
  f.count = static_cast<Index>(values.size());
  if (values.empty()) return f;
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  f.mean = sum / f.count;
  for (const double v : values) squares += (v - f.mean) * (v - f.mean);
  f.sd = std::sqrt(squares / f.count);
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  f.median = values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
  return f;
}

std::vector<double> local_plastochrons(const std::vector<PatternItem>& items) {
  constexpr size_t reach = 16;
  std::vector<double> list;
  const size_t n = items.size();
  if (n < 2 || !(items.back().time > items.front().time)) return list;
  const double least = .1 * (items.back().time - items.front().time) / static_cast<double>(n - 1);
  for (size_t i = 0; i < n; ++i) {
    const size_t from = i > reach ? i - reach : 0, to = std::min(n - 1, i + reach);
    list.push_back(std::max(least, (items[to].time - items[from].time) / static_cast<double>(to - from)));
  }
  return list;
}

namespace {

/// Whether the times of all are known. Errors: an angle that is no number, times that fall.
bool check(const std::vector<PatternItem>& items) {
  bool timed = !items.empty();
  for (size_t i = 0; i < items.size(); ++i) {
    if (!std::isfinite(items[i].angle)) fail("the angle of primordium {} is no finite number", i + 1);
    timed = timed && std::isfinite(items[i].time);
    if (timed && i > 0 && items[i].time < items[i - 1].time)
      fail("primordia are listed oldest first, but primordium {} was born at {:.10g}, before {} at {:.10g}", i + 1,
           items[i].time, i, items[i - 1].time);
  }
  return timed;
}

std::vector<double> differences(const std::vector<double>& values) {
  std::vector<double> list;
  for (size_t i = 1; i < values.size(); ++i) list.push_back(values[i] - values[i - 1]);
  return list;
}

/// Distance from the axis of each whorl (geometric mean) against that of the next.
Figures ratios(const std::vector<PatternItem>& items, const Pattern& p) {
  std::vector<double> logs(static_cast<size_t>(p.whorls), 0), count(static_cast<size_t>(p.whorls), 0);
  for (size_t i = 0; i < items.size(); ++i) {
    const double r = std::hypot(items[i].place.x(), items[i].place.z());
    if (!(r > 0) || !std::isfinite(r)) return {};
    logs[static_cast<size_t>(p.whorl[i])] += std::log(r);
    count[static_cast<size_t>(p.whorl[i])] += 1;
  }
  std::vector<double> list;
  for (size_t k = 1; k < logs.size(); ++k) list.push_back(logs[k - 1] / count[k - 1] - logs[k] / count[k]);
  Figures f = figures(list);
  if (f.count == 0) return f;
  const double mean = std::exp(f.mean);
  return {mean, f.sd * mean, std::exp(f.median), f.count};
}

void take_whorls(const std::vector<PatternItem>& items, const Whorls& w, const Spiral& spiral, Pattern& p) {
  p.jugacy = w.jugacy;
  p.whorls = static_cast<Index>(w.begin.size()) - 1;
  p.whorl.assign(items.size(), 0);
  for (Index k = 0; k < p.whorls; ++k)
    for (Index i = w.begin[static_cast<size_t>(k)]; i < w.begin[static_cast<size_t>(k) + 1]; ++i)
      p.whorl[static_cast<size_t>(i)] = k;
  p.divergences = w.divergences;
  for (size_t i = 0; i < items.size(); ++i) p.sequence.push_back(static_cast<Index>(i));
  p.intra = w.intra;
  p.spread = w.spread;
  p.missing = w.missing;
  p.plastochron = figures(differences(w.times));
  if (w.jugacy > 1) return;
  p.intra = p.spread = 0;
  p.sequence = spiral.sequence;
  p.swaps = spiral.swaps;
  p.divergences = spiral.divergences;
  for (size_t k = 0; k < p.sequence.size(); ++k) p.whorl[static_cast<size_t>(p.sequence[k])] = static_cast<int>(k);
}

}  // namespace

void measure_divergences(Pattern& p) {
  const double period = turn / p.jugacy, ambiguous = 10 * degree / p.jugacy;
  const Circular all = circular(p.divergences, period);
  int balance = 0, current = 0, run = 0, last = 0;
  for (const double d : p.divergences) {
    if (std::fabs(d) < ambiguous || std::fabs(d) > period / 2 - ambiguous) continue;
    const int sign = d > 0 ? 1 : -1;
    balance += sign;
    run = sign == last ? run + 1 : 1;
    last = sign;
    if (run < 2 || sign == current) continue;
    p.reversals += current != 0 ? 1 : 0;
    current = sign;
  }
  p.hand = balance > 0 ? 1 : balance < 0 ? -1 : 0;
  const int towards = p.hand != 0 ? p.hand : all.mean < 0 ? -1 : 1;
  const auto turned = [&](double d, double of) { return towards > 0 ? d : wrap(-d, of); };
  for (double& d : p.divergences) d = turned(d, period);
  for (double& d : p.raw) d = turned(d, turn);
  std::vector<double> absolute;
  for (const double d : p.divergences) absolute.push_back(std::fabs(d));
  const Figures folded = figures(absolute);
  p.folded_mean = folded.mean;
  p.folded_sd = folded.sd;
  p.mean = std::fabs(wrap(towards * all.mean, period));
  p.sd = all.sd;
  const Circular raw = circular(p.raw);
  p.raw_mean = std::fabs(raw.mean);
  p.raw_sd = raw.sd;
}

}  // namespace pattern

Pattern read_pattern(const std::vector<PatternItem>& items, const PatternOptions& options) {
  using namespace pattern;
  if (options.jugacy < 0 || options.jugacy > 100) fail("a jugacy must be from 1 to 100, came {}", options.jugacy);
  const bool timed = check(items);
  Pattern p;
  p.primordia = static_cast<Index>(items.size());
  for (size_t i = 1; i < items.size(); ++i) p.raw.push_back(wrap(items[i].angle - items[i - 1].angle));
  const std::vector<double> plastochron = timed ? local_plastochrons(items) : std::vector<double>();
  const Spiral spiral = options.jugacy < 2 ? best_spiral(items, plastochron) : Spiral();
  const Whorls whorls =
      options.jugacy == 0 ? find_whorls(items, spiral, plastochron) : group(items, options.jugacy, plastochron);
  take_whorls(items, whorls, spiral, p);
  measure_divergences(p);
  p.plastochron_ratio = ratios(items, p);
  const auto contacts = find_contacts(items, p);
  name_pattern(contacts, !plastochron.empty(), p);
  return p;
}

}  // namespace tunica
