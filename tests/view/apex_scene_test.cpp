// SPDX-License-Identifier: MIT
#include "view/apex_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "view/apex_scene_parts.h"
#include "view/render.h"

namespace tunica {
namespace {

constexpr double degree = M_PI / 180;

std::vector<Vec2> disc() { return {{0, 0}, {10, 0}}; }
std::vector<Vec2> cylinder() { return {{2, 0}, {2, -30}}; }

/// A half sphere of radius 1 upon a cylinder.
std::vector<Vec2> dome() {
  std::vector<Vec2> profile;
  for (int i = 0; i <= 90; ++i) profile.emplace_back(std::sin(i * degree), std::cos(i * degree));
  profile.emplace_back(1, -5);
  return profile;
}

/// Whorls of `jugacy` primordia, each turned by `divergence` degrees, `step` further out the older.
ApexPicture lattice(std::vector<Vec2> profile, double divergence, int jugacy, int whorls, double step) {
  ApexPicture apex;
  apex.profile = std::move(profile);
  apex.jugacy = jugacy;
  for (int w = 0; w < whorls; ++w)
    for (int k = 0; k < jugacy; ++k) {
      Bump bump;
      bump.theta = (w * divergence + 360.0 * k / jugacy) * degree;
      bump.age = whorls - 1 - w;
      bump.arc = 1 + step * bump.age;
      apex.primordia.push_back(bump);
    }
  return apex;
}

template <class Run>
void expect_fail(const std::string& words, Run&& run) {
  try {
    run();
    ADD_FAILURE() << "no error: " << words;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Turned, PlacesNormalsAndTheClosest) {
  const Turned dome_(dome());
  EXPECT_NEAR((dome_.place(0, M_PI / 2) - Vec3(1, 0, 0)).norm(), 0, 1e-3);
  EXPECT_NEAR((dome_.place(M_PI / 2, M_PI / 2) - Vec3(0, 0, 1)).norm(), 0, 1e-3);
  EXPECT_NEAR((dome_.normal(0, 0) - Vec3(0, 1, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((dome_.normal(1, 0.7) - dome_.place(1, 0.7)).norm(), 0, 0.01);
  EXPECT_NEAR(dome_.closest(2 * std::sin(0.6), 2 * std::cos(0.6)), 0.6, 0.01);
  EXPECT_NEAR((dome_.place(0, 100) - Vec3(1, -100 + M_PI / 2, 0)).norm(), 0, 0.01);
}

TEST(Turned, TheMapKeepsAngles) {
  // On a disc the map's height is the logarithm of the radius, on a cylinder the arc over the radius.
  const Turned flat(disc()), round(cylinder());
  EXPECT_NEAR(flat.map_height(8) - flat.map_height(2), std::log(4), 1e-12);
  EXPECT_NEAR(flat.map_height(20), std::log(2), 1e-12);
  EXPECT_NEAR(round.map_height(7) - round.map_height(3), 2, 1e-12);
  EXPECT_NEAR(flat.arc_at_map_height(flat.map_height(3), 8, 1), 3, 1e-9);
  EXPECT_TRUE(std::isfinite(flat.map_height(0)));
}

TEST(Turned, RefusesWhatIsNoProfile) {
  expect_fail("two different points", [] { Turned({}); });
  expect_fail("two different points", [] { Turned({{1, 1}, {1, 1}}); });
  expect_fail("not finite", [] { Turned({{0, 0}, {NAN, 1}}); });
  expect_fail("x >= 0", [] { Turned({{0, 0}, {-1, 1}}); });
  expect_fail("leave the axis", [] { Turned({{0, 0}, {0, 1}}); });
}

TEST(Parastichies, JoinTheContactsOfASpiral) {
  const auto apex = lattice(disc(), 137.5, 1, 40, 0.1);
  const auto [fives, eights] = parastichies(apex.primordia, {5, 8}, 1);
  ASSERT_EQ(fives.size(), 35u);
  ASSERT_EQ(eights.size(), 32u);
  for (const Link& link : fives) EXPECT_NEAR(link.turn / degree, -32.5, 1e-9);
  for (const Link& link : eights) EXPECT_NEAR(link.turn / degree, 20, 1e-9);
  EXPECT_EQ(fives[3].to, 8u);
}

TEST(Parastichies, FindTheirPartnerWithinAWhorl) {
  auto apex = lattice(disc(), 68.75, 2, 20, 0.1);
  // Members of a whorl arise together, so that their order is arbitrary.
  for (size_t w = 0; w < 20; w += 3) std::swap(apex.primordia[2 * w], apex.primordia[2 * w + 1]);
  for (const auto& family :
       {parastichies(apex.primordia, {6, 10}, 2).first, parastichies(apex.primordia, {6, 10}, 2).second}) {
    ASSERT_GE(family.size(), 30u);
    for (const Link& link : family) EXPECT_NEAR(link.turn, family[0].turn, 1e-9);
  }
}

TEST(Parastichies, OfAnEqualPairGoBothWays) {
  const auto pairs = lattice(cylinder(), 90, 2, 8, 1);
  const auto [left, right] = parastichies(pairs.primordia, {2, 2}, 2);
  ASSERT_EQ(left.size(), 14u);
  for (const Link& link : left) EXPECT_NEAR(link.turn / degree, 90, 1e-9);
  for (const Link& link : right) EXPECT_NEAR(link.turn / degree, -90, 1e-9);
  const auto two_rows = lattice(cylinder(), 180, 1, 8, 1);
  for (const Link& link : parastichies(two_rows.primordia, {1, 1}, 1).second)
    EXPECT_NEAR(link.turn / degree, -180, 1e-9);
}

TEST(Parastichies, BreakWhereAPrimordiumStrays) {
  auto apex = lattice(disc(), 137.5, 1, 40, 0.1);
  apex.primordia[20].theta += 50 * degree;
  EXPECT_EQ(parastichies(apex.primordia, {5, 8}, 1).first.size(), 33u);
}

TEST(Ring, MinimaAreFoundAcrossTheSeamAndOnLevels) {
  FieldRing ring;
  for (int i = 0; i < 360; ++i) {
    ring.angles.push_back(i * degree);
    ring.values.push_back(2 - std::cos(2 * i * degree) - 0.2 * std::cos(i * degree));
  }
  auto minima = minima_of(ring);
  ASSERT_EQ(minima.size(), 2u);
  EXPECT_NEAR(minima[0].angle, 0, 1e-9);
  EXPECT_TRUE(minima[0].chosen && !minima[1].chosen);
  EXPECT_DOUBLE_EQ(minima[0].depth, 1);
  EXPECT_TRUE(minima[1].depth > 0.5 && minima[1].depth < 1);
  ring.chosen = 181 * degree;
  EXPECT_TRUE(minima_of(ring)[1].chosen);
  for (int i = 80; i <= 101; ++i) ring.values[static_cast<size_t>(i)] = 0.1;
  minima = minima_of(ring);
  ASSERT_EQ(minima.size(), 3u);
  EXPECT_NEAR(minima[1].angle / degree, 90.5, 1e-9);
  std::fill(ring.values.begin(), ring.values.end(), 1.0);
  EXPECT_TRUE(minima_of(ring).empty());
}

/// The pixel at the middle of a picture without legends, and the brightness of a pixel.
int brightness(const std::array<uint8_t, 4>& p) { return p[0] + p[1] + p[2]; }

ApexView small(ApexView::From from) {
  ApexView view;
  view.width = view.height = 300;
  view.legend = false;
  view.from = from;
  return view;
}

TEST(ApexScene, PrimordiaStandWhereTheyAreAndHideWhatIsBehind) {
  ApexPicture apex;
  apex.profile = dome();
  Bump front, back;
  front.theta = 90 * degree, back.theta = 270 * degree;
  front.arc = back.arc = 3;
  front.radius = back.radius = 0.4;
  front.value = 1, back.value = 0;
  apex.primordia = {front, back};
  ApexView view = small(ApexView::From::side);
  view.by = ApexView::By::value;
  view.palette = palette_through({parse_colour("blue"), parse_colour("red")});
  view.reach = 5;
  const Picture side = render(scene_of_apex(apex, view));
  int red = 0, blue = 0;
  for (size_t i = 0; i < side.rgba.size(); i += 4) {
    red += side.rgba[i] > 90 && side.rgba[i + 2] < 30 && side.rgba[i + 1] < 30;
    blue += side.rgba[i + 2] > 60 && side.rgba[i] < 30 && side.rgba[i + 1] < 30;
  }
  EXPECT_GT(red, 800);
  EXPECT_EQ(blue, 0);
  view.turn = M_PI;
  const Picture other = render(scene_of_apex(apex, view));
  red = 0;
  for (size_t i = 0; i < other.rgba.size(); i += 4)
    red += other.rgba[i] > 90 && other.rgba[i + 2] < 30 && other.rgba[i + 1] < 30;
  EXPECT_EQ(red, 0);
}

TEST(ApexScene, FromAboveAnglesRunClockwiseFromTheRight) {
  ApexPicture apex;
  apex.profile = disc();
  Bump bump;
  bump.theta = 90 * degree, bump.arc = 6, bump.radius = 2, bump.height = 0;
  apex.primordia = {bump};
  ApexView view = small(ApexView::From::top);
  view.by = ApexView::By::plain;
  view.plain = parse_colour("red");
  view.surface = white;
  view.reach = 10;
  const Picture p = render(scene_of_apex(apex, view));
  const auto below = p.at(150, 150 + static_cast<int>(6 * 14.1)), above = p.at(150, 150 - static_cast<int>(6 * 14.1));
  EXPECT_LT(below[1], 40);
  EXPECT_GT(above[1], 90);
}

TEST(ApexScene, TheSurfaceCanShowAField) {
  ApexPicture apex;
  apex.profile = disc();
  apex.field = {4, {0, 10}, {0, 0, 0, 0, 1, 1, 1, 1}};
  ApexView view = small(ApexView::From::top);
  view.by = ApexView::By::field;
  view.palette = tunica::palette("greys");
  const Scene scene = scene_of_apex(apex, view);
  EXPECT_EQ(scene.points.size(), scene.point_colours.size());
  const Picture p = render(scene);
  EXPECT_GT(std::abs(brightness(p.at(150, 150)) - brightness(p.at(150 + 120, 150))), 200);
  EXPECT_NEAR(brightness(p.at(150 + 70, 150)), brightness(p.at(150, 150 + 70)), 12);
}

TEST(ApexScene, PicturesAreTheSameEachTime) {
  auto apex = lattice(dome(), 137.5, 1, 12, 0.2);
  apex.pair = {{2, 3}};
  ApexView view = small(ApexView::From::oblique);
  view.parastichies = view.labels = true;
  EXPECT_EQ(render(scene_of_apex(apex, view)).rgba, render(scene_of_apex(apex, view)).rgba);
}

TEST(ApexScene, PrimordiaLeaveRoomForEachOther) {
  const auto apex = lattice(disc(), 137.5, 1, 30, 0.2);
  const ApexView view;
  const DrawnApex drawn(apex, view);
  for (size_t i = 0; i < 30; ++i)
    for (size_t k = 0; k < i; ++k) {
      const auto &a = drawn.primordia[i], &b = drawn.primordia[k];
      EXPECT_LT(*a.radius + *b.radius,
                (drawn.surface.place(a.theta, a.arc) - drawn.surface.place(b.theta, b.arc)).norm());
    }
}

TEST(ApexScene, AnApexWithoutPrimordiaIsShownWhole) {
  ApexPicture apex;
  apex.profile = dome();
  EXPECT_GT(scene_of_apex(apex, small(ApexView::From::side)).points.size(), 100u);
}

TEST(ApexScene, RefusesWhatDoesNotFit) {
  const auto good = lattice(dome(), 137.5, 1, 5, 0.2);
  const auto refuses = [&](const char* words, auto change, auto set) {
    ApexPicture apex = good;
    ApexView view;
    change(apex), set(view);
    expect_fail(words, [&] { scene_of_apex(apex, view); });
  };
  const auto nothing = [](auto&) {};
  refuses(
      "two different points", [](ApexPicture& a) { a.profile.clear(); }, nothing);
  refuses(
      "angle of primordium 2", [](ApexPicture& a) { a.primordia[1].theta = NAN; }, nothing);
  refuses(
      "radius of primordium 1", [](ApexPicture& a) { a.primordia[0].radius = -1; }, nothing);
  refuses(
      "before the tip", [](ApexPicture& a) { a.primordia[0].arc = -1; }, nothing);
  refuses(
      "multiples of the jugacy",
      [](ApexPicture& a) {
        a.jugacy = 2, a.pair = {{3, 5}};
      },
      nothing);
  refuses("pair", nothing, [](ApexView& v) { v.parastichies = true; });
  refuses("no ring", nothing, [](ApexView& v) { v.arrows = true; });
  refuses("neither a field", nothing, [](ApexView& v) { v.by = ApexView::By::field; });
  refuses("reach", nothing, [](ApexView& v) { v.reach = -1; });
  refuses("from low to high", nothing, [](ApexView& v) { v.min = 2, v.max = 1; });
  refuses(
      "ascend",
      [](ApexPicture& a) {
        a.ring = FieldRing{1, {0, 2, 1}, {1, 1, 1}, {}, {}};
      },
      nothing);
  refuses(
      "was given 1 values",
      [](ApexPicture& a) {
        a.field = {3, {0, 1}, {1}};
      },
      nothing);
}

TEST(LatticeScene, DiscsLieAtTheirAngleAndLinesWrapAround) {
  auto apex = lattice(cylinder(), 137.5, 1, 20, 0.4);
  apex.pair = {{2, 3}};
  ApexView view;
  view.parastichies = true;
  const Scene scene = scene_of_lattice(apex, view);
  EXPECT_GE(scene.polygons.size(), 20u);
  double left = INFINITY, right = -INFINITY;
  for (const Line& line : scene.lines) {
    left = std::min({left, line.from.x(), line.to.x()});
    right = std::max({right, line.from.x(), line.to.x()});
  }
  EXPECT_LT(left, 0);
  EXPECT_GT(right, 2 * M_PI);
  EXPECT_GT(left, -0.9);
  EXPECT_LT(right, 2 * M_PI + 0.6);
  EXPECT_NO_THROW(render(scene));
  view.map = ApexView::Map::arc;
  EXPECT_NO_THROW(render(scene_of_lattice(apex, view)));
  apex.primordia[3].theta = 1e300;
  EXPECT_NO_THROW(render(scene_of_lattice(apex, view)));
  view.by = ApexView::By::field;
  expect_fail("no field", [&] { scene_of_lattice(apex, view); });
}

}  // namespace
}  // namespace tunica
