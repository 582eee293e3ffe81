// SPDX-License-Identifier: MIT
// The contact pair: nearest older primordium on either side.
#include <algorithm>
#include <cmath>
#include <map>

#include "field/pattern_parts.h"

namespace tunica::pattern {

namespace {

constexpr size_t reach = 256;     // how many older primordia are looked at
constexpr double exactly = 1e-6;  // radians: straight above, or opposite

/// Differences in number to the neighbours when it arose.
std::pair<int, int> steps_to(const std::vector<PatternItem>& items, const Pattern& p, size_t at) {
  const auto step = [&](Index older) { return older == none ? 0 : (p.whorl[at] - p.whorl[older]) * p.jugacy; };
  return {step(items[at].neighbours->first), step(items[at].neighbours->second)};
}

/// Differences in number to the nearest older ones on either side, by the places.
std::pair<int, int> nearest(const std::vector<PatternItem>& items, const Pattern& p, size_t rank) {
  const auto at = static_cast<size_t>(p.sequence[rank]);
  double least[2] = {1e300, 1e300};
  int step[2] = {0, 0};
  for (size_t back = 1; back <= std::min(rank, reach); ++back) {
    const auto older = static_cast<size_t>(p.sequence[rank - back]);
    const int whorls = p.whorl[at] - p.whorl[older];
    const double side = wrap(items[older].angle - items[at].angle);
    if (whorls < 1 || std::fabs(side) < exactly) continue;
    const double distance = (items[older].place - items[at].place).squaredNorm();
    const bool opposite = std::fabs(side) > turn / 2 - exactly;
    for (const int s : {0, 1})
      if ((opposite || (side > 0) == (s == 1)) && distance < least[s]) least[s] = distance, step[s] = whorls * p.jugacy;
  }
  return {step[0], step[1]};
}

}  // namespace

std::vector<std::pair<ParastichyPair, Index>> find_contacts(const std::vector<PatternItem>& items, Pattern& p) {
  std::map<std::pair<int, int>, Index> counts;
  Index all = 0;
  for (size_t rank = items.size() / 2; rank < items.size(); ++rank) {
    const auto at = static_cast<size_t>(p.sequence[rank]);
    const auto [one, other] = items[at].neighbours ? steps_to(items, p, at) : nearest(items, p, rank);
    if (one < 1 || other < 1) continue;
    ++all;
    ++counts[{std::min(one, other), std::max(one, other)}];
  }
  std::vector<std::pair<ParastichyPair, Index>> list;
  for (const auto& [pair, count] : counts) list.push_back({{pair.first, pair.second}, count});
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  if (list.empty()) return list;
  p.contact = list.front().first;
  p.contact_share = static_cast<double>(list.front().second) / all;
  return list;
}

}  // namespace tunica::pattern
