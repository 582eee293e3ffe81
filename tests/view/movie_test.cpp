// SPDX-License-Identifier: MIT
#include "view/movie.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"

namespace tunica {
namespace {

Picture plain(int width, int height, uint8_t grey, uint8_t alpha = 255) {
  Picture p{width, height, {}};
  for (int i = 0; i < width * height; ++i) p.rgba.insert(p.rgba.end(), {grey, grey, grey, alpha});
  return p;
}

class MovieTest : public testing::Test {
 protected:
  MovieTest() {
    char name[] = "/tmp/tunica-movie-XXXXXX";
    folder_ = mkdtemp(name);
    path_ = folder_ + "/film.mp4";
  }
  ~MovieTest() override { std::filesystem::remove_all(folder_); }

  /// What ffmpeg reads back: all frames as grey bytes.
  std::string decoded() const {
    const std::string out = folder_ + "/raw";
    const std::string command = "ffmpeg -nostdin -loglevel error -y -i " + path_ + " -f rawvideo -pix_fmt gray " + out;
    EXPECT_EQ(std::system(command.c_str()), 0);
    return read_file(out);
  }

  std::string folder_, path_;
};

TEST_F(MovieTest, HoldsEveryPictureAtAnEvenSize) {
  Movie movie(path_, 10);
  for (int i = 0; i < 7; ++i) movie.add(plain(101, 63, static_cast<uint8_t>(30 * i)));
  EXPECT_FALSE(std::filesystem::exists(path_));
  movie.finish();
  EXPECT_EQ(list_folder(folder_), std::vector<std::string>{"film.mp4"});
  const std::string raw = decoded();
  const size_t frame = 102 * 64;
  ASSERT_EQ(raw.size(), 7 * frame);
  for (size_t i = 0; i < 7; ++i)
    for (const size_t pixel : {size_t{0}, frame / 2, frame - 1})
      EXPECT_NEAR(static_cast<unsigned char>(raw[i * frame + pixel]), 30 * static_cast<int>(i), 8) << i;
}

TEST_F(MovieTest, TransparentPartsComeUponWhite) {
  Movie movie(path_);
  movie.add(plain(64, 64, 0, 0));
  movie.finish();
  EXPECT_GT(static_cast<unsigned char>(decoded()[100]), 245);
}

TEST_F(MovieTest, TheSamePicturesGiveTheSameBytes) {
  std::string bytes[2];
  for (std::string& each : bytes) {
    Movie movie(path_);
    for (int i = 0; i < 30; ++i) movie.add(plain(64, 64, static_cast<uint8_t>(i * 8)));
    movie.finish();
    each = read_file(path_);
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST_F(MovieTest, UnfinishedOnesLeaveNothing) {
  {
    Movie movie(path_);
    movie.add(plain(64, 64, 0));
  }
  EXPECT_TRUE(list_folder(folder_).empty());
}

TEST_F(MovieTest, RefusesWrongInput) {
  EXPECT_THROW(Movie("film.avi"), Error);
  EXPECT_THROW(Movie(path_, 0), Error);
  EXPECT_THROW(Movie(path_).finish(), Error);
  Movie movie(path_);
  EXPECT_THROW(movie.add(plain(8, 8, 0)), Error);
  movie.add(plain(64, 64, 0));
  EXPECT_THROW(movie.add(plain(64, 66, 0)), Error);
  movie.finish();
  EXPECT_THROW(movie.add(plain(64, 64, 0)), Error);
}

TEST_F(MovieTest, SaysWhatFfmpegSays) {
  Movie movie(folder_ + "/no/such/folder/film.mp4");
  try {
    // Enough to fill any buffer: the encoder has gone by then, which must not kill this process.
    for (int i = 0; i < 50; ++i) movie.add(plain(500, 500, 0));
    movie.finish();
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
}

TEST_F(MovieTest, NamesThePackageWhenFfmpegIsMissing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  Movie movie(path_);
  try {
    movie.add(plain(64, 64, 0));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("apt-get install ffmpeg"), std::string::npos) << error.what();
  }
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace tunica
