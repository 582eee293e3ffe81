// SPDX-License-Identifier: MIT
#include "field/sequence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/error.h"

namespace tunica {

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr int most = 1'000'000;

int jugacy_of(int m, int n, int jugacy) {
  if (m < 1 || n < 1 || m > most || n > most)
    fail("the numbers of a parastichy pair must be from 1 to {}, came ({},{})", most, m, n);
  const int common = std::gcd(m, n);
  if (jugacy != 0 && jugacy != common)
    fail("({},{}) is a pair of jugacy {}, the greatest common divisor of the two, came jugacy {}", m, n, common,
         jugacy);
  return common;
}

/// u, v with u n - v m = 1, 1 <= u <= m, for m, n without common divisor.
std::pair<long, long> bezout(long m, long n) {
  long a = n, b = m, s = 1, t = 0;  // a = s n mod m
  while (b != 0) {
    const long q = a / b;
    a = std::exchange(b, a - q * b);
    s = std::exchange(t, s - q * t);
  }
  const long u = ((s - 1) % m + m) % m + 1;
  return {u, (u * n - 1) / m};
}

double fold(double fraction) {
  const double f = fraction - std::floor(fraction);
  return std::min(f, 1 - f);
}

double limit_of(int first, int second) {
  if (second == 1) return .5;
  const auto [u, v] = bezout(first, second);
  return fold((static_cast<double>(u) + static_cast<double>(v) * std::numbers::phi) /
              (first + second * std::numbers::phi));
}

std::string ordinal(int k) {
  const bool teen = k % 100 >= 11 && k % 100 <= 13;
  const char* end = teen ? "th" : k % 10 == 1 ? "st" : k % 10 == 2 ? "nd" : k % 10 == 3 ? "rd" : "th";
  return fmt::format("{}{}", k, end);
}

std::string jugate(int jugacy) {
  const char* names[] = {"", "", "bijugate ", "trijugate ", "tetrajugate ", "pentajugate ", "hexajugate "};
  return jugacy <= 6 ? names[jugacy] : fmt::format("{}-jugate ", jugacy);
}

}  // namespace

std::string name_of(PatternKind kind, int order, int jugacy, ParastichyPair pair) {
  const std::string before = jugate(jugacy);
  switch (kind) {
    case PatternKind::too_few:
      return "too few";
    case PatternKind::none:
      return "none";
    case PatternKind::superposed:
      return jugacy == 1 ? "superposed" : fmt::format("superposed whorls of {}", jugacy);
    case PatternKind::alternating:
      if (jugacy > 3) return fmt::format("whorled of {}", jugacy);
      return jugacy == 1 ? "distichous" : jugacy == 2 ? "decussate" : "tricussate";
    case PatternKind::spiro_distichous:
      if (jugacy > 3) return fmt::format("spiro-whorled of {}", jugacy);
      return jugacy == 1 ? "spiro-distichous" : jugacy == 2 ? "spiro-decussate" : "spiro-tricussate";
    case PatternKind::fibonacci:
      return before + "Fibonacci spiral";
    case PatternKind::accessory:
      return before + (order == 1 ? "Lucas" : ordinal(order) + " accessory") + " spiral";
    case PatternKind::anomalous:
      return before + ordinal(order) + " anomalous spiral";
    case PatternKind::other:
      break;
  }
  return before + (pair.n > 0 ? fmt::format("other ({},{})", pair.m, pair.n) : "other");
}

Sequence sequence_of(int m, int n, int jugacy) {
  Sequence s;
  s.jugacy = jugacy_of(m, n, jugacy);
  int low = std::min(m, n) / s.jugacy, high = std::max(m, n) / s.jugacy;
  while (high - low < low && high > 1) low = std::exchange(high, low) - low;
  // The exchange leaves (low, high) = (high - low, low).
  s.first = low;
  s.second = high;
  if (high == 1) {
    s.kind = PatternKind::alternating;
  } else if (low == 1) {
    s.kind = high == 2 ? PatternKind::fibonacci : PatternKind::accessory;
    s.order = high - 2;
  } else if (low == 2) {
    s.kind = PatternKind::anomalous;
    s.order = (high - 3) / 2;
  } else {
    s.kind = PatternKind::other;
  }
  s.limit = limit_of(low, high) * turn / s.jugacy;
  s.name = name_of(s.kind, s.order, s.jugacy, {low * s.jugacy, high * s.jugacy});
  return s;
}

std::vector<int> Sequence::terms(int count) const {
  std::vector<int> list;
  long a = static_cast<long>(first) * jugacy, b = static_cast<long>(second) * jugacy;
  for (int i = 0; i < count && a <= 1'000'000'000; ++i) {
    list.push_back(static_cast<int>(a));
    a = std::exchange(b, a + b);
  }
  return list;
}

AllowableInterval allowable_interval(int m, int n, double angle, int jugacy) {
  const int j = jugacy_of(m, n, jugacy);
  if (!(angle >= 0 && angle <= turn)) fail("a divergence angle must be from 0 to a turn, came {:.6g} radians", angle);
  const int first = std::min(m, n) / j, second = std::max(m, n) / j;
  double low = 0, high = .5;  // of (1, 1)
  if (second > 1) {
    const auto [u, v] = bezout(first, second);
    const double a = static_cast<double>(u) / first, b = static_cast<double>(v) / second;
    low = std::min({a, b, 1 - a, 1 - b});
    high = std::fabs(low - fold(a)) < 1e-12 ? fold(b) : fold(a);
  }
  const double at = angle * j / turn, f = at - std::floor(at);
  AllowableInterval interval{low * turn / j, high * turn / j, true};
  if (f > .5) interval = {(1 - high) * turn / j, (1 - low) * turn / j, true};
  interval.opposed = fold(f) >= low - 1e-12 && fold(f) <= high + 1e-12;
  return interval;
}

std::vector<ParastichyPair> visible_pairs(double angle, int jugacy, double narrowest) {
  const double f = fold(angle * jugacy / turn);
  long a = 0, b = 1, c = 1, d = 1;  // a / b <= f <= c / d
  std::vector<ParastichyPair> pairs;
  while (pairs.size() < 100 && std::max(b, d) < most) {
    pairs.push_back({static_cast<int>(std::min(b, d)) * jugacy, static_cast<int>(std::max(b, d)) * jugacy});
    if (turn / jugacy / static_cast<double>((b + d) * std::min(b, d)) < narrowest) break;
    const double between = static_cast<double>(a + c) / static_cast<double>(b + d);
    if (std::fabs(f - between) < 1e-12) break;
    if (f < between) {
      c += a;
      d += b;
    } else {
      a += c;
      b += d;
    }
  }
  return pairs;
}

}  // namespace tunica
