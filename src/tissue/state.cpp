// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "tissue/tissue.h"
#include "tissue/validity.h"

namespace tunica {

namespace {

constexpr std::string_view magic = "tunica tissue 1";

void save_column(ByteWriter& out, const Column& column) {
  out.text(column.name);
  out.put(column.initial);
  out.put(column.inherit);
  out.put(static_cast<uint8_t>(column.geometric));
  out.array(column.values.data(), column.values.size());
}

struct LoadedColumn {
  Column column;
  std::vector<double> values;
};

LoadedColumn load_column(ByteReader& in) {
  LoadedColumn loaded;
  loaded.column.name = in.text();
  loaded.column.initial = in.get<double>();
  const auto inherit = in.get<uint8_t>();
  if (inherit > static_cast<uint8_t>(Inherit::rule)) fail("the file is damaged: column '{}'", loaded.column.name);
  loaded.column.inherit = static_cast<Inherit>(inherit);
  loaded.column.geometric = in.get<uint8_t>() != 0;
  loaded.values = in.array<double>();
  return loaded;
}

void expect_size(size_t size, size_t expected, const char* what) {
  if (size != expected) fail("the file is damaged: {} {} where {} are expected", size, what, expected);
}

}  // namespace

void Tissue::save(ByteWriter& out) const {
  out.text(magic);
  const size_t body = out.begin_text();
  out.put(static_cast<uint8_t>(geometry_));
  out.put(seed_);
  for (size_t kind = 0; kind < kinds; ++kind) {
    out.array(ids_[kind].data(), ids_[kind].size());
    out.array(index_of_[kind].data(), index_of_[kind].size());
    out.put(static_cast<uint32_t>(columns_[kind].size()));
    for (const auto& column : columns_[kind]) save_column(out, *column);
  }
  for (const auto* array : {&cell_side_, &wall_side_, &junction_side_}) out.array(array->data(), array->size());
  std::vector<Index> links;
  links.reserve(5 * side_.size());
  for (const Side& s : side_) links.insert(links.end(), {s.next, s.previous, s.cell, s.wall, s.start});
  out.array(links.data(), links.size());
  std::vector<double> coordinates;
  coordinates.reserve(3 * position_.size());
  for (const Vec3& p : position_) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  out.array(coordinates.data(), coordinates.size());
  const std::string sum = tunica::hash(out.end_text(body));
  out.text(sum);
}

std::string Tissue::hash() const {
  ByteWriter out;
  save(out);
  return tunica::hash(out.bytes());
}

/// Reads identities and columns of one kind into a fresh tissue.
void Tissue::load_kind(ByteReader& in, Kind kind) {
  auto& ids = ids_[static_cast<int>(kind)];
  auto& index_of = index_of_[static_cast<int>(kind)];
  ids = in.array<Id>();
  index_of = in.array<int64_t>();
  if (ids.size() > ReservedArray<double>::capacity || index_of.empty() || index_of[0] != -1)
    fail("the file is damaged: identities of {}s", name_of(kind));
  const int64_t last = static_cast<int64_t>(index_of.size()) - 1;
  for (const int64_t code : index_of)
    if (code >= static_cast<int64_t>(ids.size()) || code < -last - 2)
      fail("the file is damaged: identities of {}s", name_of(kind));
  auto& all = columns_[static_cast<int>(kind)];
  size_t own = all.size();
  for (auto& column : all) column->values.resize(ids.size());
  for (auto left = in.get<uint32_t>(); left > 0; --left) {
    LoadedColumn loaded = load_column(in);
    expect_size(loaded.values.size(), ids.size(), "values of a column");
    Column* target = find_column(kind, loaded.column.name);
    if (loaded.column.geometric != (target && target->geometric))
      fail("the file is damaged: column '{}'", loaded.column.name);
    if (target) {
      const bool place = !geometry_;  // row and column are whole numbers to those who use them
      for (const double value : loaded.values)
        if (place && !(std::abs(value) <= 1e9)) fail("the file is damaged: column '{}'", target->name);
      --own;
    } else {
      const Inherit inherit = std::exchange(loaded.column.inherit, Inherit::copy);  // its rule cannot come from a file
      target = &add_column(kind, std::move(loaded.column));
      target->inherit = inherit;
    }
    std::copy(loaded.values.begin(), loaded.values.end(), target->values.begin());
  }
  if (own != 0) fail("the file is damaged: a column of the {} is missing", name_of(kind));
}

void Tissue::load(ByteReader& in) {
  if (locked_) fail("the structure of a tissue cannot change while rules run");
  if (in.text() != magic) fail("this is not a tissue saved by this version of tunica");
  const std::string bytes = in.text();
  if (in.text() != tunica::hash(bytes)) fail("the file is damaged: its check sum is wrong");
  ByteReader body(bytes);
  const auto geometry = body.get<uint8_t>();
  if (geometry > 1) fail("the file is damaged");
  Tissue fresh(geometry != 0, body.get<uint64_t>());
  for (const Kind kind : {Kind::cell, Kind::wall, Kind::side, Kind::junction}) fresh.load_kind(body, kind);
  for (auto* array : {&fresh.cell_side_, &fresh.wall_side_, &fresh.junction_side_}) *array = body.array<Index>();
  expect_size(fresh.cell_side_.size(), fresh.ids_[0].size(), "cells");
  expect_size(fresh.wall_side_.size(), 2 * fresh.ids_[1].size(), "sides of walls");
  expect_size(fresh.junction_side_.size(), fresh.ids_[3].size(), "junctions");
  const std::vector<Index> links = body.array<Index>();
  expect_size(links.size(), 5 * fresh.ids_[2].size(), "links of sides");
  for (size_t i = 0; i + 4 < links.size(); i += 5)
    fresh.side_.push_back({links[i], links[i + 1], links[i + 2], links[i + 3], links[i + 4]});
  const std::vector<double> coordinates = body.array<double>();
  expect_size(coordinates.size(), 3 * fresh.ids_[3].size(), "coordinates");
  for (size_t i = 0; i + 2 < coordinates.size(); i += 3)
    fresh.position_.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  if (!body.at_end()) fail("the file is damaged: it does not end where it should");
  fresh.refresh_after_load();
  adopt(std::move(fresh));
}

/// Areas and lengths are computed anew, not believed; but the walk over the structure needs a sound one first.
void Tissue::refresh_after_load() {
  if (!geometry_) return validate(*this);
  for (const std::string& problem : find_structural_problems(*this, 1)) fail("the file is damaged: {}", problem);
  refresh_geometry();
  validate(*this);
}

/// Becomes `fresh`. Columns of the same name stay where they are in memory and keep their rule.
void Tissue::adopt(Tissue&& fresh) {
  for (size_t kind = 0; kind < kinds; ++kind) {
    for (auto& column : fresh.columns_[kind]) {
      auto& old = columns_[kind];
      const auto same =
          std::find_if(old.begin(), old.end(), [&](const auto& c) { return c && c->name == column->name; });
      if (same == old.end()) continue;
      (*same)->values = column->values;
      (*same)->initial = column->initial;
      (*same)->inherit = column->inherit;
      (*same)->geometric = column->geometric;
      column = std::move(*same);
    }
    columns_[kind] = std::move(fresh.columns_[kind]);
  }
  geometry_ = fresh.geometry_;
  seed_ = fresh.seed_;
  ids_ = std::move(fresh.ids_);
  index_of_ = std::move(fresh.index_of_);
  cell_side_ = std::move(fresh.cell_side_);
  side_ = std::move(fresh.side_);
  wall_side_ = std::move(fresh.wall_side_);
  junction_side_ = std::move(fresh.junction_side_);
  position_ = std::move(fresh.position_);
  area_ = x_ = y_ = z_ = length_ = nullptr;
  add_geometric_columns();
  ++topology_version_;
  ++geometry_version_;
}

}  // namespace tunica
