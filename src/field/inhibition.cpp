// SPDX-License-Identifier: MIT
#include "field/inhibition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace tunica {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

double positive_angle(double angle) {
  const double turned = std::fmod(angle, two_pi);
  return turned < 0 ? turned + two_pi : turned;
}

void check_settings(const InhibitionSettings& s) {
  if (!(s.ring.x() > 0) || !s.ring.allFinite())
    fail("the ring must have a radius greater than 0, it has {}", s.ring.x());
  if (s.samples < 3) fail("the ring needs at least 3 samples, came {}", s.samples);
  if (s.jugacy < 1 || s.samples % s.jugacy != 0)
    fail("the number of samples must be a multiple of the jugacy: {} samples, jugacy {}", s.samples, s.jugacy);
  if (!s.located && !(s.longest_step > 0)) fail("fixed steps need a length: dt");
}

/// A time in which what starts on the ring moves by about a hundredth of its radius.
double time_to_move(const InhibitionSettings& s) {
  const Vec2 start = s.track(0);
  const double far = 0.01 * s.ring.x();
  const auto moved = [&](double age) { return !((s.track(age) - start).norm() < far); };
  double age = 1;
  for (int i = 0; i < 200 && moved(age); ++i) age /= 2;
  for (int i = 0; i < 200 && !moved(age); ++i) age *= 2;
  if (!moved(age) || !(age < 1e50))
    fail("what starts on the ring does not move away from it: there is no growth there");
  return age;
}

}  // namespace

Inhibition::Inhibition(InhibitionSettings settings) : settings_(std::move(settings)) {
  check_settings(settings_);
  time_scale_ = time_to_move(settings_);
  const size_t n = static_cast<size_t>(settings_.samples + 3) / 4 * 4;
  angle_.resize(static_cast<size_t>(settings_.samples));
  for (AlignedBuffer* b : {&sine_, &cosine_, &radius_, &height_, &distance_}) b->resize(n);
  place_samples();
}

/// Padding repeats the first sample.
void Inhibition::place_samples() {
  const auto n = static_cast<size_t>(settings_.samples);
  for (size_t i = 0; i < sine_.size(); ++i) {
    const size_t s = i < n ? i : 0;
    const auto random = [&](uint32_t which) {
      return normal({settings_.seed, purpose("jitter of samples"), draws_, static_cast<uint32_t>(2 * s + which)});
    };
    double angle = two_pi * static_cast<double>(s) / static_cast<double>(n);
    Vec2 place = settings_.ring;
    if (settings_.jitter_angle > 0) angle += settings_.jitter_angle * random(0);
    if (settings_.jitter_along > 0) place = settings_.displaced(settings_.jitter_along * random(1));
    if (i < n) angle_[i] = angle;
    sine_.data()[i] = std::sin(angle / 2);
    cosine_.data()[i] = std::cos(angle / 2);
    radius_.data()[i] = std::fabs(place.x());
    height_.data()[i] = place.y();
  }
  evaluated_.reset();
}

void Inhibition::add_field(InhibitionField field) {
  fields_.push_back(std::move(field));
  h_.emplace_back().resize(sine_.size());
  changed();
}

/// Places are kept where squares do not overflow.
Vec2 Inhibition::track(double age) const {
  constexpr double far = 1e100;
  const Vec2 place = settings_.track(std::max(0.0, age));
  if (place.x() < 0)
    fail("the path crosses the axis: at age {:.6g} it is at x = {:.6g}; x is the distance from the axis", age, place.x());
  return {std::min(place.x(), far), std::clamp(place.y(), -far, far)};
}

