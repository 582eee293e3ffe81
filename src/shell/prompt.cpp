// SPDX-License-Identifier: MIT
#include "shell/prompt.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
// readline wants stdio first
#include <readline/history.h>
#include <readline/readline.h>

#include "base/error.h"
#include "shell/exit_codes.h"
#include "shell/terminal.h"
#include "shell/version.h"

namespace tunica::shell {

namespace {

/// readline calls this after a signal has come in: the line is given up.
int give_up_line() {
  rl_replace_line("", 0);
  rl_done = 1;
  return 0;
}

std::optional<std::string> read_line(const char* prompt) {
  if (!isatty(STDIN_FILENO)) {
    std::string line;
    if (!std::getline(std::cin, line)) return std::nullopt;
    return line;
  }
  char* line = readline(prompt);
  if (!line) return std::nullopt;
  if (*line) add_history(line);
  std::string text = line;
  std::free(line);
  return text;
}

/// Compiles as an expression, else as statements, and pushes the function. Returns false if more input is needed.
bool compile(lua_State* L, const std::string& text) {
  try {
    lua::load_text(L, "return " + text, "=(prompt)");
    return true;
  } catch (const Error&) {
  }
  try {
    lua::load_text(L, text, "=(prompt)");
    return true;
  } catch (const Error& error) {
    if (std::string_view(error.what()).ends_with("near '<eof>'")) return false;
    throw;
  }
}

void show_values(Session& session, int first) {
  lua_State* L = session.lua();
  const int count = lua_gettop(L) - first + 1;
  if (count == 0) return;
  lua_getglobal(L, "print");
  lua_insert(L, first);
  session.call(count, 0);
}

/// One input, perhaps of several lines. Returns false at the end of input.
bool one_turn(Session& session) {
  lua_State* L = session.lua();
  std::string text;
  for (;;) {
    session.interrupts().at_prompt(true);
    const auto line = read_line(text.empty() ? "> " : ">> ");
    const bool interrupted = session.interrupts().signal() != 0;
    session.interrupts().at_prompt(false);
    session.interrupts().calm(true);
    if (interrupted) return true;
    if (!line) return false;
    text += (text.empty() ? "" : "\n") + *line;
    if (text.find_first_not_of(" \t\n") == std::string::npos) return true;
    try {
      if (compile(L, text)) break;
    } catch (const Error& error) {
      say_error(error.what());
      return true;
    }
  }
  const int first = lua_gettop(L);
  if (session.call(0, LUA_MULTRET)) show_values(session, first);
  session.interrupts().calm(true);
  lua_settop(L, first - 1);
  std::fflush(stdout);
  return true;
}

}  // namespace

int run_prompt(Session& session, bool banner) {
  if (banner) fmt::print("{}\n", versions_as_text());
  rl_catch_signals = 0;
  rl_signal_event_hook = give_up_line;
  rl_readline_name = "tunica";
  while (one_turn(session)) {
  }
  if (isatty(STDIN_FILENO)) fmt::print("\n");
  return ok;
}

}  // namespace tunica::shell
