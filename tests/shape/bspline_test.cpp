// SPDX-License-Identifier: MIT
#include "shape/bspline.h"

#include <cmath>

#include "shape/gauss.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

const std::vector<Vec2> zigzag = {{0, 0}, {1, 2}, {2, -1}, {3, 1}, {4, 0}, {5, 3}};

TEST(Gauss, IsExactForPolynomialsOfItsDegree) {
  const auto power = [](int n) { return [n](double x) { return std::pow(x, n); }; };
  EXPECT_NEAR(gauss<12>(power(23), 0., 1.), 1. / 24, 1e-15);
  EXPECT_NEAR(gauss<3>(power(5), -1., 2.), 63. / 6, 1e-13);
  EXPECT_GT(std::abs(gauss<3>(power(6), 0., 1.) - 1. / 7), 1e-5);
}

TEST(BSpline, ClampedCurvesOfLeastPointsAreBezierCurves) {
  const BSpline curve({{0, 0}, {0, 1}, {2, 1}, {3, 0}}, 3, Ends::clamped);
  for (const double u : {0., .25, .5, .9, 1.}) {
    const double v = 1 - u;
    const Vec2 exact(3 * u * u * v * 2 + u * u * u * 3, 3 * u * v * v + 3 * u * u * v);
    EXPECT_NEAR((curve.at(u) - exact).norm(), 0, 1e-15);
  }
  EXPECT_NEAR((curve.derivative(0) - Vec2(0, 3)).norm(), 0, 1e-14);
  EXPECT_NEAR((curve.derivative(1) - Vec2(3, -3)).norm(), 0, 1e-14);
}

TEST(BSpline, UniformCubicHasItsKnownWeights) {
  const BSpline curve(zigzag, 3, Ends::open);
  EXPECT_DOUBLE_EQ(curve.begin(), 0);
  EXPECT_DOUBLE_EQ(curve.end(), 3);
  const auto weighted = [](int i) { return (zigzag[i] + 4 * zigzag[i + 1] + zigzag[i + 2]) / 6; };
  for (int i = 0; i < 3; ++i) EXPECT_NEAR((curve.at(i) - weighted(i)).norm(), 0, 1e-15);
  EXPECT_NEAR((curve.at(3) - weighted(3)).norm(), 0, 1e-15);
}

TEST(BSpline, DerivativesAgreeWithDifferences) {
  for (const Ends ends : {Ends::open, Ends::clamped, Ends::closed})
    for (int degree = 1; degree <= 5; ++degree) {
      const BSpline curve(zigzag, degree, ends);
      for (double at = .13; at < 1; at += .21) {
        const double u = curve.begin() + at * (curve.end() - curve.begin()), h = 1e-5;
        const Vec2 difference = (curve.at(u + h) - curve.at(u - h)) / (2 * h);
        EXPECT_NEAR((curve.derivative(u) - difference).norm(), 0, 1e-7);
        const Vec2 second = (curve.derivative(u + h) - curve.derivative(u - h)) / (2 * h);
        EXPECT_NEAR((curve.derivative(u, 2) - second).norm(), 0, 1e-6);
        Vec2 point, slope;
        curve.evaluate(u, point, slope);
        EXPECT_NEAR((slope - curve.derivative(u)).norm(), 0, 1e-13);
      }
    }
}

TEST(BSpline, ClosedCurvesMeetSmoothly) {
  const BSpline curve(zigzag, 3, Ends::closed);
  EXPECT_NEAR((curve.at(curve.begin()) - curve.at(curve.end())).norm(), 0, 1e-14);
  EXPECT_NEAR((curve.derivative(curve.begin(), 2) - curve.derivative(curve.end(), 2)).norm(), 0, 1e-13);
  EXPECT_EQ(curve.breaks().size(), 7u);
}

TEST(BSpline, KnotsOfOnesOwn) {
  // A knot as often as the degree: the curve goes through a control point there.
  const BSpline curve(zigzag, 3, {0, 0, 0, 0, 1, 1, 2, 2, 2, 2});
  EXPECT_NEAR((curve.at(0) - zigzag[0]).norm(), 0, 1e-15);
  EXPECT_NEAR((curve.at(2) - zigzag[5]).norm(), 0, 1e-15);
  const BSpline corner({{0, 0}, {1, 0}, {1, 1}}, 1, {0, 0, 3, 5, 5});
  EXPECT_NEAR((corner.at(3) - Vec2(1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((corner.direction(3) - Vec2(0, 1)).norm(), 0, 1e-15);
  EXPECT_NEAR((corner.direction(5) - Vec2(0, 1)).norm(), 0, 1e-15);
}

TEST(BSpline, TheTangentIsKnownWhereTheDerivativeVanishes) {
  const BSpline curve({{0, 0}, {0, 0}, {0, 0}, {3, 4}, {5, 4}, {6, 3}, {6, 3}, {6, 3}}, 3, Ends::open);
  EXPECT_NEAR(curve.derivative(curve.begin()).norm(), 0, 1e-15);
  EXPECT_NEAR((curve.direction(curve.begin()) - Vec2(.6, .8)).norm(), 0, 1e-14);
  EXPECT_NEAR((curve.direction(curve.end()) - Vec2(1, -1).normalized()).norm(), 0, 1e-14);
  EXPECT_NEAR((curve.direction(curve.begin() + 1e-6) - Vec2(.6, .8)).norm(), 0, 1e-9);
}

TEST(BSpline, WhatIsNoCurveIsSaid) {
  EXPECT_ERROR(BSpline({{0, 0}, {1, 1}}, 3, Ends::open), "degree 3 needs at least 4 points, not 2");
  EXPECT_ERROR(BSpline(zigzag, 0, Ends::open), "degree");
  EXPECT_ERROR(BSpline(zigzag, 25, Ends::closed), "degree");
  EXPECT_ERROR(BSpline({{0, 0}, {1, 1}}, 1, Ends::closed), "closed");
  EXPECT_ERROR(BSpline({{0, 0}, {1, NAN}}, 1, Ends::open), "point 2");
  EXPECT_ERROR(BSpline({{1, 1}, {1, 1}}, 1, Ends::open), "one place");
  EXPECT_ERROR(BSpline({{0, 0}, {1, 1}}, 1, {0, 0, 1}), "need 4 knots, not 3");
  EXPECT_ERROR(BSpline({{0, 0}, {1, 1}}, 1, {0, 1, .5, 1}), "knot 3");
  EXPECT_ERROR(BSpline({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, 1, {0, 0, 1, 1, 2, 2}), "would break");
  EXPECT_ERROR(BSpline({{0, 0}, {1, 1}}, 1, {0, 0, 0, 0}), "more than the one place");
}

}  // namespace
}  // namespace tunica
