// SPDX-License-Identifier: MIT
// A program on a pseudo-terminal, as someone sees it who sits before the screen.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace tunica::shell {

/// What is on a screen after bytes were written to it: text, cursor movements, erasing; colours are left out.
class Screen {
 public:
  explicit Screen(int width) : width_(width), lines_(1) {}
  void write(const std::string& bytes);
  /// All lines so far, those scrolled away included, without blanks at their ends.
  std::string text() const;
  /// Number of the cursor's line, and where it begins in `text`.
  size_t row_number() const { return y_; }
  size_t row_start() const;
  /// The line of the cursor.
  std::string line() const;
  /// Lines from now on have this width.
  void set_width(int width) { width_ = width; }
  /// Whether the alternate screen is shown, of which `text` then tells.
  bool alternate() const { return alternate_; }
  /// Whether a colour was asked for.
  bool coloured() const { return coloured_; }

 private:
  void put(const std::string& character);
  void sequence(const std::string& parameters, char final);
  void scroll(size_t from, long count);
  void mode(const std::string& parameters, bool on);
  std::vector<std::string>& row();

  int width_;
  size_t y_ = 0, x_ = 0;
  std::vector<std::vector<std::string>> lines_;  // of characters
  std::string unfinished_;
  std::vector<std::vector<std::string>> normal_lines_;  // while the alternate screen is shown
  size_t top_ = 0, bottom_ = 40;  // of what scrolls on the alternate screen; the line behind its last
  size_t normal_y_ = 0, normal_x_ = 0;
  bool coloured_ = false, alternate_ = false;
  std::string last_ = " ";
};

/// Starts a program on a terminal of its own, and ends it.
class PseudoTerminal {
 public:
  PseudoTerminal(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment,
                 int width = 80);
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;

  void type(const std::string& keys);
  /// Waits until the screen's text holds `text`, from the line on in which keys were typed last; false after `seconds`.
  bool shows(const std::string& text, double seconds = 20);
  /// The same, anywhere on the screen.
  bool displays(const std::string& text, double seconds = 20);
  /// Waits until the text is nowhere on the screen.
  bool hides(const std::string& text, double seconds = 20);
  /// Waits until the cursor stands on a line that is exactly `line`, below that in which keys were typed last.
  bool stands_at(const std::string& line, double seconds = 20);
  /// Reads what comes for some time.
  void watch(double seconds);
  /// Waits for the end of the program; its exit code, or -1 if it goes on.
  int exit_code(double seconds = 20);
  const Screen& screen() const { return screen_; }
  const std::string& bytes() const { return bytes_; }
  void resize(int width);
  void send_signal(int number);

 private:
  bool read_some(double seconds);

  Screen screen_;
  std::string bytes_;
  size_t mark_ = 0;  // where the line begins in which keys were typed last
  long row_ = -1;    // its number
  int terminal_ = -1, process_ = -1;
};

}  // namespace tunica::shell
