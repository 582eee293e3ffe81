// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <optional>

#include "shape/flow.h"
#include "shape/profile.h"
#include "shape/table.h"

namespace tunica {

/// What a growing tissue asks of an apex for each of its points, read from tables in some ten nanoseconds: the profile by
/// arc length, the nearest place to a point not far from it, and where a place will be. Agrees with Profile to 1e-12 of
/// its length and with Flow to 1e-10; where that cannot be had the answer is none, and they are to be asked.
class ApexTables {
 public:
  /// Made when first asked: an apex without cells needs none.
  const ApexTables& ready(const Profile& profile, const Flow& flow);

  bool has_profile() const { return static_cast<bool>(track_); }
  /// Point and unit tangent; for a place that nearest() or after() gave.
  std::optional<Vec2> at(double a) const;
  Vec2 tangent(double a) const;
  /// The a of the one place of the profile nearest to p: none if that is not certain.
  std::optional<double> nearest(const Vec2& p) const;
  std::optional<double> after(double a, double dt) const;

 private:
  void tabulate(const Profile& profile);
  void tabulate(const Flow& flow);
  double time(double log_a) const;

  std::once_flag once_;
  Table<2> track_;   ///< x and y by arc length
  double size_ = 1;  ///< length of the profile
  // x - y grows along most profiles, which gives a first guess, and a bound on how far the nearest place is from it.
  std::vector<double> level_;     ///< x - y where each step starts, and at the end
  std::vector<size_t> by_level_;  ///< the step at even values of x - y
  double rise_ = 0, sharpest_ = 0;  ///< least slope of x - y; largest curvature

  Table<1> clock_;             ///< time by log a
  std::vector<double> times_;  ///< at the start of each step, and at the end
  std::vector<size_t> by_time_;
  double last_ = 0, speed_at_last_ = 0, tail_rate_ = 0;
};

}  // namespace tunica
