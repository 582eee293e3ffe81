// SPDX-License-Identifier: MIT
// What of an apex picture is reckoned and not drawn: parastichies, minima of a ring.
#include <algorithm>
#include <cmath>

#include "view/apex_scene_parts.h"

namespace tunica {
namespace {

constexpr double turn = 2 * M_PI;

/// An angle as the nearest equivalent to `near`.
double unwrap(double angle, double near) { return near + std::remainder(angle - near, turn); }

/// Calls visit(i, k) for primordia and each member of the whorl that is `steps` primordia later.
template <class Visit>
void each_candidate(size_t count, int steps, int jugacy, Visit&& visit) {
  for (size_t i = 0; i < count; ++i) {
    const auto j = static_cast<size_t>(jugacy), first = (i / j + static_cast<size_t>(steps) / j) * j;
    for (size_t k = first; k < std::min(first + j, count); ++k) visit(i, k);
  }
}

/// The mean turn from a primordium to the nearest in angle of the whorl `steps` later. `side` 1 or -1: to the nearest
/// on that side; 0: whichever is nearer.
double mean_turn(const std::vector<Bump>& primordia, int steps, int jugacy, int side) {
  std::vector<double> nearest(primordia.size(), INFINITY);
  each_candidate(primordia.size(), steps, jugacy, [&](size_t i, size_t k) {
    double angle = unwrap(primordia[k].theta - primordia[i].theta, 0);
    if (side != 0 && angle * side < 0) angle += side * turn;
    if (std::abs(angle) < std::abs(nearest[i])) nearest[i] = angle;
  });
  double cosines = 0, sines = 0;
  for (const double angle : nearest)
    if (std::isfinite(angle)) cosines += std::cos(angle), sines += std::sin(angle);
  const double mean = std::atan2(sines, cosines);
  return side != 0 && mean * side < 0 ? mean + side * turn : mean;
}

std::vector<Link> links_of(const std::vector<Bump>& primordia, int steps, int jugacy, double mean) {
  std::vector<Link> best(primordia.size(), {0, 0, INFINITY});
  each_candidate(primordia.size(), steps, jugacy, [&](size_t i, size_t k) {
    const double angle = unwrap(primordia[k].theta - primordia[i].theta, mean);
    if (std::abs(angle - mean) < std::abs(best[i].turn - mean)) best[i] = {i, k, angle};
  });
  std::erase_if(best, [&](const Link& link) {
    return !std::isfinite(link.turn) || std::abs(link.turn - mean) > 0.5 * turn / steps;
  });
  return best;
}

}  // namespace

std::pair<std::vector<Link>, std::vector<Link>> parastichies(const std::vector<Bump>& primordia,
                                                             std::pair<int, int> pair, int jugacy) {
  const auto [m, n] = pair;
  double first = mean_turn(primordia, m, jugacy, m == n ? 1 : 0);
  double second = mean_turn(primordia, n, jugacy, m == n ? -1 : 0);
  return {links_of(primordia, m, jugacy, first), links_of(primordia, n, jugacy, second)};
}

std::vector<Minimum> minima_of(const FieldRing& ring) {
  const auto& v = ring.values;
  const size_t count = v.size();
  std::vector<Minimum> minima;
  for (size_t i = 0; i < count; ++i) {
    if (!(v[i] < v[(i + count - 1) % count])) continue;
    size_t level = 1;  // points in a row with the same value: their middle counts
    while (level < count && v[(i + level) % count] == v[i]) ++level;
    if (!(v[i] < v[(i + level) % count])) continue;
    const size_t last = i + level - 1;
    const double end = ring.angles[last % count] + (last >= count ? turn : 0);
    minima.push_back({0.5 * (ring.angles[i] + end), v[i], false});
  }
  if (minima.empty()) return minima;
  const auto by_depth = [](const Minimum& a, const Minimum& b) { return a.depth < b.depth; };
  auto chosen = std::min_element(minima.begin(), minima.end(), by_depth);
  // The field has a pole at a primordium just made: what three quarters of the ring stay below is high enough.
  std::vector<double> sorted = v;
  std::sort(sorted.begin(), sorted.end());
  const double lowest = chosen->depth, highest = sorted[3 * count / 4];
  if (ring.chosen)
    chosen = std::min_element(minima.begin(), minima.end(), [&](const Minimum& a, const Minimum& b) {
      return std::abs(unwrap(a.angle - *ring.chosen, 0)) < std::abs(unwrap(b.angle - *ring.chosen, 0));
    });
  chosen->chosen = true;
  for (Minimum& minimum : minima)
    minimum.depth = highest > lowest ? std::max(0.0, highest - minimum.depth) / (highest - lowest) : 1;
  return minima;
}

Colour family_colour(int family) { return family == 0 ? Colour{.80f, .18f, .12f, 1} : Colour{.10f, .30f, .72f, 1}; }

}  // namespace tunica
