// SPDX-License-Identifier: MIT
#include "shape/apex.h"

#include <cmath>

#include "tissue/builders.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

Profile dome() {
  const Vec2 tip(0, 0), end(1.4, -3);
  return Profile(
      BSpline({tip, tip, tip, {.55, 0}, {1, -.25}, {1.25, -.8}, {1.35, -1.6}, end, end, end}, 3, Ends::open));
}

/// Many small steps of the classical Runge-Kutta method.
double stepped(const Flow& flow, double a, double dt, int steps = 20000) {
  const double h = dt / steps;
  for (int i = 0; i < steps; ++i) {
    const double k1 = flow.speed(a), k2 = flow.speed(a + h / 2 * k1), k3 = flow.speed(a + h / 2 * k2);
    a += h / 6 * (k1 + 2 * k2 + 2 * k3 + flow.speed(a + h * k3));
  }
  return a;
}

TEST(Flow, ConstantRatesAreClosed) {
  const Flow flow(Curve::constant(1));
  EXPECT_DOUBLE_EQ(flow.after(.3, 2), .3 * std::exp(2));
  EXPECT_EQ(flow.after(0, 5), 0);
  EXPECT_DOUBLE_EQ(Flow(Curve::constant(0)).after(2, 9), 2);
  // As a curve, which then is tabulated.
  const Flow drawn(Curve({{0, 1}, {.5, 1}, {1, 1}, {3, 1}}));
  for (const double a : {1e-12, 1e-7, .01, .3, 2.9, 3., 5.})
    for (const double dt : {-9., -.1, 1e-3, 1., 20.})
      EXPECT_NEAR(drawn.after(a, dt) / (a * std::exp(dt)), 1, 1e-12) << a << ' ' << dt;
}

TEST(Flow, AgreesWithSmallSteps) {
  const Flow flow(Curve({{0, .2}, {.5, .1}, {.8, 2}, {1.5, .1}, {2, .3}, {2.5, .05}}));
  for (const double a : {1e-4, .1, .7, 1.6, 2.4, 2.5, 3.})
    for (const double dt : {-2., .3, 4.}) EXPECT_NEAR(flow.after(a, dt), stepped(flow, a, dt), 1e-10) << a << ' ' << dt;
}

TEST(Flow, StepsAddUpAndReturn) {
  testing::Dice dice(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec2> points = {{dice.between(-.5, .5), dice.between(.05, 1)}};
    for (int i = 0; i < 5; ++i) points.emplace_back(points.back().x() + dice.between(.05, 1), dice.between(.05, 2));
    const Flow flow{Curve(points)};
    for (int i = 0; i < 30; ++i) {
      const double a = std::pow(dice.real(), 3) * 3, t = dice.between(0, 2), s = dice.between(0, 2);
      EXPECT_NEAR(flow.after(flow.after(a, t), s) / flow.after(a, t + s), 1, 1e-9) << round;
      EXPECT_NEAR(flow.after(flow.after(a, t), -t) / a, 1, 1e-9);
      const double h = 1e-5;
      EXPECT_NEAR((flow.after(a, h) - flow.after(a, -h)) / (2 * h), flow.speed(a), 1e-8 * (1 + flow.speed(a)));
    }
  }
}

TEST(Flow, PointsStayWhereTheSpeedIsZero) {
  // Shrinks beyond 1: v is 0 at 2 (the integral of a roof and a trough), and points gather there.
  const Flow gathers(Curve::linear({{0, 1}, {1, 0}, {2, -1}, {3, -1}}));
  EXPECT_NEAR(gathers.speed(2), 0, 1e-15);
  EXPECT_NEAR(gathers.after(1, 60), 2, 1e-12);
  EXPECT_NEAR(gathers.after(2.7, 60), 2, 1e-12);
  EXPECT_EQ(gathers.after(2, 1), 2);
  EXPECT_NEAR(gathers.after(1.5, 2), stepped(gathers, 1.5, 2), 1e-10);
  EXPECT_NEAR(gathers.after(2.5, 2), stepped(gathers, 2.5, 2), 1e-10);
  EXPECT_NEAR(gathers.after(gathers.after(2.5, 9), -9), 2.5, 1e-9);
  // A zone at the tip that does not grow.
  const Flow central(Curve::linear({{0, 0}, {1, 0}, {1.5, 1}, {2, 1}}));
  EXPECT_EQ(central.after(.7, 50), .7);
  EXPECT_EQ(central.after(1, 50), 1);
  EXPECT_NEAR(central.after(1.1, 3), stepped(central, 1.1, 3), 1e-9);
  EXPECT_NEAR(central.after(3, -40), 1, .1);
  // None anywhere, then some.
  const Flow later(Curve::linear({{0, 0}, {2, 0}}));
  EXPECT_EQ(later.after(5, 3), 5);
}

