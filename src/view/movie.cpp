// SPDX-License-Identifier: MIT
#include "view/movie.h"

#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "view/spawn.h"

namespace tunica {
namespace {

int even(int side) { return side + side % 2; }

pid_t start_encoder(const std::vector<std::string>& command, int input, int messages) {
  const pid_t encoder = spawn(command, input, messages);
  if (encoder == -ENOENT) fail("cannot make a movie: ffmpeg is not installed (Debian: apt-get install ffmpeg)");
  if (encoder < 0) fail("cannot make a movie: ffmpeg does not start: {}", std::strerror(-encoder));
  return encoder;
}

std::vector<std::string> command_for(int width, int height, double rate, const std::string& path) {
  std::istringstream words(fmt::format(
      "ffmpeg -nostdin -y -loglevel error -f rawvideo -pix_fmt rgb24 -s {}x{} -framerate {} -i pipe:0 -an -c:v libx264 "
      "-crf 17 -threads 2 -vf scale=out_color_matrix=bt709 -pix_fmt yuv420p -colorspace bt709 -color_primaries bt709 "
      "-color_trc bt709 -map_metadata -1 -fflags +bitexact -flags:v +bitexact -movflags +faststart",
      even(width), even(height), rate));
  std::vector<std::string> command;
  for (std::string word; words >> word;) command.push_back(word);
  // "file:" keeps the encoder from taking a name with "-", ":" or "%" for something else.
  command.push_back("file:" + path);
  return command;
}

}  // namespace

Movie::Movie(std::string path, double frames_per_second) : path_(std::move(path)), rate_(frames_per_second) {
  if (path_.size() < 5 || path_.substr(path_.size() - 4) != ".mp4" || path_.find('\0') != std::string::npos)
    fail("a movie's file must end in .mp4, not '{}'", path_);
  if (!(rate_ >= 1 && rate_ <= 240)) fail("a movie has 1 to 240 pictures a second, not {}", rate_);
  part_ = fmt::format("{}.part-{}.mp4", path_.substr(0, path_.size() - 4), getpid());
}

Movie::~Movie() { discard(); }

void Movie::start(const Picture& first) {
  if (first.width < 16 || first.height < 16 || first.width > 8192 || first.height > 8192)
    fail("a movie's pictures must be 16 to 8192 pixels a side, not {} x {}", first.width, first.height);
  width_ = first.width, height_ = first.height;
  // A socket instead of a pipe: writing to a dead encoder is then an error of the call and never a SIGPIPE.
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    fail("cannot make a movie: {}", std::strerror(errno));
  messages_ = memfd_create("ffmpeg messages", MFD_CLOEXEC);
  pipe_ = ends[0];
  try {
    if (messages_ < 0) fail("cannot make a movie: {}", std::strerror(errno));
    encoder_ = start_encoder(command_for(width_, height_, rate_, part_), ends[1], messages_);
  } catch (...) {
    close(ends[1]);
    discard();
    throw;
  }
  close(ends[1]);
}

void Movie::add(const Picture& picture) {
  if (encoder_ < 0 && frames_ > 0) fail("the movie {} is finished; nothing can be added", path_);
  if (encoder_ < 0) start(picture);
  if (picture.width != width_ || picture.height != height_)
    fail("the movie {} has pictures of {} x {} pixels; one of {} x {} cannot be added", path_, width_, height_,
         picture.width, picture.height);
  const int w = even(width_), h = even(height_);
  frame_.resize(static_cast<size_t>(w) * static_cast<size_t>(h) * 3);
  auto* out = reinterpret_cast<uint8_t*>(frame_.data());
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x, out += 3) {
      const auto pixel = picture.at(std::min(x, width_ - 1), std::min(y, height_ - 1));
      for (size_t c = 0; c < 3; ++c)
        out[c] = static_cast<uint8_t>((pixel[c] * pixel[3] + 255 * (255 - pixel[3]) + 127) / 255);
    }
  send(frame_.data(), frame_.size());
  ++frames_;
}

void Movie::send(const char* data, size_t size) {
  while (size > 0) {
    const ssize_t sent = ::send(pipe_, data, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) fail_with_messages("stopped early");
    data += sent;
    size -= static_cast<size_t>(sent);
  }
}

bool Movie::wait() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
  const bool content = wait_for(encoder_);
  encoder_ = -1;
  return content;
}

void Movie::fail_with_messages(const char* what) {
  if (encoder_ >= 0) wait();
  char text[2000] = "";
  const ssize_t size = pread(messages_, text, sizeof text - 1, 0);
  std::string said(text, size > 0 ? static_cast<size_t>(size) : 0);
  while (!said.empty() && said.back() == '\n') said.pop_back();
  discard();
  fail("cannot make the movie {}: ffmpeg {}{}{}", path_, what, said.empty() ? "" : ": ", said);
}

void Movie::finish() {
  if (frames_ == 0) fail("cannot make the movie {}: it has no pictures", path_);
  if (encoder_ < 0) return;
  if (!wait()) fail_with_messages("failed");
  rename_synced(part_, path_);
  part_.clear();
  discard();
}

void Movie::discard() noexcept {
  if (encoder_ >= 0) {
    kill(encoder_, SIGKILL);
    wait();
  }
  if (pipe_ >= 0) close(pipe_);
  if (messages_ >= 0) close(messages_);
  pipe_ = messages_ = -1;
  if (!part_.empty() && frames_ + width_ > 0) std::remove(part_.c_str());
}

}  // namespace tunica
