// SPDX-License-Identifier: MIT
#include "shape/apex.h"

#include <cmath>

#include "base/error.h"

namespace tunica {

namespace {

constexpr double path_tolerance = 1e-9;
constexpr size_t most_steps = 1u << 16;  ///< of a path; where the profile has a corner, finer ones gain little

}  // namespace

Vec3 Apex::position(double theta, double a) const {
  if (!std::isfinite(theta)) fail("the angle of a place must be finite, not {}", theta);
  if (!std::isfinite(a) || a < 0) fail("a place on the profile is its distance from the tip, 0 or more, not {}", a);
  const Vec2 p = profile_->at(a);
  return {p.x() * std::cos(theta), p.y(), p.x() * std::sin(theta)};
}

Apex::Place Apex::place_of(const Vec3& p) const {
  if (!p.allFinite()) fail("a point must be finite, not ({}, {}, {})", p.x(), p.y(), p.z());
  const double r = std::hypot(p.x(), p.z());
  return {r > 0 ? std::atan2(p.z(), p.x()) : 0, profile_->closest({r, p.y()})};
}

Vec3 Apex::normal(const Place& place) const {
  if (!profile_->has_hole() && place.a <= 1e-12 * profile_->length()) return Vec3::UnitY();
  const Vec2 along = profile_->tangent(place.a);
  return {-along.y() * std::cos(place.theta), along.x(), -along.y() * std::sin(place.theta)};
}

Vec3 Apex::advance(const Vec3& p, double, double dt) const {
  const Place place = place_of(p);
  return position(place.theta, after(place.a, dt));
}

Vec3 Apex::closest(const Vec3& p) const {
  const Place place = place_of(p);
  return position(place.theta, place.a);
}

Path Apex::path(double a0, double oldest) const { return {*this, a0, oldest}; }

Path::Path(const Apex& apex, double start, double oldest) : apex_(apex), start_(start) {
  if (!std::isfinite(oldest) || !(oldest > 0)) fail("the oldest age of a path must be positive, not {}", oldest);
  for (size_t steps = 64; steps <= most_steps; steps *= 2) {
    per_age_ = static_cast<double>(steps) / oldest;
    tabulate(steps);
    if (error_ <= path_tolerance) return;
  }
}

void Path::tabulate(size_t steps) {
  table_.clear();
  table_.reserve(8 * steps);
  last_ = static_cast<double>(steps);
  const auto place = [&](double age, Vec2& point, Vec2& slope) {
    const double a = apex_.after(start_, age);
    point = apex_.profile().at(a);
    slope = apex_.speed(a) / per_age_ * apex_.profile().tangent(a);
  };
  Vec2 p, dp, q, dq;
  place(0, p, dp);
  for (size_t i = 1; i <= steps; ++i, p = q, dp = dq) {
    place(static_cast<double>(i) / per_age_, q, dq);
    for (int axis = 0; axis < 2; ++axis) {
      const double rise = q[axis] - p[axis];
      for (const double c : {p[axis], dp[axis], 3 * rise - 2 * dp[axis] - dq[axis], dp[axis] + dq[axis] - 2 * rise})
        table_.push_back(c);
    }
  }
  error_ = 0;
  for (size_t i = 0; i < steps && (error_ <= path_tolerance || steps == most_steps); ++i) {
    const double age = (static_cast<double>(i) + .5) / per_age_;
    const Vec2 exact = beyond(age);
    error_ = std::max(error_, (at(age) - exact).norm() / (1 + (exact - apex_.profile().at(start_)).norm()));
  }
}

Vec2 Path::beyond(double age) const { return apex_.profile().at(apex_.after(start_, age)); }

}  // namespace tunica
