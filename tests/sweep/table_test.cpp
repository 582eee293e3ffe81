// SPDX-License-Identifier: MIT
// The file of a sweep when it is damaged, or something else: an error that says so, before anything is read or written.
#include "sweep/table.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"

namespace tunica::sweep {
namespace {

namespace fs = std::filesystem;

class TableFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("tunica_table_test_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    Table table(good(), Table::Mode::write);
    for (int64_t i = 1; i <= 200; ++i) {
      table.add_sample({i, "random", {"1.5", "word"}});
      table.add_run({.sample = i, .seed = 7, .status = "done", .result = R"({"report":{"x":1}})"});
    }
    table.add_run({.sample = 1, .seed = 8, .status = "failed", .message = "a mistake"});
    table.commit();
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }
  std::string good() const { return path("good.db"); }

  static std::string content(const std::string& file) {
    std::ostringstream all;
    all << std::ifstream(file, std::ios::binary).rdbuf();
    return all.str();
  }
  static void write(const std::string& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
  }
  /// A copy of the good file, changed by SQL.
  std::string changed(const std::string& sql) const {
    const std::string copy = path("changed.db");
    fs::copy_file(good(), copy, fs::copy_options::overwrite_existing);
    sqlite3* db = nullptr;
    EXPECT_EQ(sqlite3_open(copy.c_str(), &db), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
    return copy;
  }
  /// Opening the file must fail with these words, to read and to write, and leave it as it was.
  static void refused(const std::string& file, const std::string& words) {
    const std::string before = fs::is_regular_file(file) ? content(file) : "";
    for (const auto mode : {Table::Mode::read, Table::Mode::write}) {
      try {
        const Table table(file, mode);
        ADD_FAILURE() << "no error: " << words;
      } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find(words), std::string::npos) << message;
        EXPECT_NE(message.find("'" + file + "'"), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      }
    }
    EXPECT_TRUE(!fs::is_regular_file(file) || content(file) == before) << words;
  }

  fs::path folder_;
};

TEST_F(TableFile, WhatIsWholeIsRead) {
  const Table table(good(), Table::Mode::read);
  EXPECT_EQ(table.samples().size(), 200u);
  EXPECT_EQ(table.runs().size(), 201u);
}

TEST_F(TableFile, EveryCutIsFound) {
  const std::string whole = content(good());
  for (size_t size = 1; size < whole.size(); size += size < 1100 ? 37 : 1999) {
    write(path("cut.db"), whole.substr(0, size));
    refused(path("cut.db"), size < 16 ? "expected an SQLite database" : "'");
  }
  write(path("cut.db"), whole.substr(0, whole.size() / 2));
  refused(path("cut.db"), "is damaged: cut off, or overwritten in part");
}

TEST_F(TableFile, OverwrittenPagesAreFound) {
  std::string bytes = content(good());
  for (size_t i = 2 * 4096; i + 40 < bytes.size(); i += 4096) bytes.replace(i, 40, 40, '\xff');
  write(path("over.db"), bytes);
  refused(path("over.db"), "is damaged");
}

TEST_F(TableFile, WhatIsSomethingElseIsSaid) {
  write(path("text.db"), "this is a text, and no database at all\n");
  refused(path("text.db"), "expected an SQLite database");
  write(path("zeros.db"), std::string(20000, '\0'));
  refused(path("zeros.db"), "expected an SQLite database");
  fs::create_directory(path("folder.db"));
  refused(path("folder.db"), "is a directory");
  ASSERT_EQ(mkfifo(path("pipe.db").c_str(), 0600), 0);
  refused(path("pipe.db"), "is no ordinary file");
  refused(changed("DROP TABLE runs"), "is a database of something else");
  refused(changed("DROP TABLE runs; CREATE TABLE runs(a)"), "is a database of something else");
  refused(changed("UPDATE notes SET value = '2' WHERE name = 'format'"), "has the format 2");
}

TEST_F(TableFile, EmptyOrMissingIsAnErrorOnlyToReaders) {
  write(path("empty.db"), "");
  EXPECT_THROW(Table(path("empty.db"), Table::Mode::read), Error);
  EXPECT_THROW(Table(path("none.db"), Table::Mode::read), Error);
  EXPECT_FALSE(fs::exists(path("none.db")));
  for (const char* name : {"empty.db", "none.db"}) {
    Table(path(name), Table::Mode::write).commit();
    EXPECT_TRUE(Table(path(name), Table::Mode::read).samples().empty());
  }
}

TEST_F(TableFile, RowsThatNoSweepWritesAreNamed) {
  for (const char* bad : {"[1,", "[1,2]", "{}", "[\"1.5\"]", "[\"1.5\",\"word\",\"more\"]", ""})
    refused(changed(fmt::format("UPDATE samples SET parameters = '{}' WHERE sample = 5", bad)),
            "the parameters of sample 5");
  for (const char* bad : {"{bad", "", "3", "[]"})
    refused(changed(fmt::format("UPDATE runs SET result = '{}' WHERE sample = 6", bad)), "sample 6, seed 7");
  refused(changed("DELETE FROM samples WHERE sample = 3"), "it has runs of sample 3, and no such sample");
}

}  // namespace
}  // namespace tunica::sweep
