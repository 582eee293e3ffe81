// SPDX-License-Identifier: MIT
#include "field/inhibition.h"

#include <gtest/gtest.h>

#include "field/inhibition_fixtures.h"

namespace tunica {
namespace {

TEST(Inhibition, FieldOfOneOnADiskIsExact) {
  for (const double b : {0.0, 1.0, 7.0}) {
    Inhibition model = single(disk(360), b, constant(1e-9));
    model.add_primordium(0, 0);
    const std::vector<double> h = model.ring_values(0);
    EXPECT_NEAR(h[180], 0.5, 1e-15);
    EXPECT_NEAR(h[90], std::sqrt(0.5), 1e-15);
    EXPECT_GT(h[0], 1e6);
  }
  Inhibition model = single(disk(360), 1, constant(1e-9));
  model.add_primordium(0, 1);
  const double e = std::exp(1.0);
  EXPECT_NEAR(model.ring_values(0)[0], 1 / e / (e - 1), 1e-15);
  EXPECT_NEAR(model.ring_values(0)[180], 1 / e / (e + 1), 1e-15);
  EXPECT_NEAR(model.value(0, std::numbers::pi, {1, 0}), 1 / e / (e + 1), 1e-15);
}

struct Steady {
  double threshold, mean, mean_error, plastochron, plastochron_error;
};

TEST(Inhibition, AnglesAndPlastochronsOnADisk) {
  for (const Steady& c :
       {Steady{5, 137.11, .05, .0871, .0003}, {10, 137.63, .05, .0482, .0002}, {2.5, 139.16, .05, .1527, .0005}}) {
    Inhibition model = single(disk(1440), 1, constant(c.threshold));
    model.add_lattice(30, 137.51 * degree, 1, {});
    insert(model, 240);
    const Summary s = last(model, 120);
    EXPECT_NEAR(s.mean, c.mean, c.mean_error) << c.threshold;
    EXPECT_NEAR(s.plastochron, c.plastochron, c.plastochron_error) << c.threshold;
    std::printf("threshold %g: %.3f degrees, sd %.2f, plastochron %.5f, %.1f evaluations and %.0f pairs a primordium\n",
                c.threshold, s.mean, s.deviation, s.plastochron, static_cast<double>(model.evaluations()) / 240,
                static_cast<double>(model.pairs()) / 240);
  }
}

TEST(Inhibition, FirstAnglesWith38Samples) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    InhibitionSettings settings = cylinder(38);
    settings.seed = seed;
    Inhibition model =
        single(settings, 3.246, [](double t) { return .1809 + (.7801 - .1809) * std::min(1.0, t / 7.775); });
    model.add_random();
    insert(model, 20);
    const double sign = divergence(model, 2) > 0 ? 1 : -1;
    const int expected[] = {19, 12, 17, 14, 15, 15, 15, 15, 15, 15};
    for (size_t i = 0; i < std::size(expected); ++i) {
      const double turn = divergence(model, i + 1) * 38 / 360;
      EXPECT_NEAR(i == 0 ? std::fabs(turn) : sign * turn, expected[i], 1e-6) << "seed " << seed << ", step " << i;
    }
  }
}

}  // namespace
}  // namespace tunica
