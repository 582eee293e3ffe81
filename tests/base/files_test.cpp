// SPDX-License-Identifier: MIT
#include "base/files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "base/error.h"

namespace tunica {
namespace {

class Files : public testing::Test {
 protected:
  Files()
      : folder_(testing::TempDir() + "tunica_files_" + testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::remove_all(folder_);
    make_folders(folder_);
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string folder_;
};

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(Files, WhatIsWrittenIsRead) {
  const std::string bytes("\0a\r\n\xff", 5);
  write_atomic(path("a"), bytes);
  EXPECT_EQ(read_file(path("a")), bytes);
  write_atomic(path("a"), "shorter");
  EXPECT_EQ(read_file(path("a")), "shorter");
}

TEST_F(Files, WritingLeavesNothingElse) {
  write_atomic(path("b"), "1");
  write_atomic(path("a"), "2");
  EXPECT_EQ(list_folder(folder_), (std::vector<std::string>{"a", "b"}));
}

TEST_F(Files, AFailedWriteLeavesTheOldContent) {
  std::filesystem::create_directories(path("taken"));
  EXPECT_NE(message_of([&] { write_atomic(path("taken"), "x"); }), "");
  EXPECT_EQ(list_folder(folder_), (std::vector<std::string>{"taken"}));
}

TEST_F(Files, ErrorsNameThePathAndTheReason) {
  EXPECT_NE(message_of([&] { read_file(path("none")); }).find("none': No such file"), std::string::npos);
  EXPECT_NE(message_of([&] { read_file(folder_); }).find("it is a folder"), std::string::npos);
  EXPECT_NE(message_of([&] { write_atomic(path("no/where"), ""); }).find("no/where"), std::string::npos);
  EXPECT_NE(message_of([&] { list_folder(path("none")); }).find("none"), std::string::npos);
  EXPECT_NE(message_of([&] { rename_synced(path("none"), path("x")); }).find("none"), std::string::npos);
}

TEST_F(Files, FilesLargerThanTheLimitAreRefused) {
  write_atomic(path("large"), std::string(1000, 'x'));
  EXPECT_EQ(read_file(path("large"), 1000).size(), 1000u);
  EXPECT_THROW(read_file(path("large"), 999), Error);
  EXPECT_THROW(read_file("/dev/zero", 1 << 20), Error);
}

}  // namespace
}  // namespace tunica
