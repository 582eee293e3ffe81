// SPDX-License-Identifier: MIT
#include "solve/watch.h"

#include <algorithm>
#include <cmath>

namespace tunica {

namespace {

constexpr double noise = 1e-100;  ///< what is left of something that has long decayed

constexpr uint64_t watch_interval = 128, watch_length = 6;

/// Flags of one column, by a loop that vector units can run.
uint8_t look(const double* values, size_t count) {
  constexpr size_t lanes = 8;
  double zero[lanes] = {}, least[lanes] = {};
  size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (size_t lane = 0; lane < lanes; ++lane) {
      const double v = values[i + lane];
      zero[lane] += v - v;
      least[lane] = v < least[lane] ? v : least[lane];
    }
  for (; i < count; ++i) zero[0] += values[i] - values[i], least[0] = values[i] < least[0] ? values[i] : least[0];
  uint8_t found = 0;
  for (size_t lane = 0; lane < lanes; ++lane)
    found |= (zero[lane] == 0 ? 0 : not_finite) | (least[lane] < 0 ? negative : 0);
  return found;
}

}  // namespace

std::optional<Watch::Symptom> Watch::begin(const System& system, const double* y, double margin) {
  alternations_ = 0;
  watch_negative_.assign(system.state().size(), 0);
  for (size_t k = 0; k < watch_negative_.size(); ++k) {
    const System::StateColumn& s = system.state()[k];
    const double* first = y + s.offset;
    for (Index i = 0; i < s.count; ++i)
      if (!std::isfinite(first[i])) return Symptom{"not finite", k, i, first[i]};
    const bool meant = std::find(signed_.begin(), signed_.end(), s.name) != signed_.end();
    if (s.count == 0) continue;
    const auto [least, largest] = std::minmax_element(first, first + s.count);
    watch_negative_[k] = !meant && *least >= -10 * margin * std::max(*largest, 0.0);
  }
  return {};
}

std::optional<Watch::Symptom> Watch::state(const System& system, const double* y, const double* y_new,
                                           const std::vector<uint8_t>* flags, double margin) const {
  for (size_t k = 0; k < system.state().size(); ++k) {
    const System::StateColumn& s = system.state()[k];
    const double* values = y_new + s.offset;
    const uint8_t found = flags ? (*flags)[k] : look(values, s.count);
    if (found & not_finite) {
      for (Index i = 0; i < s.count; ++i)
        if (!std::isfinite(values[i])) return Symptom{"not finite", k, i, values[i]};
    }
    if ((found & negative) && watch_negative_[k]) {
      const double* old = y + s.offset;
      const double largest = *std::max_element(old, old + s.count);
      for (Index i = 0; i < s.count; ++i)
        if (values[i] < -std::max(margin * largest, noise)) return Symptom{"negative", k, i, values[i]};
    }
  }
  return {};
}

std::optional<Watch::Symptom> Watch::oscillation(const System& system, uint64_t step, const double* y,
                                                 const double* y_new) {
  const uint64_t phase = step % watch_interval;
  if (phase >= watch_length) return {};
  const size_t size = system.state_size();
  if (before_.size() != size) before_.resize(size);
  double* before = before_.data();
  std::optional<Symptom> symptom;
  if (phase == 0) alternations_ = 0;
  for (size_t k = 0; phase > 0 && k < system.state().size(); ++k) {
    const System::StateColumn& s = system.state()[k];
    double product = 0, last = 0, now = 0, largest = 0;
    Index where = 0;
    for (Index i = 0; i < s.count; ++i) {
      const double change = y_new[s.offset + i] - y[s.offset + i], previous = before[s.offset + i];
      product += change * previous;
      last += previous * previous;
      now += change * change;
      if (std::fabs(change) > largest) largest = std::fabs(change), where = i;
    }
    if (product < -0.9 * std::sqrt(last * now) && now > last && largest > 1e-6 * std::fabs(y[s.offset + where]))
      alternations_ += 1;
    if (!symptom && phase == watch_length - 1 && alternations_ >= static_cast<int>(watch_length) - 1)
      symptom = Symptom{"oscillation", k, where, y_new[s.offset + where]};
  }
  for (size_t i = 0; i < size; ++i) before[i] = y_new[i] - y[i];
  return symptom;
}

Watch::Symptom Watch::most_changed(const System& system, const char* kind, const double* y, const double* y_new) {
  Symptom found{kind, 0, 0, 0};
  double most = -1;
  for (size_t k = 0; k < system.state().size(); ++k) {
    const System::StateColumn& s = system.state()[k];
    double scale = 1e-300;
    for (Index i = 0; i < s.count; ++i) scale = std::max(scale, std::fabs(y[s.offset + i]));
    for (Index i = 0; i < s.count; ++i) {
      const double change = std::fabs(y_new[s.offset + i] - y[s.offset + i]) / scale;
      if (change > most) most = change, found = {kind, k, i, y_new[s.offset + i]};
    }
  }
  return found;
}

}  // namespace tunica
