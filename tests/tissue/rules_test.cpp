// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>

#include "tissue/builders.h"
#include "tissue/chord.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

constexpr double pi = std::numbers::pi;
using Polygon = std::vector<Vec2>;

// === Brute force, written apart from the kernel: it knows only the definition, and tries directions.

struct Line {
  Vec2 centre, direction;
};

struct Crossing {
  double r;
  size_t side;
};

std::vector<Crossing> crossings(const Polygon& p, const Line& line) {
  std::vector<Crossing> found;
  for (size_t i = 0; i < p.size(); ++i) {
    const Vec2 a = p[i] - line.centre, b = p[(i + 1) % p.size()] - line.centre;
    const Vec2 across(-line.direction.y(), line.direction.x());
    const double ha = a.dot(across), hb = b.dot(across);  // heights of the ends above the line
    if ((ha >= 0) == (hb >= 0)) continue;
    found.push_back({(a + (b - a) * (ha / (ha - hb))).dot(line.direction), i});
  }
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.r < b.r; });
  return found;
}

double area(const Polygon& p) {
  double twice = 0;
  for (size_t i = 0; i < p.size(); ++i) twice += cross(p[i], p[(i + 1) % p.size()]);
  return twice / 2;
}

double share_cut_off(const Polygon& p, const Line& line, const Crossing& from, const Crossing& to) {
  Polygon piece{line.centre + from.r * line.direction};
  for (size_t i = from.side; i != to.side; i = (i + 1) % p.size()) piece.push_back(p[(i + 1) % p.size()]);
  piece.push_back(line.centre + to.r * line.direction);
  return area(piece) / area(p);
}

/// Length of the best wall in one direction; infinite if there is none.
double wall_at(const Polygon& p, const Vec2& centre, bool inside, double angle, double least) {
  const Line line{centre, {std::cos(angle), std::sin(angle)}};
  const std::vector<Crossing> c = crossings(p, line);
  double best = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k + 1 < c.size(); k += 2) {
    if (inside && !(c[k].r <= 0 && c[k + 1].r >= 0)) continue;
    if (!inside) {
      const double share = share_cut_off(p, line, c[k], c[k + 1]);
      if (share < least || share > 1 - least) continue;
    }
    best = std::min(best, c[k + 1].r - c[k].r);
  }
  return best;
}

double brute_force(const Polygon& p, const Vec2& centre, bool inside, double least) {
  std::vector<double> angles;
  for (int i = 0; i < 720; ++i) angles.push_back(i * pi / 720);
  std::vector<double> corners;
  for (const Vec2& q : p) corners.push_back(std::fmod(std::atan2(q.y() - centre.y(), q.x() - centre.x()) + 2 * pi, pi));
  std::sort(corners.begin(), corners.end());
  for (size_t i = 0; i + 1 < corners.size(); ++i)  // so that a gap seen between two corners is not missed
    for (const double part : {.001, .1, .5, .9, .999})
      angles.push_back(corners[i] + part * (corners[i + 1] - corners[i]));
  std::sort(angles.begin(), angles.end());
  std::vector<double> lengths;
  for (const double angle : angles) lengths.push_back(wall_at(p, centre, inside, angle, least));
  const double coarse = *std::min_element(lengths.begin(), lengths.end());
  double best = coarse;
  const size_t n = angles.size();
  for (size_t i = 0; i < n; ++i) {
    const double before = lengths[(i + n - 1) % n], after = lengths[(i + 1) % n];
    if (lengths[i] > before || lengths[i] > after || lengths[i] > 1.3 * coarse) continue;
    double low = i > 0 ? angles[i - 1] : angles[n - 1] - pi, high = i + 1 < n ? angles[i + 1] : angles[0] + pi;
    for (int zoom = 0; zoom < 24; ++zoom) {  // by a factor 4 each time, around the best of 17 directions
      double least_here = std::numeric_limits<double>::infinity(), at = low;
      for (int k = 0; k <= 16; ++k) {
        const double angle = low + (high - low) * k / 16;
        const double length = wall_at(p, centre, inside, angle, least);
        if (length < least_here) {
          least_here = length;
          at = angle;
        }
      }
      best = std::min(best, least_here);
      const double reach = (high - low) / 8;
      low = at - reach;
      high = at + reach;
    }
  }
  return best;
}

// === Random cells

Polygon convex(testing::Dice& dice) {
  std::vector<double> angles;
  for (int i = 0, n = 3 + dice.below(8); i < n; ++i) angles.push_back(dice.between(0, 2 * pi));
  std::sort(angles.begin(), angles.end());
  const double stretch = dice.between(.3, 1);
  Polygon p;
  for (const double a : angles) p.emplace_back(std::cos(a), stretch * std::sin(a));
  return p;
}

Polygon star(testing::Dice& dice) {
  Polygon p;
  const int n = 5 + dice.below(10);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * (i + dice.between(-.3, .3)) / n, r = dice.between(.25, 1);
    p.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return p;
}

