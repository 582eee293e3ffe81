// SPDX-License-Identifier: MIT
#include "sweep/samples.h"

#include <boost/random/sobol.hpp>
#include <cmath>

#include "base/error.h"
#include "base/random.h"

namespace tunica::sweep {

namespace {

constexpr size_t most = 10'000'000;

std::vector<size_t> varied(const std::vector<Range>& ranges) {
  std::vector<size_t> list;
  for (size_t i = 0; i < ranges.size(); ++i)
    if (ranges[i].varies()) list.push_back(i);
  return list;
}

std::vector<Sample> make_grid(const std::vector<Range>& ranges) {
  std::vector<std::vector<std::string>> values;
  double total = 1;
  for (const auto& range : ranges) {
    values.push_back(range.grid());
    total *= static_cast<double>(values.back().size());
  }
  if (total > static_cast<double>(most)) fail("the grid has {:.3g} samples; at most {} are made", total, most);
  std::vector<Sample> samples;
  std::vector<size_t> at(ranges.size(), 0);
  for (size_t n = 0; n < static_cast<size_t>(total); ++n) {
    Sample sample;
    for (size_t i = 0; i < ranges.size(); ++i) sample.push_back(values[i][at[i]]);
    samples.push_back(sample);
    for (size_t i = ranges.size(); i-- > 0 && ++at[i] == values[i].size();) at[i] = 0;
  }
  return samples;
}

/// Number `i` from 0 on of a shifted Sobol sequence, a coordinate for each parameter that varies.
class Sobol {
 public:
  Sobol(size_t dimensions, uint64_t seed) : engine_(dimensions) {
    for (size_t k = 0; k < dimensions; ++k)
      shift_.push_back(uniform({.seed = seed, .purpose = purpose("sobol"), .cell = k}));
  }
  std::vector<double> next() {
    std::vector<double> point;
    for (const double shift : shift_) {
      const double x = std::ldexp(static_cast<double>(engine_() >> 11), -53) + shift;
      point.push_back(x - std::floor(x));
    }
    return point;
  }

 private:
  boost::random::sobol engine_;
  std::vector<double> shift_;
};

}  // namespace

const char* name_of(Sampling sampling) {
  constexpr const char* names[] = {"none", "grid", "random", "sobol"};
  return names[static_cast<int>(sampling)];
}

Sample sample_at(const std::vector<Range>& ranges, const std::vector<double>& places) {
  Sample sample;
  for (size_t i = 0; i < ranges.size(); ++i) sample.push_back(ranges[i].at(places[i]));
  return sample;
}

std::vector<Sample> make_samples(const std::vector<Range>& ranges, Sampling sampling, size_t count, uint64_t seed) {
  if (sampling == Sampling::none) return {};
  if (sampling == Sampling::grid) return make_grid(ranges);
  const auto which = varied(ranges);
  if (which.empty()) fail("no parameter varies: give one a range (D=3..5) or a list (D=3,4,5)");
  if (count > most) fail("{} samples are asked for; at most {} are made", count, most);
  std::vector<Sample> samples;
  std::vector<double> places(ranges.size(), 0);
  Sobol sobol(which.size(), seed);
  for (size_t n = 0; n < count; ++n) {
    const auto point = sampling == Sampling::sobol ? sobol.next() : std::vector<double>();
    for (size_t k = 0; k < which.size(); ++k)
      places[which[k]] =
          sampling == Sampling::sobol
              ? point[k]
              : uniform({seed, purpose("sweep"), static_cast<uint64_t>(n), static_cast<uint32_t>(which[k])});
    samples.push_back(sample_at(ranges, places));
  }
  return samples;
}

}  // namespace tunica::sweep
