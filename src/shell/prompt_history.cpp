// SPDX-License-Identifier: MIT
#include "shell/prompt_history.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
// readline wants stdio first
#include <readline/history.h>

#include "shell/terminal.h"

namespace tunica::shell {

namespace {

constexpr int most_entries = 10000;
constexpr off_t largest_file = 4 << 20;

/// The file of a lock beside the history: the history itself is replaced when it is cut.
class Lock {
 public:
  explicit Lock(const std::string& path) : file_(open((path + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    // A prompt that was stopped while it held the lock must not stop this one: some tenths of a second are enough.
    for (int i = 0; file_ >= 0 && i < 20 && flock(file_, LOCK_EX | LOCK_NB) != 0; ++i) usleep(10000);
  }
  ~Lock() {
    if (file_ >= 0) close(file_);
  }
  Lock(const Lock&) = delete;

 private:
  int file_;
};

/// Only the user may read what was typed.
bool make_file(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return false;
  close(file);
  return true;
}

/// All of an entry, or nothing of it (a full disk): the next one must not be glued to half a line. errno says why.
bool append(const std::string& path, const std::string& entry) {
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return false;
  const off_t size = lseek(file, 0, SEEK_END);
  const ssize_t written = write(file, entry.data(), entry.size());
  const bool whole = written == static_cast<ssize_t>(entry.size());
  const int why = written < 0 ? errno : ENOSPC;
  if (!whole && size >= 0 && ftruncate(file, size) != 0) {
  }
  close(file);
  if (!whole) errno = why;
  return whole;
}

std::string user_path(const char* variable, const char* below_home, const char* name) {
  const char* folder = std::getenv(variable);
  if (folder && *folder == '/') return std::string(folder) + name;
  const char* home = std::getenv("HOME");
  return home && *home ? std::string(home) + below_home + name : "";
}

}  // namespace

std::string history_path() { return user_path("XDG_STATE_HOME", "/.local/state", "/tunica/history"); }
std::string init_path() { return user_path("XDG_CONFIG_HOME", "/.config", "/tunica/init.lua"); }

History::History(std::string path) : path_(std::move(path)) {
  using_history();
  // With times between entries, an entry may have several lines.
  history_comment_char = '#';
  history_write_timestamps = 1;
  history_multiline_entries = 1;
  stifle_history(most_entries);
  if (path_.empty()) return;
  if (!make_file(path_)) {  // what is there can be read all the same
    read_history(path_.c_str());
    path_.clear();
    return;
  }
  const Lock lock(path_);
  struct stat about {};
  if (stat(path_.c_str(), &about) == 0 && about.st_size > largest_file) {
    history_truncate_file(path_.c_str(), most_entries);
    chmod(path_.c_str(), 0600);
  }
  read_history(path_.c_str());
}

void History::add(const std::string& text) {
  const HIST_ENTRY* last = history_length > 0 ? history_get(history_base + history_length - 1) : nullptr;
  if (last && text == last->line) return;
  add_history(text.c_str());
  if (path_.empty() || text.starts_with(' ')) return;
  const Lock lock(path_);
  if (append(path_, fmt::format("#{}\n{}\n", std::time(nullptr), text))) return;
  say_warning(fmt::format("what is typed is not kept any more: {}: {}", path_, std::strerror(errno)));
  path_.clear();
}

}  // namespace tunica::shell
