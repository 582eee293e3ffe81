// SPDX-License-Identifier: MIT
#include "shape/lstudio.h"

#include <cmath>

#include "tissue/fixtures.h"

namespace tunica {
namespace {

std::vector<DrawnCurve> read(std::string_view text) { return read_lstudio(text, "f"); }
DrawnCurve read_one(std::string_view text) {
  auto curves = read(text);
  EXPECT_EQ(curves.size(), 1u);
  return curves.at(0);
}

constexpr const char* function =
    "fver 1 1\nname: a b\nsamples: 10\nflip: off\npoints: 4\n0 1\n.2 .5 2\n.5 2 1\n1 3 1\n";
constexpr const char* contour = "cver 1 3\nname: c\npoints: 3 7\ntype: or\nsamples: 9\n0 0 0 3\n1 0 0 1\n1 -2 0 3\n";

TEST(LStudio, Functions) {
  const DrawnCurve f = read_one(function);
  EXPECT_TRUE(f.is_function);
  EXPECT_EQ(f.name, "a b");
  EXPECT_EQ(f.samples, 10);
  EXPECT_EQ(f.points.size(), 5u);
  EXPECT_EQ(f.points[2], Vec2(.2, .5));
  EXPECT_DOUBLE_EQ(f.function()(0), 1);
  EXPECT_DOUBLE_EQ(f.function()(1), 3);
  const DrawnCurve old = read_one("range: 0 1\npoints: 4\n0 1\n.25 2\n.5 3\n1 4\n");
  EXPECT_EQ(old.points.size(), 4u);
}

TEST(LStudio, ContoursOfEveryVersion) {
  const DrawnCurve c = read_one(contour);
  EXPECT_FALSE(c.is_function);
  EXPECT_EQ(c.ends, Ends::open);
  EXPECT_EQ(c.points.size(), 7u);
  EXPECT_NEAR((c.contour().at(0) - Vec2(0, 0)).norm(), 0, 1e-15);
  const std::string square = "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n";
  const auto typed = [&](const std::string& type) {
    return read_one("cver 1 2\nname: s\npoints: 4 4\n" + square + "type: " + type + "\n");
  };
  EXPECT_EQ(typed("cr").ends, Ends::closed);
  EXPECT_EQ(typed("cr").contour().breaks().size(), 5u);
  EXPECT_EQ(typed("oe").ends, Ends::clamped);
  EXPECT_EQ(typed("oe").contour().at(1), Vec2(0, 1));
  EXPECT_EQ(typed("ce").contour().at(0), Vec2(0, 0));
  EXPECT_EQ(typed("ce").contour().at(9), Vec2(0, 0));
  EXPECT_EQ(typed("closed").ends, Ends::closed);
  EXPECT_EQ(typed("or").samples, 8);
  EXPECT_EQ(read_one("4 3 closed\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n").ends, Ends::closed);
  EXPECT_EQ(read_one("version: 1.4\ncontact: 0 0 0\nend: 0 0 0\nheading: 0 1 0\nup: 0 0 -1\nsize: 1\npoints: 4\n"
                     "range: 0.0 1.0\ndimension: 4\ntype: bspline\n" +
                     square)
                .points.size(),
            4u);
}

TEST(LStudio, LinesMayEndInAnyWay) {
  std::string text = function;
  for (const char* end : {"\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? std::string(end) : std::string(1, c);
    EXPECT_EQ(read_one(other).points, read_one(text).points);
  }
  EXPECT_EQ(read_one(text.substr(0, text.size() - 1)).points.size(), 5u);
}

TEST(LStudio, Galleries) {
  const std::string two = std::string(function) + function;
  EXPECT_EQ(read("funcgalleryver 1 1\nitems: 2\n" + two).size(), 2u);
  EXPECT_EQ(read("contourgalleryver 1 1\nitems: 1\n" + std::string(contour)).size(), 1u);
  EXPECT_ERROR(read("funcgalleryver 1 1\nitems: 3\n" + two), "announces 3 curves and has 2");
  const auto timed = read(
      "timeEdit 1 2\nitems: 1\nstart: 2\nend: 18.5\nname: X\ncolor: 1,2,3\nstartLabel: \nendLabel: \n"
      "timelineFunceditFileStart:\n" +
      std::string(function) + "timelineFunceditFileEnd:\n");
  ASSERT_EQ(timed.size(), 1u);
  EXPECT_EQ(timed[0].start, 2);
  EXPECT_EQ(timed[0].end, 18.5);
  EXPECT_EQ(timed[0].name, "a b");
}

TEST(LStudio, WhatIsWrongIsSaidWithItsLine) {
  EXPECT_ERROR(read(""), "f: no curve");
  EXPECT_ERROR(read("hello"), "f:1: expected 'key: value' or numbers, came 'hello'");
  EXPECT_ERROR(read("1 2 3"), "f:1: numbers before any curve");
  EXPECT_ERROR(read("fver 1 1\npoits: 4"), "f:2: there is no key 'poits'; did you mean 'points'?");
  EXPECT_ERROR(read("fver 1 1\npoints: 4\n0 1\n"), "announces 4 points and has 1");
  EXPECT_ERROR(read("fver 1 1\npoints: 1\n0 1\n1 1\n"), "f:4: more than the 1 points");
  EXPECT_ERROR(read("fver 1 1\npoints: 2\n0 1\n0 nan\n"), "f:4: expected a number, came 'nan'");
  EXPECT_ERROR(read("fver 1 1\npoints: 2\n0 1\n1 1e999\n"), "f:4: expected a number");
  EXPECT_ERROR(read("fver 1 1\npoints: 2\n0 1 4\n"),
               "f:3: the multiplicity of a point must be a whole number from 1 to 3");
  EXPECT_ERROR(read("fver 1 1\npoints: 2\n1 1\n0 1\n"), "f:1: x must not decrease");
  EXPECT_ERROR(read("fver 1 1\npoints: 999999999\n"), "f:2: the number of points");
  EXPECT_ERROR(read("fver 2 1\n"), "version 2.1 of 'fver' is not known");
  EXPECT_ERROR(read(std::string(function) + contour), "functions or contours, not both");
  EXPECT_ERROR(read("cver 1 3\npoints: 1 1\n0 0 2 1\n"), "f:3: the contour is not planar");
  EXPECT_ERROR(read("cver 1 3\ntype: xx\n"), "f:2: the type of a contour");
  EXPECT_ERROR(read("cver 1 3\npoints: 2 3\n0 0 0 1\n0 1 0 1\n"), "3 points in all and has 2");
  EXPECT_ERROR(read("cver 1 3\npoints: 2 2\ntype: oe\n0 0 0 1\n0 1 0 1\n"), "f:1: a B-spline of degree 3");
}

TEST(LStudio, WhatIsWrittenIsReadTheSame) {
  testing::Dice dice(4);
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec2> points;
    for (int i = 0; i < 6; ++i)
      points.insert(points.end(), static_cast<size_t>(1 + dice.below(4)), Vec2(i + dice.real(), dice.real() / 3));
    const Ends ends = std::vector{Ends::open, Ends::clamped, Ends::closed}[static_cast<size_t>(round % 3)];
    const DrawnCurve c = read_one(write_contour("a\nb", points, 3, ends));
    EXPECT_EQ(c.points, points);
    EXPECT_EQ(c.ends, ends);
    EXPECT_EQ(c.name, "a b");
    const DrawnCurve f = read_one(write_function("f", Curve(points)));
    EXPECT_EQ(f.points, points);
  }
  for (const Curve& lower : {Curve::constant(7), Curve({{0, 1}, {2, 5}}), Curve({{0, 1}, {1, 3}, {2, 0}}),
                             Curve::linear({{0, 1}, {1, 3}, {2, 0}, {5, 1}})}) {
    const Curve again = read_one(write_function("", lower)).function();
    for (double x = -1; x < 6; x += .0713) EXPECT_NEAR(again(x), lower(x), 1e-13);
  }
  EXPECT_ERROR(write_contour("", {{0, 0}, {1, 0}, {2, 1}, {3, 3}}, 2, Ends::open), "holds cubic curves");
  const BSpline corner = read_one(write_contour("", {{0, 0}, {1, 0}, {1, -1}}, 1, Ends::open)).contour();
  EXPECT_NEAR(corner.at(corner.end()).y(), -1, 1e-15);
}

/// A file is read or refused; nothing else happens, and in bounded time.
TEST(LStudio, NoFileDoesHarm) {
  const std::string two = std::string(function) + function;
  const std::vector<std::string> files = {
      function, contour, "funcgalleryver 1 1\nitems: 2\n" + two,
      "version: 1.4\npoints: 4\ntype: bspline\n0 0 0 3\n1 0 0 1\n1 -1 0 1\n2 -1 0 3\n",
      "timeEdit 1 2\nitems: 1\nstart: 2\ntimelineFunceditFileStart:\n" + two};
  const std::string alphabet = "0123456789.-+e: \n\rabfnpoitsrvcx\t\x01\xff,";
  testing::Dice dice(9);
  int good = 0;
  const auto try_one = [&](const std::string& text) {
    try {
      for (const DrawnCurve& c : read(text)) good += c.points.empty() ? 0 : 1;
    } catch (const Error&) {
    }
  };
  for (const std::string& file : files) {
    for (size_t cut = 0; cut <= file.size(); ++cut) try_one(file.substr(0, cut));
    for (int round = 0; round < 3000; ++round) {
      std::string text = file;
      for (int edits = 1 + dice.below(3); edits > 0; --edits) {
        const auto at = static_cast<size_t>(dice.below(static_cast<Index>(text.size())));
        const char c = alphabet[static_cast<size_t>(dice.below(static_cast<Index>(alphabet.size())))];
        switch (dice.below(4)) {
          case 0:
            text[at] = c;
            break;
          case 1:
            text.insert(at, 1, c);
            break;
          case 2:
            text.erase(at, static_cast<size_t>(1 + dice.below(20)));
            break;
          default:
            text.insert(at, text.substr(static_cast<size_t>(dice.below(static_cast<Index>(text.size()))), 30));
        }
        if (text.empty()) text = " ";
      }
      try_one(text);
    }
  }
  EXPECT_GT(good, 100);
}

TEST(LStudio, TheFilesOfModellersAreRead) {
  const auto folder = testing::outside_folder() / "lstudio";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the data set is not here (TUNICA_DATA)";
  int curves = 0;
  for (const char* kind : {"func", "fset", "tset", "con", "cset"})
    for (const auto& file : std::filesystem::directory_iterator(folder / kind)) {
      const auto read = read_lstudio(testing::content_of(file.path()), file.path().filename());
      curves += static_cast<int>(read.size());
      for (const DrawnCurve& c : read) EXPECT_EQ(c.is_function, kind[0] != 'c') << file.path();
    }
  EXPECT_GE(curves, 55);
  const auto given = [&](const char* name) { return read_lstudio(testing::content_of(folder / name), name).at(0); };
  EXPECT_NEAR(given("func/FernLeaf-curvature.func").function()(0), .113486, 1e-15);
  EXPECT_NEAR(given("func/FernLeaf-curvature.func").function()(1), -.630514, 1e-15);
  EXPECT_EQ(given("con/Ridley-profile.con").points.size(), 8u);
  EXPECT_EQ(given("tset/Lychnis-functions.tset").end, 18.4376);
}

}  // namespace
}  // namespace tunica
