// SPDX-License-Identifier: MIT
#include "view/tessellate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "view/triangulate.h"

namespace tunica {
namespace {

using Vec2 = Eigen::Vector2d;
using Pixel = Projector::Pixel;

/// What is drawn later lies nearer by a hair, so that a wall is seen upon its own cell but not through another.
constexpr float band_lift = 4e-4f, line_lift = 8e-4f, marker_lift = 2e-3f;

Vertex vertex(const Pixel& p, const Colour& colour, float lift) {
  const auto byte = [](float v) { return static_cast<uint8_t>(std::lround(255 * std::clamp(v, 0.f, 1.f))); };
  return {p.x,           p.y, std::clamp(p.depth - lift, 0.f, 1.f), byte(colour.r), byte(colour.g), byte(colour.b),
          byte(colour.a)};
}

class Tessellator {
 public:
  Tessellator(const Scene& scene, const Projector& projector, std::vector<Vertex>& triangles)
      : scene_(scene), projector_(projector), out_(triangles) {}

  void run() {
    check();
    pixels_.reserve(scene_.points.size());
    for (const Vec3& point : scene_.points) pixels_.push_back(projector_(point));
    if (scene_.light.on) average_normals();
    const auto order = order_of(scene_.polygons);
    each(order, [&](uint32_t i) { add_face(scene_.polygons[i], 0); });
    each(order_of(scene_.bands), [&](uint32_t i) { add_face(scene_.bands[i], band_lift); });
    each(order, [&](uint32_t i) { add_outline(scene_.polygons[i]); });
    each(scene_.lines, [&](const Line& line) {
      add_segment(projector_(line.from), projector_(line.to), line.colour, line.width, line_lift);
    });
    each(scene_.markers, [&](const Marker& marker) { add_marker(marker); });
  }

 private:
  void each(const auto& list, const auto& work) {
    for (const auto& item : list) {
      poll(scene_.cancel);
      work(item);
    }
  }

  void check() const {
    for (const auto* list : {&scene_.polygons, &scene_.bands})
      for (const Polygon& p : *list)
        if (p.count < 3 || p.first > scene_.indices.size() || p.count > scene_.indices.size() - p.first)
          fail("a face to draw needs at least 3 corners among the scene's {}", scene_.indices.size());
    for (const uint32_t index : scene_.indices)
      if (index >= scene_.points.size()) fail("a face to draw uses point {} of {}", index, scene_.points.size());
    if (!scene_.point_colours.empty() && scene_.point_colours.size() != scene_.points.size())
      fail("a scene of {} points has {} point colours", scene_.points.size(), scene_.point_colours.size());
    const auto finite = [](const Vec3& p) {
      if (!p.allFinite()) fail("cannot draw a place that is not finite: ({}, {}, {})", p.x(), p.y(), p.z());
    };
    for (const Vec3& p : scene_.points) finite(p);
    for (const Line& line : scene_.lines) finite(line.from), finite(line.to);
    for (const Marker& marker : scene_.markers) finite(marker.at), finite(marker.direction);
  }

  /// Faces in the order to draw: as given, but from far to near when some let others shine through.
  std::vector<uint32_t> order_of(const std::vector<Polygon>& faces) const {
    std::vector<uint32_t> order(faces.size());
    std::iota(order.begin(), order.end(), 0u);
    if (std::none_of(faces.begin(), faces.end(), [](const Polygon& p) { return p.fill.a > 0 && p.fill.a < 1; }))
      return order;
    std::vector<float> depth(faces.size());
    for (size_t i = 0; i < faces.size(); ++i) {
      for (uint32_t k = 0; k < faces[i].count; ++k) depth[i] += pixels_[scene_.indices[faces[i].first + k]].depth;
      depth[i] /= static_cast<float>(faces[i].count);
    }
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return depth[a] > depth[b]; });
    return order;
  }

  Vec3 vector_area(const Polygon& polygon) const {
    Vec3 sum = Vec3::Zero();
    const uint32_t* index = &scene_.indices[polygon.first];
    const Vec3& origin = scene_.points[index[0]];
    for (uint32_t k = 1; k + 1 < polygon.count; ++k)
      sum += (scene_.points[index[k]] - origin).cross(scene_.points[index[k + 1]] - origin);
    return sum;
  }

  void average_normals() {
    normals_.assign(scene_.points.size(), Vec3::Zero());
    for (const Polygon& polygon : scene_.polygons) {
      if (!polygon.smooth) continue;
      const Vec3 area = vector_area(polygon);
      for (uint32_t k = 0; k < polygon.count; ++k) normals_[scene_.indices[polygon.first + k]] += area;
    }
  }

