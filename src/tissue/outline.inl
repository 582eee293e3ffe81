// SPDX-License-Identifier: MIT
// What is worked out of the outline of a cell: written once, for one cell (Number is double) and for four side by side (see
// outline_kernels.inl), with the same bits. Included into a namespace that has choose(mask, yes, no), root(x),
// greater(a, b) and magnitude(x) of these numbers.
//
// An Outline has its number of corners `count` (the largest, of several), corner(i) for i from 0 to count, where one with fewer
// corners and corner(count) are the first again, last(), and has(i): whether corner i is one of its own.

template <class Number>
struct Point {
  Number x, y, z;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator*(Number f, Point a) { return {f * a.x, f * a.y, f * a.z}; }
  friend Point operator/(Point a, Number d) { return {a.x / d, a.y / d, a.z / d}; }
};

template <class Number>
inline Number dot(Point<Number> a, Point<Number> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number>
inline Point<Number> cross(Point<Number> a, Point<Number> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Number>
struct FanMeasure {
  Number area;
  Point<Number> centroid;
};

/// Of a polygon that is not flat: fans of triangles, as MorphoGraphX measures its cells.
template <class Number, class Outline>
inline FanMeasure<Number> measure_fan(const Outline& o, Point<Number> average) {
  const Number zero{};
  Number twice{}, again{};
  Point<Number> moment{}, a = o.corner(0) - average;
  for (int i = 1; i <= o.count; ++i) {
    const Point<Number> b = o.corner(i) - average, triangle = cross(a, b);
    const Number part = root(dot(triangle, triangle));
    twice = twice + part;
    moment = moment + part * (a + b);
    a = b;
  }
  const Point<Number> off = moment / (3.0 * twice);
  const auto empty = twice == zero;
  const Point<Number> centroid =
      average + Point<Number>{choose(empty, zero, off.x), choose(empty, zero, off.y), choose(empty, zero, off.z)};
  a = o.corner(0) - centroid;
  for (int i = 1; i <= o.count; ++i) {
    const Point<Number> b = o.corner(i) - centroid, triangle = cross(a, b);
    again = again + root(dot(triangle, triangle));
    a = b;
  }
  return {again / 2.0, centroid};
}

/// The average of the corners, and whether they are beyond doubt not in one plane.
template <class Number, class Truth>
struct Spread {
  Point<Number> average;
  Truth in_plane;   ///< all at z = 0
  Truth not_flat;   ///< were all within 1e-9 of a plane, no four corners could span so much; most cells on a curved surface do
};

template <class Number, class Truth, class Outline>
inline Spread<Number, Truth> spread(const Outline& o, Number corners) {
  const Point<Number> origin = o.corner(0);
  Point<Number> sum{};
  Number reach{};
  Truth in_plane = origin.z == Number{};
  for (int i = 1; i < o.count; ++i) {
    const Point<Number> p = o.corner(i), b = p - origin;
    sum = sum + b;
    reach = greater(reach, greater(magnitude(b.x), greater(magnitude(b.y), magnitude(b.z))));
    in_plane = in_plane & (p.z == Number{});
  }
  const Number volume = dot(cross(o.quarter(1) - origin, o.quarter(2) - origin), o.quarter(3) - origin);
  return {origin + sum / corners, in_plane, magnitude(volume) > 1e-7 * reach * reach * reach};
}

/// is_plain_cell().
template <class Truth, class Number, class Outline>
inline Truth is_plain(const Outline& o, Point<Number> outward) {
  const Number zero{};
  const Point<Number> origin = o.corner(0);
  Point<Number> twice{}, along = o.corner(1) - origin;
  for (int i = 2; i < o.count; ++i) {
    const Point<Number> next = o.corner(i) - origin;
    twice = twice + cross(along, next);
    along = next;
  }
  const Number facing = dot(twice, outward);
  Truth plain = (facing > zero) & (facing * facing > 0.25 * dot(twice, twice) * dot(outward, outward)) &
                (facing - facing == zero);
  Number turns{};
  Point<Number> edge = origin - o.last();
  const Point<Number> first = edge;
  Truth ahead = zero == zero;
  for (int i = 0; i < o.count; ++i) {
    const Point<Number> next = o.corner(i + 1) - o.corner(i);
    const Truth own = o.has(i);
    plain = plain & (choose(own, dot(cross(edge, next), twice), zero + 1.0) > zero);
    const Truth now = dot(next, first) > zero;
    turns = turns + choose(own & (now ^ ahead), zero + 1.0, zero);
    ahead = now;
    edge = next;
  }
  return plain & (turns <= zero + 2.0);  // once around: along any direction there and back
}
