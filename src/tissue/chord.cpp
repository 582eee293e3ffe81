// SPDX-License-Identifier: MIT
#include "tissue/chord.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"

namespace tunica {

namespace {

std::vector<Index> sides_of(const Tissue& tissue, Index cell) {
  std::vector<Index> sides;
  sides.reserve(8);  // room for most
  const Index first = tissue.first_side(cell);
  Index side = first;
  do sides.push_back(side);
  while ((side = tissue.next(side)) != first);
  return sides;
}

std::vector<Vec3> corners_of(const Tissue& tissue, Index cell) {
  std::vector<Vec3> corners;
  corners.reserve(8);
  tissue.collect_polygon(cell, corners);
  return corners;
}

double distance_to_outline(const FlatCell& cell) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < cell.size(); ++i) {
    const Vec2 p = cell.from(i), e = cell.along(i);
    const double at = std::clamp(-p.dot(e) / e.squaredNorm(), 0., 1.);
    least = std::min(least, (p + at * e).squaredNorm());
  }
  return std::sqrt(least);
}

/// Whether all sides run counter-clockwise around the centroid, clear of it.
bool is_star_shaped(const FlatCell& cell) {
  for (size_t i = 0; i < cell.size(); ++i) {
    const Vec2 e = cell.along(i);
    const double k = cross(cell.from(i), e);
    if (!(k > 0 && k * k > 1e-18 * cell.area * e.squaredNorm())) return false;
  }
  return true;
}

Vec2 direction_of(double angle) { return {std::cos(angle), std::sin(angle)}; }
double angle_of(const Vec2& d) { return std::atan2(d.y(), d.x()); }

}  // namespace

FlatCell::FlatCell(const Tissue& tissue, Index cell) : FlatCell(tissue, cell, corners_of(tissue, cell)) {}

FlatCell::FlatCell(const Tissue& tissue, Index cell, const std::vector<Vec3>& corners)
    : id(tissue.id(Kind::cell, cell)), sides(sides_of(tissue, cell)), frame(corners) {
  points = frame.flat(corners);
  area = signed_area(points);
  if (!(area > 0)) throw Indivisible(fmt::format("cell {} has no positive area", id));
  const Vec2 centroid = centroid_of(points);
  frame.origin += centroid.x() * frame.u + centroid.y() * frame.v;
  for (Vec2& p : points) p -= centroid;
  star_shaped = is_star_shaped(*this);
  centroid_inside =
      star_shaped || (contains(points, Vec2::Zero()) && distance_to_outline(*this) > 1e-9 * std::sqrt(area));
}

std::vector<Hit> hits_along(const FlatCell& cell, const Vec2& direction) {
  std::vector<Hit> hits;
  bool before = cross(direction, cell.from(0)) > 0;
  for (size_t i = 0; i < cell.size(); ++i) {
    // A corner on the line counts to its right, for both its sides: so the number of crossings stays even.
    const bool after = cross(direction, cell.from((i + 1) % cell.size())) > 0;
    if (before != after) hits.push_back({i, cross(cell.from(i), cell.along(i)) / cross(direction, cell.along(i))});
    before = after;
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.r < b.r; });
  return hits;
}

namespace {

double place_on(const FlatCell& cell, const Vec2& direction, size_t side) {
  const double at = -cross(direction, cell.from(side)) / cross(direction, cell.along(side));
  return std::clamp(at, 0., 1.);
}

}  // namespace

Cut cut_at(const FlatCell& cell, const Vec2& direction, size_t side_a, size_t side_b) {
  return {cell.sides[side_a], place_on(cell, direction, side_a), cell.sides[side_b], place_on(cell, direction, side_b)};
}

double share_beyond(const FlatCell& cell, const Vec2& direction, size_t side_a, size_t side_b) {
  std::vector<Vec2> piece{cell.from(side_a) + place_on(cell, direction, side_a) * cell.along(side_a)};
  for (size_t i = side_a; i != side_b; i = (i + 1) % cell.size()) piece.push_back(cell.from((i + 1) % cell.size()));
  piece.push_back(cell.from(side_b) + place_on(cell, direction, side_b) * cell.along(side_b));
  return signed_area(piece) / cell.area;
}

