// SPDX-License-Identifier: MIT
// The apex unrolled into a plane: angle against distance from the tip.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "view/apex_scene_parts.h"
#include "view/legend.h"
#include "view/text.h"

namespace tunica {
namespace {

constexpr double turn = 2 * M_PI, beside = 0.35;  ///< what is repeated on either side, in radians
constexpr double marker_radius = 0.11;            ///< of discs where the map does not keep angles

/// The world of the picture: x is the angle from 0 to 2 pi, y falls from the tip outwards.
class Unrolled {
 public:
  explicit Unrolled(const DrawnApex& apex) : apex_(apex) {
    for (size_t i = 0; i < apex.primordia.size(); ++i) {
      if (!apex.shown(i)) continue;
      const Bump& p = apex.primordia[i];
      const double size = radius_at(p), here = raw(p.arc);
      low_ = std::min(low_, here - size), high_ = std::max(high_, here + size);
      widest_ = std::max(widest_, size);
    }
    if (low_ > high_) low_ = raw(0.2 * apex.reach), high_ = raw(apex.reach);
    const double span = std::max(high_ - low_, 1e-9);
    // Where the map does not keep angles, lengths across and upright have no common measure.
    factor_ = kept() ? 1 : 4.5 / span;
    if (kept() && span < 0.6) low_ -= 0.3, high_ += 0.3;
  }

  bool kept() const { return apex_.view.map != ApexView::Map::arc; }
  /// Upright coordinate before scaling; grows away from the tip.
  double raw(double arc) const {
    switch (apex_.view.map) {
      case ApexView::Map::angles_kept:
        return apex_.surface.map_height(arc);
      case ApexView::Map::arc:
        return arc;
      case ApexView::Map::log_radius:
        return std::log(std::max(apex_.surface.at(arc).x(), 1e-9 * apex_.reach));
    }
    return arc;
  }
  double radius_at(const Bump& p) const {
    return kept() ? *p.radius / std::max(apex_.surface.at(p.arc).x(), *p.radius) : *p.radius;
  }
  Vec3 operator()(double theta, double raw_height) const { return {theta, (low_ - raw_height) * factor_, 0}; }
  double low() const { return low_; }
  double high() const { return high_; }
  double left() const { return -beside - (kept() ? widest_ : marker_radius); }  ///< of all that is repeated
  double bottom() const { return (low_ - high_) * factor_; }
  double factor() const { return factor_; }

 private:
  const DrawnApex& apex_;
  double low_ = INFINITY, high_ = -INFINITY, factor_ = 1, widest_ = 0;
};

/// A line from (x, y) to (x, y), with all its repeats, as far as they lie within the strip.
void add_wrapped(Vec3 from, Vec3 to, const Colour& colour, float width, Scene& scene) {
  if (from.x() > to.x()) std::swap(from, to);
  const double left = -beside, right = turn + beside;
  for (double shift = turn * std::floor((left - to.x()) / turn); from.x() + shift < right; shift += turn) {
    const Vec3 a = from + Vec3(shift, 0, 0), b = to + Vec3(shift, 0, 0);
    if (b.x() < left || a.x() > right) continue;
    const double length = b.x() - a.x();
    const double s = length > 0 ? std::max(0.0, (left - a.x()) / length) : 0;
    const double t = length > 0 ? std::min(1.0, (right - a.x()) / length) : 1;
    scene.lines.push_back({a + s * (b - a), a + t * (b - a), colour, width});
  }
}

void add_disc(const Vec3& centre, double radius, const Colour& colour, Scene& scene) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 48; ++k)
    corners.push_back(centre + radius * Vec3(std::cos(turn * k / 48), std::sin(turn * k / 48), 0));
  Polygon& disc = scene.add(scene.polygons, corners, colour);
  disc.outline = mix(colour, black, 0.45);
  disc.width = 1;
}

double wrapped(double theta) {
  const double rest = std::fmod(theta, turn);
  return rest < 0 ? rest + turn : rest;
}

/// Discs and numbers; those near an edge stand at the other edge too, paler.
void add_primordia(const DrawnApex& apex, const Unrolled& map, Scene& scene) {
  const double pixels = 0.9 * scene.width / (turn + 2 * beside);
  for (size_t i = 0; i < apex.primordia.size(); ++i) {
    if (!apex.shown(i)) continue;
    const Bump& p = apex.primordia[i];
    const double radius = map.kept() ? map.radius_at(p) : marker_radius;
    const double theta = wrapped(p.theta + apex.view.turn);
    for (const double shift : {0.0, -turn, turn}) {
      const double x = theta + shift;
      if (x < -beside || x > turn + beside) continue;
      const bool repeat = x < 0 || x >= turn;
      const Colour colour = repeat ? mix(apex.colour(i), white, 0.65) : apex.colour(i);
      const Vec3 at = map(x, map.raw(p.arc)) + Vec3(0, 0, 0.05);  // upon the lines
      add_disc(at, radius, colour, scene);
      if (!apex.view.labels) continue;
      Label label{at, std::to_string(*p.number), repeat ? Colour{.5f, .5f, .5f, 1} : ink_for(colour)};
      label.size = static_cast<float>(std::clamp(0.6 * radius * pixels, 8.0, 20.0));
      scene.labels.push_back(label);
    }
  }
}