  /// Both sides of a face are lit alike: a sheet has no inside to be dark.
  Colour lit(Colour colour, const Vec3& normal, const Vec3& at) const {
    const double length = normal.norm();
    if (!scene_.light.on || length == 0) return colour;
    Vec3 n = normal / length;
    if (n.dot(projector_.towards_viewer(at)) < 0) n = -n;
    const Vec3 from = (scene_.light.from.x() * projector_.right() + scene_.light.from.y() * projector_.up() +
                       scene_.light.from.z() * projector_.back())
                          .normalized();
    const double direct = std::max(0.0, n.dot(from));
    const auto brightness = static_cast<float>(scene_.light.ambient + (1 - scene_.light.ambient) * direct);
    colour.r *= brightness, colour.g *= brightness, colour.b *= brightness;
    return colour;
  }

  void add_face(const Polygon& polygon, float lift) {
    if (polygon.fill.a <= 0) return;
    const uint32_t* index = &scene_.indices[polygon.first];
    const bool smooth = polygon.smooth;
    const Colour flat =
        lit(polygon.fill, scene_.light.on ? vector_area(polygon) : Vec3(Vec3::Zero()), scene_.points[index[0]]);
    const auto corner = [&](uint32_t k) {
      const uint32_t i = index[k];
      if (!smooth) return out_.push_back(vertex(pixels_[i], flat, lift));
      Colour colour = scene_.point_colours.empty() ? polygon.fill : scene_.point_colours[i];
      if (scene_.light.on) colour = lit(colour, normals_[i], scene_.points[i]);
      out_.push_back(vertex(pixels_[i], colour, lift));
    };
    if (polygon.count == 3) {
      corner(0), corner(1), corner(2);
      return;
    }
    corners_.clear();
    for (uint32_t k = 0; k < polygon.count; ++k) corners_.push_back(scene_.points[index[k]]);
    for (const auto& triangle : triangulate(corners_))
      for (const uint32_t k : triangle) corner(k);
  }

  void add_outline(const Polygon& polygon) {
    if (polygon.outline.a <= 0 || polygon.width <= 0) return;
    for (uint32_t k = 0; k < polygon.count; ++k) {
      const uint32_t next = k + 1 < polygon.count ? k + 1 : 0;
      add_segment(pixels_[scene_.indices[polygon.first + k]], pixels_[scene_.indices[polygon.first + next]],
                  polygon.outline, polygon.width, line_lift);
    }
  }

  void add_triangle(const Pixel& a, const Pixel& b, const Pixel& c, const Colour& colour, float lift) {
    out_.push_back(vertex(a, colour, lift));
    out_.push_back(vertex(b, colour, lift));
    out_.push_back(vertex(c, colour, lift));
  }

  /// A line with round ends, as round as its width can show, so that lines that meet leave no notch.
  void add_segment(const Pixel& a, const Pixel& b, const Colour& colour, float width, float lift) {
    const double half = width / 2, angle = std::atan2(double{b.y} - a.y, double{b.x} - a.x);
    // Thin lines are most of a large picture: they get ends drawn out by half their width, at no extra triangles.
    const int steps = width <= 1.5f ? 0 : width <= 2.5f ? 2 : width <= 6 ? 4 : 8;
    const double reach = steps == 0 ? half : 0;
    const double ux = std::cos(angle), uy = std::sin(angle), quarter = M_PI / 2;
    const auto around = [&](const Pixel& p, double turn) {
      return Pixel{static_cast<float>(p.x + half * std::cos(angle + turn)),
                   static_cast<float>(p.y + half * std::sin(angle + turn)), p.depth};
    };
    const auto corner = [&](const Pixel& p, double along, double across) {
      return Pixel{static_cast<float>(p.x + along * ux - across * uy),
                   static_cast<float>(p.y + along * uy + across * ux), p.depth};
    };
    const Pixel a_left = corner(a, -reach, half), a_right = corner(a, -reach, -half);
    const Pixel b_left = corner(b, reach, half), b_right = corner(b, reach, -half);
    add_triangle(a_left, a_right, b_right, colour, lift);
    add_triangle(a_left, b_right, b_left, colour, lift);
    for (int k = 0; k < steps; ++k) {
      const double from = k * M_PI / steps, to = (k + 1) * M_PI / steps;
      if (k > 0) add_triangle(b_right, around(b, -quarter + from), around(b, -quarter + to), colour, lift);
      if (k > 0) add_triangle(a_left, around(a, quarter + from), around(a, quarter + to), colour, lift);
    }
  }

