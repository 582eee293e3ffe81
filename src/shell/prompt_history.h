// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tunica::shell {

/// What was typed, from one prompt to the next: a file that several prompts add to, each its own inputs, under a lock.
/// An input of several lines is one entry. Only the user can read it.
class History {
 public:
  /// `path`: "" keeps nothing on disk. A file that cannot be written is read all the same, and nothing is added to it.
  explicit History(std::string path);

  /// Adds an input, unless it repeats the one before or begins with a blank (which keeps it out of the file too).
  /// If the file takes no more (a full disk) that is said once, and the file stays as it was.
  void add(const std::string& text);

 private:
  std::string path_;
};

/// $XDG_STATE_HOME/tunica/history, by default under ~/.local/state; "" if there is no home.
std::string history_path();

/// $XDG_CONFIG_HOME/tunica/init.lua, by default under ~/.config; "" if there is no home.
std::string init_path();

}  // namespace tunica::shell
