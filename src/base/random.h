// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace tunica {

/// Counter-based random numbers (Philox 4x32-10, Salmon et al. 2011): a pure function of its key, so independent of
/// order, threads and restarts.
struct RandomKey {
  uint64_t seed = 0;     ///< of the run
  uint32_t purpose = 0;  ///< what the number is for: purpose("division"), ...
  uint64_t cell = 0;     ///< identity of the element (or any counter)
  uint32_t step = 0;     ///< a second counter: step, or draw within the cell
};

/// A stable 32-bit number for a purpose's name (FNV-1a).
constexpr uint32_t purpose(std::string_view name) {
  uint32_t hash = 2166136261u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

/// Uniform in [0, 1), 53 bits.
double uniform(const RandomKey& key);

/// Standard normal (Box-Muller on two independent uniforms of the same key).
double normal(const RandomKey& key);

}  // namespace tunica
