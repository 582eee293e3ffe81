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

TEST_F(PromptTest, AsksTheTerminalOnceAndLosesNoKeys) {
  start({"-q", "-i", "patterning/sheet", "cells=60"}, {{"TUNICA_IMAGES", ""}, {"NO_COLOR", ""}});
  const auto asked = [&] {
    size_t count = 0;
    for (size_t at = 0; (at = terminal_->bytes().find("\033_Gi=31", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  terminal_->type("show()\r");
  for (int i = 0; i < 100 && asked() == 0; ++i) terminal_->watch(0.05);
  terminal_->type("40");  // before the answer, in it and after it
  terminal_->type("\033_Gi=31;ENOENT\033\\ + ");
  terminal_->type("\033[?62;22c2\r");
  EXPECT_TRUE(terminal_->shows("\n42\n")) << terminal_->screen().text();
  EXPECT_TRUE(terminal_->stands_at(">"));
  says("show() 'again'", "again");
  EXPECT_EQ(asked(), 1);
}

TEST_F(PromptTest, TellsOnceWhatWasRescued) {
  const fs::path state = folder_ / "state/tunica";
  fs::create_directories(state);
  const auto make = [&](const std::string& name, int days) {
    std::ofstream(state / name) << "x = 1";
    fs::last_write_time(state / name, fs::file_time_type::clock::now() - std::chrono::hours(24 * days));
  };
  make("rescued-1", 40), make("rescued-2.lua", 2), make("rescued-notes", 90);
  start({"-q"}, {}, 200);
  EXPECT_TRUE(terminal_->displays("dofile \"" + (state / "rescued-2.lua").string() + "\""))
      << terminal_->screen().text();
  EXPECT_FALSE(fs::exists(state / "rescued-1"));
  EXPECT_TRUE(fs::exists(state / "rescued-notes")) << "it is the user's";
  start({"-q"}, {}, 200);
  EXPECT_EQ(terminal_->screen().text().find("rescued"), std::string::npos) << "told twice";
  for (int i = 10; i < 40; ++i) make("rescued-" + std::to_string(i), 1);
  start({"-q"}, {}, 200);
  EXPECT_EQ(std::distance(fs::directory_iterator(state), {}), 20 + 4) << "history, its lock, the stamp, the user's";
}

TEST_F(PromptTest, AFullDiskLeavesTheHistoryWhole) {
  fs::create_directories(folder_ / "state/tunica");
  fs::create_symlink("/dev/full", folder_ / "state/tunica/history");
  start({"-q"});
  says("1 + 1", "not kept any more");
  says("2 + 2", "\n4\n");
  EXPECT_EQ(terminal_->screen().text().find("any more"), terminal_->screen().text().rfind("any more")) << "said twice";
  terminal_->type("\x1b[A\x1b[A\r");
  EXPECT_TRUE(terminal_->shows("\n2\n")) << "kept while the prompt lives";
}

TEST_F(PromptTest, NothingIsLostByAFileThatIsBeingWritten) {
  const fs::path path = folder_ / "mine.lua";
  const std::string whole =
      "local tunica = require 'tunica'\nlocal t = tunica.ring { 10 }\nt:cell { s = 1 }\n"
      "local m = tunica.model { tissue = t, dt = 0.1, stop = 5 }\nm:rate(function(c, d) d.s = 1 end)\nreturn m\n";
  std::ofstream(path) << whole;
  start({"-q"}, {}, 200);
  says("load '" + path.string() + "'", "model, tissue");
  says("run(1)", "now at t = 1");
  for (const size_t bytes : {size_t{0}, size_t{40}, whole.size() - 10}) {
    std::ofstream(path) << whole.substr(0, bytes);
    says("reload()", "error: ");
    says("model.time, tissue:max 's' > 1.9", "\n1\ntrue\n");
  }
  says("load '" + path.string() + "'", "error: ");
  says("undo()", "back to before: run(1)");  // what ran, not what failed
  says("redo()", "again");
  fs::remove(path);
  says("reload()", "error: ");
  says("model.time", "\n1\n");
  std::ofstream(path) << whole;
  says("reload()", "t = 1 is kept");
}

TEST_F(PromptTest, KnowsWhatWasMeant) {
  start({"-q"});
  says("?run", "Runs the model at hand");  // the first input of all
  says("help", "Some things to type");
  says("load ring", "load \"ring\"");
  says("run 5", "run(5)");
  says("!ls -l", "os.execute \"ls -l\"");
  says("undo", "undo() calls it");
  says("load 'ring'", "model, tissue");
  says("D = 2", "the model's parameter is P.D");
  says("P.D", "\n1\n");
  terminal_->type("loa\x1b[A\r");
  EXPECT_TRUE(terminal_->shows("model, tissue")) << "Up looks for what begins so";
}

TEST_F(PromptTest, BreaksLinesAtBlanks) {
  start({"-q"}, {}, 40);
  says("load 'ring'",
       "\nmodel, tissue (tissue: 50 cells, 50\n  walls, no geometry), P now stand for\n  it; help(model) says more\n");
  start({"-q"}, {{"TERM", "dumb"}}, 40);
  says("load 'ring'", "\n  walls, no geometry), P now stand for\n");
  says("P", "\nkT = 2            saturation of\n                  transport by the auxin\n");
  says("x = run(20)", "");
  says("who()", "now at t = 20: 1000 steps, 50\n        cells, ");
  says("model:report(3)", "takes a table\n  of options: ");
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
