// SPDX-License-Identifier: MIT
#include "shape/plane.h"

#include <cmath>

#include "tissue/builders.h"
#include "tissue/fixtures.h"
#include "tissue/topology.h"

namespace tunica {
namespace {

double whole_area(const Tissue& tissue) {
  double sum = 0;
  for (Index c = 0; c < tissue.cells(); ++c) sum += tissue.area(c);
  return sum;
}

TEST(Plane, UniformGrowthIsExact) {
  Tissue tissue = hexagon_disk(3);
  const double before = whole_area(tissue);
  grow(tissue, UniformGrowth(.1, {1, 2, 0}), 0, 3);
  EXPECT_NEAR(whole_area(tissue), before * std::exp(.6), 1e-10);
  testing::expect_valid(tissue);
  Tissue steps = hexagon_disk(3);
  for (int i = 0; i < 30; ++i) grow(steps, UniformGrowth(.1, {1, 2, 0}), .1 * i, .1);
  for (Index j = 0; j < tissue.junctions(); ++j) EXPECT_NEAR((tissue.position(j) - steps.position(j)).norm(), 0, 1e-12);
}

TEST(Plane, AnisotropicGrowthStretchesAlongItsDirection) {
  Tissue tissue = squares(2, 2);
  grow(tissue, AnisotropicGrowth(.5, -.2, {0, 3, 0}), 0, 2);
  EXPECT_NEAR(tissue.area(0), std::exp(.6), 1e-12);
  double width = 0, height = 0;
  for (Index j = 0; j < tissue.junctions(); ++j) {
    width = std::max(width, tissue.position(j).x());
    height = std::max(height, tissue.position(j).y());
  }
  EXPECT_NEAR(width, 2 * std::exp(-.4), 1e-12);
  EXPECT_NEAR(height, 2 * std::exp(1), 1e-12);
  const Vec3 p = AnisotropicGrowth(.3, .3, {1, 1, 0}).advance({1, 2, 0}, 0, 1);
  EXPECT_NEAR((p - UniformGrowth(.3).advance({1, 2, 0}, 0, 1)).norm(), 0, 1e-14);
}

TEST(Plane, VelocityFieldsConvergeAtFourthOrder) {
  // A turning field: points run on circles.
  const auto turning = [](const Vec3& p, double) { return Vec3(-p.y(), p.x(), 0); };
  const Vec3 exact(std::cos(1), std::sin(1), 0);
  const double coarse = (VelocityField(turning, 4).advance({1, 0, 0}, 0, 1) - exact).norm();
  const double fine = (VelocityField(turning, 8).advance({1, 0, 0}, 0, 1) - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 4, .2);
  const auto in_time = [](const Vec3&, double t) { return Vec3(3 * t * t, 0, 0); };
  EXPECT_NEAR(VelocityField(in_time).advance({0, 0, 0}, 1, 1).x(), 7, 1e-12);
}

/// Carries the third column of corners past the second.
class Folding : public Plane {
 public:
  Vec3 advance(const Vec3& p, double, double) const override { return p.x() == 2 ? Vec3(.5, p.y(), 0) : p; }
};

TEST(Plane, ImpossibleGrowthLeavesTheTissueAsItWas) {
  Tissue tissue = squares(3, 3);
  const std::string before = tissue.hash();
  EXPECT_ERROR(grow(tissue, Folding(), 0, 1), "stays as it was");
  const auto nothing = [](const Vec3&, double) { return Vec3(NAN, 0, 0); };
  EXPECT_ERROR(grow(tissue, VelocityField(nothing), 0, 1), "not finite");
  EXPECT_ERROR(grow(tissue, UniformGrowth(1e300), 0, 1e300), "cell 1");
  EXPECT_ERROR(grow(tissue, AnisotropicGrowth(-800, 0, {1, 0, 0}), 0, 1), "cell 1");
  EXPECT_ERROR(grow(tissue, UniformGrowth(1), 0, INFINITY), "finite");
  EXPECT_ERROR(UniformGrowth bad(NAN), "rate of growth");
  EXPECT_ERROR(AnisotropicGrowth(1, 1, {0, 0, 1}), "direction");
  EXPECT_ERROR(VelocityField(nullptr), "function");
  EXPECT_ERROR(VelocityField(nothing, 0), "substeps");
  const auto meddling = [&](const Vec3& p, double) {
    remove_cell(tissue, 0);
    return p;
  };
  EXPECT_ERROR(grow(tissue, VelocityField(meddling), 0, 1), "while rules run");
  EXPECT_EQ(tissue.hash(), before);
  EXPECT_FALSE(tissue.locked());
  Tissue graph = ring(3);
  EXPECT_ERROR(grow(graph, UniformGrowth(1), 0, 1), "without geometry");
}

}  // namespace
}  // namespace tunica
