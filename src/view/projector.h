// SPDX-License-Identifier: MIT
#pragma once

#include "view/scene.h"

namespace tunica {

/// A rectangle of the picture, in pixels; y runs downwards.
struct Rect {
  double x = 0, y = 0, width = 0, height = 0;
};

/// Maps points of a scene to pixels of a rectangle of the picture.
class Projector {
 public:
  /// Fits the scene's content (or what the camera says) into `frame`.
  Projector(const Scene& scene, const Rect& frame);

  struct Pixel {
    float x, y, depth;  ///< depth: 0 near, 1 far, linear on the screen across a plane
  };
  Pixel operator()(const Vec3& point) const;

  /// Pixels per world unit at the middle of the content.
  double scale() const { return scale_; }
  Vec3 towards_viewer(const Vec3& point) const;  ///< unit
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& back() const { return back_; }

 private:
  struct Flat {
    double x, y, nearness;
  };
  Flat flatten(const Vec3& point) const;
  void fit(const Scene& scene, const Rect& frame);

  Vec3 right_, up_, back_, centre_{0, 0, 0};
  bool perspective_;
  double distance_ = 1;         ///< of the eye from the centre
  double radius_ = 1;           ///< of the content about the centre
  double near_ = 1, far_ = -1;  ///< nearness of depth 0 and 1
  double scale_ = 1, middle_x_ = 0, middle_y_ = 0, pixel_x_ = 0, pixel_y_ = 0;
};

}  // namespace tunica
