// SPDX-License-Identifier: MIT
#include "shell/rescued.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <string_view>

namespace tunica::shell {

namespace {

constexpr size_t most_files = 20;
constexpr time_t longest = 30 * 24 * 3600;  // seconds

struct File {
  std::string path;
  timespec written;
};

bool is_later(const timespec& a, const timespec& b) {
  return a.tv_sec != b.tv_sec ? a.tv_sec > b.tv_sec : a.tv_nsec > b.tv_nsec;
}

bool is_rescued(std::string_view name) {
  constexpr std::string_view start = "rescued-";
  if (!name.starts_with(start)) return false;
  name.remove_prefix(start.size());
  if (name.ends_with(".lua")) name.remove_suffix(4);
  return !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
}

std::vector<File> rescued_files(const std::string& folder) {
  std::vector<File> files;
  std::error_code error;
  for (std::filesystem::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    struct stat about {};
    if (is_rescued(i->path().filename().string()) && lstat(i->path().c_str(), &about) == 0 && S_ISREG(about.st_mode))
      files.push_back({i->path().string(), about.st_mtim});
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return is_later(a.written, b.written); });
  return files;
}

}  // namespace

std::vector<std::string> look_after_rescued(const std::string& folder) {
  std::vector<File> files = rescued_files(folder);
  const time_t now = std::time(nullptr);
  while (!files.empty() && (files.size() > most_files || files.back().written.tv_sec < now - longest)) {
    unlink(files.back().path.c_str());
    files.pop_back();
  }
  // The time at which they were told of last is that of a file of its own.
  const std::string told = folder + "/rescued.told";
  struct stat about {};
  const bool before = stat(told.c_str(), &about) == 0;
  std::vector<std::string> lines;
  for (const auto& file : files) {
    if (before && !is_later(file.written, about.st_mtim)) break;
    lines.push_back(fmt::format("kept when a prompt had to end, {:%Y-%m-%d %H:%M}: {} \"{}\"",
                                fmt::localtime(file.written.tv_sec), file.path.ends_with(".lua") ? "dofile" : "restore",
                                file.path));
  }
  if (lines.empty()) return lines;
  if (const int stamp = open(told.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600); stamp >= 0) {
    futimens(stamp, nullptr);
    close(stamp);
  }
  return lines;
}

}  // namespace tunica::shell
