// SPDX-License-Identifier: MIT
#include "sweep/range.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"

using namespace tunica;
using namespace tunica::sweep;

namespace {

const Parameter number{.name = "D", .type = Parameter::Type::number, .value = "1", .min = 0, .max = 100};
const Parameter flag{.name = "noisy", .type = Parameter::Type::boolean, .value = "false"};
const Parameter text{.name = "path", .type = Parameter::Type::text, .value = "x"};

void fails_with(const Parameter& p, const std::string& given, const std::string& words) {
  try {
    read_range(p, given);
    FAIL() << given << " should be refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

}  // namespace

TEST(Range, ReadsWhatIsWritten) {
  EXPECT_EQ(read_range(number, "3").kind, Range::Kind::fixed);
  EXPECT_EQ(read_range(number, "03.50").values[0], "3.5");
  EXPECT_EQ(read_range(number, "5,3,4").values, (std::vector<std::string>{"5", "3", "4"}));
  const Range range = read_range(number, "1e-2..1e1:9:log");
  EXPECT_EQ(range.kind, Range::Kind::interval);
  EXPECT_TRUE(range.log);
  EXPECT_EQ(range.steps, 9);
  EXPECT_EQ(range.text(), "0.01..10:9:log");
  EXPECT_EQ(read_range(number, ".5...75").text(), "0.5..0.75");
  EXPECT_EQ(read_range(flag, "true,false").values.size(), 2u);
  EXPECT_EQ(read_range(text, "../a").values[0], "../a");
  EXPECT_EQ(read_range(text, "'a,b'").values[0], "a,b");
}

TEST(Range, RefusesWhatCannotBeMeant) {
  fails_with(number, "5..3", "reversed; write D=3..5");
  fails_with(number, "3..3", "holds one value; write D=3");
  fails_with(number, "-1..3", "expected at least 0, got -1");
  fails_with(number, "3..101", "expected at most 100, got 101");
  fails_with(number, "3..x", "got 'x'");
  fails_with(number, "..3", "got ''");
  fails_with(number, "nan", "got 'nan'");
  fails_with(number, "1e999", "got '1e999'");
  fails_with(number, "3,,4", "got ''");
  fails_with(number, "3,4,3.0", "3 is in the list twice");
  fails_with(number, "3..5:1", "number of steps from 2 on");
  fails_with(number, "3..5:lgo", "got 'lgo'");
  fails_with(number, "0..5:log", "begins above 0");
  fails_with(number, "0.5..5:whole", "whole ends");
  const Parameter free{.name = "T", .type = Parameter::Type::number, .value = "1"};
  fails_with(free, "-1e308..1e308", "wider than a number can be");
  fails_with(free, "1e-300..1e300:log", "more than 308 decades");
  fails_with(flag, "yes", "expected true or false");
}

TEST(Range, PlacesGoThereAndBack) {
  for (const char* given : {"3..5", "0.01..90:log", "1..9:whole", "1..90:log:whole"}) {
    const Range range = read_range(number, given);
    EXPECT_EQ(range.at(0), shortest(range.low)) << given;
    EXPECT_EQ(range.at(1), shortest(range.high)) << given;
    for (double place = 0; place <= 1; place += 0.01) {
      const std::string value = range.at(place);
      EXPECT_EQ(range.at(range.place_of(std::strtod(value.c_str(), nullptr))).substr(0, 12), value.substr(0, 12))
          << given;
    }
  }
}

TEST(Range, GridsMeetBothEnds) {
  EXPECT_EQ(read_range(number, "3..5:5").grid(), (std::vector<std::string>{"3", "3.5", "4", "4.5", "5"}));
  EXPECT_EQ(read_range(number, "1..100:3:log").grid(), (std::vector<std::string>{"1", "10", "100"}));
  EXPECT_EQ(read_range(number, "3..5:whole").grid(), (std::vector<std::string>{"3", "4", "5"}));
  EXPECT_EQ(read_range(number, "1..3:9:whole").grid(), (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_THROW(read_range(number, "3..5").grid(), Error);
}

TEST(Range, NamesAreThoseOfTheModel) {
  EXPECT_EQ(read_ranges({number, flag}, {"noisy=true", "D=1..2"})[1].name, "D");
  EXPECT_THROW(read_ranges({number}, {"E=1"}), Error);
  EXPECT_THROW(read_ranges({number}, {"D=1", "D=2"}), Error);
  EXPECT_THROW(read_ranges({number}, {"D"}), Error);
  EXPECT_THROW(read_ranges({number}, {"=1"}), Error);
}
