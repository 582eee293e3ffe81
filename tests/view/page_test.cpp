// SPDX-License-Identifier: MIT
#include "view/page.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace tunica {
namespace {

using Pixel = std::array<uint8_t, 4>;

Picture plain(int width, int height, const Pixel& pixel) {
  Picture picture{width, height, {}};
  for (int i = 0; i < width * height; ++i) picture.rgba.insert(picture.rgba.end(), pixel.begin(), pixel.end());
  return picture;
}

constexpr Pixel red{255, 0, 0, 255}, blue{0, 0, 255, 255}, white_pixel{255, 255, 255, 255};

TEST(Page, PicturesStandRowByRow) {
  PageSettings settings;
  settings.columns = 2, settings.gap = 5;
  const Picture page =
      page_of({{plain(20, 10, red), ""}, {plain(20, 10, blue), ""}, {plain(10, 10, blue), ""}}, settings);
  EXPECT_EQ(page.width, 3 * 5 + 2 * 20);
  EXPECT_EQ(page.height, 3 * 5 + 2 * 10);
  EXPECT_EQ(page.at(5, 5), red);
  EXPECT_EQ(page.at(24, 14), red);
  EXPECT_EQ(page.at(25, 14), white_pixel);
  EXPECT_EQ(page.at(30, 5), blue);
  EXPECT_EQ(page.at(9, 20), white_pixel);  // the smaller one stands in the middle of its place
  EXPECT_EQ(page.at(10, 20), blue);
  EXPECT_EQ(page.at(35, 25), white_pixel);
}

TEST(Page, IsAsSquareAsItGets) {
  PageSettings settings;
  settings.gap = 0;
  EXPECT_EQ(page_of(std::vector<Tile>(25, {plain(4, 4, red), ""}), settings).width, 20);
  EXPECT_EQ(page_of(std::vector<Tile>(7, {plain(4, 4, red), ""}), settings).width, 12);
}

TEST(Page, CaptionsStandBelowAndNeverReachBeyondTheirPicture) {
  PageSettings settings;
  settings.gap = 10;
  settings.title = "title";
  const Picture page = page_of({{plain(60, 60, red), "a caption that is much too long for its place"}}, settings);
  EXPECT_GT(page.height, 100);
  int ink = 0;
  for (int y = 0; y < page.height; ++y)
    for (int x = 0; x < page.width; ++x) {
      const bool beside = x < 9 || x > page.width - 10;
      const bool dark = page.at(x, y)[1] < 128 && page.at(x, y) != red;
      ink += dark;
      EXPECT_FALSE(beside && dark);
    }
  EXPECT_GT(ink, 20);
}

TEST(Page, GroundShowsThroughTransparentPictures) {
  PageSettings settings;
  settings.background = Colour{0, 0, 1, 1};
  EXPECT_EQ(page_of({{plain(4, 4, {255, 0, 0, 0}), ""}}, settings).at(13, 13), blue);
}

TEST(Page, RefusesWhatCannotBe) {
  EXPECT_THROW(page_of({}, {}), Error);
  PageSettings settings;
  settings.gap = 9000;
  EXPECT_THROW(page_of(std::vector<Tile>(4, {plain(4, 4, red), ""}), settings), Error);
  settings.gap = -1;
  EXPECT_THROW(page_of({{plain(4, 4, red), ""}}, settings), Error);
}

}  // namespace
}  // namespace tunica
