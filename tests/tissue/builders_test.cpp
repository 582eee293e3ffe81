// SPDX-License-Identifier: MIT
#include "tissue/builders.h"

#include <cmath>

#include "tissue/fixtures.h"
#include "tissue/topology.h"

namespace tunica {
namespace {

using testing::declare;
using testing::expect_valid;

std::vector<Id> neighbour_ids(const Tissue& tissue, Index cell) {
  std::vector<Id> ids;
  for (const Index n : tissue.neighbours(cell)) ids.push_back(tissue.id(Kind::cell, n));
  return ids;
}

TEST(Builders, LinesAndRingsHaveTheirNeighbours) {
  const Tissue row = line(4);
  expect_valid(row);
  EXPECT_EQ(row.neighbours(0), (std::vector<Index>{1}));
  EXPECT_EQ(row.neighbours(1), (std::vector<Index>{2, 0}));
  const Tissue closed = ring(5);
  expect_valid(closed);
  EXPECT_EQ(closed.neighbours(0), (std::vector<Index>{1, 4}));
  EXPECT_EQ(closed.walls(), 5);
  expect_valid(line(1));
  EXPECT_EQ(line(1).side_count(0), 0);
}

TEST(Builders, GridsRunNextColumnNextRowPreviousColumnPreviousRow) {
  const Tissue open = grid(4, 3);
  expect_valid(open);
  EXPECT_EQ(open.neighbours(5), (std::vector<Index>{6, 9, 4, 1}));
  EXPECT_EQ(open.neighbours(0), (std::vector<Index>{1, 4}));
  const Tissue torus = grid(4, 3, Wrap::both);
  expect_valid(torus);
  EXPECT_EQ(torus.neighbours(0), (std::vector<Index>{1, 4, 3, 8}));
  const Tissue tube = cylinder(4, 3);
  expect_valid(tube);
  EXPECT_EQ(tube.neighbours(0), (std::vector<Index>{1, 4, 3}));
  const Tissue flat = squares(4, 3);
  expect_valid(flat);
  EXPECT_EQ(flat.neighbours(5), open.neighbours(5));
  EXPECT_DOUBLE_EQ(flat.area(7), 1);
}

TEST(Builders, RefuseImpossibleSizes) {
  EXPECT_ERROR(ring(2), "at least 3");
  EXPECT_ERROR(line(0), "at least 1");
  EXPECT_ERROR(grid(5'000'000, 2), "4000000");
  EXPECT_ERROR(grid(3'000'000, 3'000'000), "4000000");
  EXPECT_ERROR(cylinder(2, 5), "at least 3");
  EXPECT_ERROR(hexagons(3, 3, -1), "positive");
  EXPECT_ERROR(hexagon_disk(1'000'000), "2000000");
  EXPECT_ERROR(sheet({.cells = 0}), "between 1");
  EXPECT_ERROR(sheet({.cells = 5, .max_area = NAN}), "positive");
}

TEST(Builders, HexagonsHaveSixNeighboursAndTheirArea) {
  const Tissue disk = hexagon_disk(4, 2.5);
  expect_valid(disk);
  EXPECT_EQ(disk.cells(), 61);
  int inner = 0;
  for (Index c = 0; c < disk.cells(); ++c) {
    EXPECT_NEAR(disk.area(c), 2.5, 1e-12);
    inner += disk.neighbours(c).size() == 6 ? 1 : 0;
  }
  EXPECT_EQ(inner, 37);
  expect_valid(hexagons(5, 4));
}

TEST(Builders, RowsAreInsertedWithTheMeanOfTheirNeighbours) {
  Tissue tube = cylinder(5, 3);
  Column& a = declare(tube, Kind::cell, "a", 0, Inherit::copy);
  Column& w = declare(tube, Kind::wall, "w", 0, Inherit::copy);
  Column& p = declare(tube, Kind::side, "p", 0, Inherit::copy);
  for (Index c = 0; c < tube.cells(); ++c) a.values[c] = c;
  for (Index i = 0; i < tube.walls(); ++i) w.values[i] = 7;
  for (Index i = 0; i < tube.sides(); ++i) p.values[i] = 3;
  insert_row(tube, 0);
  expect_valid(tube);
  ASSERT_EQ(tube.cells(), 20);
  for (Index c = 0; c < 5; ++c) {
    EXPECT_DOUBLE_EQ(a.values[c], c);
    EXPECT_DOUBLE_EQ(a.values[5 + c], c + 2.5);
    EXPECT_DOUBLE_EQ(a.values[10 + c], c + 5);
    EXPECT_DOUBLE_EQ(tube.column(Kind::cell, "row").values[10 + c], 2);
    EXPECT_EQ(tube.neighbours(5 + c), (std::vector<Index>{5 + (c + 1) % 5, 10 + c, 5 + (c + 4) % 5, c}));
    EXPECT_EQ(tube.neighbours(c), (std::vector<Index>{(c + 1) % 5, 5 + c, (c + 4) % 5}));
  }
  for (Index i = 0; i < tube.walls(); ++i) EXPECT_DOUBLE_EQ(w.values[i], 7);
  for (Index i = 0; i < tube.sides(); ++i) EXPECT_DOUBLE_EQ(p.values[i], 3);
  remove_last_row(tube);
  expect_valid(tube);
  EXPECT_EQ(tube.cells(), 15);
  EXPECT_ERROR(insert_row(tube, 2), "rows 0 to 1");
  Tissue flat = squares(2, 2);
  EXPECT_ERROR(insert_row(flat, 0), "without geometry");
  Tissue narrow = grid(2, 2);
  insert_row(narrow, 0);
  expect_valid(narrow);
  EXPECT_EQ(narrow.walls(), 7);
}

TEST(Builders, PolygonsAreWeldedAndTurned) {
  const Tissue two = polygons({{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}},  // clockwise
                               {{1 + 1e-12, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 0, 0}}});
  expect_valid(two);
  EXPECT_EQ(two.junctions(), 6);
  EXPECT_EQ(two.walls(), 7);
  EXPECT_DOUBLE_EQ(two.area(0), 1);
  EXPECT_EQ(two.neighbours(0), (std::vector<Index>{1}));
}

TEST(Builders, PolygonsThatTouchInAPointArePartedThere) {
  const Tissue two =
      polygons({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}});
  expect_valid(two);
  EXPECT_EQ(two.junctions(), 8);
  EXPECT_EQ(components(two).size(), 2u);
}

