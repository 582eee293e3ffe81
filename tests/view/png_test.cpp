// SPDX-License-Identifier: MIT
#include "view/png.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"

namespace tunica {
namespace {

Picture noise(int width, int height, bool opaque) {
  Picture p{width, height, {}};
  for (int i = 0; i < 4 * width * height; ++i)
    p.rgba.push_back(static_cast<uint8_t>(256 * uniform({1, purpose("noise"), static_cast<uint64_t>(i), 0})));
  for (size_t i = 3; opaque && i < p.rgba.size(); i += 4) p.rgba[i] = 255;
  return p;
}

TEST(Png, GivesBackEveryPixel) {
  for (const bool opaque : {true, false}) {
    const Picture p = noise(37, 21, opaque), back = decode_png(encode_png(p));
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 21);
    EXPECT_EQ(back.rgba, p.rgba);
  }
}

TEST(Png, TheSamePictureGivesTheSameBytes) {
  const PngTexts texts = {{"Software", "tunica"}, {"tunica:parameters", "{\"D\":1}"}};
  EXPECT_EQ(encode_png(noise(50, 50, false), texts), encode_png(noise(50, 50, false), texts));
}

TEST(Png, KeepsTexts) {
  const PngTexts texts = {{"Software", "tunica 0.1"}, {"tunica:parameters", "\u03ba = 2"}, {"empty", ""}};
  EXPECT_EQ(png_texts(encode_png(noise(5, 5, true), texts)), texts);
}

TEST(Png, RefusesWrongInput) {
  EXPECT_THROW(encode_png(Picture{4, 4, std::vector<uint8_t>(63)}), Error);
  EXPECT_THROW(encode_png(Picture{0, 0, {}}), Error);
  EXPECT_THROW(encode_png(Picture{-1, 4, {}}), Error);
  EXPECT_THROW(encode_png(noise(2, 2, true), {{"", "x"}}), Error);
  EXPECT_THROW(encode_png(noise(2, 2, true), {{std::string(80, 'k'), "x"}}), Error);
  EXPECT_THROW(decode_png("not a png"), Error);
  EXPECT_THROW(decode_png(""), Error);
  EXPECT_THROW(png_texts("not a png"), Error);
}

TEST(Png, DamagedFilesAreErrorsOrPicturesNeverCrashes) {
  const std::string good = encode_png(noise(20, 20, false), {{"Software", "tunica"}, {"more", "\u03ba"}});
  for (size_t i = 0; i < good.size(); i += 3) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    for (const std::string& bytes : {bad, good.substr(0, i)}) {
      try {
        decode_png(bytes);
      } catch (const Error&) {
      }
      try {
        png_texts(bytes);
      } catch (const Error&) {
      }
    }
  }
}

}  // namespace
}  // namespace tunica
