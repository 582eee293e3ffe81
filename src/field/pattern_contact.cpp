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

}  // namespace

std::vector<std::pair<ParastichyPair, Index>> find_contacts(const std::vector<PatternItem>& items, Pattern& p) {
  for (const PatternItem& item : items)
    if (!item.place.allFinite()) return {};
  std::map<std::pair<int, int>, Index> counts;
  Index all = 0;
  for (size_t rank = items.size() / 2; rank < items.size(); ++rank) {
    const auto at = static_cast<size_t>(p.sequence[rank]);
    double nearest[2] = {1e300, 1e300};
    int step[2] = {0, 0};
    for (size_t back = 1; back <= std::min(rank, reach); ++back) {
      const auto older = static_cast<size_t>(p.sequence[rank - back]);
      const int whorls = p.whorl[at] - p.whorl[older];
      const double side = wrap(items[older].angle - items[at].angle);
      if (whorls < 1 || std::fabs(side) < exactly) continue;
      const double distance = (items[older].place - items[at].place).squaredNorm();
      const bool opposite = std::fabs(side) > turn / 2 - exactly;
      for (const int s : {0, 1}) {
        if (!opposite && (side > 0) != (s == 1)) continue;
        if (distance >= nearest[s]) continue;
        nearest[s] = distance;
        step[s] = whorls * p.jugacy;
      }
    }
    if (step[0] == 0 || step[1] == 0) continue;
    ++all;
    ++counts[{std::min(step[0], step[1]), std::max(step[0], step[1])}];
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