// === Errera with the centroid inside: on each interval between the directions of corners the chord ends on the same
// two sides, and its length is a sum of two secants, which is convex. Its least value there is found by Newton's
// method.

namespace {

/// The distance along direction theta to a side's line, r = k / g(theta), and r'.
struct Ray {
  double k;
  Vec2 e;
  Ray(const FlatCell& cell, size_t side) : k(cross(cell.from(side), cell.along(side))), e(cell.along(side)) {}
  /// {r, r', r''} for the distance's absolute value
  std::array<double, 3> at(const Vec2& d) const {
    const double inverse = 1 / cross(d, e), slope = d.dot(e) * inverse;  // -g'/g, g' = cross((-sin, cos), e)
    const double r = std::abs(k * inverse);
    return {r, r * slope, r * (1 + 2 * slope * slope)};
  }
};

struct Best {
  double length = std::numeric_limits<double>::infinity();
  Vec2 direction = Vec2::UnitX();
  size_t a = 0, b = 0;
  void offer(double candidate, const Vec2& along, size_t side_a, size_t side_b) {
    if (candidate < length) *this = {candidate, along, side_a, side_b};
  }
};

/// The direction to a corner, or away from it if it is not in the upper half plane.
struct Direction {
  double order;  ///< grows with the angle, evenly enough to tell directions apart as well as the angle does
  Vec2 unit;
  size_t corner;
  bool ahead;  ///< to it
};

/// Directions of all corners in order; the first again at the end, half a turn on.
std::vector<Direction> corner_directions(const FlatCell& cell) {
  std::vector<Direction> directions;
  directions.reserve(cell.size() + 1);
  for (size_t i = 0; i < cell.size(); ++i) {
    const Vec2& p = cell.from(i);
    if (p.x() == 0 && p.y() == 0) continue;  // a corner in the centroid
    const bool ahead = p.y() > 0 || (p.y() == 0 && p.x() > 0);
    const Vec2 d = (ahead ? p : Vec2(-p)).normalized();
    directions.push_back({-d.x() / (std::abs(d.x()) + d.y()), d, i, ahead});
  }
  std::sort(directions.begin(), directions.end(), [](const auto& a, const auto& b) { return a.order < b.order; });
  const Direction& first = directions[0];
  directions.push_back({first.order + 2, -first.unit, first.corner, !first.ahead});
  return directions;
}

/// Whether two directions, less than half a turn apart, are too close to have a chord between them.
bool coincide(const Vec2& low, const Vec2& high) { return cross(low, high) < 1e-14 && low.dot(high) > 0; }

/// A direction turned left by the angle of this tangent.
Vec2 turned(const Vec2& d, double tangent) {
  return Vec2(d.x() - tangent * d.y(), d.y() + tangent * d.x()).normalized();
}

/// The length of a chord by its direction, {l, l', l''} by the angle: convex.
struct ChordLength {
  const Ray &forward, &backward;
  std::array<double, 3> at(const Vec2& d) const {
    const auto f = forward.at(d), b = backward.at(d);
    return {f[0] + b[0], f[1] + b[1], f[2] + b[2]};
  }
};

/// The direction of the least length between two; none if that is not below `best`.
std::optional<Vec2> least_on(const ChordLength& chord, Vec2 low, Vec2 high, double best) {
  const auto start = chord.at(low), end = chord.at(high);
  if (start[1] >= 0) return low;
  if (end[1] <= 0) return high;
  // Where the tangents at both ends meet: the curve is above them, all the more if they are taken to lie farther apart
  // than they do, by twice the tangent of half the angle.
  const double width = 2 * cross(low, high) / (1 + low.dot(high));
  const double meet = (start[0] - end[0] + end[1] * width) / (end[1] - start[1]);
  if (start[0] + start[1] * meet >= best) return std::nullopt;
  const auto between = [&](const Vec2& d) {
    return cross(low, d) > 0 && cross(d, high) > 0 ? d : Vec2((low + high).normalized());
  };
  Vec2 d = between(turned(low, width * start[1] / (start[1] - end[1])));  // as if the slope grew evenly
  for (int i = 0; i < 200; ++i) {
    const auto [length, slope, curvature] = chord.at(d);
    const double step = -slope / curvature;
    const Vec2 newton = turned(d, step);
    if (std::abs(step) < 1e-8) return newton;  // what is left is the square of it
    (slope > 0 ? high : low) = d;
    d = between(newton);
  }
  return d;
}

/// The sides that the line through the centroid meets first, ahead and behind; false: there are none.
bool nearest_hits(const FlatCell& cell, const Vec2& direction, size_t& ahead, size_t& behind) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  bool left = cross(direction, cell.from(0)) > 0;
  for (size_t i = 0; i < cell.size(); ++i) {
    const bool after = cross(direction, cell.from(i + 1 < cell.size() ? i + 1 : 0)) > 0;  // as in hits_along()
    if (left != after) {
      const double r = cross(cell.from(i), cell.along(i)) / cross(direction, cell.along(i));
      if (r > 0 && r < least) least = r, ahead = i;
      if (r <= 0 && r > most) most = r, behind = i;
    }
    left = after;
  }
  return std::isfinite(least) && std::isfinite(most);
}

