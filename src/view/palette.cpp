// SPDX-License-Identifier: MIT
#include "view/palette.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace tunica {
namespace {

constexpr int entries = 256;

std::vector<Colour> parse_all(const std::vector<std::string_view>& texts) {
  std::vector<Colour> colours;
  for (const auto text : texts) colours.push_back(parse_colour(text));
  return colours;
}

/// A smooth curve in OKLab through colours given at even steps (Catmull-Rom; at the ends the tangent is the secant).
std::vector<Colour> spline(const std::vector<Colour>& colours) {
  std::vector<OkLab> knots;
  for (const Colour& colour : colours) knots.push_back(to_oklab(colour));
  const int last = static_cast<int>(knots.size()) - 1;
  const auto curve = [&](int i, double t, double OkLab::*component) {
    const auto value = [&](int k) { return knots[static_cast<size_t>(std::clamp(k, 0, last))].*component; };
    const double p = value(i), q = value(i + 1);
    const double from = i > 0 ? (q - value(i - 1)) / 2 : q - p;
    const double to = i + 1 < last ? (value(i + 2) - p) / 2 : q - p;
    const double s = 1 - t;
    return s * s * (1 + 2 * t) * p + s * s * t * from + t * t * (3 - 2 * t) * q - t * t * s * to;
  };
  std::vector<Colour> result;
  for (int k = 0; k < entries; ++k) {
    const double x = static_cast<double>(k) * last / (entries - 1);
    const int i = std::min(static_cast<int>(x), last - 1);
    result.push_back(from_oklab({curve(i, x - i, &OkLab::l), curve(i, x - i, &OkLab::a), curve(i, x - i, &OkLab::b)}));
  }
  result.front() = colours.front();
  result.back() = colours.back();
  return result;
}

template <class Function>
std::vector<Colour> sampled(Function&& lab_at) {
  std::vector<Colour> result;
  for (int k = 0; k < entries; ++k) result.push_back(from_oklab(lab_at(k / double{entries - 1})));
  return result;
}

/// Black to bright green along one hue: scaling a colour's OKLab coordinates scales its light, so every step is a
/// colour a screen can show and lightness rises evenly.
OkLab greens_at(double t) {
  static const OkLab bright = to_oklab({.45f, 1.f, .30f, 1});
  const double s = 0.22 + 0.78 * t;
  return {s * bright.l, s * bright.a, s * bright.b};
}

OkLab greys_at(double t) { return {0.12 + 0.86 * t, 0, 0}; }

/// Blue through near-white to red, with lightness and colourfulness mirrored about the middle.
OkLab diverging_at(double t) {
  const double x = 2 * t - 1, away = std::abs(x);
  const double hue = (x < 0 ? 258 : 27) * std::numbers::pi / 180;
  const double chroma = 0.155 * std::sin(away * std::numbers::pi / 2 * 0.94);
  return {0.965 - 0.50 * std::pow(away, 1.15), chroma * std::cos(hue), chroma * std::sin(hue)};
}

/// A circle of hues at one lightness: for angles and phases, where no value is more than another.
OkLab cyclic_at(double t) {
  const double hue = 2 * std::numbers::pi * (t + 0.07);
  return {0.72, 0.115 * std::cos(hue), 0.115 * std::sin(hue)};
}

std::vector<Palette> make_palettes() {
  using Type = Palette::Type;
  // Every 28th or 29th colour of the published maps; the spline between them stays within 3 of 255.
  const auto viridis = parse_all(
      {"#440154", "#482878", "#3e4a89", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6dcd59", "#b4de2c", "#fde725"});
  const auto magma = parse_all(
      {"#000004", "#180f3e", "#451077", "#721f81", "#9f2f7f", "#cd4071", "#f1605d", "#fd9567", "#fec98d", "#fcfdbf"});
  const auto inferno = parse_all(
      {"#000004", "#1b0c42", "#4b0c6b", "#781c6d", "#a52c60", "#cf4446", "#ed6925", "#fb9a06", "#f7d03c", "#fcffa4"});
  const auto cividis = parse_all(
      {"#00204d", "#00336f", "#39486b", "#575c6d", "#707173", "#8a8779", "#a69d75", "#c4b56c", "#e4cf5b", "#ffea46"});
  const Colour light{.80f, .80f, .80f, 1}, pale_red{.93f, .66f, .66f, 1}, dark{.30f, .30f, .30f, 1};
  return {
      {"cividis", Type::sequential, spline(cividis), pale_red},
      {"cyclic", Type::cyclic, sampled(cyclic_at), dark},
      {"diverging", Type::diverging, sampled(diverging_at), dark},
      {"greens", Type::sequential, sampled(greens_at), light},
      {"greys", Type::sequential, sampled(greys_at), pale_red},
      {"inferno", Type::sequential, spline(inferno), light},
      {"magma", Type::sequential, spline(magma), light},
      {"viridis", Type::sequential, spline(viridis), light},
  };
}

const std::vector<Palette>& palettes() {
  static const std::vector<Palette> all = make_palettes();
  return all;
}

}  // namespace

Colour Palette::at(double t) const {
  if (std::isnan(t)) return missing;
  const double x = std::clamp(t, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  return colours[static_cast<size_t>(std::lround(x))];
}

std::vector<std::string> palette_names() {
  std::vector<std::string> names;
  for (const Palette& each : palettes()) names.push_back(each.name);
  return names;
}

const Palette& palette(std::string_view name) {
  for (const Palette& each : palettes())
    if (each.name == name) return each;
  fail("there is no palette '{}': expected one of {}{}", name, fmt::join(palette_names(), ", "),
       did_you_mean(name, palette_names()));
}

Palette palette_through(const std::vector<Colour>& colours) {
  if (colours.size() < 2) fail("a palette needs at least two colours, not {}", colours.size());
  Palette result{"custom", Palette::Type::sequential, {}, {.72f, .72f, .72f, 1}};
  for (int k = 0; k < entries; ++k) {
    const double x = static_cast<double>(k) * static_cast<double>(colours.size() - 1) / (entries - 1);
    const auto i = std::min(static_cast<size_t>(x), colours.size() - 2);
    result.colours.push_back(mix(colours[i], colours[i + 1], x - static_cast<double>(i)));
  }
  return result;
}

}  // namespace tunica
