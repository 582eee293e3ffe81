// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <optional>

#include "shape/flow.h"
#include "shape/profile.h"
#include "shape/table.h"

namespace tunica {

/// What a growing tissue asks of an apex for each of its points, read from tables in some ten nanoseconds: the profile
/// by arc length, the nearest place to a point not far from it, and where a place will be. Agrees with Profile to 1e-12
/// of its length and with Flow to 1e-10 (moved(): both to 1e-9 of the length); where that cannot be had the answer is
/// none, and they are to be asked.
class ApexTables {
 public:
  /// Made when first asked: an apex without cells needs none.
  const ApexTables& ready(const Profile& profile, const Flow& flow);

  /// The same for many points at once (apex_kernels.h); nullptr: not to be had.
  const ApexView* view() const { return viewed_ ? &view_ : nullptr; }
  bool has_profile() const { return static_cast<bool>(track_); }
  std::optional<Vec2> at(double a) const;
  /// The one place of the profile nearest to p: none if that is not certain.
  struct Place {
    double a;
    Vec2 point, tangent;
  };
  std::optional<Place> nearest(const Vec2& p) const;
  std::optional<double> nearest_arc(const Vec2& p) const;  ///< its a
  /// Normal to the profile, of any length, close to a point that is close to it. None close to the tip.
  std::optional<Vec2> facing(const Vec2& p) const;
  std::optional<double> after(double a, double dt) const;
  /// Where a point of the profile, to 1e-9 of its length, is after dt. None close to the tip.
  std::optional<Vec2> moved(const Vec2& p, double dt) const;
  /// The a of a point of the profile and a distance: the nearest place to p is not farther from it, along the profile.
  struct Guess {
    double a, within;
  };
  std::optional<Guess> guess(const Vec2& p) const;

 private:
  void tabulate(const Profile& profile);
  void tabulate(const Flow& flow);
  void tabulate_movement(const Profile& profile, const Flow& flow);
  double between_steps(double level) const;
  double first_guess(const Vec2& p) const;
  double a_of_level(double level) const;
  double time(double a) const;
  double a_of_time(double time) const;

  std::once_flag once_;
  Table<2> track_;   ///< x and y by arc length
  double size_ = 1;  ///< length of the profile
  // x - y, the level, grows along most profiles: it tells how far along a point is.
  std::vector<double> level_;       ///< where each step of track_ starts, and at the end
  std::vector<size_t> by_level_;    ///< the step at even values of it
  double rise_ = 0, sharpest_ = 0;  ///< least slope of x - y; largest curvature

  Table<1> clock_;             ///< time by log a
  std::vector<double> times_;  ///< at the start of each step, and at the end
  std::vector<size_t> by_time_;
  double last_ = 0, speed_at_last_ = 0, tail_rate_ = 0;

  Table<3> place_;   ///< x, a and time by level
  Table<2> course_;  ///< x and y by time
  ApexView view_;
  bool viewed_ = false;
};

}  // namespace tunica
