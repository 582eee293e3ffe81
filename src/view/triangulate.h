// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tunica {

/// Splits a polygon into triangles (corner numbers, 0 .. size - 1), covering it once: a fan if it is convex, else by
/// cutting ears. Corners in space are seen along the polygon's own normal. Always ends with size - 2 triangles (some
/// may have no area), also for degenerate or self-crossing input, where the cover is only a best effort.
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Eigen::Vector3d> corners);

}  // namespace tunica
