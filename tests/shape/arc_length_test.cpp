// SPDX-License-Identifier: MIT
#include "shape/arc_length.h"

#include <cmath>

#include "base/random.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

/// The distance from p to the nearest of many places of a curve.
double searched(const BSpline& curve, const Vec2& p, int places) {
  double least = HUGE_VAL;
  for (int i = 0; i <= places; ++i)
    least = std::min(least, (curve.at(curve.begin() + (curve.end() - curve.begin()) * i / places) - p).norm());
  return least;
}

TEST(ArcLength, ASquareIsExact) {
  const ArcLength square(BSpline({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 1, Ends::closed));
  EXPECT_NEAR(square.length(), 8, 1e-14);
  EXPECT_NEAR(square.area(), 4, 1e-14);
  EXPECT_NEAR((square.at(3) - Vec2(2, 1)).norm(), 0, 1e-14);
  EXPECT_NEAR((square.tangent(2) - Vec2(0, 1)).norm(), 0, 1e-14);  // at a corner that of what follows
  const auto [a, distance] = square.nearest({3, 1.5});
  EXPECT_NEAR(a, 3.5, 1e-13);
  EXPECT_NEAR(distance, 1, 1e-14);
  EXPECT_NEAR(square.nearest({-1, -1}).a, 0, 1e-14);
}

TEST(ArcLength, AParabolaOfKnownLengthAndArea) {
  const ArcLength curve(BSpline({{0, 0}, {1, 0}, {2, -4}}, 2, Ends::clamped));
  EXPECT_NEAR(curve.length(), 2 / 2. * std::sqrt(17.) + std::asinh(4.) / 4, 1e-13);
  // Between y = -x^2 and its chord y = -2x, run with the area on the right.
  EXPECT_NEAR(curve.area(), -4. / 3, 1e-14);
}

TEST(ArcLength, AreasFarFromTheOriginKeepTheirDigits) {
  const Vec2 far(1e6, -1e6);
  const ArcLength square(BSpline({far, far + Vec2(1, 0), far + Vec2(1, 1), far + Vec2(0, 1)}, 1, Ends::closed));
  EXPECT_NEAR(square.area(), 1, 1e-9);
}

TEST(ArcLength, ClosedCurvesThatNoProfileMayBe) {
  // A figure of eight, a star, a loop drawn back upon itself.
  const std::vector<std::vector<Vec2>> drawn = {{{0, 0}, {2, 2}, {2, -2}, {-2, 2}, {-2, -2}},
                                                {{0, 1}, {.6, -.8}, {-1, .3}, {1, .3}, {-.6, -.8}},
                                                {{0, 0}, {1, 0}, {3, 0}, {1, 0}}};
  for (const auto& points : drawn)
    for (const int degree : {1, 2, 3, 5}) {
      const BSpline spline(points, degree, Ends::closed);
      const ArcLength curve(spline);
      double polygon = 0;
      Vec2 before = spline.at(spline.begin());
      for (int i = 1; i <= 20000; ++i) {
        const Vec2 p = spline.at(spline.begin() + (spline.end() - spline.begin()) * i / 20000);
        polygon += (p - before).norm();
        before = p;
      }
      EXPECT_NEAR(curve.length(), polygon, 1e-6 * polygon);
      EXPECT_NEAR((curve.at(0) - curve.at(curve.length())).norm(), 0, 1e-12);
      for (int i = 1; i < 40; ++i) {
        const double a = curve.length() * i / 40;
        EXPECT_NEAR(curve.arc(curve.parameter(a)), a, 1e-10 * curve.length()) << degree << " " << a;
        EXPECT_NEAR(curve.tangent(a).norm(), 1, 1e-14);
      }
    }
}

TEST(ArcLength, TheNearestPlaceOfRandomCurves) {
  for (uint64_t trial = 0; trial < 300; ++trial) {
    uint64_t drawn = 0;
    const auto next = [&] { return uniform({trial, purpose("test"), drawn++}); };
    std::vector<Vec2> points(static_cast<size_t>(4 + trial % 7));
    for (Vec2& p : points) p = {next(), next()};
    const BSpline spline(points, 1 + static_cast<int>(trial % 3), trial % 2 ? Ends::closed : Ends::clamped);
    const ArcLength curve(spline);
    for (int k = 0; k < 10; ++k) {
      const Vec2 p(3 * next() - 1, 3 * next() - 1);
      const auto [a, distance] = curve.nearest(p);
      EXPECT_NEAR((curve.at(a) - p).norm(), distance, 1e-10 * curve.length()) << trial;
      EXPECT_LE(distance, searched(spline, p, 20000) + 1e-10 * curve.length()) << trial << " " << p;
    }
  }
}

TEST(ArcLength, ACurveWithCuspsAndStops) {
  // Points given twice and three times: the curve comes to rest, and turns sharply.
  const ArcLength curve(
      BSpline({{0, 0}, {0, 0}, {0, 0}, {1, 1}, {1, 1}, {1, 1}, {2, 0}, {2, 0}, {2, 0}}, 3, Ends::clamped));
  EXPECT_NEAR(curve.length(), 2 * std::sqrt(2.), 1e-10);
  const double half = curve.length() / 2;
  EXPECT_NEAR((curve.at(half) - Vec2(1, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR(curve.nearest({1, 5}).a, half, 1e-6);
  EXPECT_NEAR(curve.nearest({1, 5}).distance, 4, 1e-10);
}

}  // namespace
}  // namespace tunica
