// SPDX-License-Identifier: MIT
// The apex in space: its surface, bumps upon it, the ring with its field.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "view/apex_scene_parts.h"

namespace tunica {
namespace {

/// Height of a bump at `s` of its radius from its middle, relative to its height: steep at the rim, so that it stands
/// out, and there a little below the surface, so that the two do not flicker.
double bump(double s) { return 1.03 * std::pow(std::max(0.0, 1 - s * s), 0.7) - 0.03; }

Colour darker(Colour colour, double share) {
  const auto f = static_cast<float>(share);
  colour.r *= f, colour.g *= f, colour.b *= f;
  return colour;
}

void add_triangle(uint32_t a, uint32_t b, uint32_t c, Scene& scene) {
  Polygon face{static_cast<uint32_t>(scene.indices.size()), 3};
  face.smooth = true;
  scene.polygons.push_back(face);
  for (const uint32_t corner : {a, b, c}) scene.indices.push_back(corner);
}

uint32_t add_point(const Vec3& at, const Colour& colour, Scene& scene) {
  scene.points.push_back(at);
  scene.point_colours.push_back(colour);
  return static_cast<uint32_t>(scene.points.size() - 1);
}

/// The light that the bumps around leave to a place on the surface: a dark seam makes them sit upon it.
class Seams {
 public:
  explicit Seams(const DrawnApex& apex) {
    for (size_t i = 0; i < apex.primordia.size(); ++i) {
      if (!apex.shown(i)) continue;
      const Bump& p = apex.primordia[i];
      bumps_.push_back({apex.surface.place(p.theta + apex.view.turn, p.arc), *p.radius});
    }
  }
  double light(const Vec3& at) const {
    double dark = 0;
    for (const auto& [centre, radius] : bumps_) {
      const double reach = 1.5 * radius, squared = (at - centre).squaredNorm();
      if (squared >= reach * reach) continue;
      const double t = std::min(1.0, (reach - std::sqrt(squared)) / (0.5 * radius));
      dark = std::max(dark, t * t);
    }
    return 1 - 0.35 * dark;
  }

 private:
  std::vector<std::pair<Vec3, double>> bumps_;
};

/// Bilinear between the points of a field; NaN beyond its arcs.
double field_at(const SurfaceField& field, double theta, double arc) {
  if (arc < field.arcs.front() || arc > field.arcs.back()) return std::nan("");
  const auto after = std::upper_bound(field.arcs.begin(), field.arcs.end(), arc) - field.arcs.begin();
  const auto row =
      static_cast<size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, static_cast<std::ptrdiff_t>(field.arcs.size()) - 2));
  const double t = (arc - field.arcs[row]) / (field.arcs[row + 1] - field.arcs[row]);
  const auto angles = static_cast<size_t>(field.angles);
  double turns = theta / (2 * M_PI);
  turns -= std::floor(turns);
  const double place = turns * field.angles;
  const size_t left = static_cast<size_t>(place) % angles, right = (left + 1) % angles;
  const double s = place - std::floor(place);
  const auto at = [&](size_t k, size_t i) { return field.values[k * angles + i]; };
  return (1 - t) * ((1 - s) * at(row, left) + s * at(row, right)) +
         t * ((1 - s) * at(row + 1, left) + s * at(row + 1, right));
}

/// The value of the ring's field at an angle, linear between its points.
double ring_at(const FieldRing& ring, double theta) {
  const double turn = 2 * M_PI, first = ring.angles.front();
  theta = first + (theta - first) - turn * std::floor((theta - first) / turn);
  const auto after =
      static_cast<size_t>(std::upper_bound(ring.angles.begin(), ring.angles.end(), theta) - ring.angles.begin());
  const size_t left = after == 0 ? ring.angles.size() - 1 : after - 1, right = (left + 1) % ring.angles.size();
  const double from = ring.angles[left], to = ring.angles[right] + (right == 0 ? turn : 0);
  const double s = std::clamp((theta - from) / (to - from), 0.0, 1.0);
  return (1 - s) * ring.values[left] + s * ring.values[right];
}

