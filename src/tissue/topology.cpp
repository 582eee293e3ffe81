// SPDX-License-Identifier: MIT
#include "tissue/topology.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "tissue/polygon.h"

namespace tunica {

namespace {

constexpr int at(Kind kind) { return static_cast<int>(kind); }

std::pair<double, double> parts_of(const Column& column, double mother, double share) {
  if (column.geometric || column.inherit == Inherit::copy) return {mother, mother};
  if (column.inherit == Inherit::reset) return {column.initial, column.initial};
  if (column.inherit == Inherit::split) {
    const double first = mother * share;
    return {first, mother - first};
  }
  if (!column.rule)
    fail("column '{}' divides by a rule, and a saved tissue does not hold rules: declare the column again",
         column.name);
  return column.rule(mother, share);
}

}  // namespace

Parts parts_of(Tissue& tissue, Kind kind, Index element, double share) {
  const LockWhile foreign_code_runs(tissue);
  Parts parts;
  parts.reserve(tissue.columns(kind).size());
  for (const auto& column : tissue.columns(kind))
    parts.push_back(parts_of(*column, column->values[static_cast<size_t>(element)], share));
  return parts;
}

TissueEditor::TissueEditor(Tissue& tissue) : t_(tissue) {
  if (t_.locked_) fail("the structure of a tissue cannot change while rules run");
  ++t_.topology_version_;
  ++t_.geometry_version_;
}

void TissueEditor::require_room(Kind kind, size_t more) const {
  constexpr size_t capacity = ReservedArray<double>::capacity;
  if (t_.ids_[at(kind)].size() + more > capacity) fail("a tissue is limited to {} {}s", capacity, name_of(kind));
  if (t_.index_of_[at(kind)].size() + more > size_t{UINT32_MAX})
    fail("all {} identities of {}s are used up", UINT32_MAX, name_of(kind));
}

Index TissueEditor::append(Kind kind) {
  require_room(kind, 1);
  auto& ids = t_.ids_[at(kind)];
  auto& index_of = t_.index_of_[at(kind)];
  const Index index = static_cast<Index>(ids.size());
  ids.push_back(static_cast<Id>(index_of.size()));
  index_of.push_back(index);
  for (const auto& column : t_.columns_[at(kind)]) column->values.push_back(column->initial);
  switch (kind) {
    case Kind::cell:
      t_.cell_side_.push_back(none);
      break;
    case Kind::wall:
      t_.wall_side_.insert(t_.wall_side_.end(), {none, none});
      break;
    case Kind::side:
      t_.side_.push_back({.next = index, .previous = index, .cell = none, .wall = none, .start = none});
      break;
    case Kind::junction:
      t_.junction_side_.push_back(none);
      t_.position_.push_back(Vec3::Zero());
      break;
  }
  return index;
}

/// Gives an element the next identity; the old one is said to have become this one and the one after it.
void TissueEditor::renew(Kind kind, Index index) {
  auto& index_of = t_.index_of_[at(kind)];
  Id& id = t_.ids_[at(kind)][static_cast<size_t>(index)];
  const int64_t fresh = static_cast<int64_t>(index_of.size());
  index_of[id] = -fresh - 3;
  id = static_cast<Id>(fresh);
  index_of.push_back(index);
}

/// Splits an element into itself (under a new identity) and an appended one, which is returned.
Index TissueEditor::split_off(Kind kind, Index index, const Parts& legacy) {
  require_room(kind, 2);
  renew(kind, index);
  const Index other = append(kind);
  const auto& columns = t_.columns_[at(kind)];
  for (size_t i = 0; i < legacy.size(); ++i) {
    columns[i]->values[static_cast<size_t>(index)] = legacy[i].first;
    columns[i]->values[static_cast<size_t>(other)] = legacy[i].second;
  }
  return other;
}

void TissueEditor::link(Index side, Index following) {
  t_.side_[side].next = following;
  t_.side_[following].previous = side;
}

// === Building

Index TissueEditor::add_cell() { return append(Kind::cell); }
Index TissueEditor::add_wall() { return append(Kind::wall); }

Index TissueEditor::add_junction(Vec3 position) {
  const Index junction = append(Kind::junction);
  t_.position_[junction] = position;
  return junction;
}

Index TissueEditor::add_side(Index cell, Index wall, Index start, Index before, bool lead) {
  const Index side = append(Kind::side);
  t_.side_[side].cell = cell;
  t_.side_[side].wall = wall;
  t_.side_[side].start = start;
  Index& first = t_.cell_side_[cell];
  if (first == none) {
    first = side;
  } else {
    const Index following = before == none ? first : before;
    link(t_.side_[following].previous, side);
    link(side, following);
    if (lead) first = side;
  }
  t_.wall_side_[2 * wall + (t_.wall_side_[2 * wall] == none ? 0 : 1)] = side;
  if (start != none) t_.junction_side_[start] = side;
  return side;
}

void TissueEditor::set_order(Index cell, const std::vector<Index>& sides) {
  for (size_t i = 0; i < sides.size(); ++i) link(sides[i], sides[(i + 1) % sides.size()]);
  t_.cell_side_[cell] = sides.empty() ? none : sides[0];
}

void TissueEditor::set_place(Index cell, double row, double column) {
  t_.column(Kind::cell, "row").values[static_cast<size_t>(cell)] = row;
  t_.column(Kind::cell, "column").values[static_cast<size_t>(cell)] = column;
}

// === Dividing

Index TissueEditor::split_wall(Index wall, const Vec3& position, const std::array<Parts, 3>& legacy) {
  const Index side0 = t_.wall_side_[2 * wall], side1 = t_.wall_side_[2 * wall + 1];
  const Index junction = add_junction(position);
  const Index wall2 = split_off(Kind::wall, wall, legacy[0]);
  const Index tail0 = split_off(Kind::side, side0, legacy[1]);
  t_.side_[tail0].cell = t_.side_[side0].cell;
  t_.side_[tail0].wall = wall2;
  t_.side_[tail0].start = junction;
  link(tail0, t_.side_[side0].next);
  link(side0, tail0);
  t_.wall_side_[2 * wall2] = tail0;
  t_.junction_side_[junction] = tail0;
  measure_wall(wall);
  measure_wall(wall2);
  if (side1 == none) return junction;
  const Index tail1 = split_off(Kind::side, side1, legacy[2]);  // runs with the wall's first part
  t_.side_[tail1].cell = t_.side_[side1].cell;
  t_.side_[tail1].wall = wall;
  t_.side_[tail1].start = junction;
  link(tail1, t_.side_[side1].next);
  link(side1, tail1);
  t_.side_[side1].wall = wall2;
  t_.wall_side_[2 * wall + 1] = tail1;
  t_.wall_side_[2 * wall2 + 1] = side1;
  return junction;
}

Index TissueEditor::split_cell(Index side_a, Index side_b, const Parts& legacy) {
  const Index cell = t_.side_[side_a].cell;
  // The first daughter keeps first_side: of the arcs a..b and b..a, name the one that has it a..b.
  bool in_first_arc = false;
  for (Index side = side_a; side != side_b; side = t_.side_[side].next)
    in_first_arc = in_first_arc || side == t_.cell_side_[cell];
  if (!in_first_arc) std::swap(side_a, side_b);
  const Index before_a = t_.side_[side_a].previous, before_b = t_.side_[side_b].previous;
  const Index daughter = split_off(Kind::cell, cell, legacy);
  const Index wall = append(Kind::wall);
  const Index side0 = append(Kind::side), side1 = append(Kind::side);
  t_.side_[side0].start = t_.side_[side_b].start;
  t_.side_[side1].start = t_.side_[side_a].start;
  t_.side_[side0].wall = t_.side_[side1].wall = wall;
  t_.wall_side_[2 * wall] = side0;
  t_.wall_side_[2 * wall + 1] = side1;
  link(before_b, side0);
  link(side0, side_a);
  link(before_a, side1);
  link(side1, side_b);
  t_.side_[side0].cell = cell;
  t_.cell_side_[daughter] = side_b;
  for (Index side = side_b;; side = t_.side_[side].next) {
    t_.side_[side].cell = daughter;
    if (side == side1) break;
  }
  measure_wall(wall);
  return wall;
}

void TissueEditor::measure_wall(Index wall) {
  const Index side = t_.wall_side_[2 * wall];
  t_.length_->values[static_cast<size_t>(wall)] = (t_.position(t_.end(side)) - t_.position(t_.start(side))).norm();
}

void TissueEditor::set_measure(Index cell, const Measure& measure) {
  const auto i = static_cast<size_t>(cell);
  t_.area_->values[i] = measure.area;
  t_.x_->values[i] = measure.centroid.x();
  t_.y_->values[i] = measure.centroid.y();
  t_.z_->values[i] = measure.centroid.z();
}

// === Removing

/// Takes a side out of its cell's cycle; the caller erases it.
void TissueEditor::detach_side(Index side) {
  const Index cell = t_.side_[side].cell, following = t_.side_[side].next;
  if (following == side) {
    t_.cell_side_[cell] = none;
    return;
  }
  link(t_.side_[side].previous, following);
  if (t_.cell_side_[cell] == side) t_.cell_side_[cell] = following;
}

void TissueEditor::remove_wall(Index wall) {
  for (int which : {0, 1}) {
    const Index side = t_.wall_side_[2 * wall + which];
    if (side == none) continue;
    detach_side(side);
    t_.wall_side_[2 * wall + which] = none;
    dead_sides_.push_back(side);
  }
  erase_all(Kind::side, dead_sides_);
  erase(Kind::wall, wall);
}

/// Lets a side, and those after it as far as the border or once around, start at a junction.
void TissueEditor::set_start(Index first, Index junction) {
  Index side = first;
  while (side != none) {
    t_.side_[side].start = junction;
    side = side_after(t_, side);
    if (side == first) break;
  }
}

/// The same at a new junction, in the place of the one where they start.
void TissueEditor::give_own_junction(Index first) {
  const Index old = t_.side_[first].start;
  const Index own = add_junction(t_.position_[old]);
  for (const auto& column : t_.columns_[at(Kind::junction)])
    column->values[static_cast<size_t>(own)] = column->values[static_cast<size_t>(old)];
  set_start(first, own);
  t_.junction_side_[own] = first;
}

/// Leaves the junction where a side starts to the others there, and parts those before it from those after it if
/// nothing else holds them together. False: there are no others.
bool TissueEditor::leave_junction(Index side) {
  const Index junction = t_.side_[side].start;
  const Index first = first_side_at(t_, junction), after = side_after(t_, side);
  if (first == side && (after == none || after == side)) return false;
  const bool open = t_.opposite(first) == none;
  if (open && first != side && after != none) give_own_junction(after);
  t_.junction_side_[junction] = first == side ? after : first;
  return true;
}

void TissueEditor::remove_cell(Index cell) {
  const Index first = t_.cell_side_[cell];
  for (Index side = first; side != none;) {
    dead_sides_.push_back(side);
    side = t_.side_[side].next == first ? none : t_.side_[side].next;
  }
  for (const Index side : dead_sides_)
    if (const Index junction = t_.side_[side].start; junction != none && !leave_junction(side))
      dead_junctions_.push_back(junction);
  for (size_t i = 0, own = dead_sides_.size(); i < own; ++i) {
    const Index wall = t_.side_[dead_sides_[i]].wall, other = t_.opposite(dead_sides_[i]);
    t_.wall_side_[2 * wall] = other;
    t_.wall_side_[2 * wall + 1] = none;
    if (other != none && t_.geometry_) continue;
    dead_walls_.push_back(wall);
    if (other == none) continue;
    detach_side(other);
    dead_sides_.push_back(other);
  }
  erase_all(Kind::side, dead_sides_);
  erase_all(Kind::wall, dead_walls_);
  erase_all(Kind::junction, dead_junctions_);
  erase(Kind::cell, cell);
}

/// From the highest index down, so that no element still to be erased is moved into a hole. Empties the list.
void TissueEditor::erase_all(Kind kind, std::vector<Index>& indices) {
  std::sort(indices.begin(), indices.end(), std::greater<>());
  for (const Index index : indices) erase(kind, index);
  indices.clear();
}

/// Erases an element that nothing refers to any more; the last element moves into the hole.
void TissueEditor::erase(Kind kind, Index index) {
  auto& ids = t_.ids_[at(kind)];
  t_.index_of_[at(kind)][ids[static_cast<size_t>(index)]] = -2;
  if (static_cast<size_t>(index) + 1 != ids.size()) move_last_to(kind, index);
  ids.pop_back();
  for (const auto& column : t_.columns_[at(kind)]) column->values.pop_back();
  switch (kind) {
    case Kind::cell:
      t_.cell_side_.pop_back();
      break;
    case Kind::wall:
      t_.wall_side_.resize(t_.wall_side_.size() - 2);
      break;
    case Kind::side:
      t_.side_.pop_back();
      break;
    case Kind::junction:
      t_.junction_side_.pop_back();
      t_.position_.pop_back();
      break;
  }
}

void TissueEditor::move_last_to(Kind kind, Index hole) {
  auto& ids = t_.ids_[at(kind)];
  const Index last = static_cast<Index>(ids.size()) - 1;
  ids[static_cast<size_t>(hole)] = ids.back();
  t_.index_of_[at(kind)][ids.back()] = hole;
  for (const auto& column : t_.columns_[at(kind)])
    column->values[static_cast<size_t>(hole)] = column->values[static_cast<size_t>(last)];
  switch (kind) {
    case Kind::cell: {
      const Index first = t_.cell_side_[hole] = t_.cell_side_[last];
      if (first == none) break;
      Index side = first;
      do t_.side_[side].cell = hole;
      while ((side = t_.side_[side].next) != first);
      break;
    }
    case Kind::wall:
      for (int which : {0, 1}) {
        const Index side = t_.wall_side_[2 * hole + which] = t_.wall_side_[2 * last + which];
        if (side != none) t_.side_[side].wall = hole;
      }
      break;
    case Kind::side:
      move_side(last, hole);
      break;
    case Kind::junction:
      set_start(first_side_at(t_, last), hole);
      t_.junction_side_[hole] = t_.junction_side_[last];
      t_.position_[hole] = t_.position_[last];
      break;
  }
}

void TissueEditor::move_side(Index last, Index hole) {
  t_.side_[hole] = t_.side_[last];
  if (t_.side_[hole].next == last) {  // alone in its cycle, or on its way out
    link(hole, hole);
  } else {
    link(t_.side_[hole].previous, hole);
    link(hole, t_.side_[hole].next);
  }
  Index& first = t_.cell_side_[t_.side_[hole].cell];
  if (first == last) first = hole;
  for (int which : {0, 1}) {
    Index& side = t_.wall_side_[2 * t_.side_[hole].wall + which];
    if (side == last) side = hole;
  }
  if (t_.side_[hole].start != none) {
    Index& side = t_.junction_side_[t_.side_[hole].start];
    if (side == last) side = hole;
  }
}

}  // namespace tunica
