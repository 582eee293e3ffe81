// SPDX-License-Identifier: MIT
#include "shape/curve.h"

#include <cmath>

#include "shape/gauss.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

/// The integral by many small steps.
double slowly(const Curve& curve, double from, double to) {
  double sum = 0;
  constexpr int parts = 20000;
  for (int i = 0; i < parts; ++i)
    sum += gauss<3>(curve, from + (to - from) * i / parts, from + (to - from) * (i + 1) / parts);
  return sum;
}

TEST(Curve, GoesThroughItsEndsAndKeepsThemOutside) {
  const Curve curve({{0, .3}, {.4, .9}, {.7, .1}, {1, .5}, {2, .6}});
  EXPECT_DOUBLE_EQ(curve(0), .3);
  EXPECT_DOUBLE_EQ(curve(-7), .3);
  EXPECT_DOUBLE_EQ(curve(2), .6);
  EXPECT_DOUBLE_EQ(curve(9), .6);
  EXPECT_EQ(curve.derivative(-1), 0);
  EXPECT_EQ(curve.derivative(3), 0);
}

TEST(Curve, IsTheCurveAtEachX) {
  testing::Dice dice(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec2> points = {{dice.between(-1, 1), dice.real()}};
    for (int i = 0; i < 6; ++i) points.emplace_back(points.back().x() + dice.real(), dice.between(-2, 2));
    const int degree = 1 + round % 5;
    const BSpline spline(points, degree, Ends::clamped);
    const Curve curve(points, degree);
    for (int k = 0; k < 20; ++k) {
      const Vec2 p = spline.at(spline.begin() + dice.real() * (spline.end() - spline.begin()));
      EXPECT_NEAR(curve(p.x()), p.y(), 1e-11);
    }
  }
}

TEST(Curve, StraightControlPointsGiveAStraightLine) {
  const Curve curve({{0, 1}, {.1, 1.2}, {.7, 2.4}, {1, 3}});
  for (const double x : {0., .03, .3, .777, .99}) {
    EXPECT_NEAR(curve(x), 1 + 2 * x, 1e-14);
    EXPECT_NEAR(curve.derivative(x), 2, 1e-12);
    EXPECT_NEAR(curve.integral(0, x), x + x * x, 1e-14);
  }
}

TEST(Curve, IntegralAndDerivativeAreTheOnesOfTheFunction) {
  const Curve curve({{0, .3}, {0, .9}, {.4, -.1}, {.4, .2}, {1, .5}, {1.3, .6}});
  for (const double to : {.05, .4, .8, 1.3}) EXPECT_NEAR(curve.integral(0, to), slowly(curve, 0, to), 1e-8);
  EXPECT_NEAR(curve.integral(-2, 3), 2 * .3 + curve.integral(0, 1.3) + 1.7 * .6, 1e-13);
  EXPECT_NEAR(curve.integral(.9, .2), -curve.integral(.2, .9), 1e-15);
  for (const double x : {.1, .5, .9, 1.2})
    EXPECT_NEAR(curve.derivative(x), (curve(x + 1e-6) - curve(x - 1e-6)) / 2e-6, 1e-6);
  EXPECT_TRUE(std::isinf(curve.derivative(0)));
  EXPECT_NEAR(curve.integral(.2, .2 + 1e-9) / 1e-9, curve(.2), 1e-6);
}

TEST(Curve, ConstantAndPiecewiseLinear) {
  const Curve two = Curve::constant(2);
  EXPECT_EQ(two(5), 2);
  EXPECT_EQ(two.integral(1, 4), 6);
  EXPECT_EQ(two.derivative(1), 0);
  EXPECT_TRUE(two.is_constant());
  const Curve roof = Curve::linear({{0, 0}, {1, 1}, {3, 0}});
  EXPECT_NEAR(roof(.5), .5, 1e-15);
  EXPECT_NEAR(roof(2), .5, 1e-15);
  EXPECT_NEAR(roof.integral(0, 3), 1.5, 1e-15);
  EXPECT_NEAR(roof.derivative(2), -.5, 1e-15);
  EXPECT_EQ(roof.greatest(), 1);
  EXPECT_EQ(roof.least(), 0);
  EXPECT_EQ(Curve({{0, 0}, {1, 1}}).degree(), 1);
}

TEST(Curve, RepeatedPointsAreFound) {
  const Curve curve({{0, 1}, {0, 1}, {0, 1}, {1, 2}, {2, 0}, {2, 0}, {2, 0}});
  EXPECT_NEAR(curve.derivative(0), 1, 1e-12);
  EXPECT_NEAR(curve(1e-9), 1 + 1e-9, 1e-14);
  EXPECT_NEAR(curve(2 - 1e-9), 2e-9, 1e-13);
}

TEST(Curve, WhatIsNoFunctionIsSaid) {
  EXPECT_ERROR(Curve({}), "at least one point");
  EXPECT_ERROR(Curve({{0, 1}, {1, 1}, {.5, 2}}), "point 3 (0.5, 2) lies left of point 2 (1, 1)");
  EXPECT_ERROR(Curve({{0, 1}, {0, 2}}), "needs a width");
  EXPECT_ERROR(Curve({{0, 1}, {1, 0}, {1, 1}, {1, 2}, {1, 3}, {2, 0}}), "4 points of the curve lie above each other");
  EXPECT_ERROR(Curve({{0, 1}, {0, 1}}), "all 2 points");
  EXPECT_ERROR(Curve({{0, NAN}}), "finite");
  EXPECT_ERROR(Curve({{0, 1}, {1, 1}}, 6), "degree");
}

}  // namespace
}  // namespace tunica
