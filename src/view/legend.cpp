// SPDX-License-Identifier: MIT
#include "view/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "view/surroundings.h"
#include "view/tessellate.h"
#include "view/text.h"

namespace tunica {
namespace {

/// As printed on paper: a true minus sign, no "-0".
std::string printed(double value, int decimals, bool scientific) {
  std::string text = scientific ? fmt::format("{:.{}e}", value, decimals) : fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-') text.erase(0, 1);
  std::string result;
  for (const char c : text) result += c == '-' ? "\u2212" : std::string(1, c);
  return result;
}

}  // namespace

std::vector<Tick> ticks_between(double min, double max, int wanted) {
  std::vector<Tick> ticks;
  const double span = max - min;
  if (!(span > 0) || !std::isfinite(span)) return ticks;
  const double rough = span / std::max(wanted, 1), power = std::pow(10, std::floor(std::log10(rough)));
  const double ratio = rough / power;
  const double step = power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
  const double largest = std::max(std::abs(min), std::abs(max));
  const bool scientific = largest >= 1e5 || largest < 1e-3;
  const double unit = scientific ? std::pow(10, std::floor(std::log10(largest))) : 1;
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step / unit) - 1e-9)), 0, 15);
  const double first = std::ceil(min / step - 1e-9);
  for (int k = 0; k < 64; ++k) {
    const double value = (first + k) * step;
    if (value > max + 1e-9 * span) break;
    ticks.push_back({std::clamp(value, min, max), printed(value, decimals, scientific)});
  }
  return ticks;
}

Surroundings surroundings_of(const Scene& scene) {
  const Rect frame = Legend(scene).frame();
  // Lines and markers reach a little out of the frame; the title and the legends are farther away.
  const double out = 3;
  return {{frame.x - scene.pad_left - out, frame.y - scene.pad_top - out,
           frame.width + scene.pad_left + scene.pad_right + 2 * out,
           frame.height + scene.pad_top + scene.pad_bottom + 2 * out},
          scene.title,
          scene.bars,
          scene.keys};
}

Legend::Legend(const Scene& scene) : scene_(scene), ink_(ink_for(scene.background)) {
  const double width = scene.width, height = scene.height, shorter = std::min(width, height);
  font_ = scene.font_size > 0 ? scene.font_size : std::clamp(shorter / 42, 9.0, 72.0);
  line_ = 1.5 * font_;
  const double margin = std::max(4.0, std::round(0.03 * shorter));
  double left = margin + scene.pad_left, right = width - margin - scene.pad_right;
  double top = margin + scene.pad_top, bottom = height - margin - scene.pad_bottom;
  if (!scene.title.empty()) {
    title_y_ = margin + 0.6 * font_;
    top += 1.9 * font_;
  }
  double column = 0;  // of the legends, as wide as its widest text
  for (const ColourBar& bar : scene.bars) {
    ticks_.push_back(ticks_between(bar.min, bar.max, 5));
    for (const Tick& tick : ticks_.back()) column = std::max(column, 2.0 * font_ + text_width(tick.text, font_));
    column = std::max(column, text_width(bar.title, font_));
  }
  for (const Key& key : scene.keys) column = std::max(column, 1.5 * font_ + text_width(key.text, font_));
  if (column > 0) {
    column = std::min(column, 0.5 * width);
    right -= column + 1.2 * font_;
    const double keys = static_cast<double>(scene.keys.size()) * line_;
    const double open = bottom - top;
    const double bars = scene.bars.empty() ? 0 : std::min(open - keys - line_, std::max(0.62 * open, 10 * font_));
    const double total = bars + (keys > 0 && bars > 0 ? line_ : 0) + keys;
    const double start = top + std::max(0.0, (open - total) / 2);
    place_bars(std::round(width - margin - column), start, bars);
    keys_x_ = std::round(width - margin - column);
    keys_y_ = start + total - keys;
  }
  frame_ = {left, top, std::max(1.0, right - left), std::max(1.0, bottom - top)};
}

void Legend::place_bars(double left, double top, double height) {
  const auto count = static_cast<double>(scene_.bars.size());
  for (size_t i = 0; i < scene_.bars.size(); ++i) {
    const double share = height / count, y = top + static_cast<double>(i) * share;
    const double head = scene_.bars[i].title.empty() ? 0 : line_;
    const double foot = i + 1 < scene_.bars.size() ? line_ : 0;
    bars_.push_back(
        {left, std::round(y + head), std::round(1.1 * font_), std::max(2.0, std::round(share - head - foot))});
  }
}

void Legend::add_shapes(std::vector<Vertex>& triangles) const {
  for (size_t i = 0; i < bars_.size(); ++i) {
    const Rect& r = bars_[i];
    const auto& colours = scene_.bars[i].colours;
    add_rectangle(triangles, {r.x - 1, r.y - 1, r.width + 2, r.height + 2}, ink_);
    // A row of pixels a colour: what is read off the bar is exactly what the cells are painted with.
    for (int row = 0; row < static_cast<int>(r.height) && !colours.empty(); ++row) {
      const double t = 1 - (row + 0.5) / r.height;
      const auto k = static_cast<size_t>(std::lround(t * static_cast<double>(colours.size() - 1)));
      add_rectangle(triangles, {r.x, r.y + row, r.width, 1}, colours[k]);
    }
    const ColourBar& bar = scene_.bars[i];
    for (const Tick& tick : ticks_[i]) {
      const double y = r.y + r.height * (1 - (tick.value - bar.min) / (bar.max - bar.min));
      add_rectangle(triangles,
                    {r.x + r.width + 1, std::clamp(std::round(y - 0.5), r.y - 1, r.y + r.height), 0.3 * font_, 1},
                    ink_);
    }
  }
  for (size_t i = 0; i < scene_.keys.size(); ++i) {
    const double side = std::round(0.9 * font_), y = std::round(keys_y_ + static_cast<double>(i) * line_);
    add_rectangle(triangles, {keys_x_ - 1, y - 1, side + 2, side + 2}, ink_);
    add_rectangle(triangles, {keys_x_, y, side, side}, scene_.keys[i].colour);
  }
}

void Legend::draw_texts(std::vector<uint8_t>& pixels) const {
  const int width = scene_.width, height = scene_.height;
  const auto write = [&](std::string_view text, double x, double y, double size, Label::Across across) {
    draw_text(pixels, width, height, text, x, y, size, ink_, across, Label::Along::middle);
  };
  if (!scene_.title.empty())
    write(scene_.title, frame_.x + frame_.width / 2, title_y_, 1.15 * font_, Label::Across::centre);
  for (size_t i = 0; i < bars_.size(); ++i) {
    const Rect& r = bars_[i];
    const ColourBar& bar = scene_.bars[i];
    write(bar.title, r.x - 1, r.y - 0.85 * font_, font_, Label::Across::left);
    for (const Tick& tick : ticks_[i])
      write(tick.text, r.x + r.width + 0.55 * font_,
            r.y + r.height * (1 - (tick.value - bar.min) / (bar.max - bar.min)), font_, Label::Across::left);
  }
  for (size_t i = 0; i < scene_.keys.size(); ++i)
    write(scene_.keys[i].text, keys_x_ + 1.5 * font_, keys_y_ + (static_cast<double>(i) * line_) + 0.45 * font_, font_,
          Label::Across::left);
}

}  // namespace tunica
