// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "view/colour.h"

namespace tunica {

using Vec3 = Eigen::Vector3d;

/// From where a scene is seen. By default from above the plane, fitted to the content.
struct Camera {
  Vec3 direction{0, 0, -1};      ///< along which the camera looks
  Vec3 up{0, 1, 0};              ///< what is upwards in the picture
  bool perspective = false;      ///< else parallel projection
  double zoom = 1;               ///< > 1: nearer, what does not fit is cut off
  std::optional<Vec3> centre;    ///< in the middle of the picture; else the middle of the content
  std::optional<double> extent;  ///< half the larger side of what must fit (world units); else the content
};

/// One distant lamp and light from all around, for surfaces in space. Off: colours are shown exactly as given.
struct Light {
  bool on = false;
  Vec3 from{-0.35, 0.45, 0.85};  ///< direction to the lamp as seen by the camera (right, up, towards the viewer)
  double ambient = 0.5;          ///< brightness where the lamp does not reach; 1 where it shines straight on
};

/// A face: corners `indices[first .. first + count)` into the scene's points, in order around; it may be non-convex.
struct Polygon {
  uint32_t first = 0, count = 0;
  Colour fill = white;
  Colour outline = clear;
  float width = 0;      ///< of the outline, in pixels
  bool smooth = false;  ///< colours from point_colours, normals averaged where faces share points
};

struct Line {
  Vec3 from, to;
  Colour colour = black;
  float width = 1;  ///< pixels
};

struct Marker {
  enum class Shape : uint8_t { disc, ring, square, triangle, cross, plus, arrow };
  Vec3 at;
  Shape shape = Shape::disc;
  Colour colour = black;
  float size = 10;          ///< pixels across; an arrow's length
  Vec3 direction{1, 0, 0};  ///< of an arrow
};

struct Label {
  enum class Across : uint8_t { left, centre, right };  ///< which part of the text is at the point
  enum class Along : uint8_t { top, middle, bottom };
  Vec3 at;
  std::string text;
  Colour colour = black;
  float size = 0;  ///< height of the letters' line in pixels; 0: the scene's
  Across across = Across::centre;
  Along along = Along::middle;
  float right = 0, down = 0;  ///< moved by so many pixels
};

/// A legend that turns colours back into numbers.
struct ColourBar {
  std::vector<Colour> colours;  ///< from min to max
  double min = 0, max = 1;
  std::string title;
};

/// A legend entry: a patch of colour and what it stands for.
struct Key {
  Colour colour;
  std::string text;
};

/// Everything a picture shows, as plain data. Drawn in this order: polygons, bands, lines, markers, labels, legends.
struct Scene {
  int width = 900, height = 800;  ///< pixels
  Colour background = white;      ///< a = 0: transparent
  float font_size = 0;            ///< pixels; 0: in proportion to the picture
  std::string title;
  Camera camera;
  Light light;

  std::vector<Vec3> points;
  std::vector<Colour> point_colours;  ///< empty, or one per point; for smooth polygons
  std::vector<uint32_t> indices;
  std::vector<Polygon> polygons;
  std::vector<Polygon> bands;  ///< along walls, upon the polygons
  std::vector<Line> lines;
  std::vector<Marker> markers;
  std::vector<Label> labels;
  std::vector<ColourBar> bars;
  std::vector<Key> keys;

  const CancelFlag* cancel = nullptr;  ///< polled while it is drawn

  float pad_left = 0, pad_right = 0, pad_top = 0, pad_bottom = 0;  ///< pixels kept free around the content (axes)

  /// Adds corners and the face upon them.
  Polygon& add(std::vector<Polygon>& list, std::span<const Vec3> corners, const Colour& fill) {
    Polygon polygon{static_cast<uint32_t>(indices.size()), static_cast<uint32_t>(corners.size()), fill};
    for (const Vec3& corner : corners) {
      indices.push_back(static_cast<uint32_t>(points.size()));
      points.push_back(corner);
    }
    return list.emplace_back(polygon);
  }
};

/// Largest side of a picture, in pixels.
inline constexpr int max_picture_side = 16384;

}  // namespace tunica
