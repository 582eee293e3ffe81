// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "tissue/builders.h"
#include "tissue/surface.h"

namespace tunica::testing {

/// The unit sphere with its tip at (0, 1, 0); arc lengths from the tip grow at a relative rate.
class Cap : public Surface {
 public:
  explicit Cap(double rate = 0) : rate_(rate) {}
  static Vec3 at(double theta, double a) {
    return {std::sin(a) * std::cos(theta), std::cos(a), std::sin(a) * std::sin(theta)};
  }
  static double arc(const Vec3& p) { return std::atan2(std::hypot(p.x(), p.z()), p.y()); }
  Vec3 advance(const Vec3& p, double, double dt) const override {
    return at(std::atan2(p.z(), p.x()), arc(p) * std::exp(rate_ * dt));
  }
  Vec3 closest(const Vec3& p) const override { return p.normalized(); }
  Vec3 normal(const Vec3& p) const override { return p.normalized(); }

 private:
  double rate_;
};

/// A cylinder of radius 1 around the y axis; heights grow at a relative rate.
class Tube : public Surface {
 public:
  explicit Tube(double rate = 0) : rate_(rate) {}
  Vec3 advance(const Vec3& p, double, double dt) const override { return {p.x(), p.y() * std::exp(rate_ * dt), p.z()}; }
  Vec3 closest(const Vec3& p) const override {
    const Vec3 n = normal(p);
    return {n.x(), p.y(), n.z()};
  }
  Vec3 normal(const Vec3& p) const override { return Vec3(p.x(), 0, p.z()).normalized(); }

 private:
  double rate_;
};

/// A cell of `sides` corners around the tip of a cap, at arc length a.
inline Tissue polygon_on_tip(int sides, double a) {
  std::vector<Vec3> corners;
  for (int i = 0; i < sides; ++i) corners.push_back(Cap::at(-2 * M_PI * i / sides, a));
  return polygons({corners});
}

}  // namespace tunica::testing