/// A bent band: its centroid is often outside.
Polygon boomerang(testing::Dice& dice) {
  const double bend = dice.between(1.5, 5), thick = dice.between(.1, .5);
  const int n = 3 + dice.below(5);
  Polygon p;
  for (int i = 0; i <= n; ++i) {
    const double angle = bend * i / n, r = 1 + thick * dice.between(.5, 1);
    p.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  for (int i = n; i >= 0; --i) {
    const double angle = bend * i / n, r = 1 - thick * dice.between(.5, 1);
    p.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return p;
}

Tissue cell_of(const Polygon& p) {
  std::vector<Vec3> points;
  for (const Vec2& q : p) points.emplace_back(q.x(), q.y(), 0);
  return polygons({points});
}

TEST(Errera, IsTheShortestOfAllDirections) {
  testing::Dice dice(7);
  int done = 0, outside = 0;
  while (done < 10'000) {
    const Polygon p = done % 5 < 2 ? convex(dice) : done % 5 < 4 ? star(dice) : boomerang(dice);
    if (!is_simple(p) || area(p) < .02) continue;
    const Tissue tissue = cell_of(p);
    const FlatCell cell(tissue, 0);
    const Vec2 centre = tissue.centroid(0).head<2>();
    const Chord chord = shortest_chord(cell);
    double brute = brute_force(p, centre, cell.centroid_inside, .2);
    for (double least = .1; !std::isfinite(brute); least /= 2) brute = brute_force(p, centre, false, least);
    ASSERT_NEAR(chord.length, brute, 1e-9) << "polygon " << done;
    // The cut is that wall: as long, on a line through the centroid.
    const Tissue& t = tissue;
    const auto end = [&](Index side, double at) {
      return Vec3(t.position(t.start(side)) + at * (t.position(t.end(side)) - t.position(t.start(side))));
    };
    const Vec3 a = end(chord.cut.side_a, chord.cut.at_a), b = end(chord.cut.side_b, chord.cut.at_b);
    ASSERT_NEAR((b - a).norm(), chord.length, 1e-9);
    ASSERT_NEAR(cross((a - tissue.centroid(0)).head<2>(), (b - a).head<2>()) / chord.length, 0, 1e-9);
    outside += cell.centroid_inside ? 0 : 1;
    ++done;
  }
  EXPECT_GT(outside, 500);
}

TEST(Errera, IsTheSameForATurnedAndShiftedCellInSpace) {
  testing::Dice dice(3);
  for (int i = 0; i < 100; ++i) {
    const Polygon p = star(dice);
    if (!is_simple(p)) continue;
    const double a = dice.between(0, pi), b = dice.between(0, pi);
    const Vec3 u(std::cos(a), std::sin(a), 0), v(-std::sin(a) * std::cos(b), std::cos(a) * std::cos(b), std::sin(b));
    std::vector<Vec3> points;
    for (const Vec2& q : p) points.push_back(Vec3(3, 4, 5) + q.x() * u + q.y() * v);
    const Tissue turned = polygons({points}), flat = cell_of(p);
    EXPECT_NEAR(shortest_chord(FlatCell(turned, 0)).length, shortest_chord(FlatCell(flat, 0)).length, 1e-12);
    EXPECT_NEAR(turned.area(0), flat.area(0), 1e-12);
  }
}

TEST(Rules, ClosestWallAndDirection) {
  const Tissue tissue = polygons({{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}}});
  const auto ends = [&](const Cut& cut) {
    const auto end = [&](Index side, double at) {
      return Vec3(tissue.position(tissue.start(side)) +
                  at * (tissue.position(tissue.end(side)) - tissue.position(tissue.start(side))));
    };
    return std::pair(end(cut.side_a, cut.at_a), end(cut.side_b, cut.at_b));
  };
  const auto [p, q] = ends(closest_wall(tissue, 0));
  EXPECT_NEAR((p - q).norm(), 1, 1e-12);  // across the long walls
  EXPECT_NEAR(p.x(), 2, 1e-12);
  const auto [a, b] = ends(along({3, 0, 0})(tissue, 0));
  EXPECT_NEAR((a - b).norm(), 4, 1e-12);
  EXPECT_NEAR(a.y(), .5, 1e-12);
  const auto [c, d] = ends(cut_between(tissue, 0, {1, -.1, 0}, {1.2, 1.1, 0}));
  EXPECT_NEAR((c - Vec3(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((d - Vec3(1.2, 1, 0)).norm(), 0, 1e-12);
  EXPECT_ERROR(cut_between(tissue, 0, {1, 0, 0}, {2, 0, 0}), "same wall");
  EXPECT_ERROR(cut_between(tissue, 0, {1, 0, 0}, {NAN, 0, 0}), "not finite");
}

TEST(Roots, OfPolynomials) {
  const std::vector<double> roots = roots_between({-6, 11, -6, 1}, 0, 10);  // (x - 1)(x - 2)(x - 3)
  ASSERT_EQ(roots.size(), 3u);
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(roots[i], static_cast<double>(i + 1), 1e-12);
  EXPECT_TRUE(roots_between({1, 0, 1}, -10, 10).empty());
}

}  // namespace
}  // namespace tunica
