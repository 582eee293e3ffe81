// SPDX-License-Identifier: MIT
#include "base/container.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace tunica {
namespace {

const std::map<std::string, std::string_view> sections = {
    {"empty", ""}, {"model", {"\0\x1b\xff bytes", 9}}, {"series", "time,cells\n0,1\n"}};

TEST(Container, GivesBackWhatWasPacked) {
  const std::map<std::string, std::string> back = unpack_sections(pack_sections(sections));
  EXPECT_EQ((std::map<std::string, std::string_view>(back.begin(), back.end())), sections);
  EXPECT_TRUE(unpack_sections(pack_sections({})).empty());
}

TEST(Container, TheSameSectionsGiveTheSameBytes) { EXPECT_EQ(pack_sections(sections), pack_sections(sections)); }

TEST(Container, EveryCutIsFound) {
  const std::string bytes = pack_sections(sections);
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(unpack_sections(bytes.substr(0, size)), Error) << "cut to " << size;
  EXPECT_THROW(unpack_sections(bytes + "x"), Error);
}

TEST(Container, EveryFlippedBitIsFound) {
  const std::string bytes = pack_sections(sections);
  for (size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      EXPECT_THROW(unpack_sections(damaged), Error) << "byte " << i << " bit " << bit;
    }
}

}  // namespace
}  // namespace tunica