/// What is drawn along the ring is measured by this.
double ring_size(const DrawnApex& apex) {
  return std::max(apex.surface.at(apex.given.ring->arc).x(), 1e-3 * apex.reach);
}

}  // namespace

double DrawnApex::lift(double theta, double arc) const {
  const Vec3 at = surface.place(theta, arc);
  double most = 0;
  for (size_t i = 0; i < primordia.size(); ++i) {
    const Bump& p = primordia[i];
    const Vec3 away = at - surface.place(p.theta, p.arc);
    if (shown(i) && away.norm() < *p.radius) most = std::max(most, *p.height * bump(away.norm() / *p.radius));
  }
  return most;
}

void add_apex_surface(const DrawnApex& apex, Scene& scene) {
  const bool field = apex.by_field() && apex.given.field.given();
  const Seams seams(apex);
  const int side = std::min(scene.width, scene.height);
  const auto columns = static_cast<uint32_t>(std::clamp(side / 3, 96, 288));
  const auto rows = static_cast<uint32_t>(std::clamp(side / 5, 60, 180));
  for (uint32_t row = 0; row <= rows; ++row) {
    const double arc = apex.reach * row / rows;
    poll(scene.cancel);
    for (uint32_t column = 0; column < columns; ++column) {
      const double theta = 2 * M_PI * column / columns;
      const Vec3 at = apex.surface.place(theta, arc);
      const double value = field ? field_at(apex.given.field, theta - apex.view.turn, arc) : std::nan("");
      add_point(at, std::isnan(value) ? darker(apex.view.surface, seams.light(at)) : apex.scaled(value), scene);
    }
  }
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      const uint32_t next = (column + 1) % columns, here = row * columns, below = here + columns;
      // Diagonals alternate, so that no direction around the apex is smoother than the other.
      if ((row + column) % 2 == 0) {
        add_triangle(here + column, here + next, below + next, scene);
        add_triangle(here + column, below + next, below + column, scene);
      } else {
        add_triangle(here + column, here + next, below + column, scene);
        add_triangle(here + next, below + next, below + column, scene);
      }
    }
  }
}

void add_bumps(const DrawnApex& apex, Scene& scene) {
  const double pixels = 0.45 * std::min(scene.width, scene.height) / std::max(apex.surface.at(apex.reach).x(), 1e-9);
  for (size_t i = 0; i < apex.primordia.size(); ++i) {
    poll(scene.cancel);
    if (!apex.shown(i)) continue;
    const Bump& p = apex.primordia[i];
    const double theta = p.theta + apex.view.turn;
    const Vec3 centre = apex.surface.place(theta, p.arc), down = apex.surface.along(theta, p.arc);
    const Vec3 side(-std::sin(theta), 0, std::cos(theta));
    const Colour colour = apex.by_field() ? Colour{.80f, .80f, .78f, 1} : apex.colour(i);
    const auto spokes = static_cast<uint32_t>(std::clamp(1.3 * *p.radius * pixels, 20.0, 56.0)), rings = spokes / 3;
    const auto place = [&](double s, double phi) {
      const Vec3 flat = centre + *p.radius * s * (std::cos(phi) * down + std::sin(phi) * side);
      const double radius = std::hypot(flat.x(), flat.z());
      const double arc = apex.surface.closest(radius, flat.y());
      const double angle = radius > 0 ? std::atan2(flat.z(), flat.x()) : theta;
      return Vec3(apex.surface.place(angle, arc) + *p.height * bump(s) * apex.surface.normal(angle, arc));
    };
    const uint32_t top = add_point(place(0, 0), colour, scene);
    for (uint32_t ring = 1; ring <= rings; ++ring) {
      // Closer together towards the rim, where it is steep.
      const double s = std::sin(M_PI / 2 * ring / rings);
      const Colour shade = darker(colour, 1 - 0.3 * std::pow(s, 6));
      for (uint32_t spoke = 0; spoke < spokes; ++spoke) {
        add_point(place(s, 2 * M_PI * spoke / spokes), shade, scene);
        const uint32_t next = (spoke + 1) % spokes, outer = top + 1 + (ring - 1) * spokes, inner = outer - spokes;
        if (ring == 1) {
          add_triangle(top, outer + spoke, outer + next, scene);
        } else {
          add_triangle(inner + spoke, outer + spoke, outer + next, scene);
          add_triangle(inner + spoke, outer + next, inner + next, scene);
        }
      }
    }
  }
}

