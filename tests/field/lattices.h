// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "field/pattern.h"

namespace tunica::testing {

inline constexpr double degrees = std::numbers::pi / 180;

/// The patterns of thesis table 4.2: contact pair, divergence, jugacy; and what the names are.
struct Known {
  int m, n, jugacy;
  double angle;
  const char* name;
};
inline constexpr Known table_4_2[] = {{8, 9, 1, 41.77, "6th accessory spiral"},
                                      {7, 8, 1, 47.26, "5th accessory spiral"},
                                      {6, 11, 1, 64.08, "3rd accessory spiral"},
                                      {5, 11, 1, 66.89, "other (5,11)"},
                                      {5, 9, 1, 77.96, "2nd accessory spiral"},
                                      {9, 13, 1, 82.15, "other (9,13)"},
                                      {7, 11, 1, 99.50, "Lucas spiral"},
                                      {7, 10, 1, 106.45, "other (7,10)"},
                                      {8, 11, 1, 132.18, "other (8,11)"},
                                      {8, 13, 1, 137.51, "Fibonacci spiral"},
                                      {7, 12, 1, 151.14, "1st anomalous spiral"},
                                      {7, 9, 1, 158.14, "2nd anomalous spiral"},
                                      {9, 11, 1, 162.42, "3rd anomalous spiral"},
                                      {8, 10, 2, 38.98, "bijugate 2nd accessory spiral"},
                                      {6, 8, 2, 49.75, "bijugate Lucas spiral"},
                                      {6, 10, 2, 68.75, "bijugate Fibonacci spiral"},
                                      {4, 10, 2, 75.57, "bijugate 1st anomalous spiral"},
                                      {9, 12, 3, 33.17, "trijugate Lucas spiral"},
                                      {6, 9, 3, 45.84, "trijugate Fibonacci spiral"},
                                      {8, 12, 4, 34.38, "tetrajugate Fibonacci spiral"},
                                      {5, 10, 5, 27.50, "pentajugate Fibonacci spiral"},
                                      {6, 12, 6, 22.92, "hexajugate Fibonacci spiral"},
                                      {6, 6, 6, 30, "whorled of 6"},
                                      {8, 8, 8, 22.5, "whorled of 8"},
                                      {10, 10, 10, 18, "whorled of 10"}};

/// A lattice on a cylinder of radius 1, with what makes it less than perfect.
struct Lattice {
  double angle = 137.508;  ///< between whorls, degrees
  int jugacy = 1;
  int whorls = 40;
  double rise = .1;  ///< between whorls
  double noise = 0;  ///< standard deviation of angles, degrees
  int hand = 1;
  bool times = true;
  bool places = true;
  bool shuffled = false;  ///< members of a whorl come in any order
  double lag = 0;         ///< time between members of a whorl, plastochrons
  unsigned seed = 1;
};

inline double gaussian(std::mt19937& random) {
  const double u = (random() + 1.) / 4294967297., v = random() / 4294967296.;
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

inline std::vector<PatternItem> make(const Lattice& l) {
  std::mt19937 random(l.seed);
  std::vector<PatternItem> items;
  for (int w = 0; w < l.whorls; ++w) {
    std::vector<int> member;
    for (int k = 0; k < l.jugacy; ++k) member.push_back(k);
    for (size_t k = member.size(); l.shuffled && k > 1; --k) std::swap(member[k - 1], member[random() % k]);
    for (int k = 0; k < l.jugacy; ++k) {
      PatternItem item;
      const double turned = w * l.angle + member[static_cast<size_t>(k)] * 360. / l.jugacy;
      item.angle = l.hand * (turned + l.noise * gaussian(random)) * degrees;
      if (l.times) item.time = w + k * l.lag;
      if (l.places) item.place = {std::cos(item.angle), (w - l.whorls) * l.rise, std::sin(item.angle)};
      items.push_back(item);
    }
  }
  return items;
}

/// The rise at which the parastichies m and n are equally steep: the nearest primordia are m and n whorls back.
inline double rise_of(const Known& k) {
  const auto across = [&](int m) { return std::remainder(m / k.jugacy * k.angle, 360. / k.jugacy) * degrees; };
  const double m = k.m / k.jugacy, n = k.n / k.jugacy;
  const double square = (across(k.m) * across(k.m) - across(k.n) * across(k.n)) / (n * n - m * m);
  return square > 0 ? std::sqrt(square) : .5 * std::fabs(across(k.m)) / std::sqrt(3.);
}

}  // namespace tunica::testing
