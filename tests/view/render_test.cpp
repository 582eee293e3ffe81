// SPDX-License-Identifier: MIT
#include "view/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "base/error.h"
#include "view/gnuplot.h"
#include "view/legend.h"
#include "view/palette.h"
#include "view/png.h"

namespace tunica {
namespace {

constexpr Colour red{1, 0, 0, 1}, blue{0, 0, 1, 1};

Scene small_scene(int width = 200, int height = 200) {
  Scene scene;
  scene.width = width, scene.height = height;
  // A world of -10 to 10 whatever is in it; then 1 unit is a fixed number of pixels.
  scene.camera.centre = Vec3(0, 0, 0);
  scene.camera.extent = 10;
  return scene;
}

/// Pixels per unit of small_scene: it leaves a margin of 3 %.
double scale(const Scene& scene) {
  const double shorter = std::min(scene.width, scene.height);
  return (shorter - 2 * std::max(4.0, std::round(0.03 * shorter))) / 20;
}

std::vector<Vec3> box(double x0, double y0, double x1, double y1, double z = 0) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

using Pixel = std::array<uint8_t, 4>;
constexpr Pixel red_pixel{255, 0, 0, 255}, blue_pixel{0, 0, 255, 255}, white_pixel{255, 255, 255, 255};

/// Coverage of red over a white ground, in pixels: edges count in part.
double red_area(const Picture& p) {
  double sum = 0;
  for (size_t i = 0; i < p.rgba.size(); i += 4) sum += (255 - p.rgba[i + 1]) / 255.0;
  return sum;
}

TEST(Render, AreasAreRight) {
  Scene scene = small_scene(400, 400);
  scene.add(scene.polygons, box(-3.3, -2.1, 4.7, 5.9), red);
  EXPECT_NEAR(red_area(render(scene)), 64 * scale(scene) * scale(scene), 0.002 * 64 * scale(scene) * scale(scene));
}

TEST(Render, NonConvexAreaIsRightWithinOnePercent) {
  Scene scene = small_scene(400, 400);
  std::vector<Vec3> star;
  double area = 0;
  for (int k = 0; k < 22; ++k) {
    const double r = k % 2 ? 3 : 9, angle = 2 * M_PI * k / 22;
    star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    area += 0.5 * 27 * std::sin(2 * M_PI / 22);
  }
  scene.add(scene.polygons, star, red);
  EXPECT_NEAR(red_area(render(scene)) / (scale(scene) * scale(scene)), area, 0.01 * area);
}

TEST(Render, ThinLinesKeepTheirWidth) {
  Scene scene = small_scene(400, 400);
  scene.lines.push_back({{-8, -5, 0}, {8, 7, 0}, red, 1.2f});
  const double length = 20 * scale(scene);
  EXPECT_NEAR(red_area(render(scene)), (length + 1.2) * 1.2, 0.02 * length * 1.2);
}

TEST(Render, RotatedScenesGiveRotatedPictures) {
  Scene scene = small_scene(), turned = small_scene();
  const std::vector<Vec3> shape = {{-8, -6, 0}, {5, -7.3, 0}, {7.1, 2, 0}, {-1, 1.7, 0}, {0, 8.2, 0}};
  std::vector<Vec3> quarter;
  for (const Vec3& p : shape) quarter.emplace_back(-p.y(), p.x(), 0);
  scene.add(scene.polygons, shape, red);
  turned.add(turned.polygons, quarter, red);
  const Picture a = render(scene), b = render(turned);
  // The samples of a pixel are arranged alike after a quarter turn; mirrored they are not, which softens edges
  // otherwise.
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(a.at(x, y)[c], b.at(y, 199 - x)[c], 2) << x << " " << y;
}

TEST(Render, MirroredScenesGiveMirroredPictures) {
  Scene scene = small_scene();
  for (const double side : {-1.0, 1.0})
    scene.add(scene.polygons, std::vector<Vec3>{{side * 2, -3, 0}, {side * 8, 0, 0}, {side * 3, 7, 0}}, red);
  const Picture p = render(scene);
  double difference = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 100; ++x) {
      EXPECT_NEAR(p.at(x, y)[1], p.at(199 - x, y)[1], 80);
      difference += p.at(x, y)[1] - p.at(199 - x, y)[1];
    }
  EXPECT_LT(std::abs(difference) / 255, 4);
}

TEST(Render, TheSameSceneGivesTheSamePixelsInAnyThread) {
  Scene scene = small_scene();
  scene.title = "t = 1.5";
  scene.add(scene.polygons, std::vector<Vec3>{{-8, -6, 0}, {5, -7, 0}, {0, 8, 0}}, red);
  scene.markers.push_back({{1, 2, 0}, Marker::Shape::ring, blue, 20});
  const Picture first = render(scene);
  EXPECT_EQ(first.rgba, render(scene).rgba);
  Picture other;
  std::thread([&] { other = render(scene); }).join();
  EXPECT_EQ(first.rgba, other.rgba);
}

TEST(Render, MarkersOnASlopeAreWhole) {
  Scene scene = small_scene();
  // A plane that rises by 2 for each unit to the right, towards the viewer: half of an upright disc would be inside it.
  scene.add(scene.polygons, std::vector<Vec3>{{-8, -8, -16}, {8, -8, 16}, {8, 8, 16}, {-8, 8, -16}}, red);
  scene.markers.push_back({{1, 2, 2}, Marker::Shape::disc, blue, 20});
  const Picture p = render(scene);
  double blue_area = 0;
  for (size_t i = 0; i < p.rgba.size(); i += 4) blue_area += p.rgba[i] < 128 && p.rgba[i + 2] > 128;
  EXPECT_NEAR(blue_area, M_PI * 100, 10);
}

TEST(Render, LargePicturesAreOnePieceAcrossTiles) {
  Scene scene = small_scene(2100, 1300);
  scene.add(scene.polygons, box(-9, -9, 9, 9), red);
  const Picture p = render(scene);
  const double s = scale(scene);
  for (const int x : {1023, 1024, 1050})
    for (const int y : {110, 1020, 1023, 1024}) EXPECT_EQ(p.at(x, y), red_pixel) << x << " " << y;
  EXPECT_NEAR(red_area(p), 18 * 18 * s * s, 0.001 * 18 * 18 * s * s);
}

TEST(Render, TransparentGroundHasNoCoverageAndEdgesKeepTheirColour) {
  Scene scene = small_scene();
  scene.background = clear;
  std::vector<Vec3> disc;
  for (int k = 0; k < 90; ++k) disc.emplace_back(6 * std::cos(k * M_PI / 45), 6 * std::sin(k * M_PI / 45), 0);
  scene.add(scene.polygons, disc, Colour{.8f, .4f, .2f, 1});
  const Picture p = render(scene);
  EXPECT_EQ(p.at(2, 2), (Pixel{0, 0, 0, 0}));
  EXPECT_EQ(p.at(100, 100), (Pixel{204, 102, 51, 255}));
  int edges = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const Pixel q = p.at(x, y);
      if (q[3] < 64 || q[3] == 255) continue;
      ++edges;
      EXPECT_NEAR(q[0], 204, 4);
      EXPECT_NEAR(q[1], 102, 4);
      EXPECT_NEAR(q[2], 51, 4);
    }
  EXPECT_GT(edges, 100);
}

