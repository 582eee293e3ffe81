// SPDX-License-Identifier: MIT
// Random profiles and rates of growth, awkward ones among them: what is not refused is right.
#include <cmath>

#include "shape/apex.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

using testing::Dice;

/// Mostly falling, often with repeated, level or upright parts, sometimes impossible.
BSpline random_contour(Dice& dice) {
  const double size = std::pow(10, dice.between(-6, 6));
  std::vector<Vec2> points = {{dice.below(3) ? 0 : dice.real(), 0}};
  while (points.size() < 5 + static_cast<size_t>(dice.below(6))) {
    const int kind = dice.below(6);
    const Vec2 last = points.back();
    if (kind == 0)
      points.push_back(last);
    else if (kind == 1)
      points.emplace_back(last.x() + dice.real(), last.y());
    else if (kind == 2)
      points.emplace_back(last.x(), last.y() - dice.real());
    else
      points.emplace_back(last.x() + dice.between(-.2, 1), last.y() - dice.between(-.01, 1) * dice.real());
  }
  for (Vec2& p : points) p *= size;
  return {points, 1 + dice.below(4), dice.below(3) ? Ends::clamped : Ends::open};
}

Curve random_rate(Dice& dice) {
  const double scale = std::pow(10, dice.between(-2, 2));
  std::vector<Vec2> points = {{dice.between(-1, 1), dice.between(-.3, 1)}};
  const int count = dice.below(8);
  for (int i = 0; i < count; ++i) {
    const int kind = dice.below(6);
    const Vec2 last = points.back();
    points.emplace_back(last.x() + (kind == 0 ? 0 : dice.real()), kind == 1   ? last.y()
                                                                  : kind == 2 ? 0
                                                                              : dice.between(-.5, 1));
  }
  for (Vec2& p : points) p.x() *= scale;
  return Curve(points, 1 + dice.below(4));
}

TEST(RandomShapes, ProfilesKeepToTheirArcLength) {
  Dice dice(11);
  int made = 0;
  for (int round = 0; round < 600; ++round) {
    try {
      const Profile p(random_contour(dice));
      ++made;
      const double length = p.length();
      for (int i = 0; i < 10; ++i) {
        const double a = 1.2 * length * dice.real(), h = 1e-6 * length;
        const Vec2 chord = p.at(a + h) - p.at(a);
        EXPECT_LE(chord.norm(), h * (1 + 1e-6)) << round;
        const Vec2 place = p.at(a);
        EXPECT_LE((p.at(p.closest(place)) - place).norm(), 1e-9 * length) << round;
        EXPECT_NEAR(p.tangent(a).norm(), 1, 1e-12);
      }
      const double r = p.hole() + dice.real() * (p.widest() - p.hole());
      EXPECT_NEAR(p.at(p.arc_at_radius(r)).x(), r, 1e-10 * length) << round;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(made, 200);
}

TEST(RandomShapes, GrowthIsTheFlowOfItsSpeed) {
  Dice dice(12);
  int made = 0;
  for (int round = 0; round < 300; ++round) {
    try {
      const Flow flow(random_rate(dice));
      ++made;
      const double far = std::max(1., flow.rate().last()) * 1.5;
      double before = -1, before_after = -1;
      for (int i = 0; i < 20; ++i) {
        const double a = far * i / 20, t = 2;
        const double b = flow.after(a, t), split = flow.after(flow.after(a, .7), 1.3);
        EXPECT_NEAR(split, b, 1e-8 * (far + std::abs(b))) << round << " at " << a;
        EXPECT_GE(b, 0);
        if (before >= 0) {
          EXPECT_GE(b, before_after - 1e-9 * far) << round;  // order along the profile is kept
        }
        before = a, before_after = b;
        const double h = 1e-4, slope = (flow.after(a, h) - flow.after(a, -h)) / (2 * h);
        EXPECT_NEAR(slope, flow.speed(a), 1e-4 * (far + std::abs(flow.speed(a)))) << round << " at " << a;
      }
    } catch (const Error&) {
    }
  }
  EXPECT_GT(made, 200);
}

}  // namespace
}  // namespace tunica