std::pair<Index, Index> Inhibition::neighbours(size_t primordium) const {
  constexpr double straight = 1e-6;  // radians: above it, or opposite
  constexpr size_t reach = 512;      // how many older primordia are looked at
  const Primordium& own = primordia_[primordium];
  const Vec2 start = track(0);
  double nearest[2] = {INFINITY, INFINITY};
  Index found[2] = {none, none};
  for (size_t k = primordium; k-- > 0 && primordium - k <= reach;) {
    const Primordium& other = primordia_[k];
    if (!(other.birth < own.birth)) continue;  // of the same whorl
    const double side = std::remainder(other.angle - own.angle, 2 * std::numbers::pi);
    if (std::fabs(side) < straight) continue;
    const Vec2 place = track(own.birth - other.birth);
    const double distance = place.x() * place.x() + start.x() * start.x() - 2 * place.x() * start.x() * std::cos(side) +
                            (place.y() - start.y()) * (place.y() - start.y());
    const bool opposite = std::fabs(side) > std::numbers::pi - straight;
    for (const int s : {0, 1})
      if ((opposite || (side > 0) == (s == 1)) && distance < nearest[s])
        nearest[s] = distance, found[s] = static_cast<Index>(k);
  }
  return {found[0], found[1]};
}

double Inhibition::threshold(size_t k, double t) const {
  const double value = fields_[k].threshold(t);
  if (!std::isfinite(value))
    fail("the threshold of inhibition {} is {} at t = {:.6g}; it must be a finite number", k + 1,
         std::isnan(value) ? "not a number" : "infinite", t);
  return value;
}

// === The fields on the ring

void Inhibition::add_source(const Primordium& p, double t) {
  const double age = std::max(0.0, t - p.birth);
  const Vec2 place = track(age);
  const Source source{std::sin(p.angle / 2), std::cos(p.angle / 2), place.x(), place.y(),
                      1e-14 * settings_.ring.x() * settings_.ring.x()};
  const RingView ring{sine_.data(), cosine_.data(), radius_.data(), height_.data(), static_cast<int>(sine_.size())};
  pair_count_ += fields_.size() * sine_.size();
  double weight[2];
  double* h[2];
  size_t quotients = 0;
  if (fields_.size() <= 2)
    for (size_t k = 0; k < fields_.size(); ++k)
      if (const auto w = fields_[k].rule->reciprocal(age, t)) weight[quotients] = *w, h[quotients++] = h_[k].data();
  if (quotients == fields_.size()) return pair_kernels().reciprocal[quotients - 1](ring, source, weight, h);
  pair_kernels().distances(ring, source, distance_.data());
  for (size_t k = 0; k < fields_.size(); ++k) fields_[k].rule->add(age, t, distance_.data(), ring.count, h_[k].data());
}

/// A field is not a number: finds whose.
void Inhibition::blame(size_t k, double t) {
  for (size_t i = first_active_; i < primordia_.size(); ++i) {
    const double age = std::max(0.0, t - primordia_[i].birth);
    for (int s = 0; s < settings_.samples; ++s) {
      const auto at = static_cast<size_t>(s);
      const Vec2 place = track(age);
      const double u = std::sin((angle_[at] - primordia_[i].angle) / 2), x = place.x(), r = radius_.data()[at];
      const double dy = place.y() - height_.data()[at];
      const double d = std::sqrt(
          std::max(1e-14 * settings_.ring.x() * settings_.ring.x(), (x - r) * (x - r) + dy * dy + 4 * x * r * u * u));
      const double value = fields_[k].rule->at(d, age, t);
      if (std::isnan(value))
        fail("the field of inhibition {} is not a number at distance {:.6g}, age {:.6g} (t = {:.6g})", k + 1, d, age,
             t);
    }
  }
  fail("the field of inhibition {} is not a number at t = {:.6g}: infinite shares cancel", k + 1, t);
}

void Inhibition::evaluate(double t) {
  if (evaluated_ && *evaluated_ == t) return;
  evaluated_.reset();
  ++evaluations_;
  for (AlignedBuffer& h : h_) std::fill(h.data(), h.data() + h.size(), 0.0);
  for (size_t i = first_active_; i < primordia_.size(); ++i) {
    poll(settings_.cancel);
    add_source(primordia_[i], t);
  }
  evaluated_ = t;
}

