// SPDX-License-Identifier: MIT
#include "shape/plane.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"

namespace tunica {

namespace {

void require_finite(double rate, const char* what) {
  if (!std::isfinite(rate)) fail("{} must be a finite number, not {}", what, rate);
}

void require_finite(const Vec3& centre) {
  if (!centre.allFinite()) fail("the centre of growth must be finite, not ({}, {})", centre.x(), centre.y());
}

}  // namespace

UniformGrowth::UniformGrowth(double rate, const Vec3& centre) : rate_(rate), centre_(closest(centre)) {
  require_finite(rate, "the rate of growth");
  require_finite(centre);
}

Vec3 UniformGrowth::advance(const Vec3& p, double, double dt) const {
  return centre_ + std::exp(rate_ * dt) * (closest(p) - centre_);
}

AnisotropicGrowth::AnisotropicGrowth(double rate_along, double rate_across, const Vec3& direction, const Vec3& centre)
    : along_(rate_along), across_(rate_across), direction_(closest(direction)), centre_(closest(centre)) {
  require_finite(rate_along, "the rate of growth along the direction");
  require_finite(rate_across, "the rate of growth across the direction");
  require_finite(centre);
  const double norm = direction_.norm();
  if (!std::isfinite(norm) || !(norm > 0))
    fail("the direction of growth must have a length in the plane, not ({}, {})", direction.x(), direction.y());
  direction_ /= norm;
}

Vec3 AnisotropicGrowth::advance(const Vec3& p, double, double dt) const {
  const Vec3 offset = closest(p) - centre_;
  const Vec3 along = offset.dot(direction_) * direction_;
  return centre_ + std::exp(along_ * dt) * along + std::exp(across_ * dt) * (offset - along);
}

VelocityField::VelocityField(Velocity velocity, int substeps) : velocity_(std::move(velocity)), substeps_(substeps) {
  if (!velocity_) fail("growth by a velocity field needs the function of the field");
  if (substeps < 1 || substeps > 1'000'000) fail("substeps must be between 1 and 1000000, not {}", substeps);
}

Vec3 VelocityField::checked(const Vec3& p, double t) const {
  const Vec3 v = closest(velocity_(p, t));
  if (!v.allFinite())
    fail("the velocity at ({:.6g}, {:.6g}), time {:.6g}, is not finite: ({}, {})", p.x(), p.y(), t, v.x(), v.y());
  return v;
}

Vec3 VelocityField::advance(const Vec3& p, double t, double dt) const {
  const double h = dt / substeps_;
  Vec3 at = closest(p);
  for (int i = 0; i < substeps_; ++i) {
    const double now = t + i * h;
    const Vec3 k1 = checked(at, now), k2 = checked(at + h / 2 * k1, now + h / 2);
    const Vec3 k3 = checked(at + h / 2 * k2, now + h / 2), k4 = checked(at + h * k3, now + h);
    at += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return at;
}

}  // namespace tunica
