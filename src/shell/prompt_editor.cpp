// SPDX-License-Identifier: MIT
#include "shell/prompt_editor.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
// readline wants stdio first
#include <readline/readline.h>

namespace tunica::shell {

namespace {

Editor::Complete complete;
std::function<bool()> interrupted;
Completions found;
std::string typed_before;

/// The next byte of the keyboard. readline itself reads on after a signal; here the line is given up, without a gap
/// between looking and waiting in which a signal could be lost.
int read_key(FILE* stream) {
  sigset_t stopping, before;
  sigemptyset(&stopping);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGWINCH}) sigaddset(&stopping, signal);
  for (;;) {
    sigprocmask(SIG_BLOCK, &stopping, &before);
    const bool stop = interrupted();
    if (stop) typed_before.clear();
    if (!typed_before.empty()) {
      sigprocmask(SIG_SETMASK, &before, nullptr);
      const int key = static_cast<unsigned char>(typed_before.front());
      typed_before.erase(0, 1);
      return key;
    }
    pollfd ready{fileno(stream), POLLIN, 0};
    const int count = stop ? 0 : ppoll(&ready, 1, nullptr, &before);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    if (stop) {
      std::fputs("^C", rl_outstream);
      rl_done = 1;
      return '\n';
    }
    if (count > 0) return rl_getc(stream);
    rl_check_signals();  // the window has another size
  }
}

char* copy_of(const std::string& text) { return strdup(text.c_str()); }

std::string common_start(const std::vector<std::string>& words) {
  std::string common = words.front();
  for (const auto& word : words) {
    size_t same = 0;
    while (same < common.size() && same < word.size() && common[same] == word[same]) ++same;
    common.resize(same);
  }
  // Not in the middle of a character.
  while (!common.empty() && common.size() < words.front().size() && (words.front()[common.size()] & 0xC0) == 0x80)
    common.pop_back();
  return common;
}

/// The words for readline, which has its own idea of where the word under the cursor starts.
char** words_at_cursor(const char*, int start, int end) {
  rl_attempted_completion_over = 1;
  rl_completion_append_character = '\0';
  rl_completion_suppress_append = 1;
  found = complete(std::string(rl_line_buffer), static_cast<size_t>(end));
  if (found.candidates.empty()) return nullptr;
  const auto from = static_cast<size_t>(start);
  const std::string line(rl_line_buffer);
  std::vector<std::string> words;
  for (const auto& candidate : found.candidates) {
    if (found.start >= from)
      words.push_back(line.substr(from, found.start - from) + candidate.text);
    else
      words.push_back(candidate.text.substr(std::min(candidate.text.size(), from - found.start)));
  }
  const size_t shown = words.size() == 1 ? 0 : words.size();
  char** list = static_cast<char**>(std::malloc((shown + 2) * sizeof(char*)));
  list[0] = copy_of(common_start(words));
  for (size_t i = 0; i < shown; ++i) list[i + 1] = copy_of(words[i]);
  list[shown + 1] = nullptr;
  // A string that is whole gets its closing quote.
  rl_completion_suppress_quote = words.size() > 1 || words[0].ends_with('/');
  return list;
}

/// Bytes of the text that fill at most `width` columns, every character counting one.
std::string cut(const std::string& text, size_t width) {
  size_t at = 0;
  for (size_t columns = 0; at < text.size(); ++columns) {
    size_t next = at + 1;
    while (next < text.size() && (text[next] & 0xC0) == 0x80) ++next;
    if (columns == width) break;
    at = next;
  }
  return text.substr(0, at);
}

void show_with_help(size_t width) {
  size_t widest = 0;
  for (const auto& candidate : found.candidates) widest = std::max(widest, candidate.label.size());
  widest = std::min(widest, width / 2);
  for (const auto& candidate : found.candidates)
    fmt::print("{}\n", cut(fmt::format("{:<{}}  {}", candidate.label, widest, candidate.about), width - 1));
}

void show_in_columns(size_t width) {
  size_t widest = 0;
  for (const auto& candidate : found.candidates) widest = std::max(widest, candidate.label.size());
  const size_t across = std::max<size_t>(1, width / (widest + 2)), most = across * 40;
  const size_t count = std::min(found.candidates.size(), most), down = (count + across - 1) / across;
  for (size_t row = 0; row < down; ++row) {
    std::string line;
    for (size_t i = row; i < count; i += down) line += fmt::format("{:<{}}", found.candidates[i].label, widest + 2);
    fmt::print("{}\n", cut(line, width - 1));
  }
  if (count < found.candidates.size()) fmt::print("... {} more\n", found.candidates.size() - count);
}

void show_candidates(char**, int, int) {
  const auto width = static_cast<size_t>(terminal_width());
  const bool any_help = std::any_of(found.candidates.begin(), found.candidates.end(),
                                    [](const auto& candidate) { return !candidate.about.empty(); });
  fmt::print("\n");
  if (any_help && found.candidates.size() <= 40)
    show_with_help(width);
  else
    show_in_columns(width);
  std::fflush(stdout);
  rl_on_new_line();
}

/// The first Tab completes, and lists the candidates if there is nothing to add; the next lists them. In the blank at
/// the beginning of a line it is a tab as elsewhere: two blanks.
int tab(int, int) {
  const bool blank = std::all_of(rl_line_buffer, rl_line_buffer + rl_point, [](char c) { return c == ' '; });
  if (blank && rl_point > 0) return rl_insert_text("  "), 0;
  rl_complete_internal(rl_last_func == tab ? '?' : '@');
  return 0;
}

void replace_binding(const std::string& keys, rl_command_func_t* before, rl_command_func_t* now) {
  int kind = ISFUNC;
  if (rl_function_of_keyseq(keys.c_str(), nullptr, &kind) == before && kind == ISFUNC)
    rl_bind_keyseq(keys.c_str(), now);
}

}  // namespace

Editor::Editor(Complete function, std::function<bool()> stops) {
  complete = std::move(function);
  interrupted = std::move(stops);
  rl_catch_signals = 0;
  rl_getc_function = read_key;
  rl_readline_name = "tunica";
  rl_attempted_completion_function = words_at_cursor;
  rl_completion_display_matches_hook = show_candidates;
  rl_sort_completion_matches = 0;
  rl_ignore_completion_duplicates = 0;
  rl_basic_word_break_characters = " \t\n\"'`=;|&{}(),+-*/%^#~<>[]";
  rl_completer_quote_characters = nullptr;
  rl_initialize();
  rl_bind_key('\t', tab);
  // Up and Down look for what begins as the line does; unless the user's inputrc has something else for them.
  for (const std::string start : {"\033[", "\033O"}) {
    replace_binding(start + "A", rl_get_previous_history, rl_history_search_backward);
    replace_binding(start + "B", rl_get_next_history, rl_history_search_forward);
  }
}

Editor::~Editor() { complete = nullptr; }

std::optional<std::string> Editor::read(const char* prompt) {
  char* line = readline(prompt);
  if (!line) return std::nullopt;
  std::string text = line;
  std::free(line);
  return text;
}

void Editor::typed(std::string_view keys) { typed_before += keys; }

bool Editor::asks(const char* question) {
  char* line = readline(question);
  const bool yes = !line || *line == 'y' || *line == 'Y';
  std::free(line);
  return yes;
}

int terminal_width() {
  winsize size{};
  int width = 0;
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) width = size.ws_col;
  if (const char* columns = std::getenv("COLUMNS"); width <= 0 && columns) width = std::atoi(columns);
  return width <= 0 ? 80 : std::max(20, width);
}

}  // namespace tunica::shell
