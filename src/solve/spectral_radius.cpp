// SPDX-License-Identifier: MIT
#include "solve/spectral_radius.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "base/random.h"

namespace tunica {

namespace {

/// Length of the vector value(i), summed in a fixed order.
template <class Value>
double length(size_t size, Value&& value) {
  constexpr size_t lanes = 8;  // buffers are padded to whole blocks of 256
  double sums[lanes] = {}, sum = 0;
  for (size_t i = 0; i < size; i += lanes)
    for (size_t lane = 0; lane < lanes; ++lane) sums[lane] += value(i + lane) * value(i + lane);
  for (const double part : sums) sum += part;
  return std::sqrt(sum);
}

void random_start(const System& system, AlignedBuffer& vector) {
  vector.resize(system.state_size());
  for (size_t k = 0; k < system.state().size(); ++k) {
    const System::StateColumn& s = system.state()[k];
    for (Index i = 0; i < s.count; ++i)
      vector.data()[s.offset + i] =
          uniform({0, purpose("spectral radius"), static_cast<uint64_t>(i), static_cast<uint32_t>(k)}) - 0.5;
  }
}

}  // namespace

SpectralRadius spectral_radius(System& system, double t, const double* y, const double* rate, AlignedBuffer& vector,
                               double accuracy, int most_iterations) {
  const size_t size = system.state_size();
  SpectralRadius found;
  double* v = vector.data();
  if (vector.size() != size || !(length(size, [&](size_t i) { return v[i]; }) > 0)) random_start(system, vector);
  v = vector.data();
  AlignedBuffer moved, rates;
  moved.resize(size);
  rates.resize(size);
  double *x = moved.data(), *f = rates.data();
  const double state = length(size, [&](size_t i) { return y[i]; });
  const double distance = (state > 0 ? state : 1.0) * std::sqrt(DBL_EPSILON);
  const double start = length(size, [&](size_t i) { return v[i]; });
  if (!(start > 0) || !std::isfinite(state)) {
    found.radius = std::isfinite(state) ? 0 : NAN;
    return found;
  }
  for (size_t i = 0; i < size; ++i) x[i] = y[i] + v[i] * (distance / start);
  double previous = 0;
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    system.rates(t, x, f);
    ++found.evaluations;
    const double change = length(size, [&](size_t i) { return f[i] - rate[i]; });
    found.radius = change / distance;
    if (!(change > 0) || !std::isfinite(change)) break;  // f does not depend on y, or is not finite
    if (iteration >= 2 && std::fabs(found.radius - previous) <= accuracy * found.radius) {
      found.converged = true;
      break;
    }
    previous = found.radius;
    for (size_t i = 0; i < size; ++i) x[i] = y[i] + (f[i] - rate[i]) * (distance / change);
  }
  if (std::isfinite(found.radius))
    for (size_t i = 0; i < size; ++i) v[i] = x[i] - y[i];
  return found;
}

}  // namespace tunica
