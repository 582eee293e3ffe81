// SPDX-License-Identifier: MIT
#include "lua/compiled_library.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "lua/state.h"
#include "shell/places.h"

namespace tunica::lua {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& part) { return read_file(shell::library_folder() + "/tunica/" + part + ".lua"); }

/// The first result of a chunk as text, or its error.
std::string result_of(State& state, const std::string& text) {
  load_text(state.get(), text, "@test.lua");
  if (const auto error = call_protected(state.get(), 0, 1)) return *error;
  const char* result = lua_tostring(state.get(), -1);
  return result ? result : luaL_typename(state.get(), -1);
}

/// A folder of its own with a copy of the library, each text followed by `added`, until the end of the test.
class Copy {
 public:
  explicit Copy(const std::string& added) : folder_(fs::path(testing::TempDir()) / fmt::format("library{}", getpid())) {
    fs::copy(shell::library_folder(), folder_, fs::copy_options::recursive);
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.path().extension() == ".lua") std::ofstream(entry.path(), std::ios::app) << added;
  }
  ~Copy() { fs::remove_all(folder_); }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;
  void write(const std::string& part, const std::string& text) {
    std::ofstream(folder_ / "tunica" / (part + ".lua")) << text;
  }
  std::string folder() const { return folder_.string(); }

 private:
  fs::path folder_;
};

/// Source, kind and lines with code of the function on top, which is popped.
std::vector<std::string> about_top(lua_State* L) {
  lua_Debug about;
  lua_getinfo(L, ">SL", &about);
  std::vector<std::string> all{about.source, about.short_src, about.what, std::to_string(about.lastlinedefined)};
  for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) all.push_back(std::to_string(lua_tointeger(L, -2)));
  lua_pop(L, 1);
  std::sort(all.begin() + 4, all.end());
  return all;
}

TEST(CompiledLibrary, EveryPartComesFromBytecodeAndIsTheSame) {
  State state(shell::library_folder());
  lua_State* L = state.get();
  size_t parts = 0;
  const fs::path folder = shell::library_folder() + "/tunica";
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".lua") continue;
    const std::string part = fs::relative(entry.path(), folder).replace_extension().string();
    ASSERT_TRUE(load_part(L, part, text_of(part))) << part;
    const auto from_bytecode = about_top(L);
    load_text(L, text_of(part), chunk_name(part));
    EXPECT_EQ(from_bytecode, about_top(L)) << part;
    ++parts;
  }
  EXPECT_GT(parts, 50u);
}

TEST(CompiledLibrary, WhatWasEditedSinceOrIsOfAnotherLuajitComesFromItsText) {
  State state(shell::library_folder());
  lua_State* L = state.get();
  EXPECT_FALSE(load_part(L, "init", text_of("init") + " "));
  EXPECT_FALSE(load_part(L, "no_such_part", "return 1"));
  EXPECT_THROW(load_part(L, "init", "return ("), Error);
  EXPECT_TRUE(load_part(L, "init", text_of("init")));
  lua_pushliteral(L, "LuaJIT 2.0.0");
  lua_setfield(L, LUA_REGISTRYINDEX, "tunica.luajit");
  EXPECT_FALSE(load_part(L, "init", text_of("init")));

  Copy copy("");
  copy.write("registry", "return { edited = 'yes' }");
  State edited(copy.folder());
  EXPECT_EQ(result_of(edited, "return require('tunica.registry').edited"), "yes");
}

TEST(CompiledLibrary, ErrorsAndTracebacksReadTheSame) {
  const Copy copy("\n-- edited\n");
  State compiled(shell::library_folder()), text(copy.folder());
  ASSERT_FALSE(load_part(text.get(), "init", read_file(copy.folder() + "/tunica/init.lua")));
  for (const char* wrong : {"require('tunica').grid()", "return require('tunica').gridd", "require('tunica').x = 1",
                            "require('tunica').model {} .solve = 1", "require 'tunica.nothing'"}) {
    const std::string traced = fmt::format("return select(2, xpcall(function() {} end, debug.traceback))", wrong);
    std::string expected = result_of(text, traced), plain = result_of(text, wrong);
    for (std::string* message : {&expected, &plain})
      if (const size_t at = message->find(copy.folder()); at != std::string::npos)
        message->replace(at, copy.folder().size(), shell::library_folder());
    EXPECT_EQ(result_of(compiled, traced), expected);
    EXPECT_EQ(result_of(compiled, wrong), plain);
  }
}

TEST(CompiledLibrary, ScriptsLoadNoBytecodeByAnyDoor) {
  State state(shell::library_folder());
  const std::string_view code = compiled_library().parts.at("init").bytecode;
  const Copy copy("");  // for its folder
  std::ofstream(copy.folder() + "/own.lua") << code;
  set_search_folders(state.get(), copy.folder());
  lua_pushlstring(state.get(), code.data(), code.size());
  lua_setglobal(state.get(), "code");
  lua_pushstring(state.get(), (copy.folder() + "/own.lua").c_str());
  lua_setglobal(state.get(), "path");
  EXPECT_EQ(result_of(state, R"(
    local pieces = { code:sub(1, 1), code:sub(2) }
    local function piece() return table.remove(pieces, 1) end
    for i, result in ipairs { { load(code) }, { load(code, "=tunica/init.lua", "b") }, { load(code, "x", "bt", {}) },
        { loadstring(code) }, { load(piece) }, { loadfile(path) }, { load("\239\187\191" .. code) }, { load("#\n" .. code) } } do
      assert(result[1] == nil and type(result[2]) == "string", i)
    end
    assert(not pcall(dofile, path))
    assert(not pcall(require, "own"))
    return "none")"),
            "none");
}

}  // namespace
}  // namespace tunica::lua
