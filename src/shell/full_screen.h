// SPDX-License-Identifier: MIT
// The whole terminal, for the editor of curves: text anywhere, keys and mouse one by one. By ncurses.
#pragma once

#include <string>

namespace tunica::shell {

/// For as long as it lives: alternate screen, no echo, the mouse reported (buttons, as xterm does). Its end puts all of
/// that back, and so does a signal that ends the program. One at a time.
class FullScreen {
 public:
  /// Errors: input or output is no terminal; one that cannot move the cursor or is not known (TERM).
  explicit FullScreen(bool colour);
  ~FullScreen();
  FullScreen(const FullScreen&) = delete;

  struct Key {
    std::string name;  ///< a character; "left", "shift-left", "tab" ...; "mouse-press", "mouse-release", "mouse-other"
    int column = 0, row = 0;  ///< of the mouse, from 0
  };
  /// Waits for a key. "resize": the window has another size; "stop": a signal has come (see `stops`), or the terminal
  /// has gone.
  Key key(bool (*stops)(void*), void* context);

  int width() const;
  int height() const;

  void clear();
  /// UTF-8 text at a place. Styles: "curve", "polygon", "point", "selected", "axis", "title", "error", "message", or
  /// "".
  void put(int row, int column, const std::string& text, const std::string& style);
  /// Shows what was put; the cursor at a place, or hidden (column < 0).
  void show(int column, int row);

 private:
  bool colour_;
  struct State;
  State* state_;
};

}  // namespace tunica::shell
