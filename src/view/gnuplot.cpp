// SPDX-License-Identifier: MIT
#include "view/gnuplot.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "view/spawn.h"

namespace tunica {
namespace {

/// A file in memory, which needs no place on a disk and no name.
class Memory {
 public:
  explicit Memory(const char* name) : file_(memfd_create(name, MFD_CLOEXEC)) {
    if (file_ < 0) fail("cannot draw a chart: {}", std::strerror(errno));
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { close(file_); }
  int file() const { return file_; }

  void fill(const std::string& text) {
    for (size_t done = 0; done < text.size();) {
      const ssize_t written = write(file_, text.data() + done, text.size() - done);
      if (written < 0 && errno != EINTR) fail("cannot draw a chart: {}", std::strerror(errno));
      if (written > 0) done += static_cast<size_t>(written);
    }
    lseek(file_, 0, SEEK_SET);
  }
  std::string beginning() const {
    char text[1000];
    const ssize_t size = pread(file_, text, sizeof text, 0);
    return {text, size > 0 ? static_cast<size_t>(size) : 0};
  }

 private:
  int file_;
};

}  // namespace

void run_gnuplot(const std::string& commands, const CancelFlag* cancel) {
  Memory input("gnuplot commands"), messages("gnuplot messages");
  input.fill(commands);
  const pid_t plotter = spawn({"gnuplot", "-"}, input.file(), messages.file());
  if (plotter == -ENOENT) fail("gnuplot is not installed (Debian: apt-get install gnuplot-nox)");
  if (plotter < 0) fail("gnuplot does not start: {}", std::strerror(-plotter));
  const bool done = wait_for(plotter, cancel);
  poll(cancel);
  if (!done) fail("gnuplot failed: {}", messages.beginning());
}

}  // namespace tunica
