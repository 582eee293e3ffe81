// SPDX-License-Identifier: MIT
#include "shape/apex.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace tunica {

namespace {

constexpr double path_tolerance = 1e-9;
constexpr size_t most_steps = 1u << 16;  ///< of a path; where the profile has a corner, finer ones gain little

}  // namespace

Apex::Apex(Profile profile, Curve growth)
    : profile_(std::make_shared<const Profile>(std::move(profile))),
      flow_(std::make_shared<const Flow>(std::move(growth))),
      tables_(std::make_shared<ApexTables>()) {}

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

Vec3 Apex::normal(const Vec3& p) const {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  const auto near = nearest(p, r);
  const double a = near ? near->a : place_of(p).a;
  if (!profile_->has_hole() && a <= 1e-12 * profile_->length()) return Vec3::UnitY();
  if (!(r > 0)) return normal(Place{0, a});
  const Vec2 along = near ? near->tangent : profile_->tangent(a);
  return {-along.y() * (p.x() / r), along.x(), -along.y() * (p.z() / r)};
}

/// From the tables, at a distance r from the axis.
std::optional<ApexTables::Place> Apex::nearest(const Vec3& p, double r) const {
  if (!p.allFinite()) return std::nullopt;  // the longer way says so
  return tables_->ready(*profile_, *flow_).nearest({r, p.y()});
}

double Apex::arc_of(const Vec3& p) const {
  if (!p.allFinite()) return place_of(p).a;  // which says so
  const Vec2 flat(std::sqrt(p.x() * p.x() + p.z() * p.z()), p.y());
  const auto a = tables_->ready(*profile_, *flow_).nearest_arc(flat);
  return a ? *a : place_of(p).a;
}

Vec3 Apex::facing(const Vec3& p) const {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  const auto out = r > 0 ? tables_->ready(*profile_, *flow_).facing({r, p.y()}) : std::nullopt;
  if (!out) return normal(p);
  return {out->x() * (p.x() / r), out->y(), out->x() * (p.z() / r)};
}

bool Apex::is_beyond(const Vec3& p, double a) const {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  if (p.allFinite())
    if (const auto guess = tables_->ready(*profile_, *flow_).guess({r, p.y()}))
      if (std::abs(guess->a - a) > guess->within) return guess->a > a;
  return arc_of(p) > a;
}

std::vector<char> Apex::are_beyond(const double* x, const double* y, const double* z, size_t count, double a) const {
  const ApexView* view = tables_->ready(*profile_, *flow_).view();
  std::vector<double> answers(count, std::nan(""));
  if (view) apex_kernels().beyond(*view, x, y, z, static_cast<long>(count), a, answers.data());
  std::vector<char> far(count);
  for (size_t i = 0; i < count; ++i)
    far[i] = std::isnan(answers[i]) ? is_beyond({x[i], y[i], z[i]}, a) : answers[i] > 0;
  return far;
}

/// The point of the surface at an arc length, in the direction of p from the axis.
Vec3 Apex::in_direction_of(const Vec3& p, double a) const {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  const auto known = tables_->ready(*profile_, *flow_).at(a);
  const Vec2 q = known ? *known : profile_->at(a);
  if (!(r > 0)) return {q.x(), q.y(), 0};
  return {q.x() * (p.x() / r), q.y(), q.x() * (p.z() / r)};
}

Vec3 Apex::advance(const Vec3& p, double, double dt) const {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  if (r > 0)
    if (const auto q = tables_->ready(*profile_, *flow_).moved({r, p.y()}, dt))
      return {q->x() * (p.x() / r), q->y(), q->x() * (p.z() / r)};
  const double a = arc_of(p);
  const auto there = tables_->ready(*profile_, *flow_).after(a, dt);
  return in_direction_of(p, there ? *there : after(a, dt));
}

namespace {

/// Lets a kernel answer for all points; those that it leaves out (no number) are asked for one by one.
template <class Kernel, class Single>
void answer(std::span<Vec3> points, const Kernel& kernel, const Single& single) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const std::vector<Vec3> before(points.begin(), points.end());
  if (!points.empty()) kernel(points[0].data(), static_cast<long>(points.size()));
  for (size_t i = 0; i < points.size(); ++i)
    if (std::isnan(points[i].x())) points[i] = single(before[i]);
}

}  // namespace

void Apex::advance_all(std::span<Vec3> points, double t, double dt) const {
  const ApexView* view = tables_->ready(*profile_, *flow_).view();
  if (!view || !(dt >= 0)) return Surface::advance_all(points, t, dt);
  const auto move = [&](double* xyz, long count) { apex_kernels().move(*view, dt, xyz, count); };
  answer(points, move, [&](const Vec3& p) { return advance(p, t, dt); });
}

void Apex::facing_all(std::span<Vec3> points) const {
  const ApexView* view = tables_->ready(*profile_, *flow_).view();
  if (!view) return Surface::facing_all(points);
  const auto face = [&](double* xyz, long count) { apex_kernels().face(*view, xyz, count); };
  answer(points, face, [&](const Vec3& p) { return facing(p); });
}

void Apex::places_of(const double* x, const double* y, const double* z, size_t count, double* theta, double* a) const {
  const ApexView* view = tables_->ready(*profile_, *flow_).view();
  if (view) apex_kernels().locate(*view, x, y, z, static_cast<long>(count), theta, a);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p(x[i], y[i], z[i]);
    if (!view) theta[i] = p.x() == 0 && p.z() == 0 ? 0 : std::atan2(p.z(), p.x()) * 180 / std::numbers::pi;
    if (!view || std::isnan(a[i])) a[i] = arc_of(p);
  }
}

Vec3 Apex::closest(const Vec3& p) const {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  const auto near = r > 0 ? nearest(p, r) : std::nullopt;
  if (!near) return in_direction_of(p, arc_of(p));
  return {near->point.x() * (p.x() / r), near->point.y(), near->point.x() * (p.z() / r)};
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
