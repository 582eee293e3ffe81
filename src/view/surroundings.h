// SPDX-License-Identifier: MIT
#pragma once

#include "view/projector.h"
#include "view/scene.h"

namespace tunica {

/// What a picture of a scene has around its content. Where the picture itself is too coarse for letters (blocks in a
/// terminal), it is cut off and written as text.
struct Surroundings {
  Rect content;  ///< of the picture, in pixels: all but the title and the legends
  std::string title;
  std::vector<ColourBar> bars;
  std::vector<Key> keys;

  bool empty() const { return title.empty() && bars.empty() && keys.empty(); }
};

/// Errors: no font (as for drawing it).
Surroundings surroundings_of(const Scene& scene);

}  // namespace tunica
