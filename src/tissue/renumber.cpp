// SPDX-License-Identifier: MIT
#include <algorithm>

#include "base/error.h"
#include "tissue/topology.h"

namespace tunica {

namespace {

/// Puts `width` values per element into the new order, by way of `scratch`, which many columns may share.
template <class T>
void permute(T* values, const std::vector<Index>& order, std::vector<T>& scratch, size_t width = 1) {
  scratch.resize(order.size() * width);
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t k = 0; k < width; ++k) scratch[i * width + k] = values[static_cast<size_t>(order[i]) * width + k];
  std::copy(scratch.begin(), scratch.end(), values);
}

template <class T>
void permute(std::vector<T>& values, const std::vector<Index>& order, size_t width = 1) {
  std::vector<T> scratch;
  permute(values.data(), order, scratch, width);
}

void rename(Index& reference, const std::vector<Index>& place) {
  if (reference != none) reference = place[static_cast<size_t>(reference)];
}

/// place[old] = new. Errors: not a permutation.
std::vector<Index> inverse(const std::vector<Index>& order, Index count) {
  std::vector<Index> place(static_cast<size_t>(count), none);
  if (order.size() != place.size()) fail("a new order must name all {} elements, not {}", count, order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    if (order[i] < 0 || order[i] >= count || place[static_cast<size_t>(order[i])] != none)
      fail("a new order must name every element once; place {} does not", i + 1);
    place[static_cast<size_t>(order[i])] = static_cast<Index>(i);
  }
  return place;
}

}  // namespace

void TissueEditor::renumber(Kind kind, const std::vector<Index>& order) {
  const std::vector<Index> place = inverse(order, t_.count(kind));
  auto& ids = t_.ids_[static_cast<int>(kind)];
  permute(ids, order);
  for (size_t i = 0; i < ids.size(); ++i) t_.index_of_[static_cast<int>(kind)][ids[i]] = static_cast<int64_t>(i);
  std::vector<double> scratch;
  for (const auto& column : t_.columns_[static_cast<int>(kind)]) permute(column->values.data(), order, scratch);
  switch (kind) {
    case Kind::cell:
      permute(t_.cell_side_, order);
      for (auto& side : t_.side_) rename(side.cell, place);
      break;
    case Kind::wall:
      permute(t_.wall_side_, order, 2);
      for (auto& side : t_.side_) rename(side.wall, place);
      break;
    case Kind::side:
      permute(t_.side_, order);
      for (auto& side : t_.side_) {
        rename(side.next, place);
        rename(side.previous, place);
      }
      for (auto* array : {&t_.cell_side_, &t_.wall_side_, &t_.junction_side_})
        for (Index& side : *array) rename(side, place);
      break;
    case Kind::junction:
      permute(t_.junction_side_, order);
      permute(t_.position_, order);
      for (auto& side : t_.side_) rename(side.start, place);
      break;
  }
}

void TissueEditor::separate_fans() {
  std::vector<char> seen(static_cast<size_t>(t_.sides()), 0);
  std::vector<char> taken(static_cast<size_t>(t_.junctions()), 0);
  const Index sides = t_.sides();
  for (Index side = 0; side < sides; ++side) {
    if (seen[static_cast<size_t>(side)]) continue;
    const Index junction = t_.side_[side].start;
    t_.junction_side_[junction] = side;
    const std::vector<Index> fan = sides_at(t_, junction);
    for (const Index s : fan) seen[static_cast<size_t>(s)] = 1;
    if (taken[static_cast<size_t>(junction)]) {
      give_own_junction(fan[0]);
    } else {
      taken[static_cast<size_t>(junction)] = 1;
    }
    t_.junction_side_[t_.side_[fan[0]].start] = fan[0];
  }
  // A junction shared by several fans may have been left pointing at a side that has a junction of its own now.
  for (Index side = sides - 1; side >= 0; --side) t_.junction_side_[t_.side_[side].start] = side;
}

}  // namespace tunica
