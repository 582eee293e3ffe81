// SPDX-License-Identifier: MIT
#include "shell/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace tunica::shell {

namespace {

Colour chosen = Colour::automatic;

bool is_terminal(int descriptor) {
  const char* terminal = std::getenv("TERM");
  return isatty(descriptor) && terminal && std::strcmp(terminal, "dumb") != 0;
}

void say(const char* colour, std::string_view kind, std::string_view text) {
  const bool coloured = in_colour(STDERR_FILENO);
  std::fflush(stdout);  // so that both streams keep their order on a terminal
  fmt::print(stderr, "tunica: {}{}{}{}\n", coloured ? colour : "", kind, coloured ? "\033[0m" : "", text);
}

}  // namespace

bool error_is_terminal() { return is_terminal(STDERR_FILENO); }

void choose_colour(Colour colour) { chosen = colour; }

bool in_colour(int descriptor) {
  const char* no_colour = std::getenv("NO_COLOR");
  if ((no_colour && *no_colour) || chosen == Colour::never) return false;
  return chosen == Colour::always || is_terminal(descriptor);
}

void say_error(std::string_view text) { say("\033[1;31m", "error: ", text); }
void say_warning(std::string_view text) { say("\033[33m", "warning: ", text); }
void say_note(std::string_view text) { say("", "", text); }

}  // namespace tunica::shell
