// SPDX-License-Identifier: MIT
#include "tissue/builders.h"
#include "tissue/division.h"
#include "tissue/fixtures.h"
#include "tissue/topology.h"

namespace tunica {
namespace {

using testing::declare;
using testing::expect_valid;

std::string saved(const Tissue& tissue) {
  ByteWriter out;
  tissue.save(out);
  return out.take();
}

void load(Tissue& tissue, const std::string& bytes) {
  ByteReader in(bytes);
  tissue.load(in);
}

Tissue worn() {
  Tissue tissue = hexagon_disk(1);
  declare(tissue, Kind::cell, "auxin", 1.5, Inherit::split);
  declare(tissue, Kind::side, "pin", .25, Inherit::copy);
  divide(tissue, 3, errera);
  remove_cell(tissue, 0);
  return tissue;
}

TEST(State, LoadsWhatItSavesToTheBit) {
  Tissue tissue = worn(), other(false);
  load(other, saved(tissue));
  EXPECT_EQ(other.hash(), tissue.hash());
  EXPECT_EQ(other.fate(Kind::cell, 4), tissue.fate(Kind::cell, 4));
  expect_valid(other);
  divide(tissue, 2, errera);
  divide(other, 2, errera);
  EXPECT_EQ(other.hash(), tissue.hash());
  const Tissue tube = cylinder(4, 3, 9);
  load(other, saved(tube));
  EXPECT_FALSE(other.has_geometry());
  EXPECT_EQ(other.seed(), 9u);
  EXPECT_EQ(other.hash(), tube.hash());
}

TEST(State, KeepsColumnsInPlaceAndTheirRules) {
  Tissue tissue = worn();
  Column ruled;
  ruled.name = "ruled";
  ruled.inherit = Inherit::rule;
  ruled.rule = [](double m, double) { return std::pair(m, m); };
  Column& column = tissue.add_column(Kind::cell, ruled);
  const double* address = column.values.data();
  const std::string bytes = saved(tissue);
  const uint64_t version = tissue.topology_version();
  divide(tissue, 1, errera);
  load(tissue, bytes);
  EXPECT_EQ(&tissue.column(Kind::cell, "ruled"), &column);
  EXPECT_EQ(column.values.data(), address);
  EXPECT_GT(tissue.topology_version(), version);
  divide(tissue, 1, errera);
  Tissue other(true);
  load(other, bytes);
  EXPECT_ERROR(divide(other, 1, errera), "declare the column again");
  other.lock(true);
  EXPECT_ERROR(load(other, bytes), "while rules run");
}

TEST(State, RefusesEveryDamage) {
  const std::string good = saved(worn());
  Tissue target(true);
  for (size_t size = 0; size < good.size(); ++size) EXPECT_THROW(load(target, good.substr(0, size)), Error) << size;
  for (size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ (1 << i % 8));
    EXPECT_THROW(load(target, bad), Error) << i;
  }
  EXPECT_EQ(target.cells(), 0);
}

/// With a check sum made right again, what remains is the check of the tissue itself.
TEST(State, ForgedStatesAreValidOrRefused) {
  const std::string bodies[] = {saved(worn()), saved(cylinder(3, 3))};
  for (const std::string& good : bodies) {
    ByteReader parts(good);
    const std::string magic = parts.text(), body = parts.text();
    int accepted = 0;
    for (size_t i = 0; i < body.size(); ++i)
      for (const int change : {0x01, 0x80}) {
        std::string forged = body;
        forged[i] = static_cast<char>(forged[i] ^ change);
        ByteWriter out;
        out.text(magic);
        out.text(forged);
        out.text(hash(forged));
        Tissue target(true);
        try {
          load(target, out.bytes());
        } catch (const Error&) {
          continue;
        }
        ++accepted;
        for (const std::string& problem : find_problems(target)) FAIL() << "byte " << i << ": " << problem;
      }
    EXPECT_GT(accepted, 0);  // changed numbers in columns are another valid tissue
  }
}

}  // namespace
}  // namespace tunica
