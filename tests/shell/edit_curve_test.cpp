// SPDX-License-Identifier: MIT
// The editor of curves on a pseudo-terminal: keys and mouse, what the screen shows, what becomes of the curve, and that
// the terminal is as before however the editor ends.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "shell/pseudo_terminal.h"

namespace tunica::shell {
namespace {

namespace fs = std::filesystem;

const std::string up = "\033OA", down = "\033OB", right = "\033OC", left = "\033OD", shift_right = "\033[1;2C",
                  tab = "\t", enter = "\r", ctrl_c = "\x03";

class EditCurve : public ::testing::Test {
 protected:
  EditCurve() {
    std::string name = (fs::temp_directory_path() / "tunica_curve_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~EditCurve() override {
    terminal_.reset();
    fs::remove_all(folder_);
  }

  using Environment = std::map<std::string, std::string>;

  PseudoTerminal& start(const std::vector<std::string>& arguments, Environment more = {}, int width = 80) {
    std::vector<std::string> command = {TUNICA_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    more.merge(Environment{{"TERM", "xterm-256color"},
                           {"LC_ALL", "C.UTF-8"},
                           {"NO_COLOR", "1"},
                           {"INPUTRC", "/dev/null"},
                           {"HOME", folder_.string()},
                           {"XDG_STATE_HOME", (folder_ / "state").string()},
                           {"XDG_CONFIG_HOME", (folder_ / "config").string()}});
    terminal_ = std::make_unique<PseudoTerminal>(command, more, width);
    return *terminal_;
  }
  void prompt(Environment more = {}, int width = 80, const std::vector<std::string>& arguments = {"-q", "--private"}) {
    start(arguments, std::move(more), width);
    ASSERT_TRUE(terminal_->stands_at(">", 60)) << screen();
  }

  std::string screen() const { return terminal_->screen().text(); }
  void says(const std::string& line, const std::string& answer) {
    terminal_->type(line + "\r");
    EXPECT_TRUE(terminal_->shows(answer)) << "after: " << line << "\n" << screen();
    EXPECT_TRUE(terminal_->stands_at(">")) << screen();
  }
  /// A key in the editor, and what must then be on the screen.
  void key(const std::string& keys, const std::string& expected) {
    terminal_->type(keys);
    EXPECT_TRUE(terminal_->displays(expected)) << "after a key: " << expected << "\n" << screen();
  }
  /// Opens the editor on a curve.
  void edit(const std::string& line) {
    terminal_->type(line + "\r");
    ASSERT_TRUE(terminal_->displays("point 1 of ")) << screen();
    ASSERT_TRUE(terminal_->displays("all keys")) << screen();
    EXPECT_TRUE(terminal_->screen().alternate());
  }
  /// Ends the editor with a key, and expects the prompt to say something.
  void leave(const std::string& last_key, const std::string& answer) {
    terminal_->type(last_key);
    EXPECT_TRUE(terminal_->displays(answer)) << screen();
    EXPECT_TRUE(terminal_->displays("\n>")) << screen();
    as_before();
  }
  /// Whether mouse, alternate screen and cursor are as before.
  void as_before() {
    terminal_->watch(0.1);
    EXPECT_FALSE(terminal_->screen().alternate());
    const std::string& bytes = terminal_->bytes();
    for (const auto& [on, off] : {std::pair("\033[?1049h", "\033[?1049l"), {"\033[?25l", "\033[?25h"}})
      EXPECT_GT(bytes.rfind(off) + 1, bytes.rfind(on) + 1) << (off + 1);
    const size_t mouse_on = bytes.rfind("1000h"), mouse_off = bytes.rfind("1000l");
    ASSERT_NE(mouse_on, std::string::npos);
    ASSERT_NE(mouse_off, std::string::npos);
    EXPECT_GT(mouse_off, mouse_on);
    EXPECT_GT(bytes.rfind("1006"), mouse_on - 8);
  }

  /// Column and row, from 1, of a mark in the picture.
  std::pair<int, int> place_of(const std::string& mark) const {
    std::istringstream in(screen());
    std::string line;
    for (int row = 1; std::getline(in, line); ++row)
      if (const size_t at = line.find(mark); row > 1 && at != std::string::npos) {
        int column = 1;
        for (size_t i = 0; i < at; ++i) column += (line[i] & 0xC0) != 0x80;
        return {column, row};
      }
    ADD_FAILURE() << "no " << mark << " in\n" << screen();
    return {1, 1};
  }
  static std::string mouse(int button, int column, int row, bool press) {
    return "\033[<" + std::to_string(button) + ";" + std::to_string(column) + ";" + std::to_string(row) +
           (press ? "M" : "m");
  }
  std::string file(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_;
  std::unique_ptr<PseudoTerminal> terminal_;
};

const std::string curve = "c = tunica.curve { { 0, 0.3 }, { 0.5, 1 }, { 2, 1 } }";

TEST_F(EditCurve, OfAModelTakesEffectAndIsUndone) {
  prompt({}, 80, {"-q", "--private", "-i", "growth/apex", "max_area=0.05"});
  says("run(0.1)", "now at t = 0.1");
  terminal_->type("edit_curve \"gro\t");
  EXPECT_TRUE(terminal_->shows("edit_curve \"growth")) << screen();
  terminal_->type("\x15");
  terminal_->type("edit_curve(P.growth)\r");
  ASSERT_TRUE(terminal_->displays("growth (raised): curve, ")) << screen();
  for (const char* mark : {"? all keys", "●", "○", "└──"}) EXPECT_TRUE(terminal_->displays(mark)) << screen();
  key("e", "x, y: 0");
  key("\x15", "x, y:");
  key("0, 0.125" + enter, "(changed)");
  EXPECT_TRUE(terminal_->displays("f(0) = 0.125")) << screen();
  leave(enter, "growth: raised -> 0,0.125 ");
  says("P.growth", "\"0,0.125 ");
  says("model.time", "\n0.1\n");
  says("run { by = 0.02 }", "now at t = 0.12");
  says("undo(2)", "back to before: edit_curve");
  says("P.growth", "\"raised\"");
  edit("edit_curve 'profile'");
  leave(ctrl_c, "left as it was");
  says("P.profile", "\"dome\"");
}

TEST_F(EditCurve, KeysMoveAddDeleteAndUndo) {
  prompt();
  says(curve, "");
  edit("c = edit_curve(c)");
  EXPECT_NE(screen().find("point 1 of 3: 0, 0.3; step 0.02"), std::string::npos) << screen();
  EXPECT_NE(screen().find("f(0) = 0.3"), std::string::npos) << screen();
  EXPECT_NE(screen().find("most 1 at 2"), std::string::npos) << screen();
  key(up, "point 1 of 3: 0, 0.32");
  key(tab, "point 2 of 3: 0.5, 1");
  key(right + right, "point 2 of 3: 0.54, 1");
  key(shift_right, "point 2 of 3: 0.542, 1");
  key("-", "step 0.002");
  key(left, "point 2 of 3: 0.54, 1");
  key("+a", "point 3 of 4: 1.27, 1");
  key("d", "point 3 of 3: 2, 1");
  key("uu", "point 2 of 3: 0.54, 1");
  key("u", "point 2 of 3: 0.5, 1");
  key("r", "point 2 of 3: 0.54, 1");
  key("1", "degree 1");
  key("p" + std::string(60, 'n'), "point 1 of 3");  // keys typed ahead
  key("?", "by a tenth of the step");
  terminal_->type(" ");
  EXPECT_TRUE(terminal_->hides("by a tenth of the step")) << screen();
  leave("q", "\n>");
  says("c:text()", "\"0,0.32 0.54,1 2,1 degree=1\"");
}

TEST_F(EditCurve, KeepsTheOrderOfAFunctionAndSaysWhatIsWrong) {
  prompt();
  says("p = tunica.contour { { 0, 0 }, { 1, 0 }, { 1, -1 } }", "");
  edit("p = edit_curve(p)");
  key(left + left, "point 1 of 3: -0.04, 0");
  leave(enter, "\n>");
  says("p:text()", "\"-0.04,0 1,0 1,-1\"");
  says(curve, "");
  edit("c = edit_curve(c)");
  key("e", "x, y:");
  key("\x15" + std::string("5 0.5") + enter, "x stays between the points before and after it");
  key(tab + "e", "x, y:");
  key("\x15" + std::string("2 1") + enter, "point 2 of 3: 2, 1");
  key("n" + std::string("e"), "x, y:");
  terminal_->type("\x15" + std::string("0.5 9") + enter);
  EXPECT_TRUE(terminal_->displays("point 3 of 3: 2, 9")) << screen();
  key("p" + std::string("p"), "point 1 of 3");
  key("e", "x, y:");
  key("\x15" + std::string("2 0.3") + enter, "refused: ");
  EXPECT_TRUE(terminal_->displays("3 points of the curve lie above")) << screen();
  terminal_->type(enter);  // not taken
  terminal_->watch(0.3);
  EXPECT_TRUE(terminal_->screen().alternate());
  leave(ctrl_c, "left as it was");
  says("c:text()", "\"0,0.3 0.5,1 2,1\"");
}

TEST_F(EditCurve, TheMouseSelectsMovesAddsAndDeletes) {
  for (const char* terminal : {"xterm-256color", "tmux-256color"}) {
    const bool plain = std::string(terminal) == "tmux-256color";  // reports as xterm's first protocol
    const auto click = [&](int button, std::pair<int, int> at, bool press) {
      if (!plain) return mouse(button, at.first, at.second, press);
      return std::string("\033[M") + static_cast<char>(32 + (press ? button : 3)) + static_cast<char>(32 + at.first) +
             static_cast<char>(32 + at.second);
    };
    prompt({{"TERM", terminal}, {"LC_ALL", "C"}});
    says(curve, "");
    edit("c = edit_curve(c)");
    const auto first = place_of("@"), second = place_of("o");
    EXPECT_LT(second.second, first.second);
    key(click(0, second, true) + click(0, second, false), "point 2 of 3: 0.5, 1");
    EXPECT_EQ(place_of("@"), second);
    const std::pair<int, int> lower{second.first, second.second + 10};
    key(click(0, second, true) + click(0, lower, false), "f(0) = 0.3");
    EXPECT_TRUE(terminal_->hides("0.5, 1;")) << screen();
    EXPECT_EQ(place_of("@"), lower);
    key("u", "point 2 of 3: 0.5, 1");
    const std::pair<int, int> free{second.first + 20, second.second + 8};
    key(click(0, free, true) + click(0, free, false), "point 3 of 4");
    EXPECT_EQ(place_of("@"), free);
    key(click(2, free, true) + click(2, free, false), "point 3 of 3: 2, 1");
    leave(ctrl_c, "left as it was");
    terminal_->type("1 + 1\r");
    EXPECT_TRUE(terminal_->shows("\n2\n")) << screen();
  }
}

TEST_F(EditCurve, FitsIntoFortyColumnsAndFollowsTheWindow) {
  for (const bool unicode : {true, false}) {
    prompt({{"LC_ALL", unicode ? "C.UTF-8" : "C"}}, 40);
    says(curve, "");
    edit("c = edit_curve(c)");
    EXPECT_TRUE(terminal_->displays("? all keys")) << screen();
    const std::string shown = screen();
    std::istringstream in(shown);
    for (std::string line; std::getline(in, line);) {
      size_t columns = 0;
      for (const char c : line) columns += (c & 0xC0) != 0x80;
      EXPECT_LE(columns, 40u) << line;
    }
    EXPECT_EQ(shown.find("○") != std::string::npos, unicode);
    EXPECT_EQ(shown.find("@") != std::string::npos, !unicode);
    for (const char* colour : {"[36m", "[33m", "[1;3", "[3m"})
      EXPECT_EQ(terminal_->bytes().find(colour), std::string::npos);
    key(up, "point 1 of 3: 0, 0.32");
    terminal_->resize(100);
    EXPECT_TRUE(terminal_->displays("s to a file, Enter done, Ctrl-C leave, ? all keys")) << screen();
    EXPECT_TRUE(terminal_->displays("point 1 of 3: 0, 0.32; step")) << screen();
    terminal_->resize(15);
    EXPECT_TRUE(terminal_->displays("window too ")) << screen();
    terminal_->resize(60);
    key(up, "point 1 of 3: 0, 0.34");
    leave(enter, "\n>");
    says("c:text()", "0,0.34 ");
  }
  prompt({{"NO_COLOR", ""}});
  says(curve, "");
  edit("c = edit_curve(c)");
  EXPECT_NE(terminal_->bytes().find("[36m"), std::string::npos);
  leave(ctrl_c, "left as it was");
}

TEST_F(EditCurve, WritesFiles) {
  const std::string path = (folder_ / "drawn.func").string(), mine = (folder_ / "mine.con").string();
  prompt();
  says(curve, "");
  edit("edit_curve(c)");
  key("s", "write to: curve.func");
  key("\x15" + path.substr(0, path.size() - 5) + enter, "written: ");
  EXPECT_NE(file("drawn.func").find("0.3"), std::string::npos) << file("drawn.func");
  key(up + "s" + enter, "write over it? y or n:");
  key("n" + enter, "not written");
  key("s\x15/no/such/folder/a.func" + enter, "not written: ");
  leave(enter, "\n>");
  says("tunica.curve('" + path + "')(0)", "\n0.3\n");  // as a cubic, which is what such files hold
  edit("edit_curve '" + path + "'");
  key(up, "0, 0.32");
  leave(enter, "written: ");
  says("tunica.curve('" + path + "')(0)", "\n0.32\n");
  // From the shell: a new file.
  start({"curve", mine});
  ASSERT_TRUE(terminal_->displays("(new): contour, 4 points")) << screen();
  key("a", "point 2 of 5: 0.25, 1");
  terminal_->type(enter);
  EXPECT_TRUE(terminal_->displays("0,1 0.25,1 0.5,1 1,0.5 1,0")) << screen();
  EXPECT_EQ(terminal_->exit_code(), 0);
  EXPECT_NE(file("mine.con"), "");
  start({"curve", mine});
  ASSERT_TRUE(terminal_->displays("contour, 5 points")) << screen();
  terminal_->type(ctrl_c);
  EXPECT_TRUE(terminal_->displays("left as it was")) << screen();
  EXPECT_EQ(terminal_->exit_code(), 0);
}

TEST_F(EditCurve, LeavesTheTerminalAsItWas) {
  prompt();
  says(curve, "");
  edit("edit_curve(c)");
  terminal_->send_signal(SIGINT);
  leave("", "left as it was");
  says("1 + 1", "\n2\n");
  for (const char* what : {"error 'broken'", "terminal.draw(5)", "error({})", "screen.full(function() end)"}) {
    terminal_->type("screen = require 'tunica.prompt.screen'\r");
    EXPECT_TRUE(terminal_->stands_at(">"));
    terminal_->type(std::string("screen.full(function(terminal) ") + what + " end)\r");
    EXPECT_TRUE(terminal_->displays("error")) << screen();
    EXPECT_TRUE(terminal_->stands_at(">")) << screen();
    as_before();
  }
  terminal_->type("screen.full(function() while true do end end)\r");
  terminal_->watch(0.5);
  EXPECT_TRUE(terminal_->screen().alternate());
  terminal_->send_signal(SIGINT);
  EXPECT_TRUE(terminal_->stands_at(">", 10)) << screen();
  as_before();
  edit("edit_curve(c)");
  terminal_->send_signal(SIGTERM);
  EXPECT_EQ(terminal_->exit_code(), 143);
  as_before();
  for (const int signal : {SIGQUIT, SIGSEGV, SIGABRT}) {
    prompt();
    says(curve, "");
    edit("edit_curve(c)");
    terminal_->send_signal(signal);
    EXPECT_EQ(terminal_->exit_code(), 128 + signal);
    as_before();
  }
  // A second signal while code that cannot be broken off runs.
  prompt();
  terminal_->type(
      "require('tunica.prompt.screen').full(function() string.rep('a', 30000):find(('a*'):rep(30) .. 'b') end)\r");
  terminal_->watch(0.5);
  EXPECT_TRUE(terminal_->screen().alternate());
  terminal_->send_signal(SIGTERM);
  terminal_->watch(0.2);
  terminal_->send_signal(SIGTERM);
  EXPECT_EQ(terminal_->exit_code(), 143);
  as_before();
}

TEST_F(EditCurve, RefusesWhereThereIsNoTerminalForIt) {
  prompt({{"TERM", "dumb"}}, 200);
  says(curve, "");
  says("edit_curve(c)", "TERM is 'dumb'");
  EXPECT_EQ(terminal_->bytes().find('\033'), std::string::npos);
  prompt({{"TERM", "no-such-terminal"}}, 200);
  says(curve, "");
  says("edit_curve(c)", "TERM is 'no-such-terminal'");
  says("edit_curve(c)", "TERM is 'no-such-terminal'");
  says("edit_curve(c, '0,1 1,2'):text()", "\"0,1 1,2\"");
  const std::string program = TUNICA_PROGRAM;
  terminal_ = std::make_unique<PseudoTerminal>(
      std::vector<std::string>{"/bin/sh", "-c", program + " curve raised | cat; echo end"},
      Environment{{"TERM", "xterm"}}, 120);
  EXPECT_TRUE(terminal_->displays("standard output is none")) << screen();
  EXPECT_TRUE(terminal_->displays("end")) << screen();
  EXPECT_EQ(terminal_->bytes().find("\033[?1049h"), std::string::npos);
}

}  // namespace
}  // namespace tunica::shell
