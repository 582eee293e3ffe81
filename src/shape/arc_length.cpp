// SPDX-License-Identifier: MIT
#include "shape/arc_length.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "shape/gauss.h"
#include "shape/zero_between.h"

namespace tunica {

namespace {

constexpr int samples_per_panel = 16;
constexpr int most_depth = 30;  ///< of halving a panel
constexpr size_t most_panels = 1u << 16;

}  // namespace

ArcLength::ArcLength(BSpline curve) : curve_(std::move(curve)), size_(curve_->size()) { measure(curve_->breaks()); }

ArcLength::ArcLength(const Cap& cap, double length) : cap_(cap), size_(length) {
  measure({0, cap.radius * cap.slope, length});
}

// === Along the parameter

void ArcLength::evaluate(double u, Vec2& point, Vec2& derivative) const {
  if (curve_) return curve_->evaluate(u, point, derivative);
  const double angle = std::min(u / cap_.radius, cap_.slope), rest = std::max(0., u - cap_.radius * cap_.slope);
  derivative = {std::cos(angle), -std::sin(angle)};
  // 1 - cos without its loss of digits at the tip.
  const double half = std::sin(angle / 2);
  point = cap_.radius * Vec2(std::sin(angle), -2 * half * half) + rest * derivative;
}

Vec2 ArcLength::point_at(double u) const {
  Vec2 point, derivative;
  evaluate(u, point, derivative);
  return point;
}

Vec2 ArcLength::direction(double u) const {
  if (curve_) return curve_->direction(u);
  Vec2 point, derivative;
  evaluate(u, point, derivative);
  return derivative;
}

double ArcLength::speed(double u) const {
  Vec2 point, derivative;
  evaluate(u, point, derivative);
  return derivative.norm();
}

double ArcLength::length_between(double from, double to) const {
  return gauss<12>([&](double u) { return speed(u); }, from, to);
}

// === Making

void ArcLength::measure(const std::vector<double>& breaks) {
  panels_.push_back({breaks.front(), 0});
  for (size_t i = 0; i + 1 < breaks.size(); ++i) add_panels(breaks[i], breaks[i + 1], 0);
  while (panels_.size() > 1 && panels_.back().a == panels_[panels_.size() - 2].a) panels_.pop_back();
  if (!(length() > 1e-12 * size_)) fail("the curve has no length");
  take_samples();
}

void ArcLength::add_panels(double from, double to, int depth) {
  const double middle = (from + to) / 2;
  const double whole = length_between(from, to), left = length_between(from, middle),
               right = length_between(middle, to);
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
      panels_.push_back({to, panels_.back().a});
    return;
  }
  panels_.push_back({to, panels_.back().a + left + right});
}

void ArcLength::take_samples() {
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
}

// === Between arc length and parameter

size_t ArcLength::panel_at(double a) const {
  const auto after =
      std::upper_bound(panels_.begin(), panels_.end() - 1, a, [](double x, const Panel& p) { return x < p.a; });
  return static_cast<size_t>(std::max<long>(after - panels_.begin(), 1) - 1);
}

/// The parameter at arc length a, 0 <= a <= length: Newton's method, kept within a shrinking bracket.
double ArcLength::parameter(double a) const {
  const size_t i = panel_at(a);
  const Panel &from = panels_[i], &to = panels_[i + 1];
  double low = from.u, high = to.u, u = low + (high - low) * (a - from.a) / (to.a - from.a);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double error = from.a + length_between(from.u, u) - a;
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

double ArcLength::arc(double u) const {
  const auto after =
      std::upper_bound(panels_.begin(), panels_.end() - 1, u, [](double x, const Panel& p) { return x < p.u; });
  const auto& from = panels_[static_cast<size_t>(std::max<long>(after - panels_.begin(), 1) - 1)];
  return from.a + length_between(from.u, u);
}

/// Where between two parameters the distance to p turns from falling to rising, if it does.
std::optional<double> ArcLength::nearest_between(const Vec2& p, double low, double high) const {
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

ArcLength::Nearest ArcLength::nearest(const Vec2& p) const {
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
  if (best == samples_.back().u) return {length(), least};
  return {best == samples_[0].u ? 0 : arc(best), least};
}

double ArcLength::area() const {
  const Vec2 start = point_at(begin()), finish = point_at(end());
  const auto share = [&](double u) {
    Vec2 point, derivative;
    evaluate(u, point, derivative);
    return (point.x() - start.x()) * derivative.y();
  };
  double sum = (finish.x() - start.x()) / 2 * (start.y() - finish.y());
  for (size_t i = 0; i + 1 < panels_.size(); ++i) sum += gauss<24>(share, panels_[i].u, panels_[i + 1].u);
  return sum;
}

}  // namespace tunica
