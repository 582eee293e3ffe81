// SPDX-License-Identifier: MIT
#include "solve/tolerance.h"

#include <cmath>

namespace tunica {

void ErrorNorm::scale(const System& system, const double* y) {
  y_ = y;
  count_ = 0;
  columns_.clear();
  for (const System::StateColumn& s : system.state()) {
    const double* first = y + s.offset;
    double sums[lanes] = {}, sum = 0;
    const size_t count = s.count, whole = count / lanes * lanes;
    for (size_t i = 0; i < whole; i += lanes)
      for (size_t lane = 0; lane < lanes; ++lane) sums[lane] += first[i + lane] * first[i + lane];
    for (size_t i = whole; i < count; ++i) sum += first[i] * first[i];
    for (const double part : sums) sum += part;
    const double scale = count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
    columns_.push_back({s.offset, count, scale > 0 ? scale : 1.0});
    count_ += count;
  }
}

}  // namespace tunica
