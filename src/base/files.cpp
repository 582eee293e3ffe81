// SPDX-License-Identifier: MIT
#include "base/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/error.h"

namespace tunica {

namespace {

/// Closes on every way out; `close()` itself reports errors, because a full disk may show only there.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

int open_again(const char* path, int flags, mode_t mode = 0) {
  int number;
  do number = ::open(path, flags | O_CLOEXEC, mode);
  while (number < 0 && errno == EINTR);
  return number;
}

std::string folder_of(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

}  // namespace

std::string read_file(const std::string& path, size_t limit) {
  Descriptor file(open_again(path.c_str(), O_RDONLY | O_NOCTTY));
  if (file.number() < 0) fail("cannot read '{}': {}", path, std::strerror(errno));
  struct stat about {};
  if (fstat(file.number(), &about) == 0 && S_ISDIR(about.st_mode)) fail("cannot read '{}': it is a folder", path);
  std::string bytes;
  if (S_ISREG(about.st_mode)) bytes.reserve(std::min(limit, static_cast<size_t>(about.st_size)));
  char buffer[65536];
  for (;;) {
    const ssize_t count = ::read(file.number(), buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("cannot read '{}': {}", path, std::strerror(errno));
    if (count == 0) return bytes;
    bytes.append(buffer, static_cast<size_t>(count));
    if (bytes.size() > limit) fail("'{}' is too large: more than {} bytes", path, limit);
  }
}

void write_atomic(const std::string& path, std::string_view bytes) {
  // The process number keeps two programs apart that write the same file; each still replaces it as one act.
  const std::string temporary = fmt::format("{}.part-{}", path, ::getpid());
  Descriptor file(open_again(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666));
  if (file.number() < 0) fail("cannot write '{}': {}", path, std::strerror(errno));
  const auto give_up = [&] {
    const int reason = errno;
    ::unlink(temporary.c_str());
    fail("cannot write '{}': {}", path, std::strerror(reason));
  };
  if (!write_all(file.number(), bytes) || ::fsync(file.number()) != 0 || !file.close()) give_up();
  if (::rename(temporary.c_str(), path.c_str()) != 0) give_up();
  sync_folder(folder_of(path));
}

void rename_synced(const std::string& from, const std::string& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) fail("cannot rename '{}' to '{}': {}", from, to, std::strerror(errno));
  sync_folder(folder_of(to));
}

void sync_folder(const std::string& path) {
  Descriptor folder(open_again(path.c_str(), O_RDONLY | O_DIRECTORY));
  if (folder.number() < 0) fail("cannot open folder '{}': {}", path, std::strerror(errno));
  // Some file systems do not sync folders and say EINVAL: nothing more can be done there.
  if (::fsync(folder.number()) != 0 && errno != EINVAL) fail("cannot sync folder '{}': {}", path, std::strerror(errno));
}

void make_folders(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) fail("cannot make folder '{}': {}", path, error.message());
}

bool lock_file(const std::string& path) {
  const int number = open_again(path.c_str(), O_RDWR | O_CREAT, 0666);
  if (number < 0) fail("cannot open '{}': {}", path, std::strerror(errno));
  if (::flock(number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(number);
    return false;
  }
  // The number is for messages only: a full disk does not matter. The descriptor stays open, it is what holds the lock.
  if (::ftruncate(number, 0) == 0) write_all(number, fmt::format("{}\n", ::getpid()));
  return true;
}

std::vector<std::string> list_folder(const std::string& path) {
  std::error_code error;
  std::vector<std::string> names;
  for (std::filesystem::directory_iterator i(path, error), end; !error && i != end; i.increment(error))
    names.push_back(i->path().filename().string());
  if (error) fail("cannot list folder '{}': {}", path, error.message());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace tunica
