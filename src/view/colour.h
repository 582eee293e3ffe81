// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace tunica {

/// A colour as screens take it: sRGB components and coverage in [0, 1], not premultiplied.
struct Colour {
  float r = 0, g = 0, b = 0, a = 1;
  bool operator==(const Colour&) const = default;
};

inline constexpr Colour black{0, 0, 0, 1};
inline constexpr Colour white{1, 1, 1, 1};
inline constexpr Colour clear{0, 0, 0, 0};

/// Lightness, green-red and blue-yellow in OKLab (B. Ottosson 2020), where equal distances look equally different.
struct OkLab {
  double l = 0, a = 0, b = 0;
};
OkLab to_oklab(const Colour& colour);
/// Components outside [0, 1] are clipped; coverage is 1.
Colour from_oklab(const OkLab& lab);

/// A point `t` in [0, 1] of the way from `from` to `to`, even to the eye (OKLab); coverage too.
Colour mix(const Colour& from, const Colour& to, double t);

/// Black or white, whichever reads better upon `ground`.
Colour ink_for(const Colour& ground);

/// "#rgb", "#rrggbb", "#rrggbbaa", or a name ("red", "green", "transparent", ...).
/// Errors: anything else (names the nearest colour).
Colour parse_colour(std::string_view text);

}  // namespace tunica
