// SPDX-License-Identifier: MIT
// The lattice of primordia from which a run may start.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "field/inhibition.h"

namespace tunica {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

}  // namespace

void Inhibition::check_empty() const {
  if (!primordia_.empty()) fail("there are {} primordia already; a lattice is the start of a run", primordia_.size());
  if (fields_.empty()) fail("a lattice needs the inhibition, whose threshold gives its plastochron");
}

/// The first field at angle 0 of whorls of ages T, 2 T, ..., each turned back by the angle against the one after it.
double Inhibition::lattice_sum(int whorls, double angle, int jugacy, double plastochron) {
  double sum = 0;
  const double radius = settings_.ring.x();
  for (int k = 1; k <= whorls; ++k) {
    const double age = k * plastochron;
    const Vec2 p = track(age);
    for (int m = 0; m < jugacy; ++m) {
      const double u = std::sin((k * angle + two_pi * m / jugacy) / 2);
      const double d2 = (p - settings_.ring).squaredNorm() + 4 * p.x() * radius * u * u;
      sum += fields_[0].rule->at(std::sqrt(std::max(d2, 1e-14 * radius * radius)), age, time_);
    }
  }
  return sum;
}

double Inhibition::add_lattice(int whorls, double angle, int jugacy, std::optional<double> given) {
  check_empty();
  if (whorls < 1 || jugacy < 1) fail("a lattice has at least one whorl of at least one primordium");
  if (!std::isfinite(angle)) fail("the lattice's angle must be a finite number, came {}", angle);
  double plastochron = given.value_or(0);
  if (given && !(*given > 0 && std::isfinite(*given)))
    fail("the lattice's spacing must be greater than 0, came {}", *given);
  if (!given) {
    const double goal = threshold(0, time_);
    const auto sum = [&](double T) { return lattice_sum(whorls, angle, jugacy, T); };
    // From long plastochrons down; sums grow, and the first that reaches the threshold is meant.
    constexpr double factor = 0.98;
    double longer = 1e4 * time_scale_, best = longer, largest = sum(longer);
    bool found = false;
    for (double T = longer * factor; T > 1e-5 * time_scale_ && !found; T *= factor) {
      poll(settings_.cancel);
      const double s = sum(T);
      if (s > largest) largest = s, best = T;
      found = s >= goal;
      if (!found) longer = T;
    }
    if (found) {
      double shorter = longer * factor;
      for (int i = 0; i < 200 && longer - shorter > 1e-14 * longer; ++i) {
        const double middle = shorter + (longer - shorter) / 2;
        (sum(middle) >= goal ? shorter : longer) = middle;
      }
      best = longer;
    }
    plastochron = best;
  }
  for (int k = whorls; k >= 1; --k)
    for (int m = 0; m < jugacy; ++m) add_primordium(-k * angle + two_pi * m / jugacy, k * plastochron);
  return plastochron;
}

}  // namespace tunica
