// SPDX-License-Identifier: MIT
#include "field/sequence.h"

#include <cmath>
#include <numbers>

#include "field/lattices.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

using testing::degrees;

TEST(Sequence, LimitsAreThoseOfTheTable) {
  for (const auto& k : testing::table_4_2)
    EXPECT_NEAR(sequence_of(k.m, k.n, k.jugacy).limit / degrees, k.angle, .0051) << k.m << "," << k.n;
  const double golden = 360 * (2 - std::numbers::phi);
  EXPECT_NEAR(sequence_of(1, 2).limit / degrees, golden, 1e-10);
  EXPECT_NEAR(sequence_of(89, 144).limit / degrees, golden, 1e-10);
  EXPECT_NEAR(sequence_of(10, 6).limit / degrees, golden / 2, 1e-10);
}

TEST(Sequence, PairsFindTheirSequenceAndName) {
  EXPECT_EQ(sequence_of(8, 13).terms(6), (std::vector<int>{1, 2, 3, 5, 8, 13}));
  EXPECT_EQ(sequence_of(7, 11).terms(5), (std::vector<int>{1, 3, 4, 7, 11}));
  EXPECT_EQ(sequence_of(9, 12).terms(4), (std::vector<int>{3, 9, 12, 21}));
  EXPECT_EQ(sequence_of(7, 10).terms(3), (std::vector<int>{3, 7, 10}));
  EXPECT_EQ(sequence_of(1, 1).name, "distichous");
  EXPECT_EQ(sequence_of(2, 2).name, "decussate");
  EXPECT_EQ(sequence_of(3, 3).name, "tricussate");
  EXPECT_EQ(sequence_of(8, 8).name, "whorled of 8");
  EXPECT_EQ(sequence_of(3, 4).name, "Lucas spiral");
  EXPECT_EQ(sequence_of(5, 9).name, "2nd accessory spiral");
  EXPECT_EQ(sequence_of(9, 11).name, "3rd anomalous spiral");
  EXPECT_EQ(sequence_of(3, 7).name, "other (3,7)");
  EXPECT_EQ(sequence_of(14, 21).name, "7-jugate Fibonacci spiral");
  EXPECT_LE(sequence_of(1, 2).terms(50).size(), 50u);
}

TEST(Sequence, IntervalsAreThoseOfTheThesis) {
  const auto expect = [](int m, int n, double low, double high) {
    const AllowableInterval i = allowable_interval(m, n, sequence_of(m, n).limit);
    EXPECT_TRUE(i.opposed);
    EXPECT_NEAR(i.low / degrees, low, 1e-9) << m << "," << n;
    EXPECT_NEAR(i.high / degrees, high, 1e-9) << m << "," << n;
  };
  expect(5, 8, 135, 144);
  expect(3, 5, 120, 144);
  expect(8, 13, 135, 1800. / 13);
  expect(6, 12, 0, 30);
  expect(5, 10, 0, 36);
  expect(3, 7, 720. / 7, 120);
  expect(1, 2, 0, 180);
  expect(1, 7, 0, 360. / 7);
  EXPECT_NEAR(allowable_interval(5, 8, 220 * degrees).high / degrees, 225, 1e-9);  // of the other hand
  EXPECT_FALSE(allowable_interval(8, 13, 100 * degrees).opposed);
  EXPECT_FALSE(allowable_interval(5, 8, 100 * degrees).holds(100 * degrees));
}

TEST(Sequence, VisiblePairsHoldTheAngle) {
  const double golden = sequence_of(1, 2).limit;
  const std::vector<ParastichyPair> pairs = visible_pairs(golden, 1, .1 * degrees);
  ASSERT_GE(pairs.size(), 6u);
  EXPECT_EQ(pairs[2], (ParastichyPair{2, 3}));
  EXPECT_EQ(pairs[5], (ParastichyPair{8, 13}));
  for (const double angle : {41., 77.96, 99.5, 137.51, 151.1, 179.}) {
    for (const ParastichyPair& pair : visible_pairs(angle * degrees, 1, .05 * degrees)) {
      EXPECT_TRUE(allowable_interval(pair.m, pair.n, angle * degrees).holds(angle * degrees, 1e-9))
          << angle << ": " << pair.m << "," << pair.n;
    }
  }
  EXPECT_EQ(visible_pairs(68.75 * degrees, 2, degrees)[2], (ParastichyPair{4, 6}));
}

TEST(Sequence, ImpossiblePairsAreRefused) {
  EXPECT_ERROR(sequence_of(0, 5), "from 1 to 1000000");
  EXPECT_ERROR(sequence_of(4, 6, 1), "jugacy 2");
  EXPECT_ERROR(allowable_interval(5, 8, NAN), "angle");
  EXPECT_ERROR(allowable_interval(5, 8, -1), "angle");
}

}  // namespace
}  // namespace tunica
