// SPDX-License-Identifier: MIT
#include "rule/layout.h"

#include <algorithm>
#include <utility>

namespace tunica {

Layout::Layout(const Tissue& tissue)
    : cells(tissue.cells()), blocks((cells + block_size - 1) / block_size), edges(0), walls(0) {
  neighbour_count.resize(static_cast<size_t>(blocks) * block_size);
  position.reserve(cells);
  run_begin.reserve(blocks + 1);
  edge_begin.reserve(blocks + 1);
  for (auto* v : {&own, &across, &wall, &side, &mirror}) v->reserve(tissue.sides());

  std::vector<int> count(block_size);
  std::vector<std::vector<uint8_t>> by_count;
  for (Index block = 0; block < blocks; ++block) {
    const Index first = block * block_size, last = std::min(cells, first + block_size);
    run_begin.push_back(static_cast<int32_t>(runs.size()));
    edge_begin.push_back(static_cast<int32_t>(own.size()));
    for (auto& bucket : by_count) bucket.clear();
    for (Index cell = first; cell < last; ++cell) {
      size_t n = 0;
      const Index start = tissue.first_side(cell);
      Index s = start;
      if (s != none) do {
          n += tissue.neighbour(s) != none;
          s = tissue.next(s);
        } while (s != start);
      if (by_count.size() <= n) by_count.resize(n + 1);
      if (n > UINT16_MAX) fail("a cell has {} neighbours; the limit is {}", n, UINT16_MAX);
      by_count[n].push_back(static_cast<uint8_t>(cell - first));
      neighbour_count.data()[cell] = static_cast<double>(n);
    }
    for (size_t n = 0; n < by_count.size(); ++n) {
      if (by_count[n].empty()) continue;
      for (const uint8_t place : by_count[n]) {
        position.push_back(place);
        const Index cell = first + place, start = tissue.first_side(cell);
        Index s = start;
        if (s != none) do {
            const Index other = tissue.opposite(s);
            if (other != none) {
              own.push_back(cell);
              across.push_back(tissue.cell_of(other));
              wall.push_back(tissue.wall_of(s));
              side.push_back(s);
              mirror.push_back(other);
            }
            s = tissue.next(s);
          } while (s != start);
      }
      add_runs(static_cast<int>(n), static_cast<int>(by_count[n].size()));
    }
  }
  run_begin.push_back(static_cast<int32_t>(runs.size()));
  edges = static_cast<Index>(own.size());
  edge_begin.push_back(edges);

  std::vector<int32_t> place(tissue.walls(), -1);
  for (Index e = 0; e < edges; ++e) {
    if (tissue.wall_side(wall[e], 0) != side[e]) continue;
    place[wall[e]] = static_cast<int32_t>(primary.size());
    primary.push_back(e);
  }
  walls = static_cast<Index>(primary.size());
  wall_stride = padded_to_blocks(walls);
  signed_wall.resize(edges);
  for (Index e = 0; e < edges; ++e)
    signed_wall[e] = place[wall[e]] + (tissue.wall_side(wall[e], 0) == side[e] ? 0 : wall_stride);
}

/// The last `count` cells laid out, as runs: stretches of a grid on their own, where long enough.
void Layout::add_runs(int neighbours, int count) {
  const uint8_t* place = position.data() + position.size() - count;
  const int32_t* to = across.data() + across.size() - static_cast<size_t>(count) * neighbours;
  const auto follows = [&](int i) {
    bool one_on = place[i] == place[i - 1] + 1;
    for (int q = 0; q < neighbours; ++q) one_on &= to[i * neighbours + q] == to[(i - 1) * neighbours + q] + 1;
    return one_on;
  };
  const auto add = [&](int length, bool consecutive) {
    if (length > 0) runs.push_back({static_cast<uint16_t>(neighbours), static_cast<uint16_t>(length), consecutive});
  };
  int waiting = 0;
  for (int i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && follows(end);) ++end;
    if (neighbours == 0 || end - i < min_consecutive) {
      waiting += end - i;
      continue;
    }
    add(std::exchange(waiting, 0), false);
    add(end - i, true);
  }
  add(waiting, false);
}

LayoutView Layout::view() const {
  return {position.data(), runs.data(), run_begin.data(), edge_begin.data(), across.data(), signed_wall.data()};
}

}  // namespace tunica
