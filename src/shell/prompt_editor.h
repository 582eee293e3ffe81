// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::shell {

/// What could stand where the cursor is.
struct Candidate {
  std::string text;   ///< the whole word
  std::string label;  ///< as it is shown
  std::string about;  ///< one line of help, or ""
};
struct Completions {
  size_t start = 0;  ///< where the word begins in the line, in bytes
  std::vector<Candidate> candidates;
};

/// The line editor of the terminal (GNU readline). There is one: readline keeps its state in variables of its own.
class Editor {
 public:
  using Complete = std::function<Completions(const std::string& line, size_t cursor)>;

  /// `complete` is called at Tab; it must not throw. `interrupted`: whether a signal has come that ends the line being
  /// typed.
  Editor(Complete complete, std::function<bool()> interrupted);
  ~Editor();
  Editor(const Editor&) = delete;

  /// Reads a line, or several that were pasted at once. Returns nothing at the end of input; what was typed so far if a
  /// signal has come.
  std::optional<std::string> read(const char* prompt);

  /// Keys that were typed before: they are read first.
  void typed(std::string_view keys);

  /// A question that one key answers: whether it was y.
  bool asks(const char* question);
};

/// Columns of the terminal that shows standard output; COLUMNS, or 80, where there is none. Never less than 20.
int terminal_width();

}  // namespace tunica::shell
