// SPDX-License-Identifier: MIT
#include "shape/bulges.h"

#include "shape/cap.h"
#include "tissue/division.h"
#include "tissue/fixtures.h"
#include "tissue/statistics.h"

namespace tunica {
namespace {

using testing::Cap;
using testing::Dice;
using testing::expect_valid;

double radius_of(double age) { return .25 + .002 * age; }
double height_of(double age) { return std::min(.2, .004 * age); }

Bulges with_three(double rate = .01) {
  Bulges surface(std::make_shared<Cap>(rate), radius_of, height_of);
  surface.add(Cap::at(0, .5), 0);
  surface.add(Cap::at(.5, .5), 0);  // overlaps the first
  surface.add(Cap::at(3, .4), 30);
  return surface;
}

TEST(Bulges, LiftsAlongTheNormal) {
  Bulges surface = with_three();
  ASSERT_EQ(surface.bumps().size(), 2u);
  EXPECT_EQ(surface.bumps()[0].height, 0);  // at birth
  surface.set_time(50);
  ASSERT_EQ(surface.bumps().size(), 3u);
  EXPECT_EQ(surface.bumps()[2].which, 2u);
  const double a = .4 * std::exp(.2);
  EXPECT_NEAR((surface.bumps()[2].centre - Cap::at(3, a)).norm(), 0, 1e-12);
  EXPECT_NEAR(surface.lifted(Cap::at(3, a)).norm(), 1 + height_of(20), 1e-12);
  EXPECT_NEAR(surface.height(Cap::at(3, a + .2)), height_of(20) * std::pow(1 - std::pow(2 * std::sin(.1) / .29, 2), 2),
              1e-12);
  EXPECT_EQ(surface.height(Cap::at(3, a + .4)), 0);
  double fraction = 0;
  const Bulges::Bump* bump = surface.bump_at(surface.lifted(Cap::at(3, a + .2)), &fraction);
  ASSERT_TRUE(bump);
  EXPECT_EQ(bump->which, 2u);
  EXPECT_NEAR(fraction, 2 * std::sin(.1) / .29, 1e-12);
  EXPECT_EQ(surface.bump_at(Cap::at(-2, .8)), nullptr);
  EXPECT_NEAR((surface.normal(surface.lifted(Cap::at(3, a))) - Cap::at(3, a)).norm(), 0, 1e-6);
}

/// Across rims and where bumps overlap, height and slope are continuous.
TEST(Bulges, HasNoKinks) {
  Bulges surface = with_three();
  surface.set_time(50);
  Vec3 before = surface.lifted(Cap::at(-1, .7)), direction = Vec3::Zero();
  for (int i = 1; i < 60'000; ++i) {
    const Vec3 p = surface.lifted(Cap::at(-1 + i * 1e-4, .7));
    const Vec3 now = (p - before).normalized();
    if (i > 1) {
      ASSERT_LT((now - direction).norm(), .004) << i;
    }
    direction = now;
    before = p;
  }
}

TEST(Bulges, ClosestPointAgainstSampling) {
  Bulges surface = with_three();
  surface.set_time(50);
  Dice dice(3);
  for (int i = 0; i < 300; ++i) {
    const double theta = dice.between(-M_PI, M_PI), a = dice.between(0, 1.2);
    const Vec3 on = surface.lifted(Cap::at(theta, a));
    ASSERT_NEAR((surface.closest(on) - on).norm(), 0, 1e-8);
    const Vec3 n = surface.normal(on);
    for (const double off : {-.03, .02, .1}) {
      const Vec3 q = surface.closest(on + off * n);
      // What is closest is straight above or below, and no nearer point is to be found around it.
      const Vec3 away = on + off * n - q;
      EXPECT_LE(away.norm(), std::abs(off) + 1e-8);
      EXPECT_GT(std::abs(away.normalized().dot(surface.normal(q))), 1 - 1e-10);
      EXPECT_NEAR((surface.closest(q) - q).norm(), 0, 1e-8);
      double least = INFINITY;
      for (int k = 0; k < 400; ++k) {
        const double t = theta + .6 * (k % 20 - 10) / 10 / std::max(a, .2), b = a + .6 * (k / 20 - 10) / 10;
        least = std::min(least, (surface.lifted(Cap::at(t, b)) - on - off * n).norm());
      }
      EXPECT_LE(away.norm(), least + 1e-9);
    }
  }
}

TEST(Bulges, CellsGrowAndDivideOnIt) {
  Bulges surface = with_three();
  Tissue tissue = testing::polygon_on_tip(8, .8);
  for (int step = 0; step < 60; ++step) {
    grow(tissue, surface, 1);
    divide_above(tissue, {.area = .008}, errera, {}, &surface);
  }
  EXPECT_EQ(surface.time(), 60);
  EXPECT_GT(tissue.cells(), 600);
  expect_valid(tissue);
  EXPECT_EQ(cell_statistics(tissue).four_way, 0);
  int lifted = 0;
  for (Index j = 0; j < tissue.junctions(); ++j) {
    ASSERT_NEAR((surface.closest(tissue.position(j)) - tissue.position(j)).norm(), 0, 1e-8);
    lifted += tissue.position(j).norm() > 1.05 ? 1 : 0;
  }
  EXPECT_GT(lifted, 50);
  // There and back again.
  const Vec3 p = surface.lifted(Cap::at(.2, .9));
  const double t = surface.time();
  EXPECT_NEAR((surface.advance(surface.advance(p, t, 7), t + 7, -7) - p).norm(), 0, 1e-12);
}

TEST(Bulges, Errors) {
  Bulges surface = with_three();
  EXPECT_ERROR(surface.set_time(NAN), "finite");
  EXPECT_ERROR(surface.add({NAN, 0, 0}, 0), "finite");
  EXPECT_ERROR(Bulges(nullptr, radius_of, height_of), "base");
  Bulges wrong(std::make_shared<Cap>(), radius_of, [](double age) { return 1 - age; });
  EXPECT_EQ(wrong.bumps().size(), 0u);
  wrong.add(Cap::at(0, .5), 0);
  EXPECT_ERROR(wrong.set_time(2), "0 or more");
  EXPECT_EQ(wrong.time(), 0);
  Tissue tissue = testing::polygon_on_tip(8, .2);
  const std::string before = tissue.hash();
  EXPECT_ERROR(grow(tissue, wrong, 2), "0 or more");
  EXPECT_EQ(wrong.time(), 0);
  EXPECT_EQ(tissue.hash(), before);
}

/// Without height a primordium is only a place: the surface is its base, and distances are those in space.
TEST(Bulges, WithoutHeightArePlaces) {
  Bulges surface(std::make_shared<Cap>(.01), radius_of, [](double) { return 0.; });
  surface.add(Cap::at(1, .5), 0);
  surface.set_time(20);
  ASSERT_EQ(surface.bumps().size(), 1u);
  const Vec3 p = Cap::at(1.2, .7), centre = Cap::at(1, .5 * std::exp(.2));
  EXPECT_EQ((surface.closest(1.1 * p) - p).norm() < 1e-12, true);
  EXPECT_NEAR((surface.advance(p, 20, 3) - Cap::at(1.2, .7 * std::exp(.03))).norm(), 0, 1e-12);
  EXPECT_NEAR((surface.normal(p) - p).norm(), 0, 1e-12);
  double fraction = 0;
  ASSERT_TRUE(surface.bump_at(p, &fraction));
  EXPECT_NEAR(fraction, (p - centre).norm() / radius_of(20), 1e-12);
}

TEST(Bulges, TellCellsTheirPrimordia) {
  Tissue tissue = testing::polygon_on_tip(8, .6);
  divide_above(tissue, {.area = .015}, errera, {});
  Bulges surface(std::make_shared<Cap>(0.), [](double) { return .3; }, [](double) { return 0.; });
  surface.add(Cap::at(0, .2), 0);
  surface.add(Cap::at(3, .25), 0);
  differentiate(tissue, surface);
  const Column &which = tissue.column(Kind::cell, "primordium"), &closeness = tissue.column(Kind::cell, "closeness");
  int inside[3] = {0, 0, 0};
  for (Index c = 0; c < tissue.cells(); ++c) {
    const double d[] = {(tissue.centroid(c) - Cap::at(0, .2)).norm(), (tissue.centroid(c) - Cap::at(3, .25)).norm()};
    const int nearest = d[0] < d[1] ? 0 : 1, number = d[nearest] < .3 ? nearest + 1 : 0;
    ++inside[number];
    EXPECT_EQ(which.values[static_cast<size_t>(c)], number);
    EXPECT_NEAR(closeness.values[static_cast<size_t>(c)], number > 0 ? 1 - d[nearest] / .3 : 0, 1e-12);
  }
  EXPECT_GT(std::min({inside[0], inside[1], inside[2]}), 2);
}

}  // namespace
}  // namespace tunica
