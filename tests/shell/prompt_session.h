// SPDX-License-Identifier: MIT
// What tests of the prompt have in common: a folder of their own, and the program on a pseudo-terminal.
#pragma once

#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "shell/pseudo_terminal.h"

namespace tunica::shell {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

class PromptTest : public ::testing::Test {
 protected:
  PromptTest() {
    std::string name = (fs::temp_directory_path() / "tunica_prompt_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~PromptTest() override {
    terminal_.reset();
    fs::remove_all(folder_);
  }

  std::map<std::string, std::string> environment() const {
    return {{"TERM", "xterm-256color"},
            {"LC_ALL", "C.UTF-8"},
            {"NO_COLOR", "1"},
            {"INPUTRC", "/dev/null"},
            {"HOME", folder_.string()},
            {"XDG_STATE_HOME", (folder_ / "state").string()},
            {"XDG_CONFIG_HOME", (folder_ / "config").string()},
            {"TUNICA_IMAGES", "blocks"}};
  }

  /// Starts the program and waits for its prompt.
  PseudoTerminal& start(const std::vector<std::string>& arguments = {}, std::map<std::string, std::string> more = {},
                        int width = 80) {
    std::vector<std::string> command = {TUNICA_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    more.merge(environment());
    terminal_ = std::make_unique<PseudoTerminal>(command, more, width);
    EXPECT_TRUE(terminal_->stands_at(">", 60)) << terminal_->screen().text();
    return *terminal_;
  }

  /// Types a line and expects an answer before the next prompt.
  void says(const std::string& line, const std::string& answer) {
    terminal_->type(line + "\r");
    EXPECT_TRUE(terminal_->shows(answer)) << "after: " << line << "\n" << terminal_->screen().text();
    EXPECT_TRUE(terminal_->stands_at(">")) << terminal_->screen().text();
  }

  /// How many times as long as alone something takes now that the machine has other work: wall clock over processor
  /// time of 0.05 s of work, at least 1.
  static double slowdown() {
    const auto cpu = [] {
      timespec t{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
      return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    const auto start = Clock::now();
    const double before = cpu();
    double used = 0;
    while ((used = cpu() - before) < 0.05) {
    }
    return std::max(1.0, std::chrono::duration<double>(Clock::now() - start).count() / used);
  }

  /// Types a line that goes on for ever, and then Ctrl-C; the seconds until the prompt is back, as they would be
  /// without the machine's other work.
  double time_to_stop(const std::string& line, double before = 0.5) {
    terminal_->type(line + "\r");
    terminal_->watch(before);
    EXPECT_NE(terminal_->screen().line(), ">") << "it ended by itself: " << line << "\n" << terminal_->screen().text();
    const double slow = slowdown();
    const auto start = Clock::now();
    terminal_->type("\x03");
    EXPECT_TRUE(terminal_->stands_at(">", 30)) << line << "\n" << terminal_->screen().text();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return seconds / std::max(slow, slowdown());
  }

  std::string file(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_;
  std::unique_ptr<PseudoTerminal> terminal_;
};

}  // namespace tunica::shell
