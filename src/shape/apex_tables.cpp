// SPDX-License-Identifier: MIT
#include "shape/apex_tables.h"

#include <cmath>
#include <numbers>

#include "shape/gauss.h"

namespace tunica {

namespace {

constexpr double least_rise = .05;       ///< of x - y along the profile, for which the first guess is good enough
constexpr double on_profile = 1e-9;      ///< nearer than this, relative to its length, a point is on the profile
constexpr double nearest_to_tip = 2e-3;  ///< relative to where the rate gets constant: the clock starts there
constexpr size_t buckets_per_step = 4;
constexpr double share_of_slow_start =
    1e-2;  ///< of the way to a constant rate: nearer to the tip, time by place is too steep
constexpr double movement_tolerance = 1e-10;  ///< relative to the length of the profile

/// For even steps of a quantity that grows: in which of the given intervals each falls.
std::vector<size_t> buckets(const std::vector<double>& grows) {
  const size_t count = buckets_per_step * grows.size();
  std::vector<size_t> result(count + 1);
  size_t step = 0;
  for (size_t i = 0; i <= count; ++i) {
    const double value =
        grows.front() + (grows.back() - grows.front()) * static_cast<double>(i) / static_cast<double>(count);
    while (step + 2 < grows.size() && grows[step + 1] <= value) ++step;
    result[i] = step;
  }
  return result;
}

/// The interval in which a value falls, from the first to the last.
size_t interval(const std::vector<double>& grows, const std::vector<size_t>& by_value, double value) {
  const double share = (value - grows.front()) / (grows.back() - grows.front());
  const auto bucket = static_cast<size_t>(std::clamp(share, 0., 1.) * static_cast<double>(by_value.size() - 1));
  size_t step = by_value[bucket];
  while (step > 0 && grows[step] > value) --step;  // rounding may have put it into the next bucket
  while (step + 2 < grows.size() && grows[step + 1] <= value) ++step;
  return step;
}

}  // namespace

const ApexTables& ApexTables::ready(const Profile& profile, const Flow& flow) {
  std::call_once(once_, [&] {
    tabulate(profile);
    tabulate(flow);
    tabulate_movement(profile, flow);
  });
  return *this;
}

// === The profile

void ApexTables::tabulate(const Profile& profile) {
  size_ = profile.length();
  std::vector<double> breaks = profile.breaks();
  breaks.push_back(2 * size_);  // it goes on straight
  const auto place = [&](double a, Table<2>::Values& value, Table<2>::Values& slope) {
    const Vec2 p = profile.at(a), t = profile.tangent(a);
    value = {p.x(), p.y()}, slope = {t.x(), t.y()};
  };
  const Table<2> track(breaks, place, 1e-13 * size_);
  if (!track) return;
  rise_ = HUGE_VAL;
  Vec2 before = profile.tangent(0);
  for (size_t i = 0; i < track.steps(); ++i) {
    const double h = 1 / track.find(track.start(i)).per_x;
    level_.push_back(track.value({i, 0, 1}, 0) - track.value({i, 0, 1}, 1));
    for (const double s : {0., .5, 1.}) {
      const Table<2>::Place at{i, s, 1 / h};
      rise_ = std::min(rise_, track.slope(at, 0) - track.slope(at, 1));
      sharpest_ = std::max(sharpest_, std::hypot(track.bend(at, 0), track.bend(at, 1)));
    }
    const Vec2 now(track.slope({i, 0, 1 / h}, 0), track.slope({i, 0, 1 / h}, 1));
    if ((now - before).norm() > 1e-6) sharpest_ = HUGE_VAL;  // a corner
    before = {track.slope({i, 1, 1 / h}, 0), track.slope({i, 1, 1 / h}, 1)};
  }
  level_.push_back(track.value({track.steps() - 1, 1, 1}, 0) - track.value({track.steps() - 1, 1, 1}, 1));
  if (!(rise_ > least_rise)) return;
  by_level_ = buckets(level_);
  track_ = track;
}

std::optional<Vec2> ApexTables::at(double a) const {
  if (!track_ || !(a <= track_.last())) return std::nullopt;
  const auto p = track_.find(a);
  return Vec2(track_.value(p, 0), track_.value(p, 1));
}

/// The a of a level, near enough for a first guess.
double ApexTables::between_steps(double level) const {
  const size_t step = interval(level_, by_level_, level);
  const double from = track_.start(step), to = step + 1 < track_.steps() ? track_.start(step + 1) : track_.last();
  return from + (to - from) * std::clamp((level - level_[step]) / (level_[step + 1] - level_[step]), 0., 1.);
}

/// The a near which the nearest place to p is.
double ApexTables::first_guess(const Vec2& p) const {
  const double level = p.x() - p.y();
  if (!place_ || !(level >= place_.first() && level <= place_.last())) return between_steps(level);
  // The point of the profile at the same level, and from there on along the tangent.
  const auto at = place_.find(level);
  const double along = (2 * place_.slope(at, 0) - 1) / place_.slope(at, 1);
  return std::clamp(place_.value(at, 1) + (p.x() - place_.value(at, 0)) * along, 0., track_.last());
}

std::optional<double> ApexTables::nearest_arc(const Vec2& p) const {
  if (!track_) return std::nullopt;
  double a = first_guess(p);
  for (int i = 0; i < 12; ++i) {
    const auto at = track_.find(a);
    const Vec2 away(track_.value(at, 0) - p.x(), track_.value(at, 1) - p.y());
    const Vec2 along(track_.slope(at, 0), track_.slope(at, 1)), bend(track_.bend(at, 0), track_.bend(at, 1));
    const double f = away.dot(along), slope = along.squaredNorm() + away.dot(bend);
    if (!(slope > 0)) return std::nullopt;
    const double next = std::clamp(a - f / slope, 0., track_.last());
    const double moved = std::abs(next - a);
    a = next;
    if (!(moved <= 1e-6 * size_)) continue;  // the last step squares that
    if (a == track_.last()) return std::nullopt;
    // Elsewhere x - y differs by rise_ times the distance along the profile at least, and so by root 2 times the
    // distance in space at most: nothing beyond `reach` is nearer. Within, the profile bends too little for two places.
    const double d = away.norm(), reach = 2 * std::sqrt(2) * d / rise_;
    if (d > on_profile * size_ && !((d + reach) * sharpest_ < .9)) return std::nullopt;
    return a;
  }
  return std::nullopt;
}

std::optional<ApexTables::Place> ApexTables::nearest(const Vec2& p) const {
  const auto a = nearest_arc(p);
  if (!a) return std::nullopt;
  const auto at = track_.find(*a);
  return Place{
      *a, {track_.value(at, 0), track_.value(at, 1)}, Vec2(track_.slope(at, 0), track_.slope(at, 1)).normalized()};
}

// === Growth

void ApexTables::tabulate(const Flow& flow) {
  if (!flow.spreads()) return;
  last_ = flow.last();
  speed_at_last_ = flow.speed(last_);
  tail_rate_ = flow.rate().points().back().y();
  const double first = std::max(flow.near(), nearest_to_tip * last_);
  std::vector<double> places = {first}, breaks;
  for (const double a : flow.rate().breaks())
    if (a > first && a < last_) places.push_back(a);
  places.push_back(last_);
  for (const double a : places) breaks.push_back(std::log(a));
  // The speed, relative to a, is smooth, and asked for very often: by the integral of da / v, from one step of its
  // table to the next. (Flow finds the same from the curve itself, a hundred times slower.)
  const Table<1> relative_speed(
      places,
      [&](double a, Table<1>::Values& value, Table<1>::Values& slope) {
        const double v = flow.speed(a) / a;
        value = {v}, slope = {(flow.rate()(a) - v) / a};
      },
      3e-12 * speed_at_last_ / last_);
  const auto speed = [&](double a) { return a * relative_speed.value(relative_speed.find(a), 0); };
  // Over da first; where the speed is so even that the steps of its table are wide, 1 / v bends too much within one,
  // and a / v over the logarithm of a does not.
  for (const bool by_log : {false, true}) {
    const auto between = [&](double from, double to) {
      if (!by_log) return gauss<6>([&](double a) { return 1 / speed(a); }, from, to);
      const auto per_log = [&](double log_a) { return std::exp(log_a) / speed(std::exp(log_a)); };
      return gauss<6>(per_log, std::log(from), std::log(to));
    };
    std::vector<double> start, begun = {flow.time(first)};
    for (size_t i = 0; i < relative_speed.steps(); ++i) start.push_back(relative_speed.start(i));
    for (size_t i = 0; i + 1 < start.size(); ++i) begun.push_back(begun.back() + between(start[i], start[i + 1]));
    const auto time = [&](double log_a, Table<1>::Values& value, Table<1>::Values& slope) {
      const double a = std::clamp(std::exp(log_a), first, last_);
      if (!relative_speed) {
        value = {flow.time(a)}, slope = {a / flow.speed(a)};
        return;
      }
      const size_t step = relative_speed.find(a).step;
      value = {begun[step] + between(start[step], a)}, slope = {a / speed(a)};
    };
    clock_ = Table<1>(breaks, time, 3e-11 * last_ / speed_at_last_);
    if (clock_) break;
  }
  if (!clock_) return;
  for (size_t i = 0; i < clock_.steps(); ++i) times_.push_back(clock_.value({i, 0, 1}, 0));
  times_.push_back(clock_.value({clock_.steps() - 1, 1, 1}, 0));
  by_time_ = buckets(times_);
}

/// How long what starts close to the tip takes to a place.
double ApexTables::time(double a) const {
  if (a < last_) return clock_.value(clock_.find(std::log(a)), 0);
  const double way = (a - last_) / speed_at_last_;
  return times_.back() + (tail_rate_ == 0 ? way : std::log1p(tail_rate_ * way) / tail_rate_);
}

/// Its inverse.
double ApexTables::a_of_time(double time) const {
  if (time >= times_.back()) {
    const double left = time - times_.back();
    return last_ + speed_at_last_ * (tail_rate_ == 0 ? left : std::expm1(tail_rate_ * left) / tail_rate_);
  }
  const size_t step = interval(times_, by_time_, time);
  Table<1>::Place at{step, (time - times_[step]) / (times_[step + 1] - times_[step]), 1};
  for (int i = 0; i < 12; ++i) {
    const double move = (clock_.value(at, 0) - time) / clock_.slope(at, 0);
    at.s -= move;
    if (std::abs(move) < 1e-9) break;
  }
  return std::exp(clock_.start(step) + at.s / clock_.find(clock_.start(step)).per_x);
}

std::optional<double> ApexTables::after(double a, double dt) const {
  if (!clock_ || !(dt >= 0) || !(a > 0)) return std::nullopt;
  if (a >= last_) {
    const double speed = speed_at_last_ + tail_rate_ * (a - last_);
    return a + speed * (tail_rate_ == 0 ? dt : std::expm1(tail_rate_ * dt) / tail_rate_);
  }
  if (!(std::log(a) >= clock_.first())) return std::nullopt;
  return a_of_time(time(a) + dt);
}

// === Both: points of the surface as they move

/// The a of a level, exact.
double ApexTables::a_of_level(double level) const {
  double a = between_steps(level);
  for (int i = 0; i < 12; ++i) {
    const auto at = track_.find(a);
    const double off = track_.value(at, 0) - track_.value(at, 1) - level;
    const double next = std::clamp(a - off / (track_.slope(at, 0) - track_.slope(at, 1)), 0., track_.last());
    const bool done = std::abs(next - a) <= 1e-9 * size_;
    a = next;
    if (done) break;
  }
  return a;
}

void ApexTables::tabulate_movement(const Profile& profile, const Flow& flow) {
  if (!track_ || !clock_ || !(tail_rate_ >= 0)) return;
  const double end = track_.last(), first = std::max(std::exp(clock_.first()), share_of_slow_start * last_);
  if (!(first < end)) return;
  std::vector<double> places = {first, end};
  if (last_ > first && last_ < end) places.push_back(last_);
  for (const auto& breaks : {profile.breaks(), flow.rate().breaks()})
    for (const double a : breaks)
      if (a > first && a < end) places.push_back(a);
  for (double a = 2 * first; a < std::min(last_, end); a *= 2)
    places.push_back(a);  // near the tip time goes with the logarithm of a
  std::sort(places.begin(), places.end());
  const double near = 1e-9 * size_;  // two breaks as close as that are one
  places.erase(std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a < near; }),
               places.end());
  places.back() = end;
  const double speed = speed_at_last_;
  std::vector<double> levels, times;
  for (const double a : places) {
    const auto at = track_.find(a);
    levels.push_back(track_.value(at, 0) - track_.value(at, 1));
    times.push_back(time(a));
  }
  const auto place = [&](double level, Table<3>::Values& value, Table<3>::Values& slope) {
    const double a = std::max(first, a_of_level(level));
    const auto at = track_.find(a);
    const double dx = track_.slope(at, 0), rise = dx - track_.slope(at, 1);
    // Time is taken times a speed, so that one tolerance does for all.
    value = {track_.value(at, 0), a, speed * time(a)};
    slope = {dx / rise, 1 / rise, speed / (flow.speed(a) * rise)};
  };
  const auto course = [&](double t, Table<2>::Values& value, Table<2>::Values& slope) {
    const double a = std::clamp(a_of_time(t), first, end), v = flow.speed(a);
    const auto at = track_.find(a);
    value = {track_.value(at, 0), track_.value(at, 1)};
    slope = {v * track_.slope(at, 0), v * track_.slope(at, 1)};
  };
  place_ = Table<3>(levels, place, movement_tolerance * size_);
  course_ = Table<2>(times, course, movement_tolerance * size_);
  if (!place_ || !course_) place_ = {}, course_ = {};
  viewed_ = track_.view(view_.track) && place_.view(view_.place) && course_.view(view_.course);
  view_.size = size_, view_.speed = speed_at_last_, view_.rise = rise_, view_.sharpest = sharpest_;
  view_.on_profile = on_profile;
}

