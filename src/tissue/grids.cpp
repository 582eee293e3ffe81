// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/error.h"
#include "tissue/builders.h"
#include "tissue/order.h"
#include "tissue/topology.h"

namespace tunica {

namespace {

void require_size(int64_t n, int64_t least, const char* what) {
  if (n < least) fail("{} must be at least {}, not {}", what, least, n);
  if (n > 4'000'000) fail("{} must be at most 4000000, not {}", what, n);
}

Tissue build_grid(int64_t nx, int64_t ny, bool wrap_x, bool wrap_y, uint64_t seed, const CancelFlag* cancel) {
  if (nx * ny > 4'000'000) fail("a grid can have at most 4000000 cells, not {}", nx * ny);
  Tissue tissue(false, seed);
  TissueEditor editor(tissue);
  const Index columns = static_cast<Index>(nx), rows = static_cast<Index>(ny), cells = columns * rows;
  for (Index i = 0; i < cells; ++i) {
    poll(cancel);
    editor.set_place(editor.add_cell(), i / columns, i % columns);
  }
  // Walls first, each as the cell meets it (next column, next row), then sides cell by cell in cyclic order.
  std::vector<std::array<Index, 2>> wall_of(static_cast<size_t>(cells), {none, none});
  for (Index i = 0; i < cells; ++i) {
    poll(cancel);
    if (i % columns + 1 < columns || wrap_x) wall_of[static_cast<size_t>(i)][0] = editor.add_wall();
    if (i / columns + 1 < rows || wrap_y) wall_of[static_cast<size_t>(i)][1] = editor.add_wall();
  }
  for (Index i = 0; i < cells; ++i) {
    poll(cancel);
    const Index row = i / columns, column = i % columns;
    const Index west = row * columns + (column + columns - 1) % columns;
    const Index south = (row + rows - 1) % rows * columns + column;
    const Index around[4] = {wall_of[static_cast<size_t>(i)][0], wall_of[static_cast<size_t>(i)][1],
                             column > 0 || wrap_x ? wall_of[static_cast<size_t>(west)][0] : none,
                             row > 0 || wrap_y ? wall_of[static_cast<size_t>(south)][1] : none};
    for (const Index wall : around)
      if (wall != none) editor.add_side(i, wall);
  }
  return tissue;
}

}  // namespace

Tissue line(int64_t n, uint64_t seed, const CancelFlag* cancel) {
  require_size(n, 1, "the number of cells in a line");
  return build_grid(n, 1, false, false, seed, cancel);
}

Tissue ring(int64_t n, uint64_t seed, const CancelFlag* cancel) {
  require_size(n, 3, "the number of cells in a ring");
  return build_grid(n, 1, true, false, seed, cancel);
}

Tissue grid(int64_t nx, int64_t ny, Wrap wrap, uint64_t seed, const CancelFlag* cancel) {
  require_size(nx, wrap == Wrap::open ? 1 : 3, "the number of columns of a grid");
  require_size(ny, wrap == Wrap::both ? 3 : 1, "the number of rows of a grid");
  return build_grid(nx, ny, wrap != Wrap::open, wrap == Wrap::both, seed, cancel);
}

Tissue cylinder(int64_t around, int64_t rows, uint64_t seed, const CancelFlag* cancel) {
  require_size(around, 3, "the number of cells around a cylinder");
  require_size(rows, 1, "the number of rows of a cylinder");
  return build_grid(around, rows, true, false, seed, cancel);
}

// === Rows

namespace {

using Places = std::map<std::pair<int64_t, int64_t>, Index>;  // (row, column) -> cell

int64_t place(const Tissue& graph, const char* which, Index cell) {
  return static_cast<int64_t>(graph.find_column(Kind::cell, which)->values[static_cast<size_t>(cell)]);
}

std::vector<Index> row_of(const Tissue& graph, int64_t row) {
  std::vector<Index> cells;
  for (Index c = 0; c < graph.cells(); ++c)
    if (place(graph, "row", c) == row) cells.push_back(c);
  std::sort(cells.begin(), cells.end(), [&](Index a, Index b) {
    return std::pair(place(graph, "column", a), a) < std::pair(place(graph, "column", b), b);
  });
  return cells;
}

int64_t last_row(const Tissue& graph) {
  if (graph.has_geometry()) fail("rows are for tissues without geometry (grid, cylinder)");
  if (graph.cells() == 0) fail("the tissue has no cells, so no rows");
  int64_t last = 0;
  for (Index c = 0; c < graph.cells(); ++c) last = std::max(last, place(graph, "row", c));
  return last;
}

void set_mean(Tissue& graph, Kind kind, Index target, Index a, Index b) {
  for (const auto& column : graph.columns(kind))
    if (!column->geometric)
      column->values[static_cast<size_t>(target)] =
          (column->values[static_cast<size_t>(a)] + column->values[static_cast<size_t>(b)]) / 2;
}

std::vector<double> values_of(const Tissue& graph, Kind kind, Index element) {
  std::vector<double> values;
  for (const auto& column : graph.columns(kind)) values.push_back(column->values[static_cast<size_t>(element)]);
  return values;
}

void set_values(Tissue& graph, Kind kind, Index element, const std::vector<double>& values) {
  for (size_t i = 0; i < values.size(); ++i) graph.columns(kind)[i]->values[static_cast<size_t>(element)] = values[i];
}

/// Puts cell `n` between neighbours a and b of consecutive rows. New walls and sides take the places and values of the
/// old; the new cell's two sides get those of the sides they look along with.
void put_between(Tissue& graph, TissueEditor& editor, Index a, Index n, Index b) {
  const Index side_a = side_between(graph, a, b), side_b = graph.opposite(side_a), wall = graph.wall_of(side_a);
  const auto from_a = values_of(graph, Kind::side, side_a), from_b = values_of(graph, Kind::side, side_b);
  const auto of_wall = values_of(graph, Kind::wall, wall);
  const bool lead_a = graph.first_side(a) == side_a, lead_b = graph.first_side(b) == side_b;
  const Index upper = editor.add_wall(), lower = editor.add_wall();
  const Index in_a = editor.add_side(a, upper, none, side_a, lead_a);
  const Index to_b = editor.add_side(n, lower), to_a = editor.add_side(n, upper);
  const Index in_b = editor.add_side(b, lower, none, side_b, lead_b);
  for (const Index w : {upper, lower}) set_values(graph, Kind::wall, w, of_wall);
  for (const Index s : {in_a, to_b}) set_values(graph, Kind::side, s, from_a);
  for (const Index s : {in_b, to_a}) set_values(graph, Kind::side, s, from_b);
  editor.remove_wall(wall);
}

}  // namespace

void insert_row(Tissue& graph, int64_t at) {
  const int64_t last = last_row(graph);
  if (at < 0 || at >= last) fail("a row can be inserted after rows 0 to {}, not after {}", last - 1, at);
  const std::vector<Index> before = row_of(graph, at), after = row_of(graph, at + 1);
  if (before.size() != after.size()) fail("rows {} and {} have not the same number of cells", at, at + 1);
  const size_t width = before.size();
  for (size_t i = 0; i < width; ++i)
    if (side_between(graph, before[i], after[i]) == none)
      fail("cells {} and {} of rows {} and {} are not neighbours", graph.id(Kind::cell, before[i]),
           graph.id(Kind::cell, after[i]), at, at + 1);
  TissueEditor editor(graph);
  editor.require_room(Kind::side, 6 * width);
  std::vector<Index> fresh(width);
  for (size_t i = 0; i < width; ++i) {
    fresh[i] = editor.add_cell();
    set_mean(graph, Kind::cell, fresh[i], before[i], after[i]);
  }
  // Cycle of a new cell: next column, next row, previous column, previous row. First the walls between the rows.
  for (size_t i = 0; i < width; ++i) put_between(graph, editor, before[i], fresh[i], after[i]);
  for (size_t i = 0; i < width; ++i) {
    const size_t j = (i + 1) % width;
    const Index old_a = side_between(graph, before[i], before[j]), old_b = side_between(graph, after[i], after[j]);
    const bool again = i == j || (width == 2 && i == 1);
    if (again || old_a == none || old_b == none) continue;  // no wall along the row here
    const Index wall = editor.add_wall();
    const Index to_next = editor.add_side(fresh[i], wall, none, graph.first_side(fresh[i]), true);
    const Index to_a = side_between(graph, fresh[j], before[j]);
    const Index to_previous = editor.add_side(fresh[j], wall, none, to_a);
    set_mean(graph, Kind::wall, wall, graph.wall_of(old_a), graph.wall_of(old_b));
    set_mean(graph, Kind::side, to_next, old_a, old_b);
    set_mean(graph, Kind::side, to_previous, graph.opposite(old_a), graph.opposite(old_b));
  }
  Column& rows = graph.column(Kind::cell, "row");
  const std::vector<double> columns = [&] {
    std::vector<double> values;
    for (const Index c : before) values.push_back(graph.column(Kind::cell, "column").values[static_cast<size_t>(c)]);
    return values;
  }();
  for (Index c = 0; c < graph.cells(); ++c)
    if (rows.values[static_cast<size_t>(c)] > static_cast<double>(at)) rows.values[static_cast<size_t>(c)] += 1;
  for (size_t i = 0; i < width; ++i) editor.set_place(fresh[i], static_cast<double>(at + 1), columns[i]);
  std::vector<Index> order(static_cast<size_t>(graph.cells()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::pair(place(graph, "row", a), place(graph, "column", a)) <
           std::pair(place(graph, "row", b), place(graph, "column", b));
  });
  renumber(graph, order);
}

void remove_last_row(Tissue& graph) {
  const int64_t last = last_row(graph);
  if (last == 0) fail("the only row of a tissue cannot be removed");
  std::vector<Index> cells = row_of(graph, last);
  std::sort(cells.begin(), cells.end(), std::greater<>());
  TissueEditor editor(graph);
  for (const Index cell : cells) editor.remove_cell(cell);
}

}  // namespace tunica