  void add_marker(const Marker& marker) {
    const double r = marker.size / 2;
    // It faces the viewer, and the surface may not: it is held before it, so that a surface up to 70 degrees aslant
    // hides none of it.
    const Pixel at = projector_(marker.at + 3 * r / projector_.scale() * projector_.towards_viewer(marker.at));
    const auto point = [&](double x, double y) {
      return Pixel{static_cast<float>(at.x + x), static_cast<float>(at.y + y), at.depth};
    };
    const auto stroke = [&](double x0, double y0, double x1, double y1) {
      add_segment(point(x0, y0), point(x1, y1), marker.colour, static_cast<float>(std::max(1.5, 0.28 * r)),
                  marker_lift);
    };
    switch (marker.shape) {
      case Marker::Shape::disc:
      case Marker::Shape::ring:
        return add_round(marker, at, r);
      case Marker::Shape::square:
        add_triangle(point(-r, -r), point(r, -r), point(r, r), marker.colour, marker_lift);
        return add_triangle(point(-r, -r), point(r, r), point(-r, r), marker.colour, marker_lift);
      case Marker::Shape::triangle:
        return add_triangle(point(0, -r), point(0.87 * r, 0.5 * r), point(-0.87 * r, 0.5 * r), marker.colour,
                            marker_lift);
      case Marker::Shape::cross:
        return stroke(-0.7 * r, -0.7 * r, 0.7 * r, 0.7 * r), stroke(-0.7 * r, 0.7 * r, 0.7 * r, -0.7 * r);
      case Marker::Shape::plus:
        return stroke(-r, 0, r, 0), stroke(0, -r, 0, r);
      case Marker::Shape::arrow:
        return add_arrow(marker, at, r);
    }
  }

  void add_round(const Marker& marker, const Pixel& at, double r) {
    const int steps = std::clamp(static_cast<int>(4 * std::sqrt(2 * r)) * 4, 16, 160);
    const double inner = marker.shape == Marker::Shape::ring ? std::max(0.0, r - std::max(1.5, 0.28 * r)) : 0;
    const auto point = [&](int k, double radius) {
      const double angle = 2 * M_PI * k / steps;
      return Pixel{static_cast<float>(at.x + radius * std::cos(angle)),
                   static_cast<float>(at.y + radius * std::sin(angle)), at.depth};
    };
    for (int k = 0; k < steps; ++k) {
      add_triangle(point(k, inner), point(k, r), point(k + 1, r), marker.colour, marker_lift);
      if (inner > 0) add_triangle(point(k, inner), point(k + 1, r), point(k + 1, inner), marker.colour, marker_lift);
    }
  }

  /// Of the marker's length on the screen whatever the view, turned as its direction is seen; seen end-on, a disc.
  void add_arrow(const Marker& marker, const Pixel& at, double r) {
    const Vec2 seen(projector_.right().dot(marker.direction), -projector_.up().dot(marker.direction));
    if (seen.norm() < 1e-3 * marker.direction.norm() || seen.norm() == 0) return add_round(marker, at, 0.3 * r);
    const Vec2 along = seen.normalized(), side(-along.y(), along.x());
    const auto point = [&](double u, double v) {
      const Vec2 p = u * along + v * side;
      return Pixel{static_cast<float>(at.x + p.x()), static_cast<float>(at.y + p.y()), at.depth};
    };
    add_segment(point(-r, 0), point(0.3 * r, 0), marker.colour, static_cast<float>(std::max(1.5, 0.2 * r)),
                marker_lift);
    add_triangle(point(r, 0), point(0.15 * r, 0.45 * r), point(0.15 * r, -0.45 * r), marker.colour, marker_lift);
  }

  const Scene& scene_;
  const Projector& projector_;
  std::vector<Vertex>& out_;
  std::vector<Pixel> pixels_;
  std::vector<Vec3> normals_, corners_;
};

}  // namespace

void tessellate(const Scene& scene, const Projector& projector, std::vector<Vertex>& triangles) {
  Tessellator(scene, projector, triangles).run();
}

void add_rectangle(std::vector<Vertex>& triangles, const Rect& rect, const Colour& colour) {
  const auto point = [&](double x, double y) {
    return vertex({static_cast<float>(x), static_cast<float>(y), 0}, colour, 0);
  };
  const double right = rect.x + rect.width, bottom = rect.y + rect.height;
  for (const Vertex& corner : {point(rect.x, rect.y), point(right, rect.y), point(right, bottom), point(rect.x, rect.y),
                               point(right, bottom), point(rect.x, bottom)})
    triangles.push_back(corner);
}

}  // namespace tunica
