// SPDX-License-Identifier: MIT
#include "shape/profile.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "shape/gauss.h"

namespace tunica {

namespace {

constexpr int samples_per_panel = 16;
constexpr int most_depth = 30;  ///< of halving a panel
constexpr size_t most_panels = 1u << 16;

/// The zero between low and high of a function that is negative at low and not at high (Illinois, with bisection).
template <class F>
double zero_between(const F& f, double low, double high) {
  double f_low = f(low), f_high = f(high);
  if (!(f_low < 0)) return low;
  if (!(f_high >= 0)) return high;
  int side = 0;
  for (int i = 0; i < 200; ++i) {
    double middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    if (i % 3 != 2) {
      const double chord = (low * f_high - high * f_low) / (f_high - f_low);
      if (chord > low && chord < high) middle = chord;
    }
    const double value = f(middle);
    if (value == 0) return middle;
    if (value < 0) {
      low = middle, f_low = value;
      if (side == -1) f_high /= 2;
      side = -1;
    } else {
      high = middle, f_high = value;
      if (side == 1) f_low /= 2;
      side = 1;
    }
    if (high - low <= 4e-16 * (std::abs(low) + std::abs(high))) break;
  }
  return std::abs(f_low) < std::abs(f_high) ? low : high;
}

}  // namespace

Profile::Profile(BSpline curve) : curve_(std::move(curve)) {
  if (curve_->points().size() > 10000) fail("a profile has at most 10000 points, not {}", curve_->points().size());
  size_ = curve_->size();
  measure(curve_->breaks());
}

Profile::Profile(const Cap& cap, double length) : cap_(cap), size_(length) {
  measure({0, cap.radius * cap.slope, length});
}

Profile Profile::cap(double radius, double slope, double length) {
  if (!std::isfinite(radius) || !(radius > 0)) fail("the radius of a cap must be positive, not {}", radius);
  if (!(slope > 0 && slope <= M_PI / 2))
    fail("the slope at which a cap ends must be above 0 and at most 90 degrees, not {:.6g}", slope * 180 / M_PI);
  if (!std::isfinite(length) || !(length > radius * slope))
    fail("a profile that starts with a cap of arc length {:.6g} must be longer than that, not {:.6g}", radius * slope,
         length);
  return Profile(Cap{radius, slope}, length);
}

// === Along the parameter

void Profile::evaluate(double u, Vec2& point, Vec2& derivative) const {
  if (curve_) return curve_->evaluate(u, point, derivative);
  const double angle = std::min(u / cap_.radius, cap_.slope), rest = std::max(0., u - cap_.radius * cap_.slope);
  derivative = {std::cos(angle), -std::sin(angle)};
  // 1 - cos without its loss of digits at the tip.
  const double half = std::sin(angle / 2);
  point = cap_.radius * Vec2(std::sin(angle), -2 * half * half) + rest * derivative;
}

Vec2 Profile::point_at(double u) const {
  Vec2 point, derivative;
  evaluate(u, point, derivative);
  return point;
}

Vec2 Profile::direction(double u) const {
  if (curve_) return curve_->direction(u);
  Vec2 point, derivative;
  evaluate(u, point, derivative);
  return derivative;
}

double Profile::speed(double u) const {
  Vec2 point, derivative;
  evaluate(u, point, derivative);
  return derivative.norm();
}

double Profile::ring(double u) const {
  Vec2 point, derivative;
  evaluate(u, point, derivative);
  return 2 * M_PI * point.x() * derivative.norm();
}

// === Making

void Profile::measure(const std::vector<double>& breaks) {
  Vec2 derivative;
  evaluate(breaks.front(), start_, derivative);
  evaluate(breaks.back(), end_, derivative);
  if (std::abs(start_.x()) < 1e-12 * size_) start_.x() = 0;
  panels_.push_back({breaks.front(), 0, 0});
  for (size_t i = 0; i + 1 < breaks.size(); ++i) add_panels(breaks[i], breaks[i + 1], 0);
  while (panels_.size() > 1 && panels_.back().a == panels_[panels_.size() - 2].a) panels_.pop_back();
  if (!(length() > 1e-12 * size_)) fail("the profile has no length");
  take_samples();
  check();
  onward_ = direction(panels_.back().u);
  if (onward_.x() < 0) onward_ = {0, -1};
}

void Profile::add_panels(double from, double to, int depth) {
  const double middle = (from + to) / 2;
  const auto length_of = [&](double a, double b) { return gauss<12>([&](double u) { return speed(u); }, a, b); };
  const auto area_of = [&](double a, double b) { return gauss<12>([&](double u) { return ring(u); }, a, b); };
  const double whole = length_of(from, to), left = length_of(from, middle), right = length_of(middle, to);
  if (depth < most_depth && std::abs(whole - left - right) > 1e-14 * (size_ + std::abs(whole)) &&
      panels_.size() < most_panels) {
    add_panels(from, middle, depth + 1);
    add_panels(middle, to, depth + 1);
    return;
  }
  if (!(left + right > 1e-15 * size_)) {  // all its control points are in one place
    if (panels_.size() == 1)
      panels_[0].u = to;
    else
      panels_.push_back({to, panels_.back().a, panels_.back().area});
    return;
  }
  const Panel& last = panels_.back();
  panels_.push_back({to, last.a + left + right, last.area + area_of(from, middle) + area_of(middle, to)});
}

/// Evenly in each panel, and the places where x is largest or least.
void Profile::take_samples() {
  Vec2 point, derivative, before = Vec2::Zero();
  const auto add = [&](double u) {
    evaluate(u, point, derivative);
    if (!samples_.empty() && before.x() * derivative.x() < 0) {
      const double sign = before.x() < 0 ? 1 : -1;
      const auto slope = [&](double v) {
        Vec2 p, d;
        evaluate(v, p, d);
        return sign * d.x();
      };
      const double turn = zero_between(slope, samples_.back().u, u);
      Vec2 there, along;
      evaluate(turn, there, along);
      if (turn > samples_.back().u && turn < u) samples_.push_back({turn, 0, there});
    }
    samples_.push_back({u, 0, point});
    before = derivative;
  };
  for (size_t i = 0; i + 1 < panels_.size(); ++i) {
    const double from = panels_[i].u, width = panels_[i + 1].u - from;
    if (panels_[i + 1].a == panels_[i].a) continue;  // stands still
    for (int k = 0; k < samples_per_panel; ++k) add(from + width * k / samples_per_panel);
  }
  add(panels_.back().u);
  for (Sample& s : samples_) s.a = arc(s.u);
  for (const Sample& s : samples_) widest_ = std::max(widest_, s.point.x());
}

void Profile::check() const {
  const double rounding = 1e-12 * size_;
  double lowest = start_.y(), heading = 0;
  for (size_t i = 0; i < samples_.size(); ++i) {
    const Vec2& p = samples_[i].point;
    if (p.x() < -rounding)
      fail("the profile crosses the axis: x = {:.6g} at y = {:.6g}; x must be 0 or more", p.x(), p.y());
    if (p.y() > lowest + rounding) {
      if (end_.y() > start_.y())
        fail(
            "the profile must start at the tip, which is its top; this one rises from y = {:.6g} to {:.6g}: give its "
            "points the other way round",
            start_.y(), end_.y());
      fail("the profile rises at ({:.6g}, {:.6g}); from the tip on, y may only fall or stay", p.x(), p.y());
    }
    lowest = std::min(lowest, p.y());
    // A curve that never rises can only meet itself where it is level.
    if (i == 0 || std::abs(p.x() - samples_[i - 1].point.x()) < rounding) continue;
    const double step = p.x() - samples_[i - 1].point.x();
    const bool level = std::abs(p.y() - samples_[i - 1].point.y()) < 1e-13 * size_;
    if (level && heading * step < 0) fail("the profile turns back on itself at ({:.6g}, {:.6g})", p.x(), p.y());
    heading = level ? step : 0;
  }
  if (!(widest_ > rounding)) fail("the profile stays on the axis: it needs a place with x > 0");
}

// === Between arc length and parameter

size_t Profile::panel_at_arc(double a) const {
  const auto after =
      std::upper_bound(panels_.begin(), panels_.end() - 1, a, [](double x, const Panel& p) { return x < p.a; });
  return static_cast<size_t>(std::max<long>(after - panels_.begin(), 1) - 1);
}

/// The parameter at arc length a, 0 <= a <= length: Newton's method, kept within a shrinking bracket.
double Profile::parameter(double a) const {
  const size_t i = panel_at_arc(a);
  const Panel &from = panels_[i], &to = panels_[i + 1];
  double low = from.u, high = to.u, u = low + (high - low) * (a - from.a) / (to.a - from.a);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double error = from.a + gauss<12>([&](double v) { return speed(v); }, from.u, u) - a;
    if (std::abs(error) < 1e-15 * size_) return u;
    (error < 0 ? low : high) = u;
    const double v = speed(u);
    double next = v > 0 ? u - error / v : low - 1;
    if (!(next > low && next < high)) next = (low + high) / 2;
    // Where the curve comes to rest at an end of the panel its speed changes by as much again within the distance from
    // there; a step that is so much shorter leaves an error of rounding.
    if (std::abs(next - u) <= 1e-8 * std::min(next - from.u, to.u - next)) return next;
    if (std::abs(next - u) <= 1e-16 * (std::abs(u) + to.u - from.u)) return next;
    u = next;
  }
  return u;
}

