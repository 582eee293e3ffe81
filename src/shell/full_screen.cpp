// SPDX-License-Identifier: MIT
#include "shell/full_screen.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <string_view>

#include "base/error.h"
#include "shell/signals.h"
#include "shell/terminal.h"
// ncurses defines macros of common names, so it comes last
#define NCURSES_WIDECHAR 1
#define NCURSES_NOMACROS 1
#include <curses.h>
#include <term.h>

namespace tunica::shell {

namespace {

constexpr std::array ends_program = {SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
termios before_all;

/// The terminal as it was, from within a signal handler: mouse, keypad, screen, colours, cursor, line settings.
void put_back_at_once() {
  constexpr std::string_view sequences =
      "\033[?1006l\033[?1003l\033[?1002l\033[?1000l\033[?1l\033>\033[0m\033[?1049l\033[?25h";
  if (write(STDOUT_FILENO, sequences.data(), sequences.size()) < 0) {
  }
  tcsetattr(STDOUT_FILENO, TCSANOW, &before_all);
}

void on_end(int number) {
  put_back_at_once();
  raise(number);  // SA_RESETHAND: now with the usual effect
}

void on_resize(int) {}  // only ends the waiting

void install(int number, void (*handler)(int), int flags, struct sigaction* old) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, old);
}

void check_terminal() {
  const char* terminal = std::getenv("TERM");
  if (!isatty(STDIN_FILENO)) fail("this needs a terminal, and standard input is none");
  if (!isatty(STDOUT_FILENO))
    fail("this needs a terminal, and standard output is none (it goes into a file or a pipe)");
  if (!terminal || !*terminal) fail("this needs a terminal that can move its cursor, and TERM, its kind, is not set");
  if (std::strcmp(terminal, "dumb") == 0) fail("this needs a terminal that can move its cursor, and TERM is 'dumb'");
}

const std::map<int, std::string>& names_of_keys() {
  static const std::map<int, std::string> names = {
      {KEY_LEFT, "left"},    {KEY_RIGHT, "right"},      {KEY_UP, "up"},
      {KEY_DOWN, "down"},    {KEY_SLEFT, "shift-left"}, {KEY_SRIGHT, "shift-right"},
      {KEY_SR, "shift-up"},  {KEY_SF, "shift-down"},    {KEY_HOME, "home"},
      {KEY_END, "end"},      {KEY_IC, "insert"},        {KEY_DC, "delete"},
      {KEY_BTAB, "backtab"}, {KEY_ENTER, "enter"},      {KEY_BACKSPACE, "backspace"}};
  return names;
}

std::string name_of_key(int code) {
  const auto found = names_of_keys().find(code);
  if (found != names_of_keys().end()) return found->second;
  const char* name = keyname(code);
  if (name && std::strcmp(name, "kUP") == 0) return "shift-up";
  if (name && std::strcmp(name, "kDN") == 0) return "shift-down";
  return "other";
}

std::string utf8(wint_t c) {
  std::string text;
  if (c < 0x80) {
    text += static_cast<char>(c);
  } else if (c < 0x800) {
    text += static_cast<char>(0xC0 | (c >> 6));
    text += static_cast<char>(0x80 | (c & 0x3F));
  } else {
    if (c >= 0x10000) text += static_cast<char>(0xF0 | (c >> 18));
    text += static_cast<char>(c >= 0x10000 ? 0x80 | ((c >> 12) & 0x3F) : 0xE0 | (c >> 12));
    text += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (c & 0x3F));
  }
  return text;
}

std::string name_of_character(wint_t c) {
  switch (c) {
    case '\t':
      return "tab";
    case '\r':
    case '\n':
      return "enter";
    case 3:
      return "ctrl-c";
    case 21:
      return "ctrl-u";
    case 27:
      return "escape";
    case 8:
    case 127:
      return "backspace";
    default:
      return c < 32 ? "other" : utf8(c);
  }
}

std::string name_of_mouse(mmask_t state) {
  if (state & BUTTON1_PRESSED) return "mouse-press";
  if (state & BUTTON1_RELEASED) return "mouse-release";
  return state & (BUTTON2_PRESSED | BUTTON3_PRESSED) ? "mouse-other" : "other";
}

}  // namespace

struct FullScreen::State {
  SCREEN* screen = nullptr;
  std::deque<Key> mouse;       ///< events read and not yet given
  TERMINAL* others = nullptr;  ///< readline's
  struct sigaction resize {
  }, stop{}, ends[ends_program.size()] = {};
};

