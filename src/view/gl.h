// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel.h"
#include "view/colour.h"
#include "view/picture.h"

namespace tunica {

/// A corner of a triangle, ready for the screen: pixels from the top left, depth 0 (near) to 1 (far), straight colour.
struct Vertex {
  float x, y, depth;
  uint8_t r, g, b, a;
};

/// Triangles, three vertices each; `upon` covers everything in `solid`, without a depth test. Of `solid`, what lies
/// outside of the clip rectangle (whole pixels) is not drawn.
struct TriangleList {
  std::vector<Vertex> solid, upon;
  int clip_left = 0, clip_top = 0, clip_right = 1 << 20, clip_bottom = 1 << 20;
};

/// Draws triangles off screen through OSMesa, with 16 samples per pixel (4 in the renderer, twice as many pixels each
/// way). Errors: OSMesa missing or unusable; Cancelled. The result is premultiplied, four bytes a pixel, rows from the top.
std::vector<uint8_t> rasterise(int width, int height, const Colour& background, const TriangleList& triangles,
                               const CancelFlag* cancel = nullptr);

}  // namespace tunica
