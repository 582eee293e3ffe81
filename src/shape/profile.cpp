// SPDX-License-Identifier: MIT
#include "shape/profile.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "shape/gauss.h"
#include "shape/zero_between.h"

namespace tunica {

namespace {

BSpline of_profile(BSpline curve) {
  if (curve.points().size() > 10000) fail("a profile has at most 10000 points, not {}", curve.points().size());
  return curve;
}

}  // namespace

Profile::Profile(BSpline curve) : Profile(ArcLength(of_profile(std::move(curve)))) {}

Profile::Profile(ArcLength arc) : arc_(std::move(arc)) {
  start_ = arc_.point_at(arc_.begin());
  if (std::abs(start_.x()) < 1e-12 * arc_.size()) start_.x() = 0;
  end_ = arc_.point_at(arc_.curve() ? arc_.curve()->end() : arc_.end());
  for (const auto& s : arc_.samples()) widest_ = std::max(widest_, s.point.x());
  check();
  measure_area();
  onward_ = arc_.direction(arc_.end());
  if (onward_.x() < 0) onward_ = {0, -1};
}

Profile Profile::cap(double radius, double slope, double length) {
  if (!std::isfinite(radius) || !(radius > 0)) fail("the radius of a cap must be positive, not {}", radius);
  if (!(slope > 0 && slope <= M_PI / 2))
    fail("the slope at which a cap ends must be above 0 and at most 90 degrees, not {:.6g}", slope * 180 / M_PI);
  if (!std::isfinite(length) || !(length > radius * slope))
    fail("a profile that starts with a cap of arc length {:.6g} must be longer than that, not {:.6g}", radius * slope,
         length);
  return Profile(ArcLength(ArcLength::Cap{radius, slope}, length));
}

double Profile::ring(double u) const {
  Vec2 point, derivative;
  arc_.evaluate(u, point, derivative);
  return 2 * M_PI * point.x() * derivative.norm();
}

double Profile::area_between(double from, double to) const {
  return gauss<12>([&](double u) { return ring(u); }, from, to);
}

void Profile::measure_area() {
  const auto& panels = arc_.panels();
  areas_.push_back(0);
  for (size_t i = 0; i + 1 < panels.size(); ++i) {
    const double from = panels[i].u, to = panels[i + 1].u, middle = (from + to) / 2;
    const bool stands = panels[i + 1].a == panels[i].a;
    areas_.push_back(stands ? areas_.back() : areas_.back() + area_between(from, middle) + area_between(middle, to));
  }
}

void Profile::check() const {
  const double rounding = 1e-12 * arc_.size();
  const auto& samples = arc_.samples();
  double lowest = start_.y(), heading = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    const Vec2& p = samples[i].point;
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
    if (i == 0 || std::abs(p.x() - samples[i - 1].point.x()) < rounding) continue;
    const double step = p.x() - samples[i - 1].point.x();
    const bool level = std::abs(p.y() - samples[i - 1].point.y()) < 1e-13 * arc_.size();
    if (level && heading * step < 0) fail("the profile turns back on itself at ({:.6g}, {:.6g})", p.x(), p.y());
    heading = level ? step : 0;
  }
  if (!(widest_ > rounding)) fail("the profile stays on the axis: it needs a place with x > 0");
}

Vec2 Profile::at(double a) const {
  if (!(a > 0)) return start_;
  if (a >= length()) return end_ + (a - length()) * onward_;
  return arc_.at(a);
}

Vec2 Profile::tangent(double a) const {
  if (a >= length()) return onward_;
  return arc_.direction(a > 0 ? arc_.parameter(a) : arc_.begin());
}

std::vector<double> Profile::breaks() const {
  std::vector<double> result;
  for (const auto& panel : arc_.panels())
    if (result.empty() || panel.a > result.back()) result.push_back(panel.a);
  return result;
}

double Profile::area(double a) const {
  if (!(a > 0)) return 0;
  if (a >= length()) {
    const double on = a - length();
    return areas_.back() + 2 * M_PI * on * (end_.x() + on * onward_.x() / 2);
  }
  const size_t i = arc_.panel_at(a);
  return areas_[i] + area_between(arc_.panels()[i].u, arc_.parameter(a));
}

double Profile::arc_at_radius(double r) const {
  if (r < start_.x()) fail("there is no ring of radius {:.6g}: the profile starts at radius {:.6g}", r, hole());
  if (!(r <= widest_ * (1 + 1e-12)))
    fail("there is no ring of radius {:.6g}: the profile reaches {:.6g} at most", r, widest_);
  if (r == start_.x()) return 0;
  const double reached = std::min(r, widest_);
  const auto& samples = arc_.samples();
  size_t i = 1;
  while (i + 1 < samples.size() && samples[i].point.x() < reached) ++i;
  const auto short_of = [&](double u) { return arc_.point_at(u).x() - reached; };
  return arc_.arc(zero_between(short_of, samples[i - 1].u, samples[i].u));
}

double Profile::closest(const Vec2& p) const {
  const auto [a, distance] = arc_.nearest(p);
  const double on = std::max(0., (p - end_).dot(onward_));
  if (on > 0 && ((end_ + on * onward_ - p).norm() < distance || a == length())) return length() + on;
  return a;
}

}  // namespace tunica