void add_families(const DrawnApex& apex, const Unrolled& map, Scene& scene) {
  const auto families = parastichies(apex.primordia, *apex.given.pair, apex.given.jugacy);
  for (int family = 0; family < 2; ++family)
    for (const Link& link : family == 0 ? families.first : families.second) {
      if (!apex.shown(link.from) || !apex.shown(link.to)) continue;
      const Bump &a = apex.primordia[link.from], &b = apex.primordia[link.to];
      const double theta = wrapped(a.theta + apex.view.turn);
      add_wrapped(map(theta, map.raw(a.arc)), map(theta + link.turn, map.raw(b.arc)), family_colour(family), 2, scene);
    }
}

const char* upright_title(ApexView::Map map) {
  switch (map) {
    case ApexView::Map::angles_kept:
      return "distance from the tip, angles kept";
    case ApexView::Map::arc:
      return "distance from the tip";
    case ApexView::Map::log_radius:
      return "log radius";
  }
  return "";
}

void add_axes(const DrawnApex& apex, const Unrolled& map, Scene& scene) {
  const Colour ink = ink_for(scene.background), pale{.6f, .6f, .6f, 1};
  const double bottom = map.bottom(), foot = bottom - 0.06;
  const double font = std::clamp(std::min(scene.width, scene.height) / 42.0, 10.0, 72.0);
  scene.font_size = static_cast<float>(font);
  for (const double x : {0.0, turn}) scene.lines.push_back({{x, 0, 0}, {x, foot, 0}, pale, 1});
  scene.lines.push_back({{0, foot, 0}, {turn, foot, 0}, ink, 1.2f});
  const auto label = [&](const Vec3& at, const std::string& text, float right, float down, Label::Across across) {
    Label made{at, text, ink};
    made.right = right, made.down = down, made.across = across;
    made.along = Label::Along::top;
    scene.labels.push_back(made);
  };
  const auto em = static_cast<float>(font);
  for (int degrees = 0; degrees <= 360; degrees += 60) {
    const double x = turn * degrees / 360;
    scene.lines.push_back({{x, foot, 0}, {x, foot - 0.05, 0}, ink, 1.2f});
    label({x, foot - 0.05, 0}, fmt::format("{}°", degrees), 0, 0.4f * em, Label::Across::centre);
  }
  scene.pad_bottom = 1.6f * em;
  double widest = 0;
  const double left = map.left();
  scene.lines.push_back({{left, 0, 0}, {left, bottom, 0}, ink, 1.2f});
  // Where angles are kept only differences mean something: they count from the youngest.
  const double zero = apex.view.map == ApexView::Map::angles_kept ? map.low() : 0;
  for (const Tick& tick : ticks_between(map.low() - zero, map.high() - zero, 5)) {
    const Vec3 at = map(left, tick.value + zero);
    scene.lines.push_back({at, at - Vec3(0.05, 0, 0), ink, 1.2f});
    Label made{at - Vec3(0.05, 0, 0), tick.text, ink};
    made.across = Label::Across::right;
    made.right = -0.4f * em;
    scene.labels.push_back(made);
    widest = std::max(widest, text_width(tick.text, font));
  }
  scene.pad_left = static_cast<float>(widest + 0.5 * font);
  Label title{{left, 0, 0}, upright_title(apex.view.map), ink};
  title.across = Label::Across::left, title.along = Label::Along::bottom;
  title.down = -0.8f * em;
  scene.labels.push_back(title);
  scene.pad_top = 1.9f * em;
}

}  // namespace

Scene scene_of_lattice(const ApexPicture& apex, const ApexView& view) {
  if (view.by == ApexView::By::field) fail("a lattice shows no field; colour it by age, size or value");
  if (view.arrows) fail("a lattice shows no ring, so there is no place for arrows");
  const DrawnApex drawn(apex, view);
  const Unrolled map(drawn);
  Scene scene;
  scene.width = view.width > 0 ? view.width : 900;
  const double needed = 130 - map.bottom() / (turn + 2 * beside + 0.3) * (scene.width - (view.legend ? 190 : 90));
  scene.height = view.height > 0 ? view.height : static_cast<int>(std::clamp(needed, 240.0, 1600.0));
  scene.title = view.title;
  scene.background = view.background;
  scene.cancel = view.cancel;
  scene.camera.zoom = view.zoom;
  if (view.parastichies) add_families(drawn, map, scene);
  add_primordia(drawn, map, scene);
  add_axes(drawn, map, scene);
  if (view.legend && !drawn.values.empty())
    scene.bars.push_back({drawn.palette.colours, drawn.min, drawn.max, legend_title_of(view)});
  if (view.legend && view.parastichies) add_family_keys(drawn, scene);
  return scene;
}

}  // namespace tunica
