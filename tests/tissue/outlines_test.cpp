// SPDX-License-Identifier: MIT
#include <cstring>

#include "tissue/fixtures.h"
#include "tissue/outline_kernels.h"
#include "tissue/polygon.h"

namespace tunica {
namespace {

using testing::Dice;

TEST(Outlines, FourSideBySideAreAsOneWithEachInstructionSet) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "only one here";
  Dice dice(3);
  for (int round = 0; round < 200; ++round) {
    FourOutlines four{};
    alignas(32) double outward[3][4];
    for (int k = 0; k < 4; ++k) {
      const int n = four.corners[k] = 3 + static_cast<int>(dice.between(0, 12.99));
      four.count = std::max(four.count, n);
      for (int i = 0; i < n; ++i) {
        const double turn = 2 * M_PI * (i + dice.between(-.4, .4)) / n;
        four.x[i][k] = std::cos(turn), four.y[i][k] = std::sin(turn), four.z[i][k] = dice.between(-.1, .1);
      }
      for (int i = n; i <= FourOutlines::most; ++i)
        four.x[i][k] = four.x[0][k], four.y[i][k] = four.y[0][k], four.z[i][k] = four.z[0][k];
      outward[0][k] = dice.between(-1, 1), outward[1][k] = dice.between(-1, 1), outward[2][k] = 1;
    }
    FourMeasures a{}, b{};
    const int certain = avx2::outline_kernels().measure(four, b);
    EXPECT_EQ(sse2::outline_kernels().measure(four, a), certain);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
    const int plain = avx2::outline_kernels().plain(four, outward);
    EXPECT_EQ(sse2::outline_kernels().plain(four, outward), plain);
    for (int k = 0; k < 4; ++k) {
      std::vector<Vec3> polygon;
      for (int i = 0; i < four.corners[k]; ++i) polygon.emplace_back(four.x[i][k], four.y[i][k], four.z[i][k]);
      const Measure m = measure(polygon);
      EXPECT_EQ((certain >> k & 1) != 0, four.corners[k] > 3);  // three corners lie in a plane
      if (four.corners[k] > 3) {
        EXPECT_EQ(m.area, b.area[k]);
        EXPECT_EQ(m.centroid, Vec3(b.x[k], b.y[k], b.z[k]));
      }
      EXPECT_EQ(is_plain_cell(polygon, {outward[0][k], outward[1][k], outward[2][k]}), (plain >> k & 1) != 0);
    }
  }
}

}  // namespace
}  // namespace tunica
