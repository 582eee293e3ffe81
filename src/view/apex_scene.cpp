// SPDX-License-Identifier: MIT
#include "view/apex_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "view/apex_scene_parts.h"
#include "view/tissue_scene.h"

namespace tunica {
namespace {

constexpr size_t most_primordia = 20000;

/// From yellow through green to dark green: what is old is dark.
const Palette& age_palette() {
  static const Palette made = palette_through(
      {parse_colour("#f6dc6b"), parse_colour("#8fbf5a"), parse_colour("#3c8f5b"), parse_colour("#1f5a54")});
  return made;
}

void check_number(double value, const char* what, size_t number) {
  if (!std::isfinite(value)) fail("the {} of primordium {} is not finite: {}", what, number, value);
}

void check_primordia(const std::vector<Bump>& primordia) {
  if (primordia.size() > most_primordia)
    fail("a picture shows at most {} primordia, came {}", most_primordia, primordia.size());
  for (size_t i = 0; i < primordia.size(); ++i) {
    const Bump& p = primordia[i];
    check_number(p.theta, "angle", i + 1), check_number(p.arc, "place", i + 1), check_number(p.age, "age", i + 1);
    if (p.arc < 0) fail("primordium {} lies before the tip: its arc is {}", i + 1, p.arc);
    if (p.radius && !(*p.radius > 0 && std::isfinite(*p.radius)))
      fail("the radius of primordium {} must be positive, not {}", i + 1, *p.radius);
    if (p.height && !(*p.height >= 0 && std::isfinite(*p.height)))
      fail("the height of primordium {} must be 0 or more, not {}", i + 1, *p.height);
  }
}

void check_ring(const FieldRing& ring) {
  if (!(ring.arc >= 0) || !std::isfinite(ring.arc)) fail("the ring's arc must be 0 or more, not {}", ring.arc);
  if (ring.angles.size() != ring.values.size())
    fail("a ring of {} angles was given {} values", ring.angles.size(), ring.values.size());
  if (!ring.values.empty() && ring.values.size() < 3)
    fail("a ring needs at least 3 sampling points, came {}", ring.values.size());
  for (size_t i = 0; i < ring.angles.size(); ++i) {
    if (!std::isfinite(ring.angles[i])) fail("angle {} of the ring is not finite", i + 1);
    if (std::isnan(ring.values[i])) fail("value {} of the ring is not a number", i + 1);
    if (i > 0 && !(ring.angles[i] > ring.angles[i - 1]))
      fail("the angles of the ring must ascend; number {} does not", i + 1);
  }
  if (!ring.angles.empty() && !(ring.angles.back() - ring.angles.front() < 2 * M_PI))
    fail("the angles of the ring must ascend through less than one turn");
}

void check_field(const SurfaceField& field) {
  if (!field.given()) return;
  if (field.angles < 3 || field.arcs.size() < 2)
    fail("a field on the surface needs 3 or more angles and 2 or more arcs, came {} and {}", field.angles,
         field.arcs.size());
  if (field.values.size() != field.arcs.size() * static_cast<size_t>(field.angles))
    fail("a field of {} arcs and {} angles was given {} values", field.arcs.size(), field.angles, field.values.size());
  for (size_t k = 0; k < field.arcs.size(); ++k)
    if (!std::isfinite(field.arcs[k]) || (k > 0 && field.arcs[k] <= field.arcs[k - 1]))
      fail("the arcs of a field must be finite and ascend; number {} does not", k + 1);
}

void check_pair(const ApexPicture& apex) {
  if (apex.jugacy < 1) fail("the jugacy must be 1 or more, not {}", apex.jugacy);
  if (!apex.pair) return;
  const auto [m, n] = *apex.pair;
  if (m < 1 || n < 1) fail("a parastichy pair is two whole numbers from 1 on, not ({}, {})", m, n);
  if (m % apex.jugacy != 0 || n % apex.jugacy != 0)
    fail("the parastichy pair ({}, {}) must be multiples of the jugacy, {}", m, n, apex.jugacy);
}

/// A field has a pole at every primordium: the scale ends where nine tenths of the values lie below.
std::pair<double, double> field_scale(std::vector<double> values) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return {0, 1};
  std::sort(values.begin(), values.end());
  const double low = values.front(), high = values[values.size() * 9 / 10];
  return high > low ? std::pair{low, high} : scale_of({low, values.back()}, Palette::Type::sequential);
}

void set_camera(const ApexView& view, Scene& scene) {
  Camera& camera = scene.camera;
  camera.zoom = view.zoom;
  camera.up = Vec3(0, 1, 0);
  camera.perspective = view.from != ApexView::From::top;
  switch (view.from) {
    case ApexView::From::top:
      camera.direction = Vec3(0, -1, 0);
      camera.up = Vec3(0, 0, -1);
      break;
    case ApexView::From::oblique:
      camera.direction = Vec3(0, -0.75, -1);
      break;
    case ApexView::From::side:
      camera.direction = Vec3(0, -0.16, -1);
      break;
  }
}

/// Curves over the tops of the primordia of each family.
void add_parastichies(const DrawnApex& apex, Scene& scene) {
  const auto families = parastichies(apex.primordia, *apex.given.pair, apex.given.jugacy);
  const float width = std::clamp(0.0042f * static_cast<float>(std::min(scene.width, scene.height)), 1.2f, 12.f);
  for (int family = 0; family < 2; ++family) {
    for (const Link& link : family == 0 ? families.first : families.second) {
      poll(scene.cancel);
      if (!apex.shown(link.from) || !apex.shown(link.to)) continue;
      const Bump &a = apex.primordia[link.from], &b = apex.primordia[link.to];
      const double low = apex.surface.map_height(a.arc), high = apex.surface.map_height(b.arc);
      constexpr int steps = 28;
      Vec3 before;
      for (int k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps, theta = a.theta + t * link.turn;
        const double arc = apex.surface.arc_at_map_height(low + t * (high - low), a.arc, b.arc);
        // From top to top: a curve that went down into every valley would be hard to follow.
        const double tops = (1 - t) * *a.height + t * *b.height + 0.05 * std::min(*a.radius, *b.radius);
        const double up = std::max(tops, apex.lift(theta, arc) + 0.03 * std::min(*a.radius, *b.radius));
        const double turned = theta + apex.view.turn;
        const Vec3 here = apex.surface.place(turned, arc) + up * apex.surface.normal(turned, arc);
        if (k > 0) scene.lines.push_back({before, here, family_colour(family), width});
        before = here;
      }
    }
  }
}

/// Numbers on the bumps that face the viewer. Seen from aside, a bump's middle is not at its top.
void add_labels(const DrawnApex& apex, Scene& scene) {
  const double widest = std::max(apex.surface.at(apex.reach).x(), 1e-9);
  const double pixels = 0.47 * std::min(scene.width, scene.height) / widest;
  for (size_t i = 0; i < apex.primordia.size(); ++i) {
    if (!apex.shown(i)) continue;
    const Bump& p = apex.primordia[i];
    const double theta = p.theta + apex.view.turn;
    const Vec3 normal = apex.surface.normal(theta, p.arc);
    if (normal.dot(-scene.camera.direction.normalized()) < 0.4) continue;
    Label label{apex.surface.place(theta, p.arc) + 0.35 * *p.height * normal, std::to_string(*p.number),
                ink_for(apex.colour(i))};
    label.size =
        static_cast<float>(std::clamp(0.7 * *p.radius * pixels, 7.0, 0.03 * std::min(scene.width, scene.height)));
    scene.labels.push_back(label);
  }
}

}  // namespace

