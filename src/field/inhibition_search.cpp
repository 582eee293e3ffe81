// SPDX-License-Identifier: MIT
// When the next primordium is inserted, and which old ones no longer count.
#include <algorithm>
#include <cmath>

#include "field/inhibition.h"

namespace tunica {

namespace {

/// The last intervals between insertions, those at one time not counted.
std::vector<double> last_intervals(const std::vector<Primordium>& primordia) {
  constexpr size_t most = 10;
  std::vector<double> intervals;
  for (size_t i = primordia.size(); i-- > 1 && intervals.size() < most;)
    if (primordia[i - 1].birth < primordia[i].birth) intervals.push_back(primordia[i].birth - primordia[i - 1].birth);
  return intervals;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// The middle one, if there are pauses among them; those within whorls are far shorter than those between them.
double usual(std::vector<double> intervals) {
  if (intervals.size() < 3) return 0;
  const double all = mean(intervals);
  std::nth_element(intervals.begin(), intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2),
                   intervals.end());
  return std::min(all, std::max(intervals[intervals.size() / 2], all / 10));
}

}  // namespace

double Inhibition::plastochron() const { return mean(last_intervals(primordia_)); }

/// At most half a plastochron. Where nothing varies but ages, the time since the last insertion is the least that the
/// present plastochron can be.
double Inhibition::next_step() const {
  if (!settings_.located) return settings_.longest_step;
  const bool varies = std::any_of(fields_.begin(), fields_.end(), [](const InhibitionField& f) { return f.varies; });
  const double least = varies ? usual(last_intervals(primordia_)) : plastochron();
  const double since = primordia_.empty() || varies ? 0 : std::max(0.0, from_ - primordia_.back().birth);
  double step = least > 0 ? 0.5 * std::max(least, since) : std::max(time_scale_, 0.5 * since);
  if (settings_.longest_step > 0) step = std::min(step, settings_.longest_step);
  return step;
}

Inhibition::Ahead Inhibition::look_ahead() {
  const double now = excess(from_);
  if (now < 0) return {from_, true};
  const double end = from_ + next_step();
  if (!(end > from_)) fail("insertions follow each other too fast at t = {:.6g}: the threshold is too high", from_);
  const double then = excess(end);
  if (!(then < 0)) return {end, false};
  return {settings_.located ? locate(from_, now, end, then) : end, true};
}

/// The first time with a candidate, to the tolerance: regula falsi (Illinois), with a bisection where it has not halved
/// the interval in three evaluations. g(low) >= 0 > g(high) throughout; returns high.
double Inhibition::locate(double low, double g_low, double high, double g_high) {
  const double plastochron_now = plastochron();
  const double near =
      std::max(settings_.tolerance * (plastochron_now > 0 ? plastochron_now : time_scale_), 4e-16 * std::fabs(high));
  double width = high - low;
  int count = 0, side = 0;
  double w_low = g_low, w_high = g_high;
  while (high - low > near) {
    double t = high - w_high * (high - low) / (w_high - w_low);
    if (++count % 3 == 0) {
      if (high - low > 0.5 * width) t = low + (high - low) / 2;
      width = high - low;
    }
    if (!(t > low + near / 2)) t = low + near / 2;  // so that the interval closes from both sides
    if (!(t < high - near / 2)) t = high - near / 2;
    if (t <= low || t >= high) break;
    const double g = excess(t);
    if (g < 0) {
      high = t, w_high = g;
      if (side == -1) w_low /= 2;
      side = -1;
    } else {
      low = t, w_low = g;
      if (side == 1) w_high /= 2;
      side = 1;
    }
  }
  return high;
}

double Inhibition::known_until() {
  if (fields_.empty()) fail("there is no inhibition");
  if (recount_) leave_out_old(from_);
  recount_ = false;
  if (!ahead_) ahead_ = look_ahead();
  return ahead_->end;
}

void Inhibition::show(double t) {
  if (!(t >= from_ && t <= known_until())) fail("internal: t = {} is not shown from {} to {}", t, from_, known_until());
  time_ = t;
}

Inhibition::Status Inhibition::advance(double to) {
  try {
    known_until();
    if (ahead_->insertion ? ahead_->end > to : ahead_->end >= to) {
      time_ = std::max(time_, to);
      return Status::reached;
    }
    evaluate(ahead_->end);
  } catch (const Cancelled&) {
    return Status::interrupted;
  }
  const Ahead found = *ahead_;
  if (found.insertion) insert(found.end);
  if (found.end > from_) ++steps_;
  time_ = from_ = found.end;
  ahead_.reset();
  return found.insertion ? Status::inserted : Status::clear;
}

void Inhibition::changed() {
  from_ = time_;
  first_active_ = 0;
  ahead_.reset();
  evaluated_.reset();
  recount_ = true;
}

void Inhibition::reconsider() {
  from_ = time_;
  ahead_.reset();
  evaluated_.reset();
}

// === Old primordia

/// A bound on |f| on the ring for a primordium of this age and older: the largest over distances that occur, sampled.
double Inhibition::largest_share(size_t k, double age, double t) {
  constexpr double latest = 30, ratio = 1.03;  // ages
  constexpr int steps = 4;
  double most = 0;
  for (double factor = 1; factor < latest; factor *= ratio) {
    const Vec2 p = track(factor * age);
    const double x = p.x(), y = p.y() - settings_.ring.y();
    const double nearest = std::hypot(x - settings_.ring.x(), y), farthest = std::hypot(x + settings_.ring.x(), y);
    for (int i = 0; i <= steps; ++i) {
      const double d = std::max(nearest + (farthest - nearest) * i / steps, 1e-7 * settings_.ring.x());
      const double share = std::fabs(fields_[k].rule->at(d, factor * age, t));
      most = std::isnan(share) ? INFINITY : std::max(most, share);
    }
  }
  return most;
}

/// Moves first_active_ on while the shares of all that are left out, now and later, stay below the tolerance in every
/// field.
void Inhibition::leave_out_old(double t) {
  const size_t most = static_cast<size_t>(settings_.most_active);
  std::vector<double> room;
  for (size_t k = 0; k < fields_.size(); ++k)  // what changes with time may come back
    room.push_back(fields_[k].rule_varies ? 0 : settings_.drop * std::fabs(threshold(k, t)));
  // Those left out before have decayed since: count them again, from the youngest, until they no longer matter.
  const auto take = [&](size_t i, std::vector<double>& left) {
    double largest = 0;
    for (size_t k = 0; k < left.size(); ++k) {
      const double share = largest_share(k, t - primordia_[i].birth, t);
      left[k] -= share;
      largest = std::max(largest, room[k] > 0 ? share / room[k] : INFINITY);
    }
    return largest;
  };
  std::vector<double> left = room;
  for (size_t i = first_active_; i-- > 0;)
    if (take(i, left) < 1e-6) break;
  while (first_active_ + 1 < primordia_.size()) {
    take(first_active_, left);
    if (!std::all_of(left.begin(), left.end(), [](double x) { return x > 0; })) break;
    ++first_active_;
  }
  if (primordia_.size() - first_active_ > most) {
    first_active_ = primordia_.size() - most;
    overflowed_ = true;
  }
}

}  // namespace tunica
