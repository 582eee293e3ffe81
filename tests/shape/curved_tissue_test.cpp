// SPDX-License-Identifier: MIT
// Growth, division and removal on strongly curved surfaces.
#include <Eigen/Geometry>

#include "shape/cap.h"
#include "tissue/chord.h"
#include "tissue/division.h"
#include "tissue/fixtures.h"
#include "tissue/statistics.h"
#include "tissue/topology.h"

namespace tunica {
namespace {

using testing::Cap;
using testing::expect_valid;
using testing::polygon_on_tip;
using testing::Tube;

void expect_on(const Tissue& tissue, const Surface& surface, double tolerance = 1e-12) {
  for (Index j = 0; j < tissue.junctions(); ++j)
    ASSERT_LE((tissue.position(j) - surface.closest(tissue.position(j))).norm(), tolerance);
  for (Index c = 0; c < tissue.cells(); ++c)
    ASSERT_GT(tissue.normal(c).dot(surface.normal(tissue.centroid(c))), .5) << "cell " << c;
}

void remove_beyond(Tissue& tissue, double a) {
  std::vector<Id> far;
  for (Index c = 0; c < tissue.cells(); ++c)
    if (Cap::arc(tissue.centroid(c)) > a) far.push_back(tissue.id(Kind::cell, c));
  remove_cells(tissue, far);
}

/// Cells on a cap, from one at its tip, that grow, divide and go beyond an arc length of 1.4.
int64_t grow_on_cap(Tissue& tissue, const Cap& cap, double area, int64_t wanted, const DivisionRule& rule) {
  int64_t divisions = 0;
  for (int step = 0; divisions < wanted; ++step) {
    grow(tissue, cap, step, 1);
    divisions += divide_above(tissue, {.area = area}, rule, {}, &cap);
    remove_beyond(tissue, 1.4);
    if (step % 50 == 0) expect_valid(tissue);
  }
  return divisions;
}

TEST(CurvedTissue, ThousandsOfDivisionsOnADome) {
  const Cap cap(.01);
  Tissue tissue = polygon_on_tip(8, .05);
  EXPECT_GT(tissue.normal(0).y(), .99);
  grow_on_cap(tissue, cap, .008, 4000, errera);
  expect_valid(tissue);
  expect_on(tissue, cap);
  const CellStatistics s = cell_statistics(tissue);
  EXPECT_EQ(s.four_way, 0);
  EXPECT_GT(s.interior, 600);
  EXPECT_NEAR(s.mean_sides, 6, .1);
  EXPECT_NEAR(s.area_cv, .27, .08);
  // Flat cells cover a little less than the cap: by the square of their size over the radius.
  double area = 0, inside = 0;
  for (Index c = 0; c < tissue.cells(); ++c) {
    area += tissue.area(c);
    if (Cap::arc(tissue.centroid(c)) < 1.2) inside += tissue.area(c);
  }
  EXPECT_NEAR(inside, 2 * M_PI * (1 - std::cos(1.2)), .02 * inside);
  EXPECT_LT(area, 2 * M_PI * (1 - std::cos(1.5)));
  RecordProperty("cells", tissue.cells());
}

TEST(CurvedTissue, CellsAsLargeAsTheRadiusOfCurvature) {
  for (const double area : {.3, .8}) {
    for (const DivisionRule& rule : {DivisionRule(errera), DivisionRule(closest_wall)}) {
      const Cap cap(.01);
      Tissue tissue = polygon_on_tip(8, .2);
      grow_on_cap(tissue, cap, area, 300, rule);
      expect_valid(tissue);
      expect_on(tissue, cap);
      EXPECT_EQ(cell_statistics(tissue).four_way, 0);
    }
  }
}

TEST(CurvedTissue, GrowsAndDividesAlongACylinder) {
  const Tube tube(.01);
  std::vector<std::vector<Vec3>> cells;
  const auto at = [](int i, double y) { return Vec3(std::cos(i * M_PI / 3), y, std::sin(i * M_PI / 3)); };
  for (int i = 0; i < 6; ++i) cells.push_back({at(i, -1), at(i, 1), at(i + 1, 1), at(i + 1, -1)});
  Tissue tissue = polygons(cells);
  EXPECT_EQ(components(tissue)[0].borders, 2);
  for (int step = 0; step < 400; ++step) {
    grow(tissue, tube, step, 1);
    divide_above(tissue, {.area = .2}, errera, {}, &tube);
  }
  expect_valid(tissue);
  expect_on(tissue, tube);
  EXPECT_GT(tissue.cells(), 3000);
  EXPECT_EQ(cell_statistics(tissue).four_way, 0);
  EXPECT_EQ(components(tissue)[0].borders, 2);
}

/// Length, on the sphere, of the wall through a cell's centroid in a direction of its mean plane.
double length_on_cap(const FlatCell& flat, const std::vector<Vec3>& corners, double angle) {
  const Vec2 d(std::cos(angle), std::sin(angle));
  const std::vector<Hit> hits = hits_along(flat, d);
  const auto place = [&](const Hit& hit) {
    const Vec3 &from = corners[hit.side], &to = corners[(hit.side + 1) % corners.size()];
    const double at = -cross(d, flat.from(hit.side)) / cross(d, flat.along(hit.side));
    return Vec3((from + at * (to - from)).normalized());
  };
  const Vec3 middle = flat.frame.origin.normalized(), p = place(hits.front()), q = place(hits.back());
  return std::acos(std::min(1., p.dot(middle))) + std::acos(std::min(1., q.dot(middle)));
}

/// The rule looks at the mean plane; held against the shortest wall on the surface itself, through the centroid.
TEST(CurvedTissue, ErreraInTheMeanPlaneIsErreraOnTheSurface) {
  for (const double area : {.008, .1, .3}) {
    const Cap cap(.01);
    Tissue tissue = polygon_on_tip(8, .05);
    grow_on_cap(tissue, cap, area, area < .01 ? 500 : 100, errera);
    double worst = 0;
    for (Index c = 0; c < tissue.cells(); ++c) {
      const FlatCell flat(tissue, c);
      if (!flat.centroid_inside) continue;
      double least = INFINITY;
      for (int i = 0; i < 720; ++i) least = std::min(least, length_on_cap(flat, tissue.polygon(c), i * M_PI / 720));
      const Cut cut = shortest_chord(flat).cut;
      const auto end = [&](Index side, double at) {
        return flat.frame.flat(tissue.position(tissue.start(side)) +
                               at * (tissue.position(tissue.end(side)) - tissue.position(tissue.start(side))));
      };
      const Vec2 d = end(cut.side_b, cut.at_b) - end(cut.side_a, cut.at_a);
      const double chosen = length_on_cap(flat, tissue.polygon(c), std::atan2(d.y(), d.x()));
      worst = std::max(worst, chosen / least - 1);
    }
    EXPECT_LT(worst, .05 * area) << "cells of area " << area;
  }
}

/// Moves nothing, and throws when it is asked which way a cell faces.
class Blind : public Cap {
 public:
  Vec3 normal(const Vec3&) const override { fail("no idea"); }
};

TEST(CurvedTissue, FailuresLeaveTheTissueAsItWas) {
  Tissue tissue = polygon_on_tip(8, .5);
  const std::string before = tissue.hash();
  EXPECT_ERROR(grow(tissue, Blind(), 0, 1), "no idea");
  EXPECT_ERROR(divide(tissue, 0, errera, {}, std::make_unique<Blind>().get()), "no idea");
  EXPECT_FALSE(tissue.locked());
  // From inside, the cell is turned over.
  class Inside : public Cap {
    Vec3 normal(const Vec3& p) const override { return -p; }
  };
  EXPECT_ERROR(grow(tissue, Inside(), 0, 1), "turn over");
  EXPECT_EQ(tissue.hash(), before);
  EXPECT_ERROR(remove_cells(tissue, {1}), "last cell");
  EXPECT_EQ(tissue.hash(), before);
}

}  // namespace
}  // namespace tunica
