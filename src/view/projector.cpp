// SPDX-License-Identifier: MIT
#include "view/projector.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tunica {
namespace {

/// Calls `visit(point)` for everything in the scene that has a place in space and must be in the picture.
template <class Visit>
void each_point(const Scene& scene, Visit&& visit) {
  for (const Vec3& point : scene.points) visit(point);
  for (const Line& line : scene.lines) visit(line.from), visit(line.to);
  for (const Marker& marker : scene.markers) visit(marker.at);
}

struct Range {
  double min = INFINITY, max = -INFINITY;
  void add(double v) { min = std::min(min, v), max = std::max(max, v); }
  bool empty() const { return min > max; }
  double middle() const { return empty() ? 0 : (min + max) / 2; }
  double size() const { return empty() ? 0 : max - min; }
};

}  // namespace

Projector::Projector(const Scene& scene, const Rect& frame) : perspective_(scene.camera.perspective) {
  back_ = -scene.camera.direction.normalized();
  right_ = scene.camera.up.cross(back_);
  // Looking along `up` itself leaves the roll open: any upwards will do, but always the same one.
  if (right_.norm() < 1e-6 * scene.camera.up.norm())
    right_ = (std::abs(back_.y()) < 0.9 ? Vec3(0, 1, 0) : Vec3(0, 0, -1)).cross(back_);
  right_.normalize();
  up_ = back_.cross(right_);
  fit(scene, frame);
}

void Projector::fit(const Scene& scene, const Rect& frame) {
  Range x, y, z;
  each_point(scene, [&](const Vec3& p) { x.add(right_.dot(p)), y.add(up_.dot(p)), z.add(back_.dot(p)); });
  centre_ = x.middle() * right_ + y.middle() * up_ + z.middle() * back_;
  if (scene.camera.centre) centre_ = *scene.camera.centre;
  double radius = 0;
  each_point(scene, [&](const Vec3& p) { radius = std::max(radius, (p - centre_).norm()); });
  radius_ = radius > 0 ? radius : 1;
  // 28 degrees of view: about what a figure is looked at with; the eye always stays outside of the content.
  distance_ = radius_ / std::sin(14 * M_PI / 180);
  near_ = perspective_ ? 1 / (distance_ - 1.02 * radius_) : 1.02 * radius_;
  far_ = perspective_ ? 1 / (distance_ + 1.02 * radius_) : -1.02 * radius_;

  Range u, v;
  each_point(scene, [&](const Vec3& p) {
    const Flat flat = flatten(p);
    u.add(flat.x), v.add(flat.y);
  });
  middle_x_ = scene.camera.centre ? 0 : u.middle();
  middle_y_ = scene.camera.centre ? 0 : v.middle();
  double half_width = std::max(u.max - middle_x_, middle_x_ - u.min);
  double half_height = std::max(v.max - middle_y_, middle_y_ - v.min);
  if (scene.camera.extent) half_width = half_height = *scene.camera.extent;
  const double tiny = 1e-9 * radius_;
  scale_ = std::min(frame.width / (2 * std::max(half_width, tiny)), frame.height / (2 * std::max(half_height, tiny)));
  if (half_width < tiny && half_height < tiny) scale_ = 1;
  if (!std::isfinite(scale_)) scale_ = 1;
  scale_ *= scene.camera.zoom;
  pixel_x_ = frame.x + frame.width / 2;
  pixel_y_ = frame.y + frame.height / 2;
}

Projector::Flat Projector::flatten(const Vec3& point) const {
  const Vec3 d = point - centre_;
  const double x = right_.dot(d), y = up_.dot(d), z = back_.dot(d);
  if (!perspective_) return {x, y, z};
  const double away = std::max(distance_ - z, 1e-3 * distance_);
  return {x * distance_ / away, y * distance_ / away, 1 / away};
}

Projector::Pixel Projector::operator()(const Vec3& point) const {
  const Flat flat = flatten(point);
  const double depth = (near_ - flat.nearness) / (near_ - far_);
  return {static_cast<float>(pixel_x_ + scale_ * (flat.x - middle_x_)),
          static_cast<float>(pixel_y_ - scale_ * (flat.y - middle_y_)),
          static_cast<float>(std::clamp(depth, 0.0, 1.0))};
}

Vec3 Projector::towards_viewer(const Vec3& point) const {
  if (!perspective_) return back_;
  return (centre_ + distance_ * back_ - point).normalized();
}

}  // namespace tunica
