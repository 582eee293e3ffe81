// SPDX-License-Identifier: MIT
#include "tissue/statistics.h"

#include <cmath>

#include "base/random.h"
#include "tissue/builders.h"
#include "tissue/fixtures.h"
#include "tissue/order.h"

namespace tunica {
namespace {

TEST(Statistics, OfHexagons) {
  const CellStatistics s = cell_statistics(hexagon_disk(5, 2));
  EXPECT_EQ(s.cells, 91);
  EXPECT_EQ(s.interior, 61);
  EXPECT_EQ(s.shares[6], 1);
  EXPECT_EQ(s.mean_sides, 6);
  EXPECT_NEAR(s.mean_area, 2, 1e-12);
  EXPECT_NEAR(s.area_cv, 0, 1e-12);
  EXPECT_EQ(s.sharp_cells, 0);
  EXPECT_NEAR(s.mean_least_angle, 120, 1e-9);
  EXPECT_EQ(s.four_way, 0);
  EXPECT_EQ(cell_statistics(squares(4, 4)).four_way, 9);
  EXPECT_EQ(cell_statistics(squares(1, 1)).interior, 0);
  EXPECT_ERROR(cell_statistics(ring(5)), "no cell shapes");
}

TEST(Statistics, LewisSlopeIsTheRegressionOfAreaOnSides) {
  const Tissue tissue = sheet({.cells = 400});
  const CellStatistics s = cell_statistics(tissue);
  double n = 0, a = 0, nn = 0, na = 0, count = 0;
  for (Index c = 0; c < tissue.cells(); ++c) {
    if (tissue.on_border(c)) continue;
    const double k = static_cast<double>(tissue.neighbours(c).size()), area = tissue.area(c) / s.mean_area;
    n += k;
    a += area;
    nn += k * k;
    na += k * area;
    ++count;
  }
  EXPECT_NEAR(s.lewis_slope, (count * na - n * a) / (count * nn - n * n), 1e-12);
  double shares = 0, angles = 0;
  for (const double share : s.shares) shares += share;
  for (const double share : s.least_angle) angles += share;
  EXPECT_NEAR(shares, 1, 1e-12);
  EXPECT_NEAR(angles, 1, 1e-12);
}

TEST(Peaks, AreStrictMaximaAboveTheMean) {
  Tissue tissue = ring(12);
  Column& a = testing::declare(tissue, Kind::cell, "a", 1, Inherit::copy);
  a.values[2] = 5;
  a.values[7] = 1.1;               // above its neighbours, below the mean
  a.values[9] = a.values[10] = 4;  // a plateau
  EXPECT_EQ(find_peaks(tissue, "a").cells, (std::vector<Index>{2}));
  EXPECT_EQ(find_peaks(tissue, "a", 0).cells, (std::vector<Index>{2, 7}));
  a.values[0] = NAN;
  EXPECT_EQ(find_peaks(tissue, "a").cells, (std::vector<Index>{2}));
  EXPECT_ERROR(find_peaks(tissue, "b"), "no column 'b'");
}

TEST(Peaks, HaveDistances) {
  Tissue tissue = squares(9, 3);
  Column& a = testing::declare(tissue, Kind::cell, "a", 0, Inherit::copy);
  for (const Index c : {9, 12, 17}) a.values[c] = 1;
  const Peaks peaks = find_peaks(tissue, "a");
  EXPECT_EQ(peaks.cells.size(), 3u);
  EXPECT_NEAR(peaks.mean_distance, (3 + 3 + 5) / 3., 1e-12);
}

TEST(Order, KeepsCellsWallsAndValuesAndPutsNeighboursNear) {
  Tissue tissue = hexagon_disk(20);
  Column& a = testing::declare(tissue, Kind::cell, "a", 0, Inherit::copy);
  Column& w = testing::declare(tissue, Kind::wall, "w", 0, Inherit::copy);
  for (Index c = 0; c < tissue.cells(); ++c) a.values[c] = tissue.id(Kind::cell, c);
  for (Index i = 0; i < tissue.walls(); ++i) w.values[i] = tissue.id(Kind::wall, i);
  std::vector<std::vector<Id>> before(static_cast<size_t>(tissue.cells()) + 1);
  const auto cycle = [&](Index c) {
    std::vector<Id> ids;
    for (const Index n : tissue.neighbours(c)) ids.push_back(tissue.id(Kind::cell, n));
    return ids;
  };
  for (Index c = 0; c < tissue.cells(); ++c) before[tissue.id(Kind::cell, c)] = cycle(c);
  std::vector<Index> shuffle;
  for (Index c = 0; c < tissue.cells(); ++c) shuffle.push_back((c * 500) % tissue.cells());
  renumber(tissue, shuffle);
  testing::expect_valid(tissue);
  const auto spread = [&] {
    double sum = 0;
    for (Index s = 0; s < tissue.sides(); ++s)
      if (tissue.neighbour(s) != none) sum += std::abs(tissue.neighbour(s) - tissue.cell_of(s));
    return sum / tissue.sides();
  };
  const double shuffled = spread();
  renumber_along_curve(tissue);
  testing::expect_valid(tissue);
  EXPECT_LT(spread(), .1 * shuffled);
  for (Index c = 0; c < tissue.cells(); ++c) {
    EXPECT_EQ(a.values[c], tissue.id(Kind::cell, c));
    EXPECT_EQ(cycle(c), before[tissue.id(Kind::cell, c)]);
  }
  for (Index i = 0; i < tissue.walls(); ++i) EXPECT_EQ(w.values[i], tissue.id(Kind::wall, i));
  EXPECT_ERROR(renumber(tissue, {0, 1}), "all 1261");
  shuffle[0] = shuffle[1];
  EXPECT_ERROR(renumber(tissue, shuffle), "once");
  Tissue graph = grid(30, 30);
  renumber_along_curve(graph);
  testing::expect_valid(graph);
}

TEST(Checkerboard, IsOneForAlternationAndNegativeForWhatIsSmooth) {
  const Tissue squares = grid(12, 12);
  std::vector<double> values(144);
  const auto fill = [&](auto&& f) {
    for (Index c = 0; c < 144; ++c) values[c] = f(c % 12, c / 12);
    return checkerboard_index(squares, values.data());
  };
  EXPECT_NEAR(fill([](int x, int y) { return (x + y) % 2 ? 3.0 : -1.0; }), 1, 1e-12);
  EXPECT_LT(fill([](int x, int y) { return std::sin(.5 * x) * std::cos(.4 * y); }), -.5);
  EXPECT_EQ(fill([](int, int) { return 7.0; }), 0);
  const double noise = fill([](int x, int y) {
    return uniform({.seed = 3, .cell = static_cast<uint64_t>(x), .step = static_cast<uint32_t>(y)});
  });
  EXPECT_GT(noise, .2);
  EXPECT_FALSE(alternates(squares, noise));
  EXPECT_TRUE(alternates(squares, .9));
  EXPECT_EQ(fill([](int x, int y) { return x + y == 5 ? NAN : 1.0; }), 0);
}

TEST(Columns, NamesAreCheckedAndUnknownOnesNameTheNearest) {
  Tissue tissue = ring(3);
  testing::declare(tissue, Kind::cell, "auxin", 2, Inherit::copy);
  EXPECT_EQ(tissue.column(Kind::cell, "auxin").values[2], 2);
  EXPECT_ERROR(tissue.column(Kind::cell, "auxim"), "did you mean 'auxin'");
  EXPECT_ERROR(testing::declare(tissue, Kind::cell, "auxin", 2, Inherit::copy), "already");
  EXPECT_ERROR(testing::declare(tissue, Kind::cell, "2x", 2, Inherit::copy), "cannot name a column");
  EXPECT_ERROR(testing::declare(tissue, Kind::cell, "x", 2, Inherit::rule), "no rule is given");
}

}  // namespace
}  // namespace tunica
