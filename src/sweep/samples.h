// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sweep/range.h"

namespace tunica::sweep {

/// Values of the parameters of one sample, as text, in the order of the ranges (fixed ones too).
using Sample = std::vector<std::string>;

enum class Sampling { none, grid, random, sobol };
const char* name_of(Sampling sampling);

/// All samples of a sweep. Of random and Sobol samples the first n are the same whatever `count`; grids ignore `count`
/// and `seed`. The last parameter runs fastest in a grid. Sobol points (Joe and Kuo 2008) are shifted by a random
/// vector modulo 1, which keeps their evenness (Cranley and Patterson 1976). Errors: nothing to vary, too many samples.
std::vector<Sample> make_samples(const std::vector<Range>& ranges, Sampling sampling, size_t count, uint64_t seed);

/// The sample at a place from 0 to 1 for each range; those of fixed parameters are not looked at.
Sample sample_at(const std::vector<Range>& ranges, const std::vector<double>& places);

}  // namespace tunica::sweep
