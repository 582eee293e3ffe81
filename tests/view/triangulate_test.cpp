// SPDX-License-Identifier: MIT
#include "view/triangulate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/random.h"

namespace tunica {
namespace {

using Eigen::Vector3d;
using Corners = std::vector<Vector3d>;

Vector3d vector_area(const Corners& p) {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < p.size(); ++i) sum += p[i].cross(p[(i + 1) % p.size()]) / 2;
  return sum;
}

/// Sum of the triangles' areas, each positive: equals the polygon's only if they neither overlap nor leave it.
double covered(const Corners& p) {
  double sum = 0;
  for (const auto& t : triangulate(p)) sum += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
  return sum;
}

/// Star-shaped about the origin, with radii as ragged as they come.
Corners ragged(uint64_t seed, int corners) {
  Corners p;
  for (int k = 0; k < corners; ++k) {
    const double r = 0.1 + uniform({seed, purpose("radius"), static_cast<uint64_t>(k), 0});
    const double angle = 2 * M_PI * k / corners;
    p.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
  }
  return p;
}

TEST(Triangulate, CoversRaggedPolygonsOnceInAnyPlane) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    Corners p = ragged(seed, 3 + static_cast<int>(seed % 40));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.1 * static_cast<double>(seed), Vector3d(1, 2, 3).normalized()));
    for (Vector3d& corner : p) corner = turn * corner + Vector3d(5, -3, 2);
    EXPECT_EQ(triangulate(p).size(), p.size() - 2);
    EXPECT_NEAR(covered(p), vector_area(p).norm(), 1e-9) << seed;
  }
}

TEST(Triangulate, CoversAComb) {
  Corners p;
  for (int tooth = 0; tooth < 20; ++tooth) {
    p.emplace_back(2 * tooth, 10, 0);
    p.emplace_back(2 * tooth + 1, 1, 0);
  }
  p.emplace_back(40, 10, 0);
  p.emplace_back(40, 0, 0);
  p.emplace_back(0, 0, 0);
  EXPECT_NEAR(covered(p), vector_area(p).norm(), 1e-9);
}

TEST(Triangulate, EndsForDegenerateInput) {
  EXPECT_TRUE(triangulate(Corners{}).empty());
  EXPECT_TRUE(triangulate(Corners(2, Vector3d::Zero())).empty());
  EXPECT_EQ(triangulate(Corners(7, Vector3d::Ones())).size(), 5u);
  EXPECT_EQ(triangulate(Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).size(), 2u);
  const Corners pentagram = {{0, 3, 0}, {1.8, -2.4, 0}, {-2.9, .9, 0}, {2.9, .9, 0}, {-1.8, -2.4, 0}};
  EXPECT_EQ(triangulate(pentagram).size(), 3u);
}

TEST(Triangulate, TakesCollinearAndRepeatedCorners) {
  const Corners p = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}, {0, 1, 0}};
  EXPECT_NEAR(covered(p), 3, 1e-12);
}

}  // namespace
}  // namespace tunica