double Profile::arc(double u) const {
  const auto after =
      std::upper_bound(panels_.begin(), panels_.end() - 1, u, [](double x, const Panel& p) { return x < p.u; });
  const auto& from = panels_[static_cast<size_t>(std::max<long>(after - panels_.begin(), 1) - 1)];
  return from.a + gauss<12>([&](double v) { return speed(v); }, from.u, u);
}

Vec2 Profile::at(double a) const {
  if (!(a > 0)) return start_;
  if (a >= length()) return end_ + (a - length()) * onward_;
  return point_at(parameter(a));
}

Vec2 Profile::tangent(double a) const {
  if (a >= length()) return onward_;
  return direction(a > 0 ? parameter(a) : panels_.front().u);
}

double Profile::area(double a) const {
  if (!(a > 0)) return 0;
  if (a >= length()) {
    const double on = a - length();
    return panels_.back().area + 2 * M_PI * on * (end_.x() + on * onward_.x() / 2);
  }
  const Panel& from = panels_[panel_at_arc(a)];
  return from.area + gauss<12>([&](double v) { return ring(v); }, from.u, parameter(a));
}

double Profile::arc_at_radius(double r) const {
  if (r < start_.x()) fail("there is no ring of radius {:.6g}: the profile starts at radius {:.6g}", r, hole());
  if (!(r <= widest_ * (1 + 1e-12)))
    fail("there is no ring of radius {:.6g}: the profile reaches {:.6g} at most", r, widest_);
  if (r == start_.x()) return 0;
  const double reached = std::min(r, widest_);
  size_t i = 1;
  while (i + 1 < samples_.size() && samples_[i].point.x() < reached) ++i;
  const auto short_of = [&](double u) { return point_at(u).x() - reached; };
  return arc(zero_between(short_of, samples_[i - 1].u, samples_[i].u));
}

