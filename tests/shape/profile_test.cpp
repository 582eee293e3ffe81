// SPDX-License-Identifier: MIT
#include "shape/profile.h"

#include <cmath>

#include "tissue/fixtures.h"

namespace tunica {
namespace {

/// The dome of the measurements: a cubic with its ends tripled.
Profile dome() {
  const Vec2 tip(0, 0), end(1.4, -3);
  return Profile(
      BSpline({tip, tip, tip, {.55, 0}, {1, -.25}, {1.25, -.8}, {1.35, -1.6}, end, end, end}, 3, Ends::open));
}

Profile parabola() { return Profile(BSpline({{0, 0}, {1, 0}, {2, -4}}, 2, Ends::clamped)); }
double length_of_parabola(double x) { return x / 2 * std::sqrt(1 + 4 * x * x) + std::asinh(2 * x) / 4; }

TEST(Profile, ArcLengthIsExact) {
  const Profile p = parabola();
  EXPECT_NEAR(p.length(), length_of_parabola(2), 1e-13);
  for (const double x : {1e-6, .1, .5, 1., 1.9}) {
    const double a = length_of_parabola(x);
    EXPECT_NEAR((p.at(a) - Vec2(x, -x * x)).norm(), 0, 1e-13);
    EXPECT_NEAR((p.tangent(a) - Vec2(1, -2 * x).normalized()).norm(), 0, 1e-12);
    EXPECT_NEAR(p.arc_at_radius(x), a, 1e-13);
    const double s = std::sqrt(1 + 4 * x * x);
    EXPECT_NEAR(p.area(a), M_PI / 6 * (s * s * s - 1), 1e-12);
  }
}

TEST(Profile, HemisphereAndCylinder) {
  const Profile p = Profile::cap(2, M_PI / 2, 2 + M_PI);
  EXPECT_NEAR(p.at(M_PI).x(), 2, 1e-15);
  EXPECT_NEAR(p.at(M_PI).y(), -2, 1e-15);
  EXPECT_NEAR(p.length(), 2 + M_PI, 1e-14);
  EXPECT_NEAR((p.at(1) - 2 * Vec2(std::sin(.5), std::cos(.5) - 1)).norm(), 0, 1e-15);
  EXPECT_NEAR((p.at(M_PI + 1) - Vec2(2, -3)).norm(), 0, 1e-15);
  EXPECT_NEAR((p.at(9) - Vec2(2, M_PI - 11)).norm(), 0, 1e-14);
  EXPECT_NEAR(p.area(M_PI), 8 * M_PI, 1e-12);
  EXPECT_NEAR(p.area(M_PI + 7), 8 * M_PI + 28 * M_PI, 1e-12);
  EXPECT_NEAR(p.arc_at_radius(1), M_PI / 3, 1e-14);
  EXPECT_NEAR(p.at(1e-8).y(), -.25e-16, 1e-30);
}

TEST(Profile, TheDomeOfTheMeasurements) {
  const Profile p = dome();
  EXPECT_NEAR(p.arc_at_radius(1), 1.1015, 5e-5);
  EXPECT_NEAR(p.at(p.arc_at_radius(1)).x(), 1, 1e-13);
  EXPECT_FALSE(p.has_hole());
  EXPECT_NEAR((p.tangent(0) - Vec2(1, 0)).norm(), 0, 1e-14);
  // Equal steps of arc length are equal distances, also at the tripled ends.
  for (double a = 1e-4; a < p.length(); a *= 1.3)
    EXPECT_NEAR((p.at(a * (1 + 1e-4)) - p.at(a)).norm() / (a * 1e-4), 1, 1e-7) << a;
  const Vec2 end = p.tangent(p.length());
  EXPECT_NEAR((p.at(p.length() + 2) - Vec2(1.4, -3) - 2 * end).norm(), 0, 1e-13);
}

TEST(Profile, TheClosestPlaceIsFound) {
  for (const Profile& p : {dome(), parabola(), Profile::cap(1, 1.3, 3), Profile::line({1, 0}, {1, -2})}) {
    testing::Dice dice(7);
    for (int i = 0; i < 200; ++i) {
      const double a = dice.real() * 1.5 * p.length();
      const Vec2 place = p.at(a), along = p.tangent(a);
      EXPECT_NEAR(p.closest(place), a, 2e-10 * p.length());
      const Vec2 outside = place + dice.real() * Vec2(-along.y(), along.x());
      EXPECT_NEAR(p.closest(outside), a, 1e-10 * p.length());
    }
    for (int i = 0; i < 200; ++i) {
      const Vec2 q(dice.between(0, 2), dice.between(-5, 2));
      const double least = (p.at(p.closest(q)) - q).norm();
      for (double a = 0; a < 2 * p.length(); a += .01) EXPECT_LE(least, (p.at(a) - q).norm() + 1e-12);
    }
  }
  EXPECT_EQ(dome().closest({0, 1}), 0);
  EXPECT_EQ(dome().closest({0, 0}), 0);
}

TEST(Profile, CornersAndLevelParts) {
  const Profile flat = Profile::line({0, 0}, {3, 0});
  EXPECT_NEAR(flat.arc_at_radius(1), 1, 1e-15);
  EXPECT_NEAR(flat.at(5).x(), 5, 1e-15);
  EXPECT_NEAR(flat.area(2), 4 * M_PI, 1e-13);
  const Profile step(BSpline({{0, 0}, {1, 0}, {1, -2}}, 1, Ends::clamped));
  EXPECT_NEAR(step.closest({2, 1}), 1, 1e-12);
  EXPECT_NEAR(step.length(), 3, 1e-15);
  EXPECT_NEAR((step.tangent(1) - Vec2(0, -1)).norm(), 0, 1e-15);
}

TEST(Profile, OverhangsAndHoles) {
  const Profile bulb(BSpline({{0, 0}, {2, 0}, {2, -2}, {.5, -3}}, 3, Ends::clamped));
  EXPECT_NEAR(bulb.at(bulb.arc_at_radius(bulb.widest())).x(), bulb.widest(), 1e-12);
  EXPECT_NEAR((bulb.tangent(bulb.length() + 1) - Vec2(0, -1)).norm(), 0, 1e-15);
  const Profile pipe = Profile::line({1, 0}, {1, -3});
  EXPECT_TRUE(pipe.has_hole());
  EXPECT_EQ(pipe.hole(), 1);
  EXPECT_EQ(pipe.arc_at_radius(1), 0);
  EXPECT_ERROR(pipe.arc_at_radius(.5), "starts at radius 1");
  EXPECT_ERROR(pipe.arc_at_radius(1.5), "reaches 1 at most");
  EXPECT_ERROR(pipe.arc_at_radius(NAN), "no ring");
}

TEST(Profile, WhatIsNoProfileIsSaid) {
  const auto straight = [](std::vector<Vec2> points) { return Profile(BSpline(std::move(points), 1, Ends::clamped)); };
  EXPECT_ERROR(straight({{.5, 0}, {-.1, -1}}), "crosses the axis");
  EXPECT_ERROR(straight({{1, -2}, {0, 0}}), "the other way round");
  EXPECT_ERROR(straight({{0, 0}, {1, -1}, {2, -.5}, {3, -3}}), "rises at (1.0625, -0.96875)");
  EXPECT_ERROR(straight({{0, 0}, {2, 0}, {1, 0}, {1, -1}}), "turns back");
  EXPECT_ERROR(straight({{0, 0}, {0, -1}}), "stays on the axis");
  EXPECT_ERROR(Profile::cap(1, 2, 5), "at most 90");
  EXPECT_ERROR(Profile::cap(0, 1, 5), "radius");
  EXPECT_ERROR(Profile::cap(1, 1, .5), "longer");
}

}  // namespace
}  // namespace tunica