TEST(Flow, WhatCannotBeIsSaid) {
  const Flow flow(Curve::constant(1));
  EXPECT_ERROR(flow.after(-1, 1), "distance from the tip");
  EXPECT_ERROR(flow.after(NAN, 1), "distance from the tip");
  EXPECT_ERROR(flow.after(1, INFINITY), "finite");
  EXPECT_ERROR(flow.after(1, 1e9), "beyond all numbers");
  EXPECT_ERROR(Flow(Curve::linear({{0, 1}, {1, 2}})).after(1, 1e9), "beyond all numbers");
}

TEST(Apex, PlacesAndPoints) {
  const Apex apex(dome(), Curve::constant(1));
  testing::Dice dice(2);
  for (int i = 0; i < 100; ++i) {
    const double theta = dice.between(-3.1, 3.1), a = dice.between(.01, 3);
    const Vec3 p = apex.position(theta, a), n = apex.normal(p);
    const Apex::Place place = apex.place_of(p + .2 * n);
    EXPECT_NEAR(place.theta, theta, 1e-12);
    EXPECT_NEAR(place.a, a, 1e-10);
    EXPECT_NEAR((apex.closest(p + .1 * n) - p).norm(), 0, 1e-10);
    EXPECT_NEAR(n.norm(), 1, 1e-13);
    EXPECT_GE(n.dot(Vec3(p.x(), 0, p.z())), 0);
    EXPECT_NEAR((apex.advance(p, 0, .4) - apex.position(theta, a * std::exp(.4))).norm(), 0, 1e-9);
  }
  EXPECT_EQ(apex.place_of({0, 1, 0}).theta, 0);
  EXPECT_EQ(apex.normal(Vec3(0, 0, 0)), Vec3(0, 1, 0));
  EXPECT_ERROR(apex.position(NAN, 1), "angle");
  EXPECT_ERROR(apex.position(1, -1), "distance from the tip");
  EXPECT_ERROR(apex.place_of({NAN, 0, 0}), "finite");
}

TEST(Apex, ADiskGrowsLikeThePlane) {
  const Apex disk(Profile::line({0, 0}, {2, 0}), Curve::constant(1));
  for (const double a : {.1, 1., 3.})
    EXPECT_NEAR((disk.advance({a, 0, a}, 0, 1) - Vec3(a * M_E, 0, a * M_E)).norm(), 0, 1e-10);
}

TEST(Apex, PathsAreWithinTheirTolerance) {
  const Curve raised = Curve({{0, .3}, {.5, .25}, {.9, 1.2}, {1.3, 1.1}, {1.8, .3}, {3, .05}});
  for (const Apex& apex : {Apex(dome(), raised), Apex(Profile::line({0, 0}, {1, 0}), Curve::constant(1))}) {
    const Path path = apex.path(.9, 6);
    EXPECT_LE(path.error(), 1e-9);
    EXPECT_GE(path.oldest(), 6 - 1e-12);
    for (double age = 0; age < 8; age += .0137) {
      const Vec2 exact = apex.profile().at(apex.after(.9, age));
      EXPECT_NEAR((path.at(age) - exact).norm() / (1 + exact.norm()), 0, 2e-9) << age;
    }
    EXPECT_ERROR(apex.path(1, 0), "positive");
  }
  // Where the curvature jumps the table is finer.
  const Path over_edge = Apex(Profile::cap(1, M_PI / 2, 4), Curve::constant(1)).path(.5, 3);
  EXPECT_LE(over_edge.error(), 1e-9);
}

}  // namespace
}  // namespace tunica
