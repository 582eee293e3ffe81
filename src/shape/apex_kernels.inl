// SPDX-License-Identifier: MIT
// Compiled once per instruction set with TUNICA_ISA (namespace) set; nothing here calls inline library code.

#include "base/lanes.inl"
#include "shape/apex_kernels.h"

namespace tunica::TUNICA_ISA {
namespace {

inline Four nan() { return all(__builtin_nan("")); }

// === Tables

/// Places in a table: for each the cubics there, share of the step gone, steps per unit.
struct Places {
  const double* cubics[4];
  Four s, per_x;
};

inline Places find(const TableView& table, Four x) {
  int i = table.spans - 1;  // most cells are far from the tip, where spans are wide
  Four from = all(table.from[i]), per_x = all(table.per_x[i]);
  Four first = all(table.first_step[i]), last = all(table.last_step[i]);
  for (; i > 0; --i) {
    const Mask before = ~(x >= all(table.from[i]));
    if (none_of(before)) break;
    from = choose(before, all(table.from[i - 1]), from);
    per_x = choose(before, all(table.per_x[i - 1]), per_x);
    first = choose(before, all(table.first_step[i - 1]), first);
    last = choose(before, all(table.last_step[i - 1]), last);
  }
  const Four at = greater((x - from) * per_x, Four{});
  const Four most = last - first;
  const Four below = choose(at < most, at, most);
  const Four whole = __builtin_convertvector(__builtin_convertvector(below, Steps), Four);
  const Steps step = __builtin_convertvector(first + whole, Steps);
  Places places;
  for (int k = 0; k < 4; ++k) places.cubics[k] = table.cubics + 4L * table.columns * step[k];
  places.s = at - whole;
  places.per_x = per_x;
  return places;
}

/// One column of a table there: value, slope and bend as those of Table.
struct Cubic {
  Four c0, c1, c2, c3;
  Four value(const Places& p) const { return c0 + p.s * (c1 + p.s * (c2 + p.s * c3)); }
  Four slope(const Places& p) const { return p.per_x * (c1 + p.s * (2.0 * c2 + 3.0 * p.s * c3)); }
  Four bend(const Places& p) const { return p.per_x * p.per_x * (2.0 * c2 + 6.0 * p.s * c3); }
};

inline Cubic column(const Places& p, int i) {
  Cubic c{load(p.cubics[0] + 4 * i), load(p.cubics[1] + 4 * i), load(p.cubics[2] + 4 * i), load(p.cubics[3] + 4 * i)};
  transpose(c.c0, c.c1, c.c2, c.c3);
  return c;
}

inline Mask within(const TableView& table, Four x) { return (x >= all(table.first)) & (x <= all(table.last)); }

// === Points

struct Points {
  Four x, y, z;
};

/// Four points of a list; behind its end the first of the four again.
inline Points points_at(const double* points, long left) {
  if (left < 4) {
    Points p{all(points[0]), all(points[1]), all(points[2])};
    for (long k = 1; k < left; ++k) p.x[k] = points[3 * k], p.y[k] = points[3 * k + 1], p.z[k] = points[3 * k + 2];
    return p;
  }
  const Four a = load(points), b = load(points + 4), c = load(points + 8);  // x y z x | y z x y | z x y z
  const Four xy = __builtin_shuffle(a, b, Mask{0, 3, 6, 5}), yx = __builtin_shuffle(a, b, Mask{1, 4, 7, 2});
  return {__builtin_shuffle(xy, c, Mask{0, 1, 2, 5}), __builtin_shuffle(yx, c, Mask{0, 1, 2, 6}),
          __builtin_shuffle(__builtin_shuffle(yx, b, Mask{3, 5, 0, 0}), c, Mask{0, 1, 4, 7})};
}

inline Points places(const double* x, const double* y, const double* z, long left) {
  if (left == 4) return {load(x), load(y), load(z)};
  Points p{all(x[0]), all(y[0]), all(z[0])};
  for (int k = 1; k < left; ++k) p.x[k] = x[k], p.y[k] = y[k], p.z[k] = z[k];
  return p;
}

inline void put(double* points, long left, const Points& p) {
  if (left < 4) {
    for (long k = 0; k < left; ++k) points[3 * k] = p.x[k], points[3 * k + 1] = p.y[k], points[3 * k + 2] = p.z[k];
    return;
  }
  const Four low = __builtin_shuffle(p.x, p.y, Mask{0, 4, 1, 5}), high = __builtin_shuffle(p.x, p.y, Mask{2, 6, 3, 7});
  store(points, __builtin_shuffle(low, __builtin_shuffle(low, p.z, Mask{4, 2, 5, 3}), Mask{0, 1, 4, 5}));
  store(points + 4, __builtin_shuffle(__builtin_shuffle(low, p.z, Mask{3, 5, 0, 0}), high, Mask{0, 1, 4, 5}));
  store(points + 8, __builtin_shuffle(high, p.z, Mask{6, 2, 3, 7}));
}

/// (x, y) of the profile, in the direction of p.
inline Points around(const Points& p, Four r, Four x, Four y, Mask known) {
  return {choose(known, x * (p.x / r), nan()), y, x * (p.z / r)};
}

void move(const ApexView& apex, double dt, double* points, long count) {
  for (long i = 0; i < count; i += 4) {
    const Points p = points_at(points + 3 * i, count - i);
    const Four r = root(p.x * p.x + p.z * p.z), level = r - p.y;
    const Places here = find(apex.place, level);
    const Four time = column(here, 2).value(here) / all(apex.speed) + all(dt);
    const Mask known = (r > Four{}) & within(apex.place, level) & within(apex.course, time) &
                       (magnitude(r - column(here, 0).value(here)) <= all(apex.on_profile * apex.size));
    const Places then = find(apex.course, time);
    put(points + 3 * i, count - i, around(p, r, column(then, 0).value(then), column(then, 1).value(then), known));
  }
}

void face(const ApexView& apex, double* points, long count) {
  for (long i = 0; i < count; i += 4) {
    const Points p = points_at(points + 3 * i, count - i);
    const Four r = root(p.x * p.x + p.z * p.z), level = r - p.y;
    const Places here = find(apex.place, level);
    const Four dx = column(here, 0).slope(here);
    put(points + 3 * i, count - i, around(p, r, 1.0 - dx, dx, (r > Four{}) & within(apex.place, level)));
  }
}

// === Angles

/// The arc tangent of t in [0, 1]: beyond tan(pi / 8) by that of (t - 1) / (t + 1); there a rational function (S. L.
/// Moshier's coefficients), good to 2 units in the last place.
inline Four arc_tangent(Four t) {
  const Mask far = t > all(0.4142135623730950488);
  const Four x = choose(far, (t - 1.0) / (t + 1.0), t), q = x * x;
  const Four top = (((-8.750608600031904122785e-1 * q - 1.615753718733365076637e1) * q - 7.500855792314704667340e1) * q -
                    1.228866684490136173410e2) * q - 6.485021904942025371773e1;
  const Four bottom = ((((q + 2.485846490142306297962e1) * q + 1.650270098316988542046e2) * q +
                        4.328810604912902668951e2) * q + 4.853903996359136964868e2) * q + 1.945506571482613964425e2;
  const Four small = x + x * (q * top / bottom);
  return choose(far, small + 0.78539816339744830962, small);
}

/// Of a point (x, z) around the axis, -180 to 180 degrees; 0 on the axis.
inline Four angle(Four x, Four z) {
  const Four dx = magnitude(x), dz = magnitude(z), most = greater(dx, dz), least = choose(dx < dz, dx, dz);
  Four t = arc_tangent(least / choose(most > Four{}, most, all(1)));
  t = choose(dz > dx, 1.57079632679489661923 - t, t);
  t = choose(x < Four{}, 3.14159265358979323846 - t, t);
  return choose(z < Four{}, -t, t) * 180.0 / 3.14159265358979323846;
}

// === Nearest places

/// ApexTables::nearest_arc().
inline Four nearest_arc(const ApexView& apex, Four r, Four y) {
  const Four level = r - y;
  const Mask there = within(apex.place, level);
  const Places guess = find(apex.place, level);
  const Cubic x_of_level = column(guess, 0), a_of_level = column(guess, 1);
  // The point of the profile at the same level, and from there on along the tangent.
  const Four per_level = a_of_level.slope(guess), along = (2.0 * x_of_level.slope(guess) - 1.0) / per_level;
  Four a = a_of_level.value(guess) + (r - x_of_level.value(guess)) * along, result = nan();
  a = choose(a < all(apex.track.last), greater(a, Four{}), all(apex.track.last));
  Mask open = there & (y == y);
  for (int i = 0; i < 12 && !none_of(open); ++i) {
    const Places at = find(apex.track, a);
    const Cubic x = column(at, 0), h = column(at, 1);
    const Four away_x = x.value(at) - r, away_y = h.value(at) - y;
    const Four along_x = x.slope(at), along_y = h.slope(at);
    const Four f = away_x * along_x + away_y * along_y;
    const Four slope = along_x * along_x + along_y * along_y + (away_x * x.bend(at) + away_y * h.bend(at));
    const Four step = a - f / slope, next = choose(step > all(apex.track.last), all(apex.track.last), greater(step, Four{}));
    const Mask done = open & (slope > Four{}) & (magnitude(next - a) <= all(1e-6 * apex.size));
    const Four d = root(away_x * away_x + away_y * away_y), reach = 2.0 * all(1.4142135623730950488) * d / apex.rise;
    const Mask certain = (next < all(apex.track.last)) &
                         ((d <= all(apex.on_profile * apex.size)) | ((d + reach) * apex.sharpest < all(0.9)));
    result = choose(done & certain, next, result);
    open = open & (slope > Four{}) & ~done;
    a = next;
  }
  return result;
}

void beyond(const ApexView& apex, const double* x, const double* y, const double* z, long count, double a,
            double* answer) {
  for (long i = 0; i < count; i += 4) {
    const long left = count - i < 4 ? count - i : 4;
    const Points p = places(x + i, y + i, z + i, left);
    const Four r = root(p.x * p.x + p.z * p.z), level = r - p.y;
    const Places here = find(apex.place, level);
    const Four off = all(1.4142135623730950488) * magnitude(r - column(here, 0).value(here));
    const Four way = column(here, 1).value(here) - a;
    const Mask clear = within(apex.place, level) &
                       (magnitude(way) > all(1.4142135623730950488) * off / apex.rise + apex.on_profile * apex.size);
    store(answer + i, left, choose(clear, choose(way > Four{}, all(1), Four{}), nan()));
  }
}

void locate(const ApexView& apex, const double* x, const double* y, const double* z, long count, double* theta,
            double* a) {
  for (long i = 0; i < count; i += 4) {
    const long left = count - i < 4 ? count - i : 4;
    const Points p = places(x + i, y + i, z + i, left);
    store(a + i, left, nearest_arc(apex, root(p.x * p.x + p.z * p.z), p.y));
    store(theta + i, left, angle(p.x, p.z));
  }
}

void deepest(const Disc* discs, int count_of_discs, const double* x, const double* y, const double* z, long count,
             double* disc, double* depth) {
  for (long i = 0; i < count; i += 4) {
    const long left = count - i < 4 ? count - i : 4;
    const Points p = places(x + i, y + i, z + i, left);
    Four least = all(1), found{}, number = all(1);
    for (int d = 0; d < count_of_discs; ++d, number += 1.0) {
      const Four dx = p.x - discs[d].x, dy = p.y - discs[d].y, dz = p.z - discs[d].z;
      const Four here = (dx * dx + dy * dy + dz * dz) * discs[d].per_square;
      const Mask nearer = here < least;
      least = choose(nearer, here, least);
      found = choose(nearer, number, found);
    }
    store(disc + i, left, found);
    store(depth + i, left, 1.0 - root(least));
  }
}

}  // namespace

const ApexKernels& apex_kernels() {
  static const ApexKernels set{move, face, locate, beyond, deepest};
  return set;
}

}  // namespace tunica::TUNICA_ISA