void add_ring(const DrawnApex& apex, Scene& scene) {
  const FieldRing& ring = *apex.given.ring;
  const double size = ring_size(apex), half = 0.045 * size;
  const bool coloured = apex.by_field() && !ring.values.empty();
  constexpr uint32_t columns = 720;
  const auto first = static_cast<uint32_t>(scene.points.size());
  for (uint32_t column = 0; column < columns; ++column) {
    const double theta = 2 * M_PI * column / columns;
    const Colour colour = coloured ? apex.scaled(ring_at(ring, theta - apex.view.turn)) : Colour{.35f, .4f, .35f, 1};
    for (const double side : {-1.0, 1.0}) {
      const double arc = std::max(0.0, ring.arc + side * (coloured ? half : 0.2 * half));
      add_point(apex.surface.place(theta, arc) + 0.004 * size * apex.surface.normal(theta, arc), colour, scene);
    }
  }
  const float edge = std::clamp(0.0016f * static_cast<float>(std::min(scene.width, scene.height)), 0.7f, 4.f);
  for (uint32_t column = 0; column < columns; ++column) {
    const uint32_t here = first + 2 * column, next = first + 2 * ((column + 1) % columns);
    add_triangle(here, next, next + 1, scene);
    add_triangle(here, next + 1, here + 1, scene);
    // The field around it may have the same colours.
    for (const uint32_t k : {0u, 1u})
      if (coloured) scene.lines.push_back({scene.points[here + k], scene.points[next + k], black, edge});
  }
}

void add_arrows(const DrawnApex& apex, Scene& scene) {
  if (!apex.given.ring || apex.given.ring->values.empty())
    fail("arrows stand at the minima of the ring's field: the data has no ring with values");
  const FieldRing& ring = *apex.given.ring;
  const double size = ring_size(apex), tip = ring.arc - 0.07 * size, room = std::min(0.8 * size, 0.85 * tip);
  if (!(room > 0.1 * size)) fail("arrows need room between the tip and the ring; the ring's arc is {}", ring.arc);
  for (const Minimum& minimum : minima_of(ring)) {
    if (minimum.depth < 0.05) continue;
    const double theta = minimum.angle + apex.view.turn, length = room * std::max(minimum.depth, 0.2);
    const double head = std::min(0.16 * size, 0.6 * length);
    const Colour colour = minimum.chosen ? black : Colour{.52f, .52f, .52f, 1};
    const Vec3 side(-std::sin(theta), 0, std::cos(theta));
    const auto at = [&](double back, double across) {
      const double arc = tip - back;
      return Vec3(apex.surface.place(theta, arc) + 0.006 * size * apex.surface.normal(theta, arc) + across * side);
    };
    const auto quad = [&](double from, double to, double wide_from, double wide_to) {
      const uint32_t a = add_point(at(from, -wide_from), colour, scene),
                     b = add_point(at(from, wide_from), colour, scene);
      const uint32_t c = add_point(at(to, wide_to), colour, scene), d = add_point(at(to, -wide_to), colour, scene);
      add_triangle(a, b, c, scene);
      add_triangle(a, c, d, scene);
    };
    quad(0, head, 0, 0.45 * head);
    const double thick = 0.02 * size;
    for (int k = 0; k < 12; ++k)
      quad(0.98 * head + (length - head) * k / 12, 0.98 * head + (length - head) * (k + 1) / 12, thick, thick);
  }
}

}  // namespace tunica
