// SPDX-License-Identifier: MIT
#include "sweep/samples.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "base/error.h"

using namespace tunica::sweep;

namespace {

std::vector<Range> unit_ranges(int count) {
  std::vector<Range> ranges;
  for (int i = 0; i < count; ++i)
    ranges.push_back({.name = fmt::format("p{}", i), .kind = Range::Kind::interval, .low = 0, .high = 1});
  return ranges;
}

}  // namespace

TEST(Samples, MoreSamplesKeepTheFirst) {
  const auto ranges = unit_ranges(3);
  for (const auto kind : {Sampling::random, Sampling::sobol}) {
    const auto few = make_samples(ranges, kind, 10, 7), many = make_samples(ranges, kind, 100, 7);
    EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
    EXPECT_NE(few, make_samples(ranges, kind, 10, 8));
  }
}

TEST(Samples, GridsHoldEveryCombinationOnce) {
  std::vector<Range> ranges = unit_ranges(2);
  ranges[0].steps = 4;
  ranges[1].steps = 3;
  ranges.push_back({.name = "fixed", .values = {"9"}});
  const auto samples = make_samples(ranges, Sampling::grid, 0, 1);
  EXPECT_EQ(samples.size(), 12u);
  EXPECT_EQ(std::set<Sample>(samples.begin(), samples.end()).size(), 12u);
  EXPECT_EQ(samples[0], (Sample{"0", "0", "9"}));
  EXPECT_EQ(samples[1], (Sample{"0", "0.5", "9"}));
}

// Of 2^k points of a Sobol sequence each interval of 2^-k holds one in every coordinate; a shift moves at most one more
// in.
TEST(Samples, SobolFillsEachCoordinateEvenly) {
  constexpr int count = 256, dimensions = 20;
  const auto samples = make_samples(unit_ranges(dimensions), Sampling::sobol, count, 3);
  for (int k = 0; k < dimensions; ++k) {
    std::vector<int> in(16, 0);
    for (const auto& sample : samples)
      ++in[std::min(15, static_cast<int>(16 * std::strtod(sample[k].c_str(), nullptr)))];
    for (const int n : in) EXPECT_NEAR(n, count / 16, 1);
  }
}

TEST(Samples, RefuseNothingAndTooMuch) {
  EXPECT_THROW(make_samples({}, Sampling::random, 3, 1), tunica::Error);
  auto ranges = unit_ranges(4);
  for (auto& range : ranges) range.steps = 1000;
  EXPECT_THROW(make_samples(ranges, Sampling::grid, 0, 1), tunica::Error);
}
