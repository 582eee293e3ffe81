// SPDX-License-Identifier: MIT
#include "shape/apex_tissue.h"

#include <Eigen/Geometry>

#include "shape/bulges.h"
#include "tissue/division.h"
#include "tissue/fixtures.h"
#include "tissue/polygon.h"
#include "tissue/statistics.h"

namespace tunica {
namespace {

using testing::expect_valid;

Apex hemisphere(const Curve& growth = Curve::constant(1)) { return {Profile::cap(1, M_PI / 2, 4), growth}; }

void expect_on(const Tissue& tissue, const Apex& apex) {
  for (Index j = 0; j < tissue.junctions(); ++j)
    ASSERT_LE((tissue.position(j) - apex.closest(tissue.position(j))).norm(), 1e-9);
  for (Index c = 0; c < tissue.cells(); ++c)
    ASSERT_GT(tissue.normal(c).dot(apex.normal(tissue.centroid(c))), .8) << "cell " << c;
}

TEST(ApexTissue, CoversTheTip) {
  const Apex apex = hemisphere();
  const Tissue tissue = apex_tissue(apex, {.to = 1.2, .max_area = .01});
  expect_valid(tissue);
  expect_on(tissue, apex);
  const CellStatistics s = cell_statistics(tissue);
  EXPECT_EQ(s.four_way, 0);
  EXPECT_NEAR(s.mean_sides, 6, .15);
  double area = 0;
  for (Index c = 0; c < tissue.cells(); ++c) {
    area += tissue.area(c);
    EXPECT_LE(apex.place_of(tissue.centroid(c)).a, 1.2);
  }
  EXPECT_NEAR(area, apex.area(1.2), .05 * area);
  EXPECT_EQ(apex_tissue(apex, {.cells = 77}).cells(), 77);
  EXPECT_EQ(apex_tissue(apex, {.cells = 50, .seed = 4}).hash(), apex_tissue(apex, {.cells = 50, .seed = 4}).hash());
  EXPECT_NE(apex_tissue(apex, {.cells = 50, .seed = 5}).hash(), apex_tissue(apex, {.cells = 50, .seed = 4}).hash());
}

TEST(ApexTissue, GrowsDividesAndGoes) {
  const Apex apex = hemisphere();
  Tissue tissue = apex_tissue(apex, {.to = 2, .max_area = .02});
  int64_t divisions = 0, removed = 0;
  for (int step = 0; step < 400; ++step) {
    grow(tissue, apex, 0, .01);
    divisions += divide_above(tissue, {.area = .02}, errera, {}, &apex);
    removed += remove_beyond(tissue, apex, 2);
  }
  EXPECT_GT(divisions, 1500);
  EXPECT_GT(removed, 1500);
  expect_valid(tissue);
  expect_on(tissue, apex);
  EXPECT_EQ(cell_statistics(tissue).four_way, 0);
  EXPECT_EQ(components(tissue).size(), 1u);
}

TEST(ApexTissue, KnowsPlaces) {
  const auto apex = std::make_shared<Apex>(hemisphere());
  Tissue tissue = apex_tissue(*apex, {.cells = 60});
  locate(tissue, *apex);
  const auto at = [&](Index c, const char* name) { return tissue.column(Kind::cell, name).values[c]; };
  for (Index c = 0; c < tissue.cells(); ++c) {
    const Vec3 p = tissue.centroid(c);
    EXPECT_NEAR(at(c, "a"), std::atan2(std::hypot(p.x(), p.z()), 1 + p.y()), 1e-9);
    EXPECT_NEAR(at(c, "theta"), std::atan2(p.z(), p.x()) * 180 / M_PI, 1e-9);
  }
  const Division d = divide(tissue, 7, errera, {}, apex.get());
  std::vector<Id> near_by;
  for (const Index daughter : {d.first, d.second})
    for (const Index n : tissue.neighbours(daughter)) near_by.push_back(tissue.id(Kind::cell, n));
  follow(tissue, *apex, near_by);
  const std::vector<double> near(tissue.column(Kind::cell, "a").values.begin(),
                                 tissue.column(Kind::cell, "a").values.begin() + tissue.cells());
  locate(tissue, *apex);
  for (Index c = 0; c < tissue.cells(); ++c) EXPECT_EQ(at(c, "a"), near[c]);
  const Bulges bulges(
      apex, [](double) { return 1; }, [](double) { return 1; });
  EXPECT_EQ(apex_below(bulges), apex.get());
}

TEST(ApexTissue, Errors) {
  const Apex apex = hemisphere();
  EXPECT_ERROR(apex_tissue(apex, {}), "one of");
  EXPECT_ERROR(apex_tissue(apex, {.to = 1, .cells = 3}), "one of");
  EXPECT_ERROR(apex_tissue(apex, {.to = -1}), "positive");
  EXPECT_ERROR(apex_tissue(apex, {.to = 1, .max_area = 0}), "positive");
  EXPECT_ERROR(apex_tissue(apex, {.to = 1, .growth = 0}), "growth");
  EXPECT_ERROR(apex_tissue(hemisphere(Curve::constant(0)), {.to = 1}), "does not grow");
  EXPECT_ERROR(apex_tissue(hemisphere(Curve::constant(0)), {.cells = 3}), "stop growing");
  const Apex tube(Profile::line({1, 0}, {1, -3}), Curve::constant(1));
  EXPECT_ERROR(apex_tissue(tube, {.to = 1}), "hole");
  Tissue tissue = apex_tissue(apex, {.cells = 20});
  const std::string before = tissue.hash();
  EXPECT_ERROR(remove_beyond(tissue, apex, 0), "last cell");
  EXPECT_ERROR(remove_beyond(tissue, apex, NAN), "finite");
  EXPECT_EQ(tissue.hash(), before);
  CancelFlag stop;
  stop.request();
  EXPECT_THROW(apex_tissue(apex, {.to = 1, .cancel = &stop}), Cancelled);
}

/// Cells measured four at once and one by one: the same bits.
TEST(ApexTissue, CellsAreMeasuredTogetherAsAlone) {
  Tissue tissue = apex_tissue(Apex(Profile::cap(1.45, 1.3, 9), Curve::constant(.2)), {.to = 4, .max_area = .2});
  const auto values = [&] {
    std::vector<double> all;
    for (const char* name : {"area", "x", "y", "z"}) {
      const auto& column = tissue.column(Kind::cell, name).values;
      all.insert(all.end(), column.begin(), column.end());
    }
    for (Index w = 0; w < tissue.walls(); ++w) all.push_back(tissue.length(w));
    return all;
  };
  tissue.refresh_geometry();
  const std::vector<double> together = values();
  for (Index c = 0; c < tissue.cells(); ++c) tissue.refresh_geometry(c);
  EXPECT_EQ(together, values());
  for (Index c = 0; c < tissue.cells(); ++c) {
    const Measure m = measure(tissue.polygon(c));
    EXPECT_EQ(m.area, tissue.area(c));
    EXPECT_EQ(m.centroid, tissue.centroid(c));
  }
}

}  // namespace
}  // namespace tunica
