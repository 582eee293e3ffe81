// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <map>

#include "field/inhibition_fixtures.h"

namespace tunica {

/// What the last primordia of a run are, by groups (whorls) of j successive ones; angles in degrees.
struct Measured {
  double mean = 0, sd = 0;  ///< of the divergence between whorls, modulo 360 / j, folded to 0..180 / j
  double intra = 0;         ///< rms deviation from even spacing within whorls
  double spread = 0;        ///< longest whorl (last - first time) / plastochron of whorls
  double plastochron = 0;
  int m = 0, n = 0;  ///< contact pair: nearest older primordium on either side, modal
};

namespace measures {

inline double wrapped(double angle, double period) { return angle - period * std::round(angle / period); }

/// Circular mean of angles with this period, about 0.
inline double mean_of(const std::vector<double>& angles, double period) {
  double c = 0, s = 0;
  for (const double a : angles) c += std::cos(a / period * 360 * degree), s += std::sin(a / period * 360 * degree);
  return std::atan2(s, c) / degree * period / 360;
}

/// Nearest older primordium to the i-th when it was born, on the left and on the right, in whorls back.
inline std::pair<int, int> contacts(const InhibitionSettings& settings, const std::vector<Primordium>& p, size_t i,
                                    int j) {
  double nearest[2] = {1e300, 1e300};
  int back[2] = {0, 0};
  const size_t whorl = i / static_cast<size_t>(j);
  for (size_t k = whorl * static_cast<size_t>(j); k-- > 0 && i - k < 80 * static_cast<size_t>(j);) {
    const double turn = wrapped((p[k].angle - p[i].angle) / degree, 360);
    const Vec2 at = settings.track(std::max(0.0, p[i].birth - p[k].birth));
    const double u = std::sin(turn * degree / 2);
    const double d2 = (at - settings.ring).squaredNorm() + 4 * at.x() * settings.ring.x() * u * u;
    const int side = turn < 0;
    if (d2 < nearest[side]) nearest[side] = d2, back[side] = static_cast<int>(whorl - k / static_cast<size_t>(j)) * j;
  }
  return {std::min(back[0], back[1]), std::max(back[0], back[1])};
}

}  // namespace measures

/// @param from  first primordium that counts; a multiple of j
inline Measured measure(const InhibitionSettings& settings, const std::vector<Primordium>& p, size_t from, int j) {
  using namespace measures;
  Measured result;
  const double period = 360.0 / j;
  const auto size = static_cast<size_t>(j);
  std::vector<double> phases, turns, begins;
  double squares = 0, longest = 0;
  size_t members = 0;
  for (size_t i = from; i + size <= p.size(); i += size) {
    std::vector<double> angles;
    for (size_t k = i; k < i + size; ++k) angles.push_back(p[k].angle / degree);
    const double phase = mean_of(angles, period);
    std::sort(angles.begin(), angles.end());
    for (size_t k = 0; j > 1 && k < size; ++k, ++members) {
      const double gap = (k + 1 < size ? angles[k + 1] : angles[0] + 360) - angles[k];
      squares += (gap - period) * (gap - period);
    }
    longest = std::max(longest, p[i + size - 1].birth - p[i].birth);
    if (!phases.empty()) turns.push_back(wrapped(phase - phases.back(), period));
    phases.push_back(phase);
    begins.push_back(p[i].birth);
  }
  const double mean = mean_of(turns, period);
  double off = 0;
  for (const double t : turns) off += std::pow(wrapped(t - mean, period), 2);
  result.mean = std::fabs(mean);
  result.sd = std::sqrt(off / static_cast<double>(turns.size()));
  result.plastochron = (begins.back() - begins.front()) / static_cast<double>(begins.size() - 1);
  result.intra = members ? std::sqrt(squares / static_cast<double>(members)) : 0;
  result.spread = longest / result.plastochron;
  std::map<std::pair<int, int>, int> counts;
  for (size_t i = from; i < p.size(); ++i) ++counts[contacts(settings, p, i, j)];
  int most = 0;
  for (const auto& [pair, count] : counts)
    if (count > most) most = count, result.m = pair.first, result.n = pair.second;
  return result;
}

}  // namespace tunica