Best shortest_through_inside(const FlatCell& cell) {
  Best best;
  const std::vector<Direction> corners = corner_directions(cell);
  size_t forward = 0, backward = 0;
  bool known = false;
  for (size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 &low = corners[i].unit, &high = corners[i + 1].unit;
    // In a star the line leaves one side for the next where it passes a corner.
    if (known) (corners[i].ahead ? forward : backward) = corners[i].corner;
    if (coincide(low, high)) continue;
    if (!known && !nearest_hits(cell, low + high, forward, backward)) continue;
    known = cell.star_shaped;
    const Ray f(cell, forward), b(cell, backward);
    const ChordLength chord{f, b};
    if (const auto d = least_on(chord, low, high, best.length)) best.offer(chord.at(*d)[0], *d, backward, forward);
  }
  return best;
}

// === Errera with the centroid outside. With s = tan(angle from the interval's middle) the length of a piece is
// sqrt(1 + s^2) N(s) / (G_near(s) G_far(s)), N and G linear: it is least at an end or at a root of a quartic.

std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> c(a.size() + b.size() - 1, 0.);
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}

std::vector<double> sum(std::vector<double> a, const std::vector<double>& b, double factor) {
  a.resize(std::max(a.size(), b.size()), 0.);
  for (size_t i = 0; i < b.size(); ++i) a[i] += factor * b[i];
  return a;
}

/// The part of [low, high] where the piece from side a to side b leaves at least `least` of the area on either side.
/// The share grows or shrinks steadily with the angle, because the centroid is not on the piece.
std::pair<double, double> balanced(const FlatCell& cell, size_t a, size_t b, double low, double high, double least) {
  const auto share = [&](double angle) { return share_beyond(cell, direction_of(angle), a, b); };
  const bool rising = share(high) > share(low);
  const auto where = [&](double wanted) {  // the angle at which the share passes a value
    double left = low, right = high;
    for (int i = 0; i < 100; ++i) {
      const double middle = (left + right) / 2;
      ((share(middle) < wanted) == rising ? left : right) = middle;
    }
    return (left + right) / 2;
  };
  const double few = where(least), many = where(1 - least);
  return rising ? std::pair(few, many) : std::pair(many, few);
}

