// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace tunica {

/// The zero between low and high of a function that is negative at low and not at high (Illinois, with bisection).
template <class F>
double zero_between(const F& f, double low, double high) {
  double f_low = f(low), f_high = f(high);
  if (!(f_low < 0)) return low;
  if (!(f_high >= 0)) return high;
  int side = 0;
  for (int i = 0; i < 200; ++i) {
    double middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    if (i % 3 != 2) {
      const double chord = (low * f_high - high * f_low) / (f_high - f_low);
      if (chord > low && chord < high) middle = chord;
    }
    const double value = f(middle);
    if (value == 0) return middle;
    if (value < 0) {
      low = middle, f_low = value;
      if (side == -1) f_high /= 2;
      side = -1;
    } else {
      high = middle, f_high = value;
      if (side == 1) f_low /= 2;
      side = 1;
    }
    if (high - low <= 4e-16 * (std::abs(low) + std::abs(high))) break;
  }
  return std::abs(f_low) < std::abs(f_high) ? low : high;
}

}  // namespace tunica