/// What is compared with the threshold: the field, or its mean over the places of a whorl.
double Inhibition::decisive(size_t k, int place) const {
  const double* h = h_[k].data();
  if (settings_.jugacy == 1) return h[place];
  double sum = 0;
  for (int m = 0; m < settings_.jugacy; ++m) sum += h[place + m * places()];
  return sum / settings_.jugacy;
}

/// Below 0 where there is a candidate: the least, over places, of the largest excess over a threshold.
double Inhibition::excess(double t) {
  evaluate(t);
  std::vector<double> thresholds;
  for (size_t k = 0; k < fields_.size(); ++k) thresholds.push_back(threshold(k, t));
  double least = INFINITY;
  for (int s = 0; s < places(); ++s) {
    double most = -INFINITY;
    for (size_t k = 0; k < fields_.size(); ++k) {
      const double e = decisive(k, s) - thresholds[k];
      if (std::isnan(e)) blame(k, t);
      most = std::max(most, e);
    }
    least = std::min(least, most);
  }
  return least;
}

// === Insertion

/// The candidate whose first field is lowest; among equals, one at random. There is one.
int Inhibition::choose(double t) {
  std::vector<double> thresholds;
  for (size_t k = 0; k < fields_.size(); ++k) thresholds.push_back(threshold(k, t));
  const auto candidate = [&](int s) {
    for (size_t k = 0; k < fields_.size(); ++k)
      if (!(decisive(k, s) < thresholds[k])) return false;
    return true;
  };
  std::vector<int> candidates;
  double lowest = INFINITY;
  for (int s = 0; s < places(); ++s)
    if (candidate(s)) candidates.push_back(s), lowest = std::min(lowest, decisive(0, s));
  if (candidates.empty())
    fail(
        "at t = {:.9g} there was room for a primordium when it was looked for, and is none now: a field, a threshold "
        "or "
        "the path depends on something that changes as it is called (a random number, a counter)",
        t);
  std::erase_if(candidates, [&](int s) { return decisive(0, s) > lowest + settings_.tie * std::fabs(lowest); });
  const double u = uniform({settings_.seed, purpose("choice among ties"), draws_, 0});
  return candidates.at(static_cast<size_t>(u * static_cast<double>(candidates.size())));
}

void Inhibition::insert(double t) {
  constexpr int most_at_once = 200;
  const size_t before = primordia_.size(),
               limit = static_cast<size_t>(most_at_once) * static_cast<size_t>(settings_.jugacy);
  if (before >= limit && primordia_[before - limit].birth == t)
    fail(
        "{} primordia were inserted at t = {:.6g} and there is still room: the threshold is too high for this field, "
        "or "
        "the field does not keep others away",
        limit, t);
  evaluate(t);
  const int place = choose(t);
  for (int m = 0; m < settings_.jugacy; ++m) {
    const double angle = angle_[static_cast<size_t>(place + m * places())];
    primordia_.push_back({positive_angle(angle), t, false});
  }
  ++draws_;
  const size_t active = first_active_;
  if (draws_ % 16 == 0) leave_out_old(t);
  if (settings_.jitter_angle > 0 || settings_.jitter_along > 0) {
    place_samples();
  } else if (active == first_active_) {
    for (size_t i = before; i < primordia_.size(); ++i) add_source(primordia_[i], t);
  } else {
    evaluated_.reset();
  }
}

void Inhibition::add_random() {
  const double u = uniform({settings_.seed, purpose("first primordium"), 0, 0});
  const int place = std::min(places() - 1, static_cast<int>(u * places()));
  for (int m = 0; m < settings_.jugacy; ++m) add_primordium(two_pi * (place + m * places()) / settings_.samples, 0);
}