void offer_piece(const FlatCell& cell, size_t near, size_t far, double low, double high, double least, Best& best) {
  const double middle = (low + high) / 2;
  const Vec2 d = direction_of(middle), n(-d.y(), d.x());
  const auto [first, last] = balanced(cell, near, far, low, high, least);
  const Ray a(cell, near), b(cell, far);
  const std::vector<double> ga{cross(d, a.e), cross(n, a.e)}, gb{cross(d, b.e), cross(n, b.e)};
  const std::vector<double> top = sum(product({b.k}, ga), product({a.k}, gb), -1);
  const std::vector<double> bottom = product(ga, gb);
  const std::vector<double> bottom_slope{bottom[1], 2 * bottom[2]};
  std::vector<double> quartic = product({0., 1.}, product(top, bottom));
  const std::vector<double> rest = sum(product({top[1]}, bottom), product(top, bottom_slope), -1);
  quartic = sum(quartic, product({1., 0., 1.}, rest), 1);
  std::vector<double> angles{first, last};
  for (const double s : roots_between(quartic, std::tan(first - middle), std::tan(last - middle)))
    angles.push_back(middle + std::atan(s));
  for (const double angle : angles) {
    const Vec2 direction = direction_of(angle);
    const double share = share_beyond(cell, direction, near, far);
    if (!(share > least - 1e-12 && share < 1 - least + 1e-12)) continue;
    best.offer(std::abs(b.k / cross(direction, b.e) - a.k / cross(direction, a.e)), direction, near, far);
  }
}

Best shortest_from_outside(const FlatCell& cell, double least) {
  Best best;
  const std::vector<Direction> corners = corner_directions(cell);
  for (size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 &from = corners[i].unit, &to = corners[i + 1].unit;
    if (coincide(from, to)) continue;
    const double low = angle_of(from), high = low + angle_of({from.dot(to), cross(from, to)});
    const std::vector<Hit> hits = hits_along(cell, direction_of((low + high) / 2));
    for (size_t k = 0; k + 1 < hits.size(); k += 2)
      offer_piece(cell, hits[k].side, hits[k + 1].side, low, high, least, best);
  }
  return best;
}

}  // namespace

Chord shortest_chord(const FlatCell& cell) {
  Best best;
  if (cell.centroid_inside) {
    best = shortest_through_inside(cell);
  } else {
    for (double least = .2; !std::isfinite(best.length) && least > 1e-3; least /= 2)
      best = shortest_from_outside(cell, least);
  }
  if (!std::isfinite(best.length))
    throw Indivisible(fmt::format("cell {} is so thin that no wall through its centroid can be found", cell.id));
  return {cut_at(cell, best.direction, best.a, best.b), best.length};
}

Chord chord_along(const FlatCell& cell, const Vec2& direction) {
  const Vec2 d = direction.normalized();
  const std::vector<Hit> hits = hits_along(cell, d);
  size_t chosen = hits.size();
  double balance = -1;
  for (size_t k = 0; k + 1 < hits.size(); k += 2) {
    const double share = share_beyond(cell, d, hits[k].side, hits[k + 1].side);
    const bool holds_centroid = cell.centroid_inside && hits[k].r < 0 && hits[k + 1].r > 0;
    const double here = holds_centroid ? 2 : std::min(share, 1 - share);
    if (here <= balance) continue;
    balance = here;
    chosen = k;
  }
  if (chosen == hits.size()) throw Indivisible(fmt::format("no wall along this line lies inside cell {}", cell.id));
  return {cut_at(cell, d, hits[chosen].side, hits[chosen + 1].side), hits[chosen + 1].r - hits[chosen].r};
}

std::vector<double> roots_between(const std::vector<double>& c, double low, double high) {
  const auto value = [&](double x) {
    double sum_so_far = 0;
    for (size_t i = c.size(); i-- > 0;) sum_so_far = sum_so_far * x + c[i];
    return sum_so_far;
  };
  if (c.size() < 2 || !(low < high)) return {};
  std::vector<double> slope;
  for (size_t i = 1; i < c.size(); ++i) slope.push_back(static_cast<double>(i) * c[i]);
  // Between the extrema the polynomial is monotonic: at most one root each, by bisection.
  std::vector<double> ends = roots_between(slope, low, high), roots;
  ends.insert(ends.begin(), low);
  ends.push_back(high);
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    double left = ends[i], right = ends[i + 1];
    const bool rising = value(right) > value(left);
    if ((value(left) > 0) == (value(right) > 0)) continue;
    for (int k = 0; k < 200 && left < right; ++k) {
      const double middle = (left + right) / 2;
      if (middle == left || middle == right) break;
      ((value(middle) > 0) == rising ? right : left) = middle;
    }
    roots.push_back((left + right) / 2);
  }
  return roots;
}

}  // namespace tunica
