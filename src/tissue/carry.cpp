// SPDX-License-Identifier: MIT
#include "tissue/carry.h"

#include <array>

#include "base/error.h"

namespace tunica {

namespace {

/// A column as it was declared, with its values by identity.
struct Declared {
  Kind kind;
  Column column;  ///< without values
  std::vector<Id> ids;
  std::vector<double> values;
};

constexpr std::array all_kinds = {Kind::cell, Kind::wall, Kind::side, Kind::junction};

std::vector<Declared> declared_columns(const Tissue& tissue) {
  std::vector<Declared> list;
  for (const Kind kind : all_kinds)
    for (const auto& column : tissue.columns(kind)) {
      if (column->geometric) continue;
      Declared d{kind, {}, {}, {}};
      d.column.name = column->name;
      d.column.initial = column->initial;
      d.column.inherit = column->inherit;
      d.column.rule = column->rule;
      for (Index i = 0; i < tissue.count(kind); ++i) {
        d.ids.push_back(tissue.id(kind, i));
        d.values.push_back(column->values[static_cast<size_t>(i)]);
      }
      list.push_back(std::move(d));
    }
  return list;
}

std::string full_name(Kind kind, const Column& column) { return std::string(name_of(kind)) + "." + column.name; }

void put_back(Tissue& tissue, Declared& d, bool with_values) {
  Column* column = tissue.find_column(d.kind, d.column.name);
  if (!column)
    column = &tissue.add_column(d.kind, std::move(d.column));
  else {
    column->initial = d.column.initial;
    column->inherit = d.column.inherit;
    column->rule = std::move(d.column.rule);
  }
  for (size_t i = 0; with_values && i < d.ids.size(); ++i) {
    const Index index = tissue.find(d.kind, d.ids[i]);
    if (index != none) column->values[static_cast<size_t>(index)] = d.values[i];
  }
}

}  // namespace

CarriedColumns carry_over(Tissue& to, const Tissue& from) {
  if (to.has_geometry() != from.has_geometry())
    fail("the tissue has {} geometry now, and had {}", to.has_geometry() ? "a" : "no",
         from.has_geometry() ? "one" : "none");
  CarriedColumns names;
  std::vector<Declared> declared = declared_columns(to);
  ByteWriter bytes;
  from.save(bytes);
  ByteReader in(bytes.bytes());
  to.load(in);
  for (const Kind kind : all_kinds)
    for (const auto& column : to.columns(kind)) {
      bool known = column->geometric;
      for (const Declared& d : declared) known = known || (d.kind == kind && d.column.name == column->name);
      if (known) continue;
      names.undeclared.push_back(full_name(kind, *column));
      if (column->inherit == Inherit::rule) column->inherit = Inherit::copy;  // its function belongs to the other
    }
  for (Declared& d : declared) {
    const bool added = !from.find_column(d.kind, d.column.name);
    if (added) names.added.push_back(full_name(d.kind, d.column));
    put_back(to, d, added);
  }
  return names;
}

}  // namespace tunica
