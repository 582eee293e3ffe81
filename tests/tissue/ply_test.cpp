// SPDX-License-Identifier: MIT
#include "tissue/ply.h"

#include <cmath>
#include <map>

#include "tissue/division.h"
#include "tissue/fixtures.h"
#include "tissue/statistics.h"

namespace tunica {
namespace {

using testing::expect_valid;

std::string three_cells() { return testing::content_of(testing::repository() / "tests" / "data" / "three_cells.ply"); }

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST(Ply, ReadsACellMesh) {
  const Tissue traced = read_ply(three_cells(), PlyWalls::traced);
  expect_valid(traced);
  ASSERT_EQ(traced.cells(), 3);
  EXPECT_EQ(traced.junctions(), 9);
  EXPECT_EQ(traced.find_column(Kind::cell, "label")->values[2], 5);
  EXPECT_NEAR(traced.area(0), 1.05, 1e-12);
  EXPECT_NEAR(traced.area(2), 2, 1e-12);
  EXPECT_EQ(traced.neighbours(0).size(), 2u);
  const Tissue straight = read_ply(three_cells());
  expect_valid(straight);
  EXPECT_EQ(straight.junctions(), 8);  // the bend in the inner wall goes, corners of the border stay
  EXPECT_NEAR(straight.area(0), 1, 1e-12);
  EXPECT_NEAR(straight.area(2), 2, 1e-12);
}

TEST(Ply, SaysWhatIsWrongAndWhere) {
  const std::string good = three_cells();
  EXPECT_ERROR(read_ply(""), "line 1");
  EXPECT_ERROR(read_ply("plyx\n"), "not a PLY file");
  EXPECT_ERROR(read_ply(replaced(good, "ascii", "binary_little_endian")), "only ascii");
  EXPECT_ERROR(read_ply(replaced(good, "element vertex 12", "element vertex 99999999999")), "line 4");
  EXPECT_ERROR(read_ply(replaced(good, "element vertex 12", "element vertex -1")), "line 4");
  EXPECT_ERROR(read_ply(replaced(good, "element vertex 12", "element vertex 11")), "line 27");
  EXPECT_ERROR(read_ply(replaced(good, "1.1 0.5", "nan 0.5")), "'nan' is not a number");
  EXPECT_ERROR(read_ply(replaced(good, "1.1 0.5", "1e400 0.5")), "not a number");
  EXPECT_ERROR(read_ply(replaced(good, "3 0 3 4 1", "3 0 3 44 1")), "vertex 44 does not exist");
  EXPECT_ERROR(read_ply(replaced(good, "3 0 3 4 1", "4 0 3 4 1")), "triangles are expected");
  EXPECT_ERROR(read_ply(replaced(good, "3 0 3 4 1", "3 0 3 3 1")), "same vertex twice");
  EXPECT_ERROR(read_ply(replaced(good, "3 0 3 4 1", "3 0 4 3 1")), "cell 1");
  EXPECT_ERROR(read_ply(replaced(good, "3 0 3 4 1", "3 0 3 4 2")), "cell");
  EXPECT_ERROR(read_ply(replaced(good, "property int label\nend_header", "end_header")), "a label");
  for (size_t size = 0; size < good.size() - 1; size += 3) {
    try {
      read_ply(good.substr(0, size));
      ADD_FAILURE() << "accepted a file cut at " << size;
    } catch (const Error&) {
    }
  }
}

TEST(Ply, HostileFilesAreValidOrRefused) {
  const std::string good = three_cells();
  const std::string alphabet = "0129-. e\nxp";
  testing::Dice dice(5);
  int accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bad = good;
    for (int k = 0; k <= round % 3; ++k)
      bad[static_cast<size_t>(dice.below(static_cast<Index>(bad.size())))] =
          alphabet[static_cast<size_t>(dice.below(static_cast<Index>(alphabet.size())))];
    for (const PlyWalls walls : {PlyWalls::straight, PlyWalls::traced}) {
      try {
        const Tissue tissue = read_ply(bad, walls);
        expect_valid(tissue);
        ++accepted;
      } catch (const Error&) {
      }
    }
  }
  EXPECT_GT(accepted, 100);
}

class Apex : public ::testing::TestWithParam<const char*> {};

TEST_P(Apex, IsReadWithTheAreasAndNeighboursOfItsOwnGraph) {
  const std::string mesh = testing::outside_data("apex/mesh_meristem_full_" + std::string(GetParam()) + ".ply");
  const std::string cells = testing::outside_data("apex/cellGraph_meristem_full_" + std::string(GetParam()) + ".ply");
  if (mesh.empty() || cells.empty()) GTEST_SKIP() << "the apex data set is not here (TUNICA_DATA)";
  const CellGraph graph = read_cell_graph(cells);
  for (const PlyWalls walls : {PlyWalls::traced, PlyWalls::straight}) {
    Tissue tissue = read_ply(mesh, walls);
    expect_valid(tissue);
    ASSERT_EQ(components(tissue).size(), 1u);
    EXPECT_EQ(components(tissue)[0].euler(), 1);
    const Column& label = tissue.column(Kind::cell, "label");
    std::map<int64_t, Index> cell_of;
    std::vector<std::pair<int64_t, int64_t>> edges;
    for (Index c = 0; c < tissue.cells(); ++c) {
      const auto own = static_cast<int64_t>(label.values[c]);
      cell_of[own] = c;
      for (const Index n : tissue.neighbours(c))
        if (const auto other = static_cast<int64_t>(label.values[n]); own < other) edges.emplace_back(own, other);
    }
    std::sort(edges.begin(), edges.end());
    EXPECT_EQ(edges, graph.edges);
    ASSERT_EQ(cell_of.size(), graph.labels.size());
    for (size_t i = 0; i < graph.labels.size(); ++i) {
      const Index c = cell_of.at(graph.labels[i]);
      const bool traced = walls == PlyWalls::traced;
      EXPECT_NEAR(tissue.area(c) / graph.areas[i], 1, traced ? 1e-5 : .35);
      EXPECT_LT((tissue.centroid(c) - graph.centres[i]).norm(), traced ? 2e-4 : 1);
    }
    // It can go on living: every cell divides once, and the surface stays one.
    const Index before = tissue.cells();
    for (Index c = 0; c < before; ++c) divide(tissue, c, errera);
    expect_valid(tissue);
    EXPECT_EQ(tissue.cells(), 2 * before);
  }
}

INSTANTIATE_TEST_SUITE_P(Times, Apex, ::testing::Values("T0", "T12h"));

TEST(ApexStatistics, AreThePublishedOnes) {
  const std::string mesh = testing::outside_data("apex/mesh_meristem_full_T0.ply");
  if (mesh.empty()) GTEST_SKIP() << "the apex data set is not here (TUNICA_DATA)";
  const CellStatistics s = cell_statistics(read_ply(mesh, PlyWalls::traced));
  EXPECT_EQ(s.interior, 299);
  EXPECT_NEAR(100 * s.shares[5], 25.4, .05);
  EXPECT_NEAR(100 * s.shares[6], 39.1, .05);
  EXPECT_NEAR(100 * s.shares[7], 25.8, .05);
  EXPECT_NEAR(s.area_cv, .273, .0005);
  EXPECT_NEAR(s.mean_sides, 5.967, .0005);
  EXPECT_NEAR(s.variance_sides, .915, .0005);
  EXPECT_NEAR(s.mean_area, 23.8, .05);
}

}  // namespace
}  // namespace tunica