/// Where between two parameters the distance to p turns from falling to rising, if it does.
std::optional<double> Profile::nearest_between(const Vec2& p, double low, double high) const {
  const auto receding = [&](double u) {
    Vec2 point, derivative;
    evaluate(u, point, derivative);
    // At repeated control points the derivative vanishes, and would hide on which side the nearest point is.
    if (derivative.norm() < 1e-6 * size_) derivative = 1e-6 * size_ * direction(u);
    return (point - p).dot(derivative);
  };
  if (!(receding(low) < 0 && receding(high) >= 0)) return std::nullopt;
  return zero_between(receding, low, high);
}

double Profile::closest(const Vec2& p) const {
  std::vector<double> distances;
  distances.reserve(samples_.size());
  for (const Sample& s : samples_) distances.push_back((s.point - p).norm());
  const auto nearest = std::min_element(distances.begin(), distances.end());
  double best = samples_[static_cast<size_t>(nearest - distances.begin())].u, least = *nearest;
  bool inside = false;  // a sample gives way to a place between samples at the same distance, which is the exact one
  for (size_t i = 0; i + 1 < samples_.size(); ++i) {
    // Along an arc the distance changes by its length at most.
    if ((distances[i] + distances[i + 1] - (samples_[i + 1].a - samples_[i].a)) / 2 > least) continue;
    const double from = samples_[i].u, to = samples_[i + 1].u;
    const auto u = nearest_between(p, from, to - 1e-13 * (to - from));  // short of what may be a corner
    if (!u) continue;
    const double distance = (point_at(*u) - p).norm();
    if (distance < least || (!inside && distance <= least)) least = distance, best = *u, inside = true;
  }
  const double on = std::max(0., (p - end_).dot(onward_));
  if (on > 0 && ((end_ + on * onward_ - p).norm() < least || best == samples_.back().u)) return length() + on;
  return best == samples_[0].u ? 0 : arc(best);
}

}  // namespace tunica
