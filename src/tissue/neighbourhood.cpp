// SPDX-License-Identifier: MIT
#include <algorithm>

#include "base/error.h"
#include "tissue/topology.h"

namespace tunica {

Index first_side_at(const Tissue& tissue, Index junction) {
  const Index some = tissue.junction_side(junction);
  if (some == none) return none;
  // Clockwise as far as the border, if there is one. The bound keeps damaged structures from turning for ever.
  Index first = some;
  for (Index turns = 0; turns < tissue.sides(); ++turns) {
    const Index across = tissue.opposite(first);
    if (across == none) break;
    first = tissue.next(across);
    if (first == some) break;
  }
  return first;
}

std::vector<Index> sides_at(const Tissue& tissue, Index junction) {
  std::vector<Index> result;
  const Index first = first_side_at(tissue, junction);
  if (first == none) return result;
  Index side = first;
  do {
    result.push_back(side);
    side = side_after(tissue, side);
  } while (side != none && side != first && result.size() < static_cast<size_t>(tissue.sides()));
  return result;
}

int degree(const Tissue& tissue, Index junction) {
  const std::vector<Index> sides = sides_at(tissue, junction);
  if (sides.empty()) return 0;
  const bool border = side_after(tissue, sides.back()) == none;
  return static_cast<int>(sides.size()) + (border ? 1 : 0);
}

Index side_between(const Tissue& tissue, Index a, Index b) {
  const Index first = tissue.first_side(a);
  if (first == none) return none;
  Index side = first;
  do {
    if (tissue.neighbour(side) == b) return side;
    side = tissue.next(side);
  } while (side != first);
  return none;
}

namespace {

std::string named(const Tissue& tissue, Index cell) { return fmt::format("cell {}", tissue.id(Kind::cell, cell)); }

Index step_in_cycle(const Tissue& tissue, Index cell, Index n, bool forward) {
  std::vector<Index> cycle = tissue.neighbours(cell);
  const auto here = std::find(cycle.begin(), cycle.end(), n);
  if (here == cycle.end()) fail("{} is not a neighbour of {}", named(tissue, n), named(tissue, cell));
  const size_t i = static_cast<size_t>(here - cycle.begin()), size = cycle.size();
  return cycle[(i + (forward ? 1 : size - 1)) % size];
}

void require_graph(const Tissue& tissue, const char* operation) {
  if (tissue.has_geometry())
    fail("{} works on a tissue without geometry (line, ring, grid, cylinder): here the walls are what makes neighbours",
         operation);
}

/// The side of `cell` before which a new side comes, for add_side.
Index place_before(const Tissue& graph, Index cell, const Place& place) {
  if (place.where == Place::last) return none;
  const Index side = place.neighbour == none ? none : side_between(graph, cell, place.neighbour);
  if (side == none) {
    if (place.neighbour == none) fail("a place after or before a neighbour needs the neighbour");
    fail("{} is not a neighbour of {}", named(graph, place.neighbour), named(graph, cell));
  }
  return place.where == Place::before ? side : graph.next(side);
}

}  // namespace

Index next_to(const Tissue& tissue, Index cell, Index n) { return step_in_cycle(tissue, cell, n, true); }
Index previous_to(const Tissue& tissue, Index cell, Index n) { return step_in_cycle(tissue, cell, n, false); }

void remove_cell(Tissue& tissue, Index cell) { TissueEditor(tissue).remove_cell(cell); }

void remove_cells(Tissue& tissue, std::vector<Id> cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  for (const Id id : cells)
    if (tissue.find(Kind::cell, id) == none) fail("cell {} {}", id, tissue.fate(Kind::cell, id));
  if (cells.empty()) return;
  if (cells.size() == static_cast<size_t>(tissue.cells())) fail("the last cell of a tissue cannot be removed");
  TissueEditor editor(tissue);
  for (const Id id : cells) editor.remove_cell(tissue.find(Kind::cell, id));
}

Index add_cell(Tissue& graph) {
  require_graph(graph, "add a cell");
  return TissueEditor(graph).add_cell();
}

Index join(Tissue& graph, Index a, Index b, Place in_a, Place in_b) {
  require_graph(graph, "join");
  if (a == b) fail("{} cannot be its own neighbour", named(graph, a));
  if (side_between(graph, a, b) != none) fail("{} and {} are neighbours already", named(graph, a), named(graph, b));
  const Index before_a = place_before(graph, a, in_a), before_b = place_before(graph, b, in_b);
  TissueEditor editor(graph);
  editor.require_room(Kind::side, 2);
  const Index wall = editor.add_wall();
  // Before the first neighbour means first: only then does the cycle start at the new side.
  editor.add_side(a, wall, none, before_a, in_a.where == Place::before && before_a == graph.first_side(a));
  editor.add_side(b, wall, none, before_b, in_b.where == Place::before && before_b == graph.first_side(b));
  return wall;
}

void separate(Tissue& graph, Index a, Index b) {
  require_graph(graph, "separate");
  Index side = side_between(graph, a, b);
  if (side == none) fail("{} and {} are not neighbours", named(graph, a), named(graph, b));
  TissueEditor editor(graph);
  for (; side != none; side = side_between(graph, a, b)) editor.remove_wall(graph.wall_of(side));
}

void set_neighbours(Tissue& graph, Index cell, const std::vector<Index>& neighbours) {
  require_graph(graph, "set neighbours");
  std::vector<Index> sorted = neighbours;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    fail("a cell occurs twice among the neighbours of {}", named(graph, cell));
  if (std::binary_search(sorted.begin(), sorted.end(), cell))
    fail("{} cannot be its own neighbour", named(graph, cell));
  TissueEditor editor(graph);
  for (const Index n : graph.neighbours(cell))
    if (!std::binary_search(sorted.begin(), sorted.end(), n)) separate(graph, cell, n);
  std::vector<Index> order;
  for (const Index n : neighbours)
    if (side_between(graph, cell, n) == none) join(graph, cell, n);
  for (const Index n : neighbours) {
    const Index first = graph.first_side(cell);
    Index side = first;
    do {  // all walls shared with n, should there be several
      if (graph.neighbour(side) == n) order.push_back(side);
      side = graph.next(side);
    } while (side != first);
  }
  editor.set_order(cell, order);
}

}  // namespace tunica
