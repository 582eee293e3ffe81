// SPDX-License-Identifier: MIT
#include <cmath>

#include "shape/apex.h"
#include "shape/lstudio.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

DrawnCurve shipped(const std::string& file) {
  return read_lstudio(testing::content_of(testing::repository() / "share/curves" / file), file).at(0);
}

Profile profile(const std::string& name) { return Profile(shipped(name + ".con").contour()); }

/// Largest distance between two profiles at equal arc length.
double difference(const Profile& p, const Profile& q, double to) {
  double most = 0;
  for (double a = 0; a <= to; a += .003) most = std::max(most, (p.at(a) - q.at(a)).norm());
  return most;
}

TEST(ShippedCurves, ProfilesAreTheFormsThatTheyName) {
  EXPECT_LT(difference(profile("hemisphere_cylinder"), Profile::cap(1.15, M_PI / 2, 6), 5.5), 4e-6);
  EXPECT_LT(difference(profile("arabidopsis"), Profile::cap(1.45, 75 * M_PI / 180, 8), 6.5), 4e-6);
  const Profile parabola = profile("paraboloid");
  for (double a = 0; a < parabola.length(); a += .1) {
    const Vec2 p = parabola.at(a);
    EXPECT_NEAR(p.y(), -p.x() * p.x(), 1e-11);
  }
  EXPECT_NEAR(profile("cone").arc_at_radius(1), 2, 1e-11);
  EXPECT_NEAR(profile("disk").arc_at_radius(1), 1, 1e-11);
  EXPECT_EQ(profile("cylinder").hole(), 1);
  EXPECT_NEAR(profile("dome").arc_at_radius(1), 1.1015, 5e-5);
}

TEST(ShippedCurves, RaisedGrowthIsTheMeasuredOne) {
  const Curve raised = shipped("raised.func").function();
  for (double a = 0; a < 6; a += .01) {
    const double s = a - 1.1015, base = s < 0 ? .25 : .25 * std::exp(-s * s);
    EXPECT_NEAR(raised(a), base + .75 * std::exp(-4 * s * s), 2e-4);
  }
  const Apex apex(profile("dome"), raised);
  EXPECT_NEAR(apex.speed(apex.profile().arc_at_radius(1)), .607, 5e-4);
  EXPECT_FALSE(apex.shrinks());
  EXPECT_EQ(shipped("constant.func").function()(.3), 1);
}

TEST(ShippedCurves, ADiskGrowsByTheExponential) {
  const Apex disk(profile("disk"), shipped("constant.func").function());
  for (const double a : {1e-6, .1, 1., 2., 4.})
    for (const double dt : {-3., .5, 2.}) EXPECT_NEAR(disk.after(a, dt) / (a * std::exp(dt)), 1, 1e-10);
}

}  // namespace
}  // namespace tunica
