// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <string>

#include "view/picture.h"

namespace tunica {

/// A film of pictures, all of one size, encoded by ffmpeg as it is fed (H.264, 8 bit 4:2:0, plays everywhere). It is
/// written under a temporary name beside `path` and renamed when it is whole; whatever happens, `path` holds the old
/// file or a complete new one. The encoder is a process of its own group: a Ctrl-C meant for the run does not cut the
/// film off. No fork: the renderer's threads would not survive it.
class Movie {
 public:
  /// `frames_per_second` 1 to 240. Errors: a path that does not end in .mp4; numbers out of range. ffmpeg is started
  /// with the first picture.
  Movie(std::string path, double frames_per_second = 24);
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;
  /// Without finish(), the film is thrown away.
  ~Movie();

  /// Transparent parts come upon white; an odd side gets one more row or column of its own edge.
  /// Errors: no ffmpeg (names the package); a picture of another size; what ffmpeg says when it fails.
  void add(const Picture& picture);
  /// Completes the file. Errors: no picture was added; what ffmpeg or the system says.
  void finish();

  int frames() const { return frames_; }

 private:
  void start(const Picture& first);
  void send(const char* data, size_t size);
  /// Waits for the encoder's end; true if it was content.
  bool wait();
  [[noreturn]] void fail_with_messages(const char* what);
  void discard() noexcept;

  std::string path_, part_;
  double rate_;
  int width_ = 0, height_ = 0, frames_ = 0;
  int pipe_ = -1, messages_ = -1;
  pid_t encoder_ = -1;
  std::string frame_;
};

}  // namespace tunica
