// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "tissue/surface.h"

namespace tunica {

/// The plane z = 0, growing in some way. Rates are relative elemental rates of length, per unit of time: at rate r a
/// length l becomes l exp(r dt), an area a exp(2 r dt) if both directions grow alike.
class Plane : public Surface {
 public:
  Vec3 closest(const Vec3& p) const override { return {p.x(), p.y(), 0}; }
  Vec3 normal(const Vec3&) const override { return Vec3::UnitZ(); }
};

/// Uniform growth away from a centre; exact for any dt. Errors: a rate or centre that is not finite.
class UniformGrowth : public Plane {
 public:
  explicit UniformGrowth(double rate, const Vec3& centre = Vec3::Zero());
  Vec3 advance(const Vec3& p, double t, double dt) const override;

 private:
  double rate_;
  Vec3 centre_;
};

/// Growth at one rate along a direction and at another across it; exact for any dt. Errors: rates or centre not finite,
/// a direction without length in the plane.
class AnisotropicGrowth : public Plane {
 public:
  AnisotropicGrowth(double rate_along, double rate_across, const Vec3& direction, const Vec3& centre = Vec3::Zero());
  Vec3 advance(const Vec3& p, double t, double dt) const override;

 private:
  double along_, across_;
  Vec3 direction_, centre_;
};

/// Growth by a field of velocities v(p, t), integrated by the classical Runge-Kutta method (fourth order).
/// Errors (when it moves): a velocity that is not finite, with the place.
class VelocityField : public Plane {
 public:
  using Velocity = std::function<Vec3(const Vec3& p, double t)>;
  /// @param substeps  equal steps per call of advance(), at least 1
  explicit VelocityField(Velocity velocity, int substeps = 1);
  Vec3 advance(const Vec3& p, double t, double dt) const override;

 private:
  Vec3 checked(const Vec3& p, double t) const;
  Velocity velocity_;
  int substeps_;
};

}  // namespace tunica
