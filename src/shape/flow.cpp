// SPDX-License-Identifier: MIT
#include "shape/flow.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "shape/gauss.h"

namespace tunica {

namespace {

constexpr int parts_per_span = 8;
constexpr double share_of_margin = 1e-6;
constexpr int most_depth = 40;
constexpr size_t most_nodes = 1u << 17;

/// (exp(g t) - 1) / g, which is t where g is 0.
double expansion(double g, double t) { return g == 0 ? t : std::expm1(g * t) / g; }
/// Its inverse for t: log(1 + g x) / g.
double inverse_expansion(double g, double x) { return g == 0 ? x : std::log1p(g * x) / g; }

}  // namespace

double Flow::Law::after(double s, double t) const {
  if (l * t > 600) return HUGE_VAL;  // far beyond any margin
  const double left = 1 - c * s * expansion(l, t);
  return left > 0 ? s * std::exp(l * t) / left : HUGE_VAL;
}

double Flow::Law::time(double from, double to) const {
  return inverse_expansion(l, (to - from) / (from * (l + c * to)));
}

Flow::Flow(Curve rate) : rate_(std::move(rate)) {
  if (rate_.points().size() > 10000) fail("a curve of growth has at most 10000 points, not {}", rate_.points().size());
  if (rate_.is_constant()) return;
  last_ = std::max(0., rate_.last());
  if (last_ > 0) divide(grid());
}

double Flow::speed(double a) const {
  // Not as a difference of integrals from the start of the curve: near 0 only few digits of it would be left.
  if (rate_.is_constant() || a <= rate_.first()) return rate_.points().front().y() * a;
  return rate_.integral(0, a);
}

// === The table

std::vector<double> Flow::grid() const {
  std::vector<double> ends = {0}, places;
  for (const double x : rate_.breaks())
    if (x > ends.back()) ends.push_back(x);
  for (size_t i = 0; i + 1 < ends.size(); ++i)
    for (int k = 0; k < parts_per_span; ++k) places.push_back(ends[i] + (ends[i + 1] - ends[i]) * k / parts_per_span);
  places.push_back(last_);
  return places;
}

/// Splits the line at the places where v = 0.
void Flow::divide(const std::vector<double>& grid) {
  std::vector<double> v;
  for (const double a : grid) v.push_back(speed(a));
  for (const double value : v) fastest_ = std::max(fastest_, std::abs(value));
  const auto is_zero = [&](size_t i) { return std::abs(v[i]) <= 1e-14 * fastest_; };
  double from = 0;
  for (size_t i = 1; i < grid.size(); ++i) {
    if (is_zero(i)) {
      add_reach(from, grid[i], !(from == grid[i - 1] && is_zero(i - 1)), grid);
      from = grid[i];
    } else if (!is_zero(i - 1) && v[i] * v[i - 1] < 0) {
      double low = grid[i - 1], high = grid[i];
      for (double middle = (low + high) / 2; middle > low && middle < high; middle = (low + high) / 2)
        (speed(middle) * v[i] > 0 ? high : low) = middle;
      add_reach(from, high, true, grid);
      from = high;
    }
  }
  add_reach(from, HUGE_VAL, true, grid);
}

void Flow::add_reach(double low, double high, bool moves, const std::vector<double>& grid) {
  Reach reach{low, high, 0, 0, {}};
  const double to = std::min(high, last_);
  if (to > low && moves) {
    reach.margin = std::min(share_of_margin * last_, (to - low) / 8);
    const double from = low + reach.margin, end = high > last_ ? last_ : high - reach.margin;
    reach.sign = speed((from + end) / 2) < 0 ? -1 : 1;
    reach.nodes.push_back({from, 0});
    auto next = std::upper_bound(grid.begin(), grid.end(), from);
    for (double a = from; a < end;) {
      const double b = next == grid.end() ? end : std::min(end, *next++);
      if (b > a) add_nodes(reach, a, b, 0);
      a = b;
    }
  }
  if (high > last_ && to <= low) reach.sign = rate_.points().back().y() < 0 ? -1 : 1;
  reaches_.push_back(std::move(reach));
}

double Flow::time_between(double from, double to) const {
  return gauss<12>([&](double a) { return 1 / std::abs(speed(a)); }, from, to);
}

void Flow::add_nodes(Reach& reach, double from, double to, int depth) const {
  const double middle = (from + to) / 2, slowest = std::min({std::abs(speed(from)), std::abs(speed(to))});
  const double whole = time_between(from, to), parts = time_between(from, middle) + time_between(middle, to);
  // What rounding leaves of v decides how well halves and whole can agree.
  const double tolerance = 1e-13 + 1e-14 * fastest_ / slowest;
  if (depth < most_depth && std::abs(whole - parts) > tolerance * parts && reach.nodes.size() < most_nodes) {
    add_nodes(reach, from, middle, depth + 1);
    add_nodes(reach, middle, to, depth + 1);
    return;
  }
  if (std::isfinite(parts)) reach.nodes.push_back({to, reach.nodes.back().time + parts});
}

Flow::Law Flow::law(double zero, double side, double margin) const {
  const double l = rate_(zero), there = side * speed(zero + side * margin);
  if (l * there <= 0) return {0, there / (margin * margin)};  // as flat as rounding can tell
  return {l, (there - l * margin) / (margin * margin)};
}

// === Moving

double Flow::after(double a, double dt) const {
  if (!std::isfinite(a) || a < 0) fail("a place on the profile is its distance from the tip, 0 or more, not {}", a);
  if (!std::isfinite(dt)) fail("the time of growth must be finite, not {}", dt);
  if (a == 0 || dt == 0) return a;
  double place;
  if (last_ == 0) {
    place = a * std::exp(rate_(0) * dt);
  } else {
    const auto reach =
        std::upper_bound(reaches_.begin(), reaches_.end() - 1, a, [](double x, const Reach& r) { return x < r.high; });
    place = a == reach->low ? a : move(*reach, a, dt);
  }
  if (!std::isfinite(place)) fail("growth for the time {:.6g} takes the place {:.6g} beyond all numbers", dt, a);
  return place;
}

double Flow::move(const Reach& reach, double a, double dt) const {
  if (reach.sign == 0) return a;
  if (a > last_ || reach.nodes.empty()) return move_in_tail(reach, a, dt);
  if (a < reach.low + reach.margin) return move_near(reach, reach.low, 1, a, dt);
  if (a > reach.high - reach.margin) return move_near(reach, reach.high, -1, a, dt);
  return move_by_table(reach, a, dt);
}

/// Where the rate is constant to infinity.
double Flow::move_in_tail(const Reach& reach, double a, double dt) const {
  const double g = rate_.points().back().y(), s = a - last_, end = speed(last_);
  const double there = s + speed(a) * expansion(g, dt);
  if (there >= 0 || reach.nodes.empty()) return last_ + std::max(0., there);
  const double to_last = -inverse_expansion(g, s / end);
  return move_by_table(reach, last_, dt - to_last);
}

/// Next to a place where v = 0; `side` is 1 above it.
double Flow::move_near(const Reach& reach, double zero, double side, double a, double dt) const {
  const Law near = law(zero, side, reach.margin);
  const double s = side * (a - zero), there = near.after(s, dt);
  if (there <= reach.margin) return zero + side * there;
  const double edge = zero + side * reach.margin;
  return move_by_table(reach, edge, dt - near.time(s, reach.margin));
}

double Flow::time(double a) const {
  const auto& nodes = reaches_[0].nodes;
  const auto after =
      std::upper_bound(nodes.begin() + 1, nodes.end() - 1, a, [](double x, const Node& n) { return x < n.a; });
  return (after - 1)->time + time_between((after - 1)->a, a);
}

double Flow::move_by_table(const Reach& reach, double a, double dt) const {
  const auto& nodes = reach.nodes;
  const auto after =
      std::upper_bound(nodes.begin() + 1, nodes.end() - 1, a, [](double x, const Node& n) { return x < n.a; });
  const Node& from = *(after - 1);
  const double time = from.time + time_between(from.a, a) + reach.sign * dt;
  if (time < 0) {
    const double s = law(reach.low, 1, reach.margin).after(reach.margin, reach.sign * time);
    return reach.low + std::min(s, reach.margin);
  }
  const double left = reach.sign * (time - nodes.back().time);
  if (time <= nodes.back().time) return place_at(reach, time);
  if (std::isinf(reach.high)) return last_ + speed(last_) * expansion(rate_.points().back().y(), left);
  const double s = law(reach.high, -1, reach.margin).after(reach.margin, left);
  return reach.high - std::min(s, reach.margin);
}

/// The place that is this time away from the first node: Newton's method, kept within a shrinking bracket.
double Flow::place_at(const Reach& reach, double time) const {
  const auto& nodes = reach.nodes;
  const auto after =
      std::upper_bound(nodes.begin() + 1, nodes.end() - 1, time, [](double x, const Node& n) { return x < n.time; });
  const Node &from = *(after - 1), &to = *after;
  double low = from.a, high = to.a;
  // Hermite's cubic of the place by time, with the speeds at both ends, is a good start.
  const double span = to.time - from.time, x = std::clamp((time - from.time) / span, 0., 1.);
  const double v0 = std::abs(speed(low)) * span, v1 = std::abs(speed(high)) * span, rise = high - low;
  double a = low + x * (v0 + x * (3 * rise - 2 * v0 - v1 + x * (v0 + v1 - 2 * rise)));
  if (!(a >= low && a <= high)) a = low + x * rise;
  for (int i = 0; i < 60; ++i) {
    const double error = from.time + time_between(from.a, a) - time;
    (error < 0 ? low : high) = a;
    double next = a - error * std::abs(speed(a));
    const bool close = std::abs(next - a) < 1e-9 * a;  // the next step squares that
    if (!(next >= low && next <= high))
      next = (low + high) / 2;
    else if (close)
      return next;
    if (next == a || !(high > low)) break;
    a = next;
  }
  return a;
}

}  // namespace tunica