FullScreen::FullScreen(bool colour) : colour_(colour), state_(nullptr) {
  check_terminal();
  std::fflush(stdout);
  auto state = std::make_unique<State>();
  state->others = cur_term;
  tcgetattr(STDOUT_FILENO, &before_all);
  // Before ncurses looks: it then leaves both signals to us. The editor cannot be suspended.
  install(SIGWINCH, on_resize, 0, &state->resize);
  install(SIGTSTP, SIG_IGN, 0, &state->stop);
  state->screen = newterm(nullptr, stdout, stdin);
  if (!state->screen || !tigetstr("cup") || tigetstr("cup") == reinterpret_cast<char*>(-1)) {
    if (state->screen) {
      endwin();
      delscreen(state->screen);
    }
    set_curterm(state->others);
    sigaction(SIGWINCH, &state->resize, nullptr);
    sigaction(SIGTSTP, &state->stop, nullptr);
    fail("this needs a terminal that can move its cursor; TERM is '{}', of which that is not known",
         std::string(std::getenv("TERM")).substr(0, 60));
  }
  for (size_t i = 0; i < ends_program.size(); ++i) install(ends_program[i], on_end, SA_RESETHAND, &state->ends[i]);
  at_abrupt_end(put_back_at_once);
  raw();
  noecho();
  nonl();
  keypad(stdscr, TRUE);
  nodelay(stdscr, TRUE);
  set_escdelay(300);  // a slow line may part the sequence of an arrow
  mouseinterval(0);
  mousemask(BUTTON1_PRESSED | BUTTON1_RELEASED | BUTTON2_PRESSED | BUTTON3_PRESSED, nullptr);
  colour_ = colour && has_colors();
  if (colour_) {
    start_color();
    use_default_colors();
    const short colours[] = {COLOR_CYAN, COLOR_YELLOW, COLOR_RED, COLOR_GREEN};
    for (short i = 0; i < 4; ++i) init_pair(static_cast<short>(i + 1), colours[i], -1);
  }
  state_ = state.release();
}

FullScreen::~FullScreen() {
  mousemask(0, nullptr);
  endwin();
  std::fflush(stdout);
  delscreen(state_->screen);
  set_curterm(state_->others);
  at_abrupt_end(nullptr);
  for (size_t i = 0; i < ends_program.size(); ++i) sigaction(ends_program[i], &state_->ends[i], nullptr);
  sigaction(SIGWINCH, &state_->resize, nullptr);
  sigaction(SIGTSTP, &state_->stop, nullptr);
  delete state_;
}

int FullScreen::width() const { return getmaxx(stdscr); }
int FullScreen::height() const { return getmaxy(stdscr); }

FullScreen::Key FullScreen::key(bool (*stops)(void*), void* context) {
  sigset_t stopping, before;
  sigemptyset(&stopping);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGWINCH}) sigaddset(&stopping, signal);
  for (int empty = 0; empty < 50;) {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0 &&
        (size.ws_col != width() || size.ws_row != height())) {
      resizeterm(size.ws_row, size.ws_col);
      return {"resize"};
    }
    if (!state_->mouse.empty()) {
      const Key key = state_->mouse.front();
      state_->mouse.pop_front();
      return key;
    }
    wint_t c = 0;
    const int kind = stops(context) ? ERR : get_wch(&c);
    if (kind == KEY_CODE_YES && c == KEY_MOUSE) {
      // What came at once, ncurses announces once and gives last first.
      for (MEVENT event; getmouse(&event) == OK;)
        state_->mouse.push_front({name_of_mouse(event.bstate), event.x, event.y});
      continue;
    }
    if (kind == KEY_CODE_YES) return {name_of_key(static_cast<int>(c))};
    if (kind == OK) return {name_of_character(c)};
    // Without a gap between looking and waiting in which a signal could be lost.
    sigprocmask(SIG_BLOCK, &stopping, &before);
    pollfd ready{STDIN_FILENO, POLLIN, 0};
    const bool stop = stops(context);
    const int count = stop ? 0 : ppoll(&ready, 1, nullptr, &before);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    if (stop || (count > 0 && !(ready.revents & POLLIN))) break;
    if (count > 0) ++empty;  // readable again and again with nothing to read: the terminal has gone
  }
  return {"stop"};
}

void FullScreen::clear() { erase(); }

void FullScreen::put(int row, int column, const std::string& text, const std::string& style) {
  if (row < 0 || row >= height() || column < 0 || column >= width()) return;
  static const std::map<std::string, std::pair<int, attr_t>> styles = {
      {"curve", {1, A_BOLD}}, {"polygon", {0, A_DIM}}, {"point", {2, A_BOLD}}, {"selected", {2, A_BOLD | A_REVERSE}},
      {"axis", {0, A_DIM}},   {"title", {0, A_BOLD}},  {"error", {3, A_BOLD}}, {"message", {4, A_NORMAL}}};
  const auto found = styles.find(style);
  const auto [pair, attributes] = found == styles.end() ? std::pair<int, attr_t>{0, A_NORMAL} : found->second;
  attrset(static_cast<int>(attributes | (colour_ && pair ? COLOR_PAIR(pair) : 0)));
  mvaddstr(row, column, text.c_str());
  attrset(A_NORMAL);
}

void FullScreen::show(int column, int row) {
  curs_set(column >= 0 ? 1 : 0);
  if (column >= 0) move(std::min(row, height() - 1), std::min(column, width() - 1));
  refresh();
}

}  // namespace tunica::shell