TEST(Render, WhatIsNearerHidesWhatIsFartherInSpace) {
  Scene scene = small_scene();
  scene.add(scene.polygons, box(-5, -5, 5, 5, 2), red);
  scene.add(scene.polygons, box(-8, -8, 8, 8, -2), blue);
  EXPECT_EQ(render(scene).at(100, 100), red_pixel);
  scene.camera.direction = Vec3(0, 0, 1);
  EXPECT_EQ(render(scene).at(100, 100), blue_pixel);
  scene.camera.perspective = true;
  EXPECT_EQ(render(scene).at(100, 100), blue_pixel);
}

TEST(Render, UpIsUp) {
  Scene scene = small_scene();
  scene.add(scene.polygons, box(-5, 3, 5, 8), red);
  scene.add(scene.polygons, box(-8, -8, -3, -3), blue);
  const Picture p = render(scene);
  EXPECT_EQ(p.at(100, 50), red_pixel);
  EXPECT_EQ(p.at(50, 150), blue_pixel);
  EXPECT_EQ(p.at(150, 150), white_pixel);
}

TEST(Render, TheColourBarShowsTheMapFromEndToEnd) {
  Scene scene = small_scene(400, 400);
  scene.add(scene.polygons, box(-5, -5, 5, 5), red);
  scene.bars.push_back({palette("viridis").colours, 0, 1, "auxin"});
  const Legend legend(scene);
  const Rect& bar = legend.bar(0);
  const Picture p = render(scene);
  const int x = static_cast<int>(bar.x + bar.width / 2), height = static_cast<int>(bar.height);
  for (int row = 0; row < height; ++row) {
    const Colour expected = palette("viridis").at(1 - (row + 0.5) / height);
    const Pixel got = p.at(x, static_cast<int>(bar.y) + row);
    EXPECT_NEAR(got[0], 255 * expected.r, 1);
    EXPECT_NEAR(got[1], 255 * expected.g, 1);
    EXPECT_NEAR(got[2], 255 * expected.b, 1);
  }
}

TEST(Render, ContentDoesNotRunIntoTheLegend) {
  Scene scene = small_scene(400, 400);
  scene.camera.zoom = 50;
  scene.add(scene.polygons, box(-9, -9, 9, 9), red);
  scene.keys.push_back({blue, "key"});
  const Picture p = render(scene);
  const Rect frame = Legend(scene).frame();
  EXPECT_EQ(p.at(static_cast<int>(frame.x + frame.width / 2), 200), red_pixel);
  for (int y = 0; y < 400; ++y) EXPECT_NE(p.at(static_cast<int>(frame.x + frame.width) + 4, y), red_pixel);
}

