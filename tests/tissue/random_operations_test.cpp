// SPDX-License-Identifier: MIT
#include <cmath>

#include "tissue/builders.h"
#include "tissue/division.h"
#include "tissue/fixtures.h"
#include "tissue/order.h"
#include "tissue/topology.h"

namespace tunica {
namespace {

using testing::declare;
using testing::Dice;

std::vector<Index> shuffled(Index n, Dice& dice) {
  std::vector<Index> order;
  for (Index i = 0; i < n; ++i) order.push_back(i);
  for (Index i = n; i-- > 1;) std::swap(order[static_cast<size_t>(i)], order[static_cast<size_t>(dice.below(i + 1))]);
  return order;
}

void save_and_load(Tissue& tissue) {
  ByteWriter out;
  tissue.save(out);
  const std::string before = tissue.hash();
  ByteReader in(out.bytes());
  tissue.load(in);
  ASSERT_EQ(tissue.hash(), before);
}

Vec3 random_point(const Tissue& tissue, Index cell, Dice& dice) {
  const double size = std::sqrt(std::abs(tissue.area(cell)));
  return tissue.centroid(cell) + Vec3(dice.between(-1, 1) * size, dice.between(-1, 1) * size, 0);
}

void change_sheet(Tissue& tissue, Dice& dice) {
  const Index cell = dice.below(tissue.cells());
  const DivisionSettings settings{.gap = dice.between(-.1, .2), .pinch = dice.between(0, .3)};
  switch (dice.below(9)) {
    case 0:
    case 1:
      divide(tissue, cell, errera, settings);
      break;
    case 2:
      divide(tissue, cell, closest_wall, settings);
      break;
    case 3:
      divide(tissue, cell, along({dice.between(-1, 1), dice.between(-1, 1), 0}), settings);
      break;
    case 4:
      divide(tissue, cell,
             cut_between(tissue, cell, random_point(tissue, cell, dice), random_point(tissue, cell, dice)), settings);
      break;
    case 5:
      if (tissue.cells() > 3) remove_cell(tissue, cell);
      break;
    case 6: {
      std::vector<Vec3> positions;
      for (Index j = 0; j < tissue.junctions(); ++j)
        positions.push_back(tissue.position(j) + Vec3(dice.between(-.03, .03), dice.between(-.03, .03), 0));
      move_junctions(tissue, positions);
      break;
    }
    case 7:
      renumber(tissue, shuffled(tissue.cells(), dice));
      break;
    default:
      save_and_load(tissue);
  }
  while (tissue.cells() > 50) remove_cell(tissue, dice.below(tissue.cells()));
}

void change_graph(Tissue& graph, Dice& dice) {
  const Index a = dice.below(graph.cells()), b = dice.below(graph.cells());
  switch (dice.below(8)) {
    case 0:
      add_cell(graph);
      break;
    case 1:
      join(graph, a, b, {static_cast<Place::Where>(dice.below(3)), dice.below(graph.cells())});
      break;
    case 2:
      separate(graph, a, b);
      break;
    case 3: {
      std::vector<Index> neighbours;
      for (Index i = 0; i < 4; ++i) neighbours.push_back(dice.below(graph.cells()));
      set_neighbours(graph, a, neighbours);
      break;
    }
    case 4:
      if (graph.cells() > 3) remove_cell(graph, a);
      break;
    case 5:
      insert_row(graph, dice.below(5));
      break;
    case 6:
      renumber(graph, shuffled(graph.cells(), dice));
      break;
    default:
      save_and_load(graph);
  }
  while (graph.cells() > 50) remove_cell(graph, dice.below(graph.cells()));
}

/// Any sequence of operations, possible and impossible ones, leaves a valid tissue; a refused one leaves it as it was.
template <class Change>
void run(Tissue tissue, uint64_t seed, Change&& change) {
  Dice dice(seed);
  declare(tissue, Kind::cell, "amount", 1, Inherit::split);
  declare(tissue, Kind::wall, "w", 2, Inherit::copy);
  declare(tissue, Kind::side, "s", 3, Inherit::reset);
  declare(tissue, Kind::junction, "j", 4, Inherit::copy);
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    const std::string before = tissue.hash();
    try {
      change(tissue, dice);
    } catch (const Error&) {
      ++refused;
      ASSERT_EQ(tissue.hash(), before) << "seed " << seed << ", operation " << i;
    }
    const std::vector<std::string> problems = find_problems(tissue);
    ASSERT_TRUE(problems.empty()) << "seed " << seed << ", operation " << i << ": " << problems[0];
  }
  EXPECT_LT(refused, 400);
}

TEST(RandomOperations, LeaveAValidSheet) {
  for (uint64_t seed = 1; seed <= 20; ++seed) run(sheet({.cells = 12, .seed = seed}), seed, change_sheet);
}

TEST(RandomOperations, LeaveAValidGraph) {
  for (uint64_t seed = 1; seed <= 20; ++seed) run(cylinder(4, 4, seed), seed, change_graph);
}

}  // namespace
}  // namespace tunica
