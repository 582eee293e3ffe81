// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "view/gl.h"
#include "view/projector.h"
#include "view/scene.h"

namespace tunica {

/// Places on a scale from `min` to `max` at round numbers (1, 2 or 5 times a power of ten apart), about `wanted` of
/// them, with the texts that name them, all to the same number of digits.
struct Tick {
  double value;
  std::string text;
};
std::vector<Tick> ticks_between(double min, double max, int wanted);

/// Where the parts of a picture go: what is left for the content, and title, colour bars and keys around it.
class Legend {
 public:
  explicit Legend(const Scene& scene);

  const Rect& frame() const { return frame_; }
  double font_size() const { return font_; }
  void add_shapes(std::vector<Vertex>& triangles) const;
  void draw_texts(std::vector<uint8_t>& pixels) const;

  /// The rectangle of the colours of bar `i`, in whole pixels.
  const Rect& bar(size_t i) const { return bars_[i]; }

 private:
  void place_bars(double left, double top, double height);

  const Scene& scene_;
  double font_, line_;
  Colour ink_;
  Rect frame_;
  double title_y_ = 0, keys_x_ = 0, keys_y_ = 0;
  std::vector<Rect> bars_;
  std::vector<std::vector<Tick>> ticks_;
};

}  // namespace tunica
