// SPDX-License-Identifier: MIT
#include "view/colour.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"

namespace tunica {
namespace {

double linear_of(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double encoded_of(double c) { return c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

/// Chosen to go well together on paper rather than to be the web's; red and green differ in lightness, for readers who
/// cannot tell them by hue.
constexpr std::pair<std::string_view, Colour> names[] = {
    {"black", {0, 0, 0, 1}},
    {"white", {1, 1, 1, 1}},
    {"grey", {.5f, .5f, .5f, 1}},
    {"lightgrey", {.83f, .83f, .83f, 1}},
    {"darkgrey", {.25f, .25f, .25f, 1}},
    {"red", {.89f, .10f, .11f, 1}},
    {"green", {.20f, .63f, .17f, 1}},
    {"blue", {.12f, .40f, .75f, 1}},
    {"yellow", {.98f, .85f, .20f, 1}},
    {"orange", {.96f, .52f, .10f, 1}},
    {"purple", {.48f, .24f, .62f, 1}},
    {"pink", {.95f, .56f, .70f, 1}},
    {"brown", {.55f, .34f, .20f, 1}},
    {"cyan", {.20f, .75f, .80f, 1}},
    {"magenta", {.85f, .15f, .60f, 1}},
    {"transparent", {0, 0, 0, 0}},
};

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

Colour parse_hex(std::string_view text) {
  const std::string_view digits = text.substr(1);
  const bool valid = (digits.size() == 3 || digits.size() == 6 || digits.size() == 8) &&
                     std::all_of(digits.begin(), digits.end(), [](char c) { return hex_digit(c) >= 0; });
  if (!valid) fail("'{}' is not a colour: after # come 3, 6 or 8 hexadecimal digits, as in #2ca02c", text);
  std::array<float, 4> value{0, 0, 0, 1};
  const size_t each = digits.size() == 3 ? 1 : 2;
  for (size_t i = 0; i < digits.size() / each; ++i) {
    const int high = hex_digit(digits[i * each]), low = hex_digit(digits[i * each + each - 1]);
    value[i] = static_cast<float>(high * 16 + low) / 255.f;
  }
  return {value[0], value[1], value[2], value[3]};
}

}  // namespace

OkLab to_oklab(const Colour& colour) {
  const double r = linear_of(colour.r), g = linear_of(colour.g), b = linear_of(colour.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Colour from_oklab(const OkLab& lab) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(lab.l + 0.3963377774 * lab.a + 0.2158037573 * lab.b);
  const double m = cube(lab.l - 0.1055613458 * lab.a - 0.0638541728 * lab.b);
  const double s = cube(lab.l - 0.0894841775 * lab.a - 1.2914855480 * lab.b);
  const auto component = [](double linear) { return static_cast<float>(encoded_of(std::clamp(linear, 0.0, 1.0))); };
  return {component(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          component(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          component(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), 1};
}

Colour mix(const Colour& from, const Colour& to, double t) {
  if (t <= 0) return from;
  if (t >= 1) return to;
  const OkLab p = to_oklab(from), q = to_oklab(to);
  Colour result = from_oklab({p.l + t * (q.l - p.l), p.a + t * (q.a - p.a), p.b + t * (q.b - p.b)});
  result.a = static_cast<float>(from.a + t * (to.a - from.a));
  return result;
}

Colour ink_for(const Colour& ground) { return ground.a < 0.5f || to_oklab(ground).l > 0.6 ? black : white; }

Colour parse_colour(std::string_view text) {
  if (!text.empty() && text[0] == '#') return parse_hex(text);
  std::vector<std::string> known;
  for (const auto& [name, colour] : names) {
    if (name == text) return colour;
    known.emplace_back(name);
  }
  fail("'{}' is not a colour: expected a name such as red, or #rrggbb{}", text, did_you_mean(text, known));
}

}  // namespace tunica
