// SPDX-License-Identifier: MIT
#include "view/tissue_scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"
#include "tissue/builders.h"
#include "view/render.h"

namespace tunica {
namespace {

Column column(const char* name) {
  Column c;
  c.name = name;
  return c;
}

Column& numbered(Tissue& tissue) {
  Column& values = tissue.add_column(Kind::cell, column("auxin"));
  for (Index c = 0; c < tissue.cells(); ++c) values.values[static_cast<size_t>(c)] = c;
  return values;
}

ViewSettings showing(const char* name) {
  ViewSettings s;
  s.colour.column = name;
  return s;
}

/// A number of settings with `key` wrong, each named in the message.
void expect_error(const Tissue& tissue, const ViewSettings& settings, const char* words) {
  try {
    scene_of(tissue, settings);
    ADD_FAILURE() << "no error: " << words;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(TissueScene, EveryCellHasItsColourOfTheMap) {
  Tissue tissue = hexagons(5, 4);
  numbered(tissue);
  const ViewSettings s = showing("auxin");
  const Scene scene = scene_of(tissue, s);
  ASSERT_EQ(scene.polygons.size(), 20u);
  for (size_t c = 0; c < 20; ++c) {
    EXPECT_EQ(scene.polygons[c].fill, s.palette.at(static_cast<double>(c) / 19));
    EXPECT_EQ(scene.polygons[c].count, 6u);
  }
  EXPECT_EQ(scene.lines.size(), static_cast<size_t>(tissue.walls()));
  ASSERT_EQ(scene.bars.size(), 1u);
  EXPECT_EQ(scene.bars[0].title, "auxin");
  EXPECT_EQ(scene.bars[0].max, 19);
}

TEST(TissueScene, PicturesShowTheColoursOfTheLegend) {
  Tissue tissue = squares(3, 3);
  numbered(tissue);
  ViewSettings s = showing("auxin");
  s.width = s.height = 400;
  const Picture p = render(scene_of(tissue, s));
  int found = 0;
  for (int value = 0; value < 9; ++value) {
    const Colour wanted = s.palette.at(value / 8.0);
    int pixels = 0;
    for (int y = 0; y < 400; ++y)
      for (int x = 0; x < 320; ++x)
        pixels += std::abs(p.at(x, y)[0] - 255 * wanted.r) < 1 && std::abs(p.at(x, y)[1] - 255 * wanted.g) < 1;
    found += pixels > 3000;
  }
  EXPECT_EQ(found, 9);
}

TEST(TissueScene, CellsWithoutValueAreShownAsSuch) {
  Tissue tissue = hexagons(3, 3);
  numbered(tissue).values[4] = NAN;
  ViewSettings s = showing("auxin");
  Scene scene = scene_of(tissue, s);
  EXPECT_EQ(scene.polygons[4].fill, s.palette.missing);
  ASSERT_EQ(scene.keys.size(), 1u);
  EXPECT_EQ(scene.keys[0].text, "no value");
  s.palette.missing = parse_colour("black"), s.missing_title = "dead";
  scene = scene_of(tissue, s);
  EXPECT_EQ(scene.polygons[4].fill, parse_colour("black"));
  EXPECT_EQ(scene.keys[0].text, "dead");
}

TEST(TissueScene, BandsLieInTheirCellAlongTheirWall) {
  Tissue tissue = hexagons(3, 3);
  Column& pin = tissue.add_column(Kind::side, column("pin"));
  const Index cell = 4;
  Index side = tissue.first_side(cell);
  pin.values[static_cast<size_t>(side)] = 2;
  pin.values[static_cast<size_t>(tissue.next(side))] = 1;
  ViewSettings s;
  s.sides.column = "pin";
  s.sides_max = 2;
  const Scene scene = scene_of(tissue, s);
  ASSERT_EQ(scene.bands.size(), 2u);
  for (const Polygon& band : scene.bands) {
    Vec3 sum = Vec3::Zero();
    for (uint32_t k = 0; k < 4; ++k) {
      const Vec3& corner = scene.points[scene.indices[band.first + k]];
      sum += corner / 4;
      if (k >= 2) continue;
      EXPECT_LT((corner - tissue.position(k ? tissue.end(side) : tissue.start(side))).norm(), 1e-12);
    }
    EXPECT_LT((sum - tissue.centroid(cell)).norm(), (sum - tissue.centroid(tissue.neighbour(side))).norm());
    // As thick as the value says: the widest is a fifth of a cell.
    const Vec3 &a = scene.points[scene.indices[band.first]], &b = scene.points[scene.indices[band.first + 1]],
               &c = scene.points[scene.indices[band.first + 2]];
    const double thickness = (b - a).cross(c - a).norm() / (b - a).norm();
    EXPECT_NEAR(thickness, 0.2 * pin.values[static_cast<size_t>(side)] / 2, 1e-9);
    side = tissue.next(side);
  }
}

TEST(TissueScene, IntensityOfBandsRunsFromTheCellToTheirColour) {
  Tissue tissue = hexagons(2, 1);
  Column& pin = tissue.add_column(Kind::side, column("pin"));
  pin.values[0] = 1;
  ViewSettings s;
  s.sides.column = "pin";
  s.sides_by_width = false;
  s.sides_max = 1;
  EXPECT_EQ(scene_of(tissue, s).bands.at(0).fill, s.sides_colour);
}

TEST(TissueScene, ARingIsBarsAndAGridIsSquares) {
  Tissue circle = ring(12);
  numbered(circle);
  const Scene bars = scene_of(circle, showing("auxin"));
  ASSERT_EQ(bars.polygons.size(), 12u);
  const auto height = [&](size_t c) {
    const Polygon& p = bars.polygons[c];
    return bars.points[bars.indices[p.first + 2]].y() - bars.points[bars.indices[p.first]].y();
  };
  for (size_t c = 1; c < 12; ++c) EXPECT_NEAR(height(c), height(1) * static_cast<double>(c), 1e-9);
  EXPECT_TRUE(bars.bars.empty());

  Tissue field = grid(4, 3, Wrap::both);
  numbered(field);
  Column& pin = field.add_column(Kind::side, column("pin"));
  for (Index s = 0; s < field.sides(); ++s) pin.values[static_cast<size_t>(s)] = 1;
  ViewSettings settings = showing("auxin");
  settings.sides.column = "pin";
  const Scene squares = scene_of(field, settings);
  EXPECT_EQ(squares.polygons.size(), 12u);
  // Each side of a cell that is closed around has its own edge.
  EXPECT_EQ(squares.bands.size(), 48u);
  for (size_t i = 0; i < 48; ++i)
    for (size_t j = 0; j < i; ++j)
      EXPECT_NE(squares.points[squares.indices[squares.bands[i].first + 2]],
                squares.points[squares.indices[squares.bands[j].first + 2]]);
}

TEST(TissueScene, ACylinderThroughPlacesIsAClosedSurface) {
  Tissue tissue = cylinder(10, 4);
  ViewSettings s;
  for (Index c = 0; c < tissue.cells(); ++c) {
    const double angle = 2 * M_PI * (c % 10) / 10;
    s.place.emplace_back(std::cos(angle), std::sin(angle), -c / 10);
  }
  const Scene scene = scene_of(tissue, s);
  EXPECT_EQ(scene.polygons.size(), 4u * 10 * 3);
  EXPECT_EQ(scene.lines.size(), static_cast<size_t>(tissue.walls()));
  Vec3 area = Vec3::Zero();
  for (const Polygon& face : scene.polygons) {
    const auto at = [&](uint32_t k) { return scene.points[scene.indices[face.first + k]]; };
    area += (at(1) - at(0)).cross(at(2) - at(0));
  }
  EXPECT_LT(area.norm(), 1e-9);
}

TEST(TissueScene, ScalesAreWhatAReaderExpects) {
  using Type = Palette::Type;
  EXPECT_EQ(scale_of({0.1, 2, NAN}, Type::sequential), std::pair(0.0, 2.0));
  EXPECT_EQ(scale_of({1.8, 2}, Type::sequential), std::pair(1.8, 2.0));
  EXPECT_EQ(scale_of({-1, 3}, Type::sequential), std::pair(-1.0, 3.0));
  EXPECT_EQ(scale_of({-1, 3}, Type::diverging), std::pair(-3.0, 3.0));
  EXPECT_EQ(scale_of({2, 2}, Type::sequential), std::pair(1.0, 3.0));
  EXPECT_EQ(scale_of({0, 0}, Type::sequential), std::pair(-0.5, 0.5));
  EXPECT_EQ(scale_of({NAN, INFINITY}, Type::sequential), std::pair(0.0, 1.0));
  EXPECT_EQ(scale_of({}, Type::sequential), std::pair(0.0, 1.0));
}

TEST(TissueScene, RefusesWhatDoesNotFit) {
  Tissue tissue = hexagons(3, 3);
  numbered(tissue);
  expect_error(tissue, showing("auxim"), "did you mean 'auxin'");
  ViewSettings s;
  s.colour.values = {1, 2};
  expect_error(tissue, s, "9 cells was given 2 values");
  s = {};
  s.labels = {"a"};
  expect_error(tissue, s, "1 labels");
  s = {};
  s.bars = true;
  expect_error(tissue, s, "cells with shapes");
  s = {};
  s.place.assign(9, Vec3::Zero());
  expect_error(tissue, s, "without geometry");
  s = showing("auxin");
  s.min = 3, s.max = 3;
  expect_error(tissue, s, "from low to high");
  const Tissue field = grid(3, 3);
  s = {};
  s.bars = true;
  expect_error(field, s, "several rows");
  s = {};
  s.place.assign(9, Vec3(NAN, 0, 0));
  expect_error(field, s, "not finite");
}

}  // namespace
}  // namespace tunica