void Inhibition::add_primordium(double angle, double age) {
  if (!std::isfinite(angle)) fail("a primordium's angle must be a finite number, came {}", angle);
  if (!(age >= 0) || !std::isfinite(age)) fail("a primordium's age must be 0 or more, came {}", age);
  if (!primordia_.empty() && time_ - age < primordia_.back().birth)
    fail("primordia are given from the oldest to the youngest; one of age {:.6g} came after one of age {:.6g}", age,
         time_ - primordia_.back().birth);
  primordia_.push_back({positive_angle(angle), time_ - age, time_ <= 0});
  changed();
}

// === Looking at the present

double Inhibition::value(size_t k, double angle, const Vec2& at) {
  double sum = 0;
  for (size_t i = first_active_; i < primordia_.size(); ++i) {
    const Vec2 p = place(primordia_[i]);
    const double u = std::sin((angle - primordia_[i].angle) / 2);
    const double d2 = (p - at).squaredNorm() + 4 * p.x() * at.x() * u * u;
    sum += fields_[k].rule->at(std::sqrt(std::max(d2, 1e-14 * settings_.ring.x() * settings_.ring.x())),
                               std::max(0.0, time_ - primordia_[i].birth), time_);
  }
  return sum;
}

std::vector<double> Inhibition::ring_values(size_t k) {
  evaluate(time_);
  std::vector<double> values(static_cast<size_t>(settings_.samples));
  for (int s = 0; s < settings_.samples; ++s) values[static_cast<size_t>(s)] = decisive(k, s % places());
  return values;
}

Inhibition::Minimum Inhibition::minimum() {
  const bool candidates = excess(time_) < 0;
  int best = 0;
  if (candidates)
    best = choose(time_);
  else
    for (int s = 1; s < places(); ++s)
      if (decisive(0, s) < decisive(0, best)) best = s;
  return {positive_angle(angle_[static_cast<size_t>(best)]), decisive(0, best), candidates};
}

// === Saving

void Inhibition::save(ByteWriter& out) const {
  out.put(static_cast<int32_t>(settings_.samples));
  out.put(static_cast<int32_t>(settings_.jugacy));
  out.put(static_cast<int32_t>(fields_.size()));
  out.put(time_);
  out.put(from_);
  out.put(draws_);
  out.put(steps_);
  out.put(static_cast<uint8_t>(recount_));
  out.put(static_cast<uint64_t>(first_active_));
  out.put(static_cast<uint64_t>(primordia_.size()));
  for (const Primordium& p : primordia_) {
    out.put(p.angle);
    out.put(p.birth);
    out.put(static_cast<uint8_t>(p.initial));
  }
}

void Inhibition::load(ByteReader& in) {
  const auto samples = in.get<int32_t>(), jugacy = in.get<int32_t>(), fields = in.get<int32_t>();
  if (samples != settings_.samples || jugacy != settings_.jugacy || fields != static_cast<int32_t>(fields_.size()))
    fail("the snapshot is of a model with {} samples, jugacy {} and {} inhibitions; this one has {}, {} and {}",
         samples, jugacy, fields, settings_.samples, settings_.jugacy, fields_.size());
  const auto time = in.get<double>(), from = in.get<double>();
  const auto draws = in.get<uint64_t>(), steps = in.get<uint64_t>();
  const bool recount = in.get<uint8_t>() != 0;
  const auto active = in.get<uint64_t>(), count = in.get<uint64_t>();
  std::vector<Primordium> primordia;
  for (uint64_t i = 0; i < count; ++i) {
    Primordium p;
    p.angle = in.get<double>();
    p.birth = in.get<double>();
    p.initial = in.get<uint8_t>() != 0;
    primordia.push_back(p);
  }
  if (active > count) fail("the saved primordia are damaged");
  time_ = time, from_ = from, draws_ = draws, steps_ = steps, first_active_ = active, recount_ = recount;
  primordia_ = std::move(primordia);
  ahead_.reset();
  place_samples();
}

}  // namespace tunica