std::optional<ApexTables::Guess> ApexTables::guess(const Vec2& p) const {
  const double level = p.x() - p.y();
  if (!place_ || !(level >= place_.first() && level <= place_.last())) return std::nullopt;
  const auto at = place_.find(level);
  // As in nearest(): along the profile the level changes by rise_ times the way at least, in space by root 2 times it
  // at most.
  const double off = std::numbers::sqrt2 * std::abs(p.x() - place_.value(at, 0));
  return Guess{place_.value(at, 1), std::numbers::sqrt2 * off / rise_ + on_profile * size_};
}

std::optional<Vec2> ApexTables::facing(const Vec2& p) const {
  const double level = p.x() - p.y();
  if (!place_ || !(level >= place_.first() && level <= place_.last())) return std::nullopt;
  const double dx = place_.slope(place_.find(level), 0);  // and dy is dx - 1, since level is x - y
  return Vec2(1 - dx, dx);
}

std::optional<Vec2> ApexTables::moved(const Vec2& p, double dt) const {
  const double level = p.x() - p.y();
  if (!place_ || !(level >= place_.first() && level <= place_.last())) return std::nullopt;
  const auto at = place_.find(level);
  if (!(std::abs(p.x() - place_.value(at, 0)) <= on_profile * size_)) return std::nullopt;
  const double time = place_.value(at, 2) / speed_at_last_ + dt;
  if (!(time >= course_.first() && time <= course_.last())) return std::nullopt;
  const auto then = course_.find(time);
  return Vec2(course_.value(then, 0), course_.value(then, 1));
}

}  // namespace tunica