DrawnApex::DrawnApex(const ApexPicture& apex, const ApexView& v)
    : given(apex), view(v), surface(apex.profile), primordia(apex.primordia) {
  check_primordia(apex.primordia);
  check_field(apex.field);
  if (apex.ring) check_ring(*apex.ring);
  check_pair(apex);
  if (view.parastichies && !apex.pair) fail("parastichies need their pair: the data has none");
  if (view.reach && !(*view.reach > 0 && std::isfinite(*view.reach)))
    fail("the reach of a view must be positive, not {}", *view.reach);
  if (!std::isfinite(view.turn)) fail("the turn of a view is not finite");
  fill_in();
  choose_colours();
}

void DrawnApex::fill_in() {
  std::vector<Vec3> places;
  for (const Bump& p : primordia) places.push_back(surface.place(p.theta, p.arc));
  for (size_t i = 0; i < primordia.size(); ++i) {
    poll(view.cancel);
    Bump& p = primordia[i];
    if (!p.number) p.number = static_cast<int>(i + 1);
    if (!p.radius) {
      // The way to each neighbour is shared by their distances from the axis, since an apex grows in proportion to it:
      // so the youngest, with neighbours on one side only, are not larger than they will be.
      const double scale = 1e-3 * surface.length(), own = std::max(surface.at(p.arc).x(), scale);
      double room = 0.35 * own;
      for (size_t k = 0; k < places.size(); ++k) {
        const double distance = (places[k] - places[i]).norm();
        const double other = std::max(std::hypot(places[k].x(), places[k].z()), scale);
        if (k != i && distance > 0) room = std::min(room, distance * own / (own + other));
      }
      p.radius = 0.96 * room;
    }
    if (!p.height) p.height = 0.5 * *p.radius;
  }
  if (view.reach) {
    limit = reach = *view.reach;
    return;
  }
  // Growth may have carried the oldest so far out that the apex itself would be a speck.
  if (given.ring) limit = given.ring->arc + 7 * surface.at(given.ring->arc).x();
  for (const Bump& p : primordia)
    if (p.arc <= limit) reach = std::max(reach, p.arc + 1.25 * *p.radius);
  if (given.ring) reach = std::max(reach, 1.4 * given.ring->arc);
  if (reach == 0) reach = surface.length();
}

