// SPDX-License-Identifier: MIT
#include "tissue/tissue.h"

#include <algorithm>
#include <cctype>

#include "base/error.h"

namespace tunica {

const char* name_of(Kind kind) {
  constexpr const char* names[kinds] = {"cell", "wall", "side", "junction"};
  return names[static_cast<int>(kind)];
}

Tissue::Tissue(bool geometry, uint64_t seed) : geometry_(geometry), seed_(seed) {
  for (auto& index_of : index_of_) index_of.push_back(-1);  // identity 0 names nothing
  add_geometric_columns();
}

void Tissue::add_geometric_columns() {
  if (geometry_) {
    area_ = &own_column(Kind::cell, "area");
    x_ = &own_column(Kind::cell, "x");
    y_ = &own_column(Kind::cell, "y");
    z_ = &own_column(Kind::cell, "z");
    length_ = &own_column(Kind::wall, "length");
  } else {
    own_column(Kind::cell, "row");
    own_column(Kind::cell, "column");
  }
}

Column& Tissue::own_column(Kind kind, const char* name) {
  if (Column* existing = find_column(kind, name)) return *existing;
  Column column;
  column.name = name;
  column.geometric = true;
  return add_column(kind, std::move(column));
}

Index Tissue::find(Kind kind, Id id) const {
  const auto& index_of = index_of_[static_cast<int>(kind)];
  if (id >= index_of.size() || index_of[id] < 0) return none;
  return static_cast<Index>(index_of[id]);
}

std::string Tissue::fate(Kind kind, Id id) const {
  const auto& index_of = index_of_[static_cast<int>(kind)];
  if (id >= index_of.size() || index_of[id] == -1) return "does not exist";
  if (index_of[id] >= 0) return "is alive";
  if (index_of[id] == -2) return "was removed";
  const int64_t first = -index_of[id] - 3;  // the two parts have consecutive identities
  return fmt::format("{} {} and {}", kind == Kind::cell ? "has divided into" : "was split into", first, first + 1);
}

std::vector<Index> Tissue::neighbours(Index cell) const {
  std::vector<Index> result;
  const Index first = first_side(cell);
  if (first == none) return result;
  Index side = first;
  do {
    const Index other = neighbour(side);
    if (other != none && std::find(result.begin(), result.end(), other) == result.end()) result.push_back(other);
    side = next(side);
  } while (side != first);
  return result;
}

bool Tissue::on_border(Index cell) const {
  const Index first = first_side(cell);
  if (first == none) return true;
  Index side = first;
  do {
    if (opposite(side) == none) return true;
    side = next(side);
  } while (side != first);
  return false;
}

int Tissue::side_count(Index cell) const {
  const Index first = first_side(cell);
  if (first == none) return 0;
  int count = 0;
  Index side = first;
  do {
    ++count;
    side = next(side);
  } while (side != first);
  return count;
}

// === Columns

namespace {

bool is_identifier(const std::string& name) {
  if (name.empty() || name.size() > 60 || std::isdigit(static_cast<unsigned char>(name[0]))) return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

}  // namespace

Column& Tissue::add_column(Kind kind, Column column) {
  if (!is_identifier(column.name))
    fail("'{}' cannot name a column: letters, digits and _ are expected, a letter first", column.name);
  if (find_column(kind, column.name)) fail("the {} has a column '{}' already", name_of(kind), column.name);
  if (column.inherit == Inherit::rule && !column.rule)
    fail("column '{}' is declared to divide by a rule, but no rule is given", column.name);
  auto owned = std::make_unique<Column>(std::move(column));
  owned->values.resize(0);
  owned->values.resize(static_cast<size_t>(count(kind)));
  if (owned->initial != 0) std::fill(owned->values.begin(), owned->values.end(), owned->initial);
  auto& all = columns_[static_cast<int>(kind)];
  all.push_back(std::move(owned));
  return *all.back();
}

const Column* Tissue::find_column(Kind kind, std::string_view name) const {
  for (const auto& column : columns(kind))
    if (column->name == name) return column.get();
  return nullptr;
}

Column* Tissue::find_column(Kind kind, std::string_view name) {
  return const_cast<Column*>(static_cast<const Tissue*>(this)->find_column(kind, name));
}

Column& Tissue::column(Kind kind, std::string_view name) {
  if (Column* found = find_column(kind, name)) return *found;
  std::vector<std::string> names;
  for (const auto& column : columns(kind)) names.push_back(column->name);
  fail("the {} has no column '{}'{}", name_of(kind), name, did_you_mean(name, names));
}

}  // namespace tunica
