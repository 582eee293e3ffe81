// SPDX-License-Identifier: MIT
#include "base/random.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace tunica {

namespace {

struct Pair {
  uint64_t first, second;
};

Pair bits(const RandomKey& key) {
  r123::Philox4x32 philox;
  const r123::Philox4x32::ctr_type counter{
      {static_cast<uint32_t>(key.cell), static_cast<uint32_t>(key.cell >> 32), key.step, key.purpose}};
  const r123::Philox4x32::key_type seed{{static_cast<uint32_t>(key.seed), static_cast<uint32_t>(key.seed >> 32)}};
  const auto r = philox(counter, seed);
  return {(uint64_t{r[0]} << 32) | r[1], (uint64_t{r[2]} << 32) | r[3]};
}

double unit(uint64_t word) { return static_cast<double>(word >> 11) * 0x1.0p-53; }

}  // namespace

double uniform(const RandomKey& key) { return unit(bits(key).first); }

double normal(const RandomKey& key) {
  const Pair pair = bits(key);
  const double radius = std::sqrt(-2.0 * std::log1p(-unit(pair.first)));
  return radius * std::cos(2.0 * std::numbers::pi * unit(pair.second));
}

}  // namespace tunica
