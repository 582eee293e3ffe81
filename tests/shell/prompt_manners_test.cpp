// SPDX-License-Identifier: MIT
// The prompt where things are not as usual: windows that change, scripts that fail, places that cannot be written.
#include <csignal>

#include "shell/prompt_session.h"

namespace tunica::shell {
namespace {

TEST_F(PromptTest, FollowsTheSizeOfTheWindow) {
  start({"-q", "-i", "patterning/ring"});
  says("list = {} for i = 1, 60 do list[i] = i * 1.25 end", "");
  // Typed half at one width, half at another, over several lines of the screen.
  terminal_->type("long = 'a text that fills more than one line ");
  terminal_->watch(0.2);
  terminal_->resize(40);
  terminal_->watch(0.3);
  terminal_->type("of a window of forty columns' .. ' by far'\r");
  EXPECT_TRUE(terminal_->stands_at(">")) << terminal_->screen().text();
  says("#long", "\n72\n");
  const size_t before = terminal_->screen().row_start();
  says("list", "a list of 60 items");
  says("P", "diffusion");
  says("model", "model ring");
  says("column 'auxin'", "50 cells");
  std::string text = terminal_->screen().text().substr(before);
  for (size_t end = text.find('\n'); end != std::string::npos; text.erase(0, end + 1), end = text.find('\n')) {
    size_t columns = 0;
    for (const char c : text.substr(0, end)) columns += (c & 0xC0) != 0x80;
    EXPECT_LE(columns, 40u) << text.substr(0, end);
  }
  terminal_->resize(120);
  terminal_->watch(0.2);
  says("1 + 1", "\n2\n");
  // While something runs, and so small that hardly anything fits.
  terminal_->type("run(30000)\r");
  terminal_->watch(0.3);
  terminal_->resize(20);
  terminal_->watch(0.3);
  terminal_->type("\x03");
  EXPECT_TRUE(terminal_->stands_at(">")) << terminal_->screen().text();
  says("P", "=");
  terminal_->resize(80);
  says("long:sub(1, 6)", "a text");
}

TEST_F(PromptTest, ComesAfterAScriptThatFailed) {
  std::ofstream(folder_ / "bad.lua") << "kept = 5\nfunction f(x)\n  return x.y.z\nend\nf {}\n";
  const std::string path = (folder_ / "bad.lua").string();
  start({"-q", "-i", path}, {}, 200);
  EXPECT_TRUE(terminal_->shows("bad.lua:3: attempt to index field 'y'")) << terminal_->screen().text();
  EXPECT_TRUE(terminal_->shows("load \"" + path + "\""));
  says("kept", "\n5\n");
  says("f { y = { z = 7 } }", "\n7\n");
  terminal_->type("\x04");
  EXPECT_EQ(terminal_->exit_code(), 0);
  // Also one that was stopped.
  std::ofstream(folder_ / "slow.lua") << "kept = 6\nwhile true do end\n";
  terminal_ = std::make_unique<PseudoTerminal>(
      std::vector<std::string>{TUNICA_PROGRAM, "-q", "-i", (folder_ / "slow.lua").string()}, environment(), 80);
  terminal_->watch(0.5);
  terminal_->type("\x03");
  EXPECT_TRUE(terminal_->stands_at(">")) << terminal_->screen().text();
  says("kept", "\n6\n");
}

TEST_F(PromptTest, HelpsWithEveryOperation) {
  std::ofstream(folder_ / "titles.lua")
      << "require 'tunica.prompt.names'()\n"
         "for _, e in ipairs(require 'tunica.registry'.all()) do print(e.title) end\n";
  const std::string list = (folder_ / "titles.txt").string();
  ASSERT_EQ(std::system((std::string(TUNICA_PROGRAM) + " " + (folder_ / "titles.lua").string() + " >" + list).c_str()),
            0);
  start({"-q", "-i", "patterning/ring"});
  std::ifstream titles(list);
  int count = 0;
  for (std::string title; std::getline(titles, title); ++count) {
    terminal_->type("?" + title + "\r");
    ASSERT_TRUE(terminal_->shows("\n" + title)) << title << terminal_->screen().text();
    ASSERT_TRUE(terminal_->stands_at(">")) << title;
  }
  EXPECT_GT(count, 150);
  EXPECT_EQ(terminal_->screen().text().find("error:"), std::string::npos);
}

TEST_F(PromptTest, WithstandsWhatIsTyped) {
  start({"-q"}, {}, 200);
  says("function f() return f() + 1 end f()", "stack overflow");
  says("local t = setmetatable({}, {__tostring = function() error 'no' end}) print(#'ok') ans = t", "");
  says("ans", "a table");
  says("load = 3", "");
  says("load 'ring'", "load = nil brings it back");
  says("load = nil", "");
  says("load 'ring'", "model, tissue");
  says("pairs = nil tostring = nil print = nil", "");
  says("{ 1, x = 2 }", "{ 1, x = 2 }");
  says("coroutine.wrap(function() run(1) end)()", "");
  says("model.time", "\n1\n");
  says("error(setmetatable({}, { __tostring = function() error 'x' end }))", "not text");
  std::ofstream(folder_ / "half.lua") << "local tunica = require 'tunica'\nlocal t = tunica.ring { 10 }\nlocal m = tun";
  says("load '" + (folder_ / "half.lua").string() + "'", "half.lua:3");
  says("model.time", "\n1\n");
  says("undo()", "back to before");
  terminal_->type("\x1b[200~w = \"\x1b[31mred\x07\"\x1b[201~\r");
  EXPECT_TRUE(terminal_->stands_at(">"));
  says("w", "\\27[31mred\\7");
  says("x = \"\xff\xfe\" #x", "");
  says("local long = '" + std::string(3000, 'a') + "'", "");
  says("#long", "3000");
}

TEST_F(PromptTest, NeedsNoPlaceForItsHistory) {
  fs::create_directories(folder_ / "state/tunica/history");  // a folder
  start({"-q"});
  says("1 + 1", "\n2\n");
  terminal_->type("\x04");
  EXPECT_EQ(terminal_->exit_code(), 0);
  start({"-q"}, {{"XDG_STATE_HOME", "/proc/nowhere"}});
  says("1 + 1", "\n2\n");
  start({"-q"}, {{"XDG_STATE_HOME", ""}, {"HOME", ""}, {"XDG_CONFIG_HOME", ""}});
  says("1 + 1", "\n2\n");
  says("load 'ring'", "model, tissue");
}

}  // namespace
}  // namespace tunica::shell
