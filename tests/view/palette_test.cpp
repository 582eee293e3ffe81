// SPDX-License-Identifier: MIT
#include "view/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace tunica {
namespace {

double distance(const Colour& a, const Colour& b) {
  const OkLab p = to_oklab(a), q = to_oklab(b);
  return std::hypot(p.l - q.l, p.a - q.a, p.b - q.b);
}

TEST(Palette, SequentialOnesGetLighterAtEveryStep) {
  for (const std::string& name : palette_names()) {
    const Palette& p = palette(name);
    if (p.type != Palette::Type::sequential) continue;
    for (size_t i = 1; i < p.colours.size(); ++i)
      EXPECT_GT(to_oklab(p.colours[i]).l, to_oklab(p.colours[i - 1]).l) << name << " at " << i;
  }
}

TEST(Palette, StepsLookEquallyLarge) {
  for (const std::string& name : palette_names()) {
    const Palette& p = palette(name);
    double sum = 0, largest = 0;
    for (size_t i = 4; i < p.colours.size(); ++i) {
      const double step = distance(p.colours[i], p.colours[i - 4]);
      sum += step, largest = std::max(largest, step);
    }
    EXPECT_LT(largest, 2.6 * sum / 252) << name;
  }
}

TEST(Palette, DivergingIsLightestInTheMiddleAndEvenlyDarkAtItsEnds) {
  const Palette& p = palette("diverging");
  for (size_t i = 1; i < 128; ++i) {
    EXPECT_GT(to_oklab(p.colours[i]).l, to_oklab(p.colours[i - 1]).l);
    EXPECT_NEAR(to_oklab(p.colours[i]).l, to_oklab(p.colours[255 - i]).l, 0.02);
  }
}

TEST(Palette, CyclicClosesAndKeepsItsLightness) {
  const Palette& p = palette("cyclic");
  EXPECT_LT(distance(p.colours.front(), p.colours.back()), 0.01);
  for (const Colour& colour : p.colours) EXPECT_NEAR(to_oklab(colour).l, 0.72, 0.01);
}

TEST(Palette, MissingIsFarFromEveryColourOfTheMap) {
  for (const std::string& name : palette_names())
    for (const Colour& colour : palette(name).colours) EXPECT_GT(distance(colour, palette(name).missing), 0.08) << name;
}

TEST(Palette, TakesTheEndsOutsideAndMissingForNan) {
  const Palette& p = palette("viridis");
  EXPECT_EQ(p.at(-1), p.colours.front());
  EXPECT_EQ(p.at(INFINITY), p.colours.back());
  EXPECT_EQ(p.at(NAN), p.missing);
}

TEST(Palette, GivenColoursAreItsKnots) {
  const Colour red = parse_colour("#ff0000"), blue = parse_colour("#0000ff");
  const Palette p = palette_through({red, white, blue});
  EXPECT_EQ(p.at(0), red);
  EXPECT_LT(distance(p.at(0.5), white), 0.01);
  EXPECT_EQ(p.at(1), blue);
  EXPECT_THROW(palette_through({red}), Error);
}

TEST(Palette, UnknownNamesNameTheNearest) {
  try {
    palette("virdis");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'viridis'"), std::string::npos) << error.what();
  }
}

TEST(Colour, IsReadFromNamesAndHexadecimals) {
  EXPECT_EQ(parse_colour("#fff"), white);
  EXPECT_EQ(parse_colour("#ff000080"), (Colour{1, 0, 0, 128 / 255.f}));
  EXPECT_EQ(parse_colour("transparent").a, 0);
  for (const char* wrong : {"", "#", "#12", "#12345", "#gggggg", "rad", "#1234567890"})
    EXPECT_THROW(parse_colour(wrong), Error);
}

TEST(Colour, OkLabGoesThereAndBack) {
  for (const Colour c : {black, white, Colour{.2f, .5f, .9f, 1}, Colour{.9f, .1f, .3f, 1}}) {
    const Colour back = from_oklab(to_oklab(c));
    EXPECT_NEAR(back.r, c.r, 1e-4);
    EXPECT_NEAR(back.g, c.g, 1e-4);
    EXPECT_NEAR(back.b, c.b, 1e-4);
  }
  EXPECT_NEAR(to_oklab(white).l, 1, 1e-4);
}

}  // namespace
}  // namespace tunica
