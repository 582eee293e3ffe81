// SPDX-License-Identifier: MIT
#include "shell/sweep_notes.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "base/error.h"

namespace tunica::shell {
namespace {

constexpr const char* identity =
    R"({"script":"1f","program":"tunica 1","parameters":[["a","1..2"]],"sampling":"grid","sampling seed":1,"until":3})";
constexpr const char* settings =
    R"({"seeds":[1],"fresh":[2],"score":"","minimize":false,"winners":5,"shard":1,"shards":1})";
constexpr const char* about =
    R"({"parameters":[{"name":"a","type":"number","value":"1"}],"reports":["x"],"script":"1f"})";

/// What is said of a file with these notes besides good ones; "" if nothing.
std::string said_of(const std::map<std::string, std::string>& notes,
                    const std::vector<std::string>& parameters = {"1"}) {
  const std::string path =
      std::filesystem::path(testing::TempDir()) / ("tunica_notes_test_" + std::to_string(getpid()) + ".db");
  std::filesystem::remove(path);
  sweep::Table table(path, sweep::Table::Mode::write);
  table.set_note("model", "model.lua");
  table.set_note("identity", identity);
  table.set_note("settings", settings);
  table.set_note("about", about);
  for (const auto& [name, text] : notes) table.set_note(name, text);
  table.add_sample({1, "grid", parameters});
  table.commit();
  try {
    check_notes(table);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(SweepNotes, GoodOnesPass) {
  EXPECT_EQ(said_of({}), "");
  EXPECT_EQ(said_of({{"files", R"({"a.txt":"12"})"}}), "");
}

TEST(SweepNotes, AFileThatWasBarelyBegunPasses) {
  const std::string path =
      std::filesystem::path(testing::TempDir()) / ("tunica_notes_begun_" + std::to_string(getpid()) + ".db");
  std::filesystem::remove(path);
  check_notes(sweep::Table(path, sweep::Table::Mode::write));
}

TEST(SweepNotes, BadOnesAreNamed) {
  for (const char* name : {"identity", "settings", "about", "files", "search"})
    for (const char* bad : {"", "{", "3", "[]", "[3]", "null", R"({"seeds":3})", R"({"a":1})"}) {
      const std::string said = said_of({{name, bad}});
      if (std::string(name) == "files" && std::string(bad) == "[]") continue;
      EXPECT_NE(said.find("is damaged"), std::string::npos) << name << " " << bad << ": " << said;
      EXPECT_NE(said.find(name), std::string::npos) << said;
      EXPECT_EQ(said.find("json.exception"), std::string::npos) << said;
    }
  std::string zero = settings;
  zero.replace(zero.find("\"shards\":1"), 10, "\"shards\":0");
  EXPECT_NE(said_of({{"settings", zero}}).find("shards is 0"), std::string::npos);
}

TEST(SweepNotes, SamplesHaveTheParametersNoted) {
  EXPECT_NE(said_of({}, {"1", "2"}).find("2 parameters, and 1"), std::string::npos);
}

}  // namespace
}  // namespace tunica::shell
