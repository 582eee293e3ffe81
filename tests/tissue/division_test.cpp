// SPDX-License-Identifier: MIT
#include "tissue/division.h"

#include <cmath>
#include <numbers>

#include "tissue/builders.h"
#include "tissue/fixtures.h"
#include "tissue/order.h"
#include "tissue/statistics.h"
#include "tissue/topology.h"

namespace tunica {
namespace {

using testing::declare;
using testing::expect_valid;
using testing::total;

void scale(Tissue& tissue, double factor) {
  for (Index j = 0; j < tissue.junctions(); ++j) tissue.set_position(j, factor * tissue.position(j));
  tissue.refresh_geometry();
}

/// One octagon, grown and divided until there are so many cells.
Tissue grown(Index cells, const DivisionRule& rule, const DivisionSettings& settings) {
  Tissue tissue = polygon(8, .3);
  while (tissue.cells() < cells) {
    scale(tissue, std::sqrt(1.01));
    divide_above(tissue, {.area = .75, .most_cells = cells}, rule, settings);
  }
  return tissue;
}

TEST(Division, OnePolygonToTenThousandCells) {
  Tissue tissue = polygon(8, .3);
  Column& amount = declare(tissue, Kind::cell, "amount", 1, Inherit::split);
  Column& level = declare(tissue, Kind::cell, "level", 2, Inherit::copy);
  Column& on_wall = declare(tissue, Kind::wall, "on_wall", 0, Inherit::split);
  Column& on_side = declare(tissue, Kind::side, "on_side", 0, Inherit::split);
  for (double& v : on_wall.values) v = 3;
  for (double& v : on_side.values) v = 5;
  while (tissue.cells() < 10'000) {
    scale(tissue, std::sqrt(1.01));
    divide_above(tissue, {.area = .75, .most_cells = 10'000}, errera);
  }
  EXPECT_EQ(tissue.cells(), 10'000);
  expect_valid(tissue);
  const std::vector<Component> parts = components(tissue);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].euler(), 1);
  EXPECT_EQ(parts[0].borders, 1);
  const CellStatistics statistics = cell_statistics(tissue);
  EXPECT_EQ(statistics.four_way, 0);
  EXPECT_GE(statistics.mean_sides, 5.7);
  EXPECT_LE(statistics.mean_sides, 6.0);
  EXPECT_NEAR(total(amount), 1, 1e-12);
  EXPECT_NEAR(total(on_wall), 24, 24e-12);
  EXPECT_NEAR(total(on_side), 40, 40e-12);
  for (const double value : level.values) ASSERT_EQ(value, 2);
}

TEST(Division, GivesTheDaughtersWhatTheColumnsSay) {
  Tissue tissue =
      polygons({{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}}, {{3, 0, 0}, {6, 0, 0}, {6, 1, 0}, {3, 1, 0}}});
  Column& copied = declare(tissue, Kind::cell, "copied", 0, Inherit::copy);
  Column& reset = declare(tissue, Kind::cell, "reset", 9, Inherit::reset);
  Column& split = declare(tissue, Kind::cell, "split", 0, Inherit::split);
  Column ruled;
  ruled.name = "ruled";
  ruled.inherit = Inherit::rule;
  ruled.rule = [](double mother, double share) { return std::pair(mother + share, -mother); };
  Column& by_rule = tissue.add_column(Kind::cell, ruled);
  Column& wall = declare(tissue, Kind::wall, "w", 4, Inherit::copy);
  copied.values[0] = reset.values[0] = split.values[0] = by_rule.values[0] = 6;
  for (double& v : wall.values) v = 1;
  // At x = 1, across the lower and the upper wall: thirds.
  const Division d = divide(tissue, 0, cut_between(tissue, 0, {1, 0, 0}, {1, 1, 0}), {.gap = .1, .pinch = 0});
  expect_valid(tissue);
  EXPECT_EQ(d.first, 0);
  EXPECT_EQ(d.second, 2);
  const double share = tissue.area(0) / 3;
  EXPECT_NEAR(std::min(tissue.area(0), tissue.area(2)), 1, 1e-12);
  EXPECT_EQ(copied.values[0], 6);
  EXPECT_EQ(copied.values[2], 6);
  EXPECT_EQ(reset.values[0], 9);
  EXPECT_EQ(reset.values[2], 9);
  EXPECT_NEAR(split.values[0], 6 * share, 1e-12);
  EXPECT_NEAR(split.values[2], 6 * (1 - share), 1e-12);
  EXPECT_NEAR(by_rule.values[0], 6 + share, 1e-12);
  EXPECT_EQ(by_rule.values[2], -6);
  EXPECT_EQ(wall.values[d.wall], 4);
  EXPECT_EQ(tissue.fate(Kind::cell, 1), "has divided into 3 and 4");
  EXPECT_EQ(tissue.find(Kind::cell, 1), none);
  EXPECT_EQ(tissue.id(Kind::cell, d.first), 3u);
  EXPECT_EQ(tissue.id(Kind::cell, d.second), 4u);
  EXPECT_EQ(tissue.fate(Kind::cell, 7), "does not exist");
}

TEST(Division, KeepsTheCyclicOrderOfNeighbours) {
  Tissue tissue = hexagon_disk(1);
  const std::vector<Index> before = tissue.neighbours(3);
  ASSERT_EQ(before.size(), 6u);
  const Division d = divide(tissue, 3, errera);
  expect_valid(tissue);
  std::vector<Index> around;  // the ring of outer neighbours, read off both daughters
  for (const Index daughter : {d.first, d.second})
    for (const Index n : tissue.neighbours(daughter))
      if (n != d.first && n != d.second && std::find(around.begin(), around.end(), n) == around.end())
        around.push_back(n);
  EXPECT_EQ(around.size(), 6u);
  EXPECT_EQ(degree(tissue, tissue.start(tissue.wall_side(d.wall, 0))), 3);
  for (const Index n : before) {
    const std::vector<Index> cycle = tissue.neighbours(n);
    int daughters = 0;
    for (const Index c : cycle) daughters += c == d.first || c == d.second ? 1 : 0;
    EXPECT_GE(daughters, 1);
  }
}

TEST(Division, KeepsTheGapAndPinches) {
  Tissue tissue = hexagon_disk(1, 1);
  const Division d = divide(tissue, 3,
                            cut_between(tissue, 3, tissue.position(tissue.start(tissue.first_side(3))),
                                        2 * tissue.centroid(3) - tissue.position(tissue.start(tissue.first_side(3)))),
                            {.gap = .12, .pinch = 0});
  double least = 1;
  for (const Index daughter : {d.first, d.second}) {
    Index side = tissue.first_side(daughter);
    for (int i = 0; i < tissue.side_count(daughter); ++i, side = tissue.next(side))
      least = std::min(least, tissue.length(tissue.wall_of(side)));
  }
  EXPECT_NEAR(least, .12, 1e-12);
  Tissue pinched = hexagon_disk(1, 1), straight = hexagon_disk(1, 1);
  const double shortened = pinched.length(divide(pinched, 3, errera, {.pinch = .08}).wall);
  const double whole = straight.length(divide(straight, 3, errera, {.pinch = 0}).wall);
  EXPECT_NEAR(shortened, .84 * whole, 1e-12);
  expect_valid(pinched);
}

TEST(Division, WhatCannotBeDividedDoesNotHinderTheOthers) {
  // Cells 5 and 9 get a cut from a wall to itself; all others are halved.
  const auto stubborn = [](const Tissue& t, Index cell) {
    const Id id = t.id(Kind::cell, cell);
    const Index side = t.first_side(cell);
    return id == 5 || id == 9 ? Cut{side, .4, side, .6} : errera(t, cell);
  };
  Tissue tissue = hexagon_disk(2);
  const Column& amount = declare(tissue, Kind::cell, "amount", 1, Inherit::split);
  const Index cells = tissue.cells();
  const double area = tissue.area(0);
  EXPECT_ERROR(divide_above(tissue, {.area = .6 * area, .variation = 0}, stubborn),
               "cell 5 cannot be divided there: a daughter or a neighbour would have no area or cross itself; nor can "
               "another cell (elsewhere there were 17 divisions)");
  EXPECT_EQ(tissue.cells(), 2 * cells - 2);
  EXPECT_NE(tissue.find(Kind::cell, 5), none);
  EXPECT_NE(tissue.find(Kind::cell, 9), none);
  EXPECT_FALSE(tissue.locked());
  expect_valid(tissue);
  EXPECT_NEAR(total(amount), cells, 1e-12);
  // Nothing is left but these two; another rule divides them.
  EXPECT_ERROR(divide_above(tissue, {.area = .6 * area, .variation = 0}, stubborn), "(nothing was divided)");
  EXPECT_EQ(divide_above(tissue, {.area = .6 * area, .variation = 0}, errera), 2);
  expect_valid(tissue);
}

TEST(Division, RefusesWhatIsImpossibleAndChangesNothing) {
  Tissue tissue = hexagon_disk(1);
  const std::string before = tissue.hash();
  const Index side = tissue.first_side(3), other = tissue.first_side(2);
  EXPECT_ERROR(divide(tissue, 3, Cut{side, .5, side, .6}), "cannot be divided there");
  EXPECT_ERROR(divide(tissue, 3, Cut{side, .5, other, .5}), "does not end on a wall");
  EXPECT_ERROR(divide(tissue, 3, Cut{side, NAN, tissue.next(side), .5}), "does not end on a wall");
  EXPECT_ERROR(divide(tissue, 3, errera, {.pinch = .6}), "pinch");
  EXPECT_ERROR(divide(tissue, 3, errera, {.gap = NAN}), "gap");
  EXPECT_ERROR(cut_between(tissue, 3, {100, 0, 0}, {0, 0, 0}), "far from cell");
  EXPECT_ERROR(divide(tissue, 3, along({0, 0, 1})), "right angles");
  EXPECT_ERROR(along({0, 0, 0}), "length");
  EXPECT_ERROR(division_rule("errara"), "did you mean 'errera'");
  EXPECT_ERROR(divide_above(tissue, {.area = -1}, errera), "positive");
  EXPECT_ERROR(divide_above(tissue, {.area = 1, .variation = 1}, errera), "variation");
  EXPECT_ERROR(divide(tissue, 3, [](const Tissue&, Index) -> Cut { throw Error("my rule fails"); }), "my rule fails");
  EXPECT_FALSE(tissue.locked());
  EXPECT_EQ(tissue.hash(), before);
  Column ruled;
  ruled.name = "ruled";
  ruled.inherit = Inherit::rule;
  ruled.rule = [&](double, double) -> std::pair<double, double> {
    remove_cell(tissue, 0);  // a rule may not change the structure either
    return {0, 0};
  };
  tissue.add_column(Kind::wall, ruled);
  const std::string with_column = tissue.hash();
  EXPECT_ERROR(divide(tissue, 3, errera), "while rules run");
  EXPECT_FALSE(tissue.locked());
  EXPECT_EQ(tissue.hash(), with_column);
  Tissue graph = ring(3);
  EXPECT_ERROR(divide(graph, 0, errera), "without geometry");
  EXPECT_ERROR(divide_above(graph, {}, errera), "without geometry");
  tissue.lock(true);
  EXPECT_ERROR(divide(tissue, 3, errera), "while rules run");
}

TEST(Division, AboveAThresholdLeavesNoneAboveIt) {
  Tissue tissue = polygon(8, 40);
  const Threshold threshold{.area = 1, .variation = .3};
  const int64_t divisions = divide_above(tissue, threshold, errera);
  expect_valid(tissue);
  EXPECT_EQ(tissue.cells(), divisions + 1);
  for (Index c = 0; c < tissue.cells(); ++c) EXPECT_LE(tissue.area(c), threshold_of(tissue, c, threshold));
  EXPECT_EQ(divide_above(tissue, threshold, errera), 0);
  CancelFlag stop;
  stop.request();
  EXPECT_THROW(divide_above(tissue, {.area = .1}, errera, {}, nullptr, &stop), Cancelled);
  expect_valid(tissue);
}

TEST(Division, DoesNotDependOnTheOrderOfCells) {
  Tissue a = sheet({.cells = 300}), b = sheet({.cells = 300});
  std::vector<Index> backwards;
  for (Index c = b.cells(); c-- > 0;) backwards.push_back(c);
  renumber(b, backwards);
  divide_above(a, {.area = .5}, errera);
  divide_above(b, {.area = .5}, errera);
  expect_valid(b);
  ASSERT_EQ(a.cells(), b.cells());
  for (Index c = 0; c < a.cells(); ++c) {
    const Index same = b.find(Kind::cell, a.id(Kind::cell, c));
    ASSERT_NE(same, none);
    EXPECT_EQ(a.area(c), b.area(same));
    EXPECT_EQ(a.neighbours(c).size(), b.neighbours(same).size());
  }
}

/// A sphere of radius 10 that does not grow.
class Sphere : public Surface {
 public:
  Vec3 advance(const Vec3& p, double, double) const override { return p; }
  Vec3 closest(const Vec3& p) const override { return 10 / p.norm() * p; }
  Vec3 normal(const Vec3& p) const override { return p.normalized(); }
};

TEST(Division, OnACurvedSurfacePutsNewJunctionsOnIt) {
  const Sphere sphere;
  Tissue flat = hexagon_disk(6, 1);
  std::vector<Vec3> positions;
  for (Index j = 0; j < flat.junctions(); ++j) positions.push_back(sphere.closest(flat.position(j) + Vec3(0, 0, 10)));
  move_junctions(flat, positions);
  expect_valid(flat);
  divide_above(flat, {.area = .4}, errera, {}, &sphere);
  expect_valid(flat);
  EXPECT_GT(flat.cells(), 250);
  for (Index j = 0; j < flat.junctions(); ++j) EXPECT_NEAR(flat.position(j).norm(), 10, 1e-12);
  EXPECT_EQ(cell_statistics(flat).four_way, 0);
}

TEST(Division, MeasuresTheSameBitsAsMeasuringEverything) {
  const Sphere sphere;
  Tissue tissue = hexagon_disk(4, 1);
  std::vector<Vec3> positions;
  for (Index j = 0; j < tissue.junctions(); ++j)
    positions.push_back(sphere.closest(tissue.position(j) + Vec3(0, 0, 10)));
  move_junctions(tissue, positions);
  Column& amount = declare(tissue, Kind::cell, "amount", 1, Inherit::split);
  for (Index c = 0; c < tissue.cells(); ++c) amount.values[static_cast<size_t>(c)] = tissue.area(c);
  // Of one cell: the daughters' parts are as their areas.
  const double whole = tissue.area(0);
  const Division division = divide(tissue, 0, errera, {}, &sphere);
  const double first = tissue.area(division.first), second = tissue.area(division.second);
  EXPECT_EQ(amount.values[static_cast<size_t>(division.first)], whole * (first / (first + second)));
  divide_above(tissue, {.area = .2}, errera, {}, &sphere);
  EXPECT_GT(tissue.cells(), 250);
  const auto measures = [&] {
    std::vector<double> all;
    for (const char* name : {"area", "x", "y", "z"})
      for (const double v : tissue.column(Kind::cell, name).values) all.push_back(v);
    for (const double v : tissue.column(Kind::wall, "length").values) all.push_back(v);
    return all;
  };
  const std::vector<double> divided = measures();
  tissue.refresh_geometry();
  EXPECT_EQ(divided, measures());
}

TEST(Division, ErreraMakesFewerSharpCellsThanTheClosestWall) {
  // As the thesis draws them (fig. 3.8), hardly displaced and not pinched; and with the defaults.
  const DivisionSettings plain{.gap_fraction = .02, .pinch = 0};
  for (const DivisionSettings& settings : {plain, DivisionSettings{}}) {
    const CellStatistics e = cell_statistics(grown(3000, errera, settings));
    const CellStatistics c = cell_statistics(grown(3000, closest_wall, settings));
    const auto below_sixty = [](const CellStatistics& s) {
      double share = 0;
      for (size_t i = 0; i < 6; ++i) share += s.least_angle[i];
      return share;
    };
    EXPECT_LT(e.sharp_cells, c.sharp_cells);
    EXPECT_LT(below_sixty(e), .2 * below_sixty(c));
    EXPECT_GT(e.mean_least_angle, c.mean_least_angle + 3);
  }
}

/// Shares of 5-, 6-, 7-sided cells and area CV of the Arabidopsis apex (T0), which the defaults are to come near.
TEST(Division, DefaultsComeNearTheRealApex) {
  double shares[3] = {0, 0, 0}, cv = 0;
  constexpr int sheets = 5;
  for (uint64_t seed = 1; seed <= sheets; ++seed) {
    const CellStatistics s = cell_statistics(sheet({.cells = 3000, .seed = seed}));
    for (size_t i = 0; i < 3; ++i) shares[i] += 100 * s.shares[5 + i] / sheets;
    cv += s.area_cv / sheets;
  }
  EXPECT_NEAR(shares[0], 25.4, 5);
  EXPECT_NEAR(shares[1], 39.1, 5);
  EXPECT_NEAR(shares[2], 25.8, 5);
  EXPECT_NEAR(cv, .273, .08);
  EXPECT_NEAR(cv, .260, .08);
}

}  // namespace
}  // namespace tunica
