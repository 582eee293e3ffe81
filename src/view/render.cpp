// SPDX-License-Identifier: MIT
#include "view/render.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "view/gl.h"
#include "view/legend.h"
#include "view/projector.h"
#include "view/tessellate.h"
#include "view/text.h"

namespace tunica {
namespace {

void check_view(const Scene& scene) {
  if (scene.width < 16 || scene.height < 16 || scene.width > max_picture_side || scene.height > max_picture_side)
    fail("a picture's sides must be 16 to {} pixels, not {} x {}", max_picture_side, scene.width, scene.height);
  const Camera& camera = scene.camera;
  if (!camera.direction.allFinite() || camera.direction.norm() == 0)
    fail("the camera's direction must be finite and not zero");
  if (!camera.up.allFinite() || camera.up.norm() == 0) fail("the camera's up must be finite and not zero");
  if (!(camera.zoom > 0) || camera.zoom > 1e6) fail("the camera's zoom must be positive, not {}", camera.zoom);
  if (camera.extent && !(*camera.extent > 0)) fail("the camera's extent must be positive, not {}", *camera.extent);
  if (camera.centre && !camera.centre->allFinite()) fail("the camera's centre must be finite");
}

/// Content larger than its frame must not run into the legends.
void clip_to(const Rect& frame, TriangleList& triangles) {
  triangles.clip_left = static_cast<int>(std::floor(frame.x));
  triangles.clip_top = static_cast<int>(std::floor(frame.y));
  triangles.clip_right = static_cast<int>(std::ceil(frame.x + frame.width));
  triangles.clip_bottom = static_cast<int>(std::ceil(frame.y + frame.height));
}

/// `frame`: what labels must lie in, or nullptr.
void draw_labels(const Scene& scene, const Projector& projector, double font, const Rect* frame,
                 std::vector<uint8_t>& pixels) {
  for (const Label& label : scene.labels) {
    poll(scene.cancel);
    if (!label.at.allFinite()) fail("cannot place the label '{}': its place is not finite", label.text);
    const auto at = projector(label.at);
    // Far outside, coordinates may be too large for whole pixels.
    if (!(std::abs(at.x) < 1e6f) || !(std::abs(at.y) < 1e6f)) continue;
    if (frame &&
        (at.x < frame->x || at.y < frame->y || at.x > frame->x + frame->width || at.y > frame->y + frame->height))
      continue;
    draw_text(pixels, scene.width, scene.height, label.text, at.x + label.right, at.y + label.down,
              label.size > 0 ? label.size : font, label.colour, label.across, label.along);
  }
}

/// Files want straight colours: those of a pixel covered in part are divided by its coverage.
void unpremultiply(std::vector<uint8_t>& pixels) {
  for (size_t i = 0; i < pixels.size(); i += 4) {
    const int alpha = pixels[i + 3];
    if (alpha == 255 || alpha == 0) continue;
    for (size_t c = i; c < i + 3; ++c)
      pixels[c] = static_cast<uint8_t>(std::min(255, (pixels[c] * 255 + alpha / 2) / alpha));
  }
}

}  // namespace

Picture render(const Scene& scene) {
  check_view(scene);
  const Legend legend(scene);
  const Projector projector(scene, legend.frame());
  TriangleList triangles;
  tessellate(scene, projector, triangles.solid);
  const bool cut = scene.camera.zoom != 1 || scene.camera.extent || scene.camera.centre;
  if (cut) clip_to(legend.frame(), triangles);
  legend.add_shapes(triangles.upon);
  Picture picture{scene.width, scene.height,
                  rasterise(scene.width, scene.height, scene.background, triangles, scene.cancel)};
  draw_labels(scene, projector, legend.font_size(), cut ? &legend.frame() : nullptr, picture.rgba);
  legend.draw_texts(picture.rgba);
  if (scene.background.a < 1) unpremultiply(picture.rgba);
  return picture;
}

}  // namespace tunica
