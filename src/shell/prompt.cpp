// SPDX-License-Identifier: MIT
#include "shell/prompt.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <memory>
#include <utility>

#include "lua/guard.h"
#include "shell/exit_codes.h"
#include "shell/prompt_editor.h"
#include "shell/prompt_history.h"
#include "shell/rescued.h"
#include "shell/screen.h"
#include "shell/terminal.h"
#include "shell/version.h"

namespace tunica::shell {

namespace {

/// The conversation, whose Lua half is lua/tunica/prompt/session.lua.
class Prompt {
 public:
  Prompt(Session& session, const PromptOptions& options);
  int run();

 private:
  enum class Turn { done, failed, more, leave };

  bool open();
  void call_session(const char* function);
  Completions complete(const std::string& line, size_t cursor);
  std::optional<std::string> read_line(const char* prompt);
  Turn one_input();
  Turn take(const std::string& text, bool last);
  bool leave_after_interrupt();

  Session& session_;
  PromptOptions options_;
  const bool terminal_ = isatty(STDIN_FILENO) != 0;
  std::unique_ptr<History> history_;
  std::unique_ptr<Editor> editor_;
  int interrupts_in_a_row_ = 0;
  bool failed_;
};

Prompt::Prompt(Session& session, const PromptOptions& options) : session_(session), options_(options), failed_(options.failed) {
  if (!terminal_) return;
  history_ = std::make_unique<History>(options.keeps_history ? history_path() : "");
  editor_ = std::make_unique<Editor>([this](const auto& line, size_t cursor) { return complete(line, cursor); },
                                     [this] { return session_.interrupts().signal() != 0; });
}

/// Pushes a function of the Lua half.
void Prompt::call_session(const char* function) {
  lua_State* L = session_.lua();
  lua_getfield(L, LUA_REGISTRYINDEX, "tunica.prompt");
  lua_getfield(L, -1, function);
  lua_remove(L, -2);
}

bool Prompt::open() {
  lua_State* L = session_.lua();
  tell_screen(session_);
  lua_getglobal(L, "require");
  lua_pushliteral(L, "tunica.prompt.session");
  if (!session_.call(1, 1)) return false;
  lua_setfield(L, LUA_REGISTRYINDEX, "tunica.prompt");
  call_session("start");
  lua_pushboolean(L, !options_.keeps_history);
  if (!session_.call(1, 0)) return false;
  lua_getfield(L, LUA_REGISTRYINDEX, "tunica.model");
  if (!lua_isnil(L, -1)) {
    call_session("take");
    lua_insert(L, -2);
    lua_getfield(L, LUA_REGISTRYINDEX, "tunica.model_name");
    if (!session_.call(2, 0)) return false;
  }
  lua_settop(L, 0);
  if (const std::string path = init_path(); options_.runs_init && !path.empty() && access(path.c_str(), R_OK) == 0) {
    call_session("init");
    lua_pushstring(L, path.c_str());
    session_.call(1, 0);
    session_.interrupts().calm(true);
  }
  return true;
}

Completions Prompt::complete(const std::string& line, size_t cursor) {
  lua_State* L = session_.lua();
  Completions completions;
  const int top = lua_gettop(L);
  lua_getglobal(L, "require");
  lua_pushliteral(L, "tunica.prompt.complete");
  if (lua_pcall(L, 1, 1, 0) == 0) {
    lua_pushlstring(L, line.data(), line.size());
    lua_pushinteger(L, static_cast<lua_Integer>(cursor));
    if (lua_pcall(L, 2, 2, 0) == 0 && lua_istable(L, -1)) {
      completions.start = static_cast<size_t>(lua_tointeger(L, -2));
      const auto field = [&](const char* name) {
        lua_getfield(L, -1, name);
        std::string text = lua_tostring(L, -1) ? lua_tostring(L, -1) : "";
        lua_pop(L, 1);
        return text;
      };
      for (int i = 1; i <= static_cast<int>(lua_objlen(L, -1)); ++i) {
        lua_rawgeti(L, -1, i);
        completions.candidates.push_back({field("text"), field("label"), field("about")});
        lua_pop(L, 1);
      }
    }
  }
  lua_settop(L, top);
  return completions;
}

std::optional<std::string> Prompt::read_line(const char* prompt) {
  if (editor_) {
    editor_->typed(std::exchange(session_.terminal().typed, ""));
    return editor_->read(prompt);
  }
  std::string line;
  if (!std::getline(std::cin, line)) return std::nullopt;
  return line;
}

Prompt::Turn Prompt::take(const std::string& text, bool last) {
  lua_State* L = session_.lua();
  call_session("turn");
  lua_pushlstring(L, text.data(), text.size());
  lua_pushboolean(L, last);
  Turn turn = Turn::failed;
  if (session_.call(2, 1)) {
    const std::string_view word = lua_tostring(L, -1) ? lua_tostring(L, -1) : "";
    turn = word == "done" ? Turn::done : word == "more" ? Turn::more : word == "leave" ? Turn::leave : Turn::failed;
    lua_pop(L, 1);
  }
  return turn;
}

/// After Ctrl-C at the prompt: the second in a row asks.
bool Prompt::leave_after_interrupt() {
  if (!terminal_) return true;
  if (++interrupts_in_a_row_ < 2) return false;
  interrupts_in_a_row_ = 0;
  const bool yes = editor_->asks("leave tunica? (y or n) ");
  session_.interrupts().calm(true);
  return yes;
}

/// One input, perhaps of several lines.
Prompt::Turn Prompt::one_input() {
  Interrupts& interrupts = session_.interrupts();
  std::string text;
  for (;;) {
    interrupts.at_prompt(true);
    const auto line = read_line(text.empty() ? "> " : ">> ");
    const int signal = interrupts.signal();
    if (signal && signal != SIGINT) return Turn::leave;
    if (signal) {
      interrupts.calm(true);
      const bool leave = leave_after_interrupt();
      interrupts.at_prompt(false);
      return leave ? Turn::leave : Turn::more;
    }
    interrupts.at_prompt(false);
    interrupts.calm(true);
    if (!line && text.empty()) return Turn::leave;
    if (line && !text.empty()) text += '\n';
    if (line) text += *line;
    if (text.find_first_not_of(" \t\n") == std::string::npos) {
      if (!line) return Turn::leave;
      return Turn::more;
    }
    interrupts_in_a_row_ = 0;
    const Turn turn = take(text, !line);
    if (turn == Turn::more && line) continue;
    if (history_ && line) history_->add(text);
    if (interrupts.signal() == SIGINT) interrupts_in_a_row_ = 1;
    if (interrupts.signal() && interrupts.signal() != SIGINT) return Turn::leave;
    interrupts.calm(true);
    lua_settop(session_.lua(), 0);
    std::fflush(stdout);
    return turn;
  }
}

int Prompt::run() {
  if (!open()) return session_.exit_code();
  if (options_.banner && terminal_) fmt::print("{}\n", versions_as_text());
  if (terminal_ && options_.keeps_history) {
    const std::string path = history_path();
    for (const auto& line : look_after_rescued(path.substr(0, path.rfind('/')))) say_note(line);
  }
  session_.interrupts().interactive(terminal_);
  for (Turn turn = Turn::done; turn != Turn::leave;) {
    call_session("look");
    session_.call(0, 0);
    turn = one_input();
    failed_ = failed_ || turn == Turn::failed;
  }
  const int signal = session_.interrupts().signal();
  if (terminal_) fmt::print("\n");
  session_.interrupts().interactive(false);
  if (signal) return signal == SIGINT && terminal_ ? ok : session_.code_of_stop();
  return failed_ && !terminal_ ? script_error : ok;
}

}  // namespace

int run_prompt(Session& session, const PromptOptions& options) { return Prompt(session, options).run(); }

}  // namespace tunica::shell