TEST(Render, LitSurfacesAreDarkerWhereTheyTurnAway) {
  Scene scene = small_scene();
  scene.light.on = true;
  scene.light.from = Vec3(0, 0, 1);
  scene.add(scene.polygons, box(-9, -9, -1, 9), white);
  scene.add(scene.polygons, std::vector<Vec3>{{1, -9, 0}, {9, -9, -8}, {9, 9, -8}, {1, 9, 0}}, white);
  const Picture p = render(scene);
  EXPECT_EQ(p.at(50, 100)[0], 255);
  EXPECT_NEAR(p.at(150, 100)[0], 255 * (0.5 + 0.5 * std::sqrt(0.5)), 2);
}

TEST(Render, LabelsAreDrawnWhereTheySay) {
  Scene scene = small_scene();
  scene.add(scene.polygons, box(-9, -9, 9, 9), white);
  scene.labels.push_back({{0, 0, 0}, "W\u00e4\u2264\xff", black, 40});
  const Picture p = render(scene);
  double ink = 0, x_sum = 0, y_sum = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const double dark = 255 - p.at(x, y)[0];
      ink += dark, x_sum += dark * x, y_sum += dark * y;
    }
  EXPECT_GT(ink, 255 * 300);
  EXPECT_NEAR(x_sum / ink, 100, 12);
  EXPECT_NEAR(y_sum / ink, 100, 8);
}

TEST(Render, RefusesWhatCannotBeDrawn) {
  Scene scene = small_scene();
  scene.width = 15;
  EXPECT_THROW(render(scene), Error);
  scene.width = 20000;
  EXPECT_THROW(render(scene), Error);
  scene = small_scene();
  scene.camera.direction = Vec3(0, 0, 0);
  EXPECT_THROW(render(scene), Error);
  scene = small_scene();
  scene.camera.zoom = 0;
  EXPECT_THROW(render(scene), Error);
  scene = small_scene();
  scene.add(scene.polygons, box(0, 0, NAN, 1), red);
  EXPECT_THROW(render(scene), Error);
  scene = small_scene();
  scene.polygons.push_back({0, 4, red});
  EXPECT_THROW(render(scene), Error);
  scene = small_scene();
  scene.lines.push_back({{0, 0, 0}, {INFINITY, 0, 0}});
  EXPECT_THROW(render(scene), Error);
}

TEST(Render, AnEmptySceneIsItsGround) {
  Scene scene;
  scene.width = scene.height = 32;
  for (const uint8_t byte : render(scene).rgba) EXPECT_EQ(byte, 255);
}

TEST(Render, StopsWhenCancelled) {
  CancelFlag cancel;
  Scene scene = small_scene(3000, 3000);
  scene.cancel = &cancel;
  for (int i = 0; i < 100; ++i) scene.add(scene.polygons, box(-5, -5, 5, 5), red);
  const Picture whole = render(scene);
  cancel.request();
  EXPECT_THROW(render(scene), Cancelled);
  EXPECT_THROW(encode_png(whole, {}, &cancel), Cancelled);
  EXPECT_THROW(run_gnuplot("pause 10", &cancel), Cancelled);
  cancel.clear();
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    cancel.request();
  });
  EXPECT_THROW(while (true) render(scene), Cancelled);
  later.join();
  cancel.clear();
  EXPECT_EQ(render(scene).rgba, whole.rgba);
}

TEST(Ticks, AreRoundNumbersWithinTheScale) {
  const auto texts = [](double min, double max) {
    std::vector<std::string> list;
    for (const Tick& tick : ticks_between(min, max, 5)) list.push_back(tick.text);
    return list;
  };
  EXPECT_EQ(texts(0, 1), (std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(texts(0, 50), (std::vector<std::string>{"0", "10", "20", "30", "40", "50"}));
  EXPECT_EQ(texts(-1, 1), (std::vector<std::string>{"\u22121.0", "\u22120.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(texts(0, 2e6), (std::vector<std::string>{"0.0e+00", "5.0e+05", "1.0e+06", "1.5e+06", "2.0e+06"}));
  EXPECT_TRUE(ticks_between(1, 1, 5).empty());
  EXPECT_TRUE(ticks_between(0, INFINITY, 5).empty());
  for (const double size : {1e-12, 3e-4, 0.7, 12.0, 4e9})
    for (const Tick& tick : ticks_between(size, 2.3 * size, 5)) {
      EXPECT_GE(tick.value, size);
      EXPECT_LE(tick.value, 2.3 * size);
    }
}

}  // namespace
}  // namespace tunica