void DrawnApex::choose_colours() {
  using By = ApexView::By;
  palette =
      view.palette.value_or(view.by == By::age || view.by == By::size ? age_palette() : tunica::palette("viridis"));
  std::vector<double> scaled;
  for (size_t i = 0; i < primordia.size() && view.by != By::plain && !by_field(); ++i) {
    const Bump& p = primordia[i];
    values.push_back(view.by == By::age ? p.age : view.by == By::size ? *p.radius : p.value);
    if (shown(i)) scaled.push_back(values.back());
  }
  if (by_field()) {
    scaled = given.field.values;
    if (given.ring) scaled.insert(scaled.end(), given.ring->values.begin(), given.ring->values.end());
    if (scaled.empty()) fail("colour by field: the data has neither a field nor a ring with values");
  }
  const auto [low, high] = by_field() ? field_scale(scaled) : scale_of(scaled, palette.type);
  min = view.min.value_or(view.max && *view.max <= low ? *view.max - 1 : low);
  max = view.max.value_or(view.min && *view.min >= high ? *view.min + 1 : high);
  if (!(min < max)) fail("the range of a view must go from low to high, not from {} to {}", min, max);
}

std::string legend_title_of(const ApexView& view) {
  if (!view.legend_title.empty()) return view.legend_title;
  switch (view.by) {
    case ApexView::By::age:
      return "age";
    case ApexView::By::size:
      return "radius";
    case ApexView::By::field:
      return "inhibition";
    default:
      return "value";
  }
}

void add_family_keys(const DrawnApex& apex, Scene& scene) {
  const auto [m, n] = *apex.given.pair;
  scene.keys.push_back({family_colour(0), fmt::format("{} parastichies", m)});
  scene.keys.push_back({family_colour(1), fmt::format("{} parastichies", n)});
}

Scene scene_of_apex(const ApexPicture& apex, const ApexView& view) {
  const DrawnApex drawn(apex, view);
  Scene scene;
  scene.width = view.width > 0 ? view.width : 900;
  scene.height = view.height > 0 ? view.height : 800;
  scene.title = view.title;
  scene.background = view.background;
  scene.cancel = view.cancel;
  set_camera(view, scene);
  scene.light.on = true;
  // Colours that are to be read off a bar must not be lost in shadow.
  scene.light.ambient = drawn.by_field() ? 0.85 : 0.5;
  scene.light.from = Vec3(-0.4, 0.5, 0.75);
  add_apex_surface(drawn, scene);
  add_bumps(drawn, scene);
  if (apex.ring && (drawn.by_field() || view.arrows)) add_ring(drawn, scene);
  if (view.arrows) add_arrows(drawn, scene);
  if (view.parastichies) add_parastichies(drawn, scene);
  if (view.labels) add_labels(drawn, scene);
  if (view.legend && view.by != ApexView::By::plain && (drawn.by_field() || !drawn.values.empty()))
    scene.bars.push_back({drawn.palette.colours, drawn.min, drawn.max, legend_title_of(view)});
  if (view.legend && view.parastichies) add_family_keys(drawn, scene);
  return scene;
}

}  // namespace tunica
