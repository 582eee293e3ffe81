// SPDX-License-Identifier: MIT
#include "sweep/search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

using namespace tunica::sweep;

namespace {

/// Best value after so many generations on a valley in [0,1]^n, ten times as steep in one half of the directions.
double best_of(Search& search, int generations, std::vector<Point>* all = nullptr) {
  double best = Search::worst;
  for (int g = 0; g < generations; ++g) {
    const auto points = search.ask();
    EXPECT_EQ(points.size(), search.population());
    std::vector<double> values;
    for (const auto& point : points) {
      double sum = 0;
      for (size_t k = 0; k < point.size(); ++k) {
        EXPECT_TRUE(point[k] >= 0 && point[k] <= 1);
        sum += (k % 2 ? 10 : 1) * std::pow(point[k] - 0.3, 2);
      }
      values.push_back(sum);
      best = std::min(best, sum);
      if (all) all->push_back(point);
    }
    search.tell(values);
  }
  return best;
}

}  // namespace

TEST(Search, FindsTheBottomOfAValley) {
  for (const size_t dimensions : {1, 2, 5, 20}) {
    Search search({.start = Point(dimensions, 0.9), .step = 0.2, .seed = 3});
    EXPECT_LT(best_of(search, dimensions == 20 ? 250 : 100), 1e-4) << dimensions;
  }
}

TEST(Search, TheFirstGenerationLiesAboutTheStart) {
  Search search({.start = Point(20, 0.5), .step = 0.01, .population = 40});
  double sum = 0;
  for (const auto& point : search.ask())
    for (const double x : point) sum += std::pow(x - 0.5, 2);
  EXPECT_NEAR(std::sqrt(sum / 800), 0.01, 0.001);
}

TEST(Search, EqualSeedsAskTheSame) {
  std::vector<Point> first, second, third;
  for (auto* all : {&first, &second, &third}) {
    Search search({.start = Point(6, 0.5), .seed = all == &third ? 8u : 7u});
    best_of(search, 20, all);
    search.ask();  // asking twice changes nothing
    EXPECT_EQ(search.ask(), search.ask());
  }
  EXPECT_EQ(first, second);
  EXPECT_NE(first, third);
}

TEST(Search, StandsPlateausAndRunsThatFail) {
  Search search({.start = Point(4, 0.5)});
  for (int g = 0; g < 50; ++g) {
    const size_t count = search.ask().size();
    search.tell(std::vector<double>(count, g % 2 ? Search::worst : 1));
  }
  for (const auto& point : search.ask())
    for (const double x : point) EXPECT_TRUE(x >= 0 && x <= 1);
  EXPECT_THROW(Search({.start = {}}), tunica::Error);
}
