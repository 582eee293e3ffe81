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

}  // namespace
}  // namespace tunica::shell
