// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tunica {

/// Pixels, row by row from the top; red, green, blue, alpha each 0-255, not premultiplied.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgba;

  std::array<uint8_t, 4> at(int x, int y) const {
    const size_t i = 4 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x));
    return {rgba[i], rgba[i + 1], rgba[i + 2], rgba[i + 3]};
  }
};

}  // namespace tunica
