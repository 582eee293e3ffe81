// SPDX-License-Identifier: MIT
#include "tissue/carry.h"

#include "tissue/builders.h"
#include "tissue/division.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

using testing::declare;
using testing::expect_valid;

TEST(Carry, StructureAndValuesComeFromTheOldDeclarationsFromTheNew) {
  Tissue old = hexagon_disk(1), fresh = hexagon_disk(1);
  declare(old, Kind::cell, "auxin", 1, Inherit::copy).values[2] = 7;
  Column pin;
  pin.name = "pin";
  pin.inherit = Inherit::rule;
  pin.rule = [](double mother, double) { return std::pair(mother, mother); };
  old.add_column(Kind::wall, std::move(pin));
  divide(old, 3, errera);
  declare(fresh, Kind::cell, "auxin", 2, Inherit::split);
  declare(fresh, Kind::cell, "age", 4, Inherit::copy).values[2] = 9;
  const CarriedColumns names = carry_over(fresh, old);
  EXPECT_EQ(names.added, std::vector<std::string>{"cell.age"});
  EXPECT_EQ(names.undeclared, std::vector<std::string>{"wall.pin"});
  EXPECT_EQ(fresh.cells(), old.cells());
  EXPECT_EQ(fresh.column(Kind::cell, "auxin").values[2], 7);
  EXPECT_EQ(fresh.column(Kind::cell, "auxin").initial, 2);
  EXPECT_EQ(fresh.column(Kind::cell, "auxin").inherit, Inherit::split);
  EXPECT_EQ(fresh.column(Kind::cell, "age").values[2], 9);
  EXPECT_EQ(fresh.column(Kind::cell, "age").values[old.cells() - 1], 4) << "a cell that the new tissue did not have";
  expect_valid(fresh);
  for (Index cell = 0; cell < 3; ++cell) divide(fresh, cell, errera);  // needs no rule of the old tissue
  expect_valid(fresh);
}

TEST(Carry, SameDeclarationsGiveTheSameBits) {
  Tissue old = hexagon_disk(2), fresh = hexagon_disk(2);
  for (Tissue* tissue : {&old, &fresh}) declare(*tissue, Kind::side, "pin", .25, Inherit::copy);
  divide(old, 4, errera);
  const CarriedColumns names = carry_over(fresh, old);
  EXPECT_TRUE(names.added.empty() && names.undeclared.empty());
  EXPECT_EQ(fresh.hash(), old.hash());
}

TEST(Carry, GeometryIsNotInvented) {
  Tissue old = hexagon_disk(1), fresh = line(5);
  EXPECT_ERROR(carry_over(fresh, old), "no geometry now");
  EXPECT_EQ(fresh.cells(), 5);
}

}  // namespace
}  // namespace tunica
