// SPDX-License-Identifier: MIT
#include "lua/state.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "lua/guard.h"
#include "shell/places.h"

namespace tunica::lua {
namespace {

/// The first result of a chunk as text, or its error.
std::string result_of(State& state, const std::string& text) {
  load_text(state.get(), text, "@test.lua");
  if (const auto error = call_protected(state.get(), 0, 1)) return *error;
  const char* result = lua_tostring(state.get(), -1);
  std::string copy = result ? result : luaL_typename(state.get(), -1);
  lua_pop(state.get(), 1);
  return copy;
}

TEST(State, TwoAtOnceDoNotDisturbEachOther) {
  State a(shell::library_folder()), b(shell::library_folder());
  const std::string draw = "return math.random()";
  const std::string first = result_of(a, draw), second = result_of(a, draw);
  EXPECT_EQ(result_of(b, draw), first);
  EXPECT_EQ(result_of(b, draw), second);
  EXPECT_NE(first, second);
  result_of(a, "x = 1");
  EXPECT_NE(result_of(b, "return x").find("not defined"), std::string::npos);
}

TEST(State, TheStackIsAsBeforeAfterErrors) {
  State state(shell::library_folder());
  const int top = lua_gettop(state.get());
  for (const char* wrong : {"error 'x'", "error {}", "return nothing", "local function f() return f() + 1 end f()"})
    result_of(state, wrong);
  EXPECT_THROW(load_text(state.get(), "x =", "=x"), Error);
  EXPECT_EQ(lua_gettop(state.get()), top);
}

TEST(State, CancelledOperationsRaiseAnError) {
  State state(shell::library_folder());
  host(state.get()).cancel.request();
  EXPECT_EQ(result_of(state, "return tostring(require('tunica.core').cancelled())"), "true");
}

TEST(State, RandomStateGoesBack) {
  State state(shell::library_folder());
  EXPECT_EQ(result_of(state, R"(
    local core = require "tunica.core"
    math.random()
    local here, first = core.random_state(), math.random()
    math.randomseed(7)
    core.random_state(here)
    return tostring(math.random() == first))"),
            "true");
}

TEST(State, EveryCutRandomStateIsAnError) {
  State state(shell::library_folder());
  EXPECT_EQ(result_of(state, R"(
    local core = require "tunica.core"
    local whole = core.random_state()
    for i = 0, #whole - 1 do assert(not pcall(core.random_state, whole:sub(1, i))) end
    return "ok")"),
            "ok");
}

TEST(State, JsonKeepsWhatItCan) {
  State state(shell::library_folder());
  EXPECT_EQ(result_of(state, R"(
    local core = require "tunica.core"
    local text = core.encode { b = 1, a = { 1, 2.5, "x", { deep = true } }, nan = 0/0, big = 2^60, tiny = 5e-324, n = -0.5 }
    local back = core.decode(text)
    assert(back.a[2] == 2.5 and back.a[4].deep == true and back.tiny == 5e-324 and back.big == 2^60 and back.nan == "NaN")
    local cycle = {}
    cycle.cycle = cycle
    for _, wrong in ipairs { function() core.encode(print) end, function() core.encode { [1] = 1, x = 2 } end,
        function() core.encode(cycle) end, function() core.decode "{" end, function() core.decode(("["):rep(1000) .. ("]"):rep(1000)) end,
        function() core.write_atomic(nil, "") end, function() core.read_file {} end, function() core.read_file "" end,
        function() core.unpack "x" end, function() core.pack { [1] = "x" } end, function() core.pack { x = {} } end } do
      assert(not pcall(wrong))
    end
    return core.encode { b = 1, a = core.as_list {} })"),
            R"({"a":[],"b":1})");
}

}  // namespace
}  // namespace tunica::lua