TEST(Builders, RefuseBadPolygons) {
  EXPECT_ERROR(polygons({{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}}), "crosses");
  EXPECT_ERROR(polygons({{{0, 0, 0}, {1, 0, 0}}}), "at least 3");
  EXPECT_ERROR(polygons({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}), "polygon 1");
  EXPECT_ERROR(polygons({{{0, 0, 0}, {1, 0, 0}, {NAN, 1, 0}}}), "polygon 1");
  EXPECT_ERROR(polygons({{{0, 0, 0}, {1, 0, 0}, {1e300, 1, 0}}}), "tolerance");
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_ERROR(polygons({square, square}), "overlap");
  EXPECT_ERROR(assemble({{0, 0, 0}}, {{0, 1, 2}}), "there are 1 points");
}

TEST(Builders, RemovalOfCellsKeepsEveryInvariant) {
  for (const uint64_t seed : {1, 2, 3}) {
    testing::Dice dice(seed);
    Tissue tissues[] = {squares(7, 7), hexagon_disk(3), grid(6, 5), cylinder(6, 5)};
    for (Tissue& tissue : tissues) {
      while (tissue.cells() > 0) {
        const Index cell = dice.below(tissue.cells());
        const Id id = tissue.id(Kind::cell, cell);
        remove_cell(tissue, cell);
        expect_valid(tissue);
        EXPECT_EQ(tissue.find(Kind::cell, id), none);
        EXPECT_EQ(tissue.fate(Kind::cell, id), "was removed");
      }
      EXPECT_EQ(tissue.walls() + tissue.sides() + tissue.junctions(), 0);
    }
  }
}

TEST(Graph, SpliceAndNeighboursAsInVV) {
  Tissue graph = ring(4);
  const Index fresh = add_cell(graph);
  EXPECT_TRUE(graph.neighbours(fresh).empty());
  join(graph, 0, fresh, {Place::after, 1});
  EXPECT_EQ(graph.neighbours(0), (std::vector<Index>{1, fresh, 3}));
  expect_valid(graph);
  join(graph, 2, fresh, {Place::before, 3}, {Place::before, 0});
  EXPECT_EQ(graph.neighbours(2), (std::vector<Index>{fresh, 3, 1}));
  EXPECT_EQ(graph.neighbours(fresh), (std::vector<Index>{2, 0}));
  EXPECT_EQ(next_to(graph, 0, 1), fresh);
  EXPECT_EQ(previous_to(graph, 0, 1), 3);
  set_neighbours(graph, 0, {3, 2, 1});
  expect_valid(graph);
  EXPECT_EQ(graph.neighbours(0), (std::vector<Index>{3, 2, 1}));
  EXPECT_EQ(graph.neighbours(2), (std::vector<Index>{fresh, 3, 1, 0}));
  separate(graph, 0, 2);
  EXPECT_EQ(neighbour_ids(graph, 0), (std::vector<Id>{4, 2}));
  set_neighbours(graph, 0, {});
  EXPECT_EQ(graph.side_count(0), 0);
  expect_valid(graph);
  EXPECT_ERROR(join(graph, 1, 1), "its own neighbour");
  EXPECT_ERROR(join(graph, 1, 2), "already");
  EXPECT_ERROR(separate(graph, 0, 1), "not neighbours");
  EXPECT_ERROR(next_to(graph, 1, 0), "not a neighbour");
  EXPECT_ERROR(join(graph, 0, 1, {Place::after, 3}), "not a neighbour");
  EXPECT_ERROR(set_neighbours(graph, 1, {2, 2}), "twice");
  Tissue flat = squares(2, 2);
  EXPECT_ERROR(join(flat, 0, 3), "without geometry");
}

TEST(Graph, ALockedTissueKeepsItsStructure) {
  Tissue graph = ring(4);
  graph.lock(true);
  EXPECT_ERROR(add_cell(graph), "while rules run");
  EXPECT_ERROR(remove_cell(graph, 0), "while rules run");
  graph.lock(false);
  remove_cell(graph, 0);
  EXPECT_EQ(graph.cells(), 3);
}

TEST(Sheet, HasExactlyTheCellsAskedForAndIsReproducible) {
  for (const int64_t n : {1, 2, 17, 200}) {
    const Tissue a = sheet({.cells = n});
    expect_valid(a);
    EXPECT_EQ(a.cells(), n);
    EXPECT_EQ(a.hash(), sheet({.cells = n}).hash());
  }
  EXPECT_NE(sheet({.cells = 200, .seed = 2}).hash(), sheet({.cells = 200}).hash());
  CancelFlag stop;
  stop.request();
  EXPECT_THROW(sheet({.cells = 100, .cancel = &stop}), Cancelled);
}

}  // namespace
}  // namespace tunica
