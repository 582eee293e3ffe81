// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "shape/apex_tables.h"
#include "shape/flow.h"
#include "shape/profile.h"
#include "tissue/surface.h"

namespace tunica {

class Path;

/// A shoot apex (thesis 3.3): a surface of revolution around the y axis with the tip at the top, growing along its
/// profile. A point of it is (theta, a), angle in radians and arc length from the tip; (3.1) puts it at
/// (x(a) cos theta, y(a), x(a) sin theta). It moves away from the tip at the speed v(a), the integral of the relative
/// elemental growth rate (3.2), and keeps its theta. The form of the surface stays. Cheap to copy.
class Apex : public Surface {
 public:
  struct Place {
    double theta, a;  ///< theta in (-pi, pi]; 0 on the axis
  };

  Apex(Profile profile, Curve growth);

  const Profile& profile() const { return *profile_; }
  const Curve& growth() const { return flow_->rate(); }
  bool shrinks() const { return growth().least() < 0; }  ///< somewhere the rate is negative: legal, but worth a word

  double speed(double a) const { return flow_->speed(a); }
  /// Where what is at a is after dt (either sign); exact, see Flow.
  double after(double a, double dt) const { return flow_->after(a, dt); }
  /// The area from the tip (or the rim of a hole there) to a.
  double area(double a) const { return profile_->area(a); }
  /// Errors: a negative or not finite, theta not finite.
  Vec3 position(double theta, double a) const;
  /// The place on the surface nearest to a point in space.
  Place place_of(const Vec3& p) const;
  /// The outward unit normal at a place; at the tip along the axis.
  Vec3 normal(const Place& place) const;

  // For points of tissues: what many ask is read from tables, made when first asked, that agree with the above to 1e-10
  // (relative to the size of the profile, and to a); where they do not serve, the same is found the longer way.
  Vec3 advance(const Vec3& p, double t, double dt) const override;
  Vec3 closest(const Vec3& p) const override;
  Vec3 normal(const Vec3& p) const override;
  Vec3 facing(const Vec3& p) const override;
  void advance_all(std::span<Vec3> points, double t, double dt) const override;
  void facing_all(std::span<Vec3> points) const override;
  /// theta (in degrees, 0 on the axis) and a of `count` points, as of place_of().
  void places_of(const double* x, const double* y, const double* z, size_t count, double* theta, double* a) const;
  /// As place_of(p).a.
  double arc_of(const Vec3& p) const;
  /// arc_of(p) > a, found with less work where it is clear.
  bool is_beyond(const Vec3& p, double a) const;
  /// Of many points, in order.
  std::vector<char> are_beyond(const double* x, const double* y, const double* z, size_t count, double a) const;

  /// The way of what is at a0 at age 0. @param oldest  ages up to this one are tabulated. Errors: as after(), and an
  /// oldest age that is not positive.
  Path path(double a0, double oldest) const;

 private:
  Vec3 in_direction_of(const Vec3& p, double a) const;
  std::optional<ApexTables::Place> nearest(const Vec3& p, double r) const;
  std::shared_ptr<const Profile> profile_;
  std::shared_ptr<const Flow> flow_;
  std::shared_ptr<ApexTables> tables_;
};

/// The place by age of what moves along an apex, from a table: Hermite cubics in equal steps of age, with an error of
/// at most 1e-9 (relative to 1 + distance from the start) where the profile and its tangent are continuous.
class Path {
 public:
  /// (x, y) of the profile at an age of 0 or more. Beyond the table slow, and exact.
  Vec2 at(double age) const {
    const double place = age * per_age_;
    if (!(place >= 0 && place < last_)) return beyond(age);
    const auto i = static_cast<size_t>(place);
    const double s = place - static_cast<double>(i);
    const double* c = table_.data() + 8 * i;
    return {c[0] + s * (c[1] + s * (c[2] + s * c[3])), c[4] + s * (c[5] + s * (c[6] + s * c[7]))};
  }
  double arc(double age) const { return apex_.after(start_, age); }  ///< a at an age; slow, exact
  double start() const { return start_; }
  double oldest() const { return last_ / per_age_; }
  double step() const { return 1 / per_age_; }
  double error() const { return error_; }  ///< largest seen, between the entries of the table
  /// The coefficients of powers of s, 0 <= s < 1 within a step: four of x, then four of y, step after step.
  const std::vector<double>& table() const { return table_; }

 private:
  friend class Apex;
  Path(const Apex& apex, double start, double oldest);
  void tabulate(size_t steps);
  Vec2 beyond(double age) const;
  Apex apex_;
  double start_, per_age_ = 1, last_ = 0, error_ = 0;  ///< last_: number of steps
  std::vector<double> table_;
};

}  // namespace tunica
