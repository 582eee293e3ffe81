// SPDX-License-Identifier: MIT
#include "view/page.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "view/scene.h"
#include "view/text.h"

namespace tunica {
namespace {

/// Puts a picture upon a page without transparency.
void put(const Picture& from, int left, int top, Picture& page) {
  for (int y = 0; y < from.height; ++y) {
    const uint8_t* source = &from.rgba[4 * static_cast<size_t>(y) * static_cast<size_t>(from.width)];
    uint8_t* target =
        &page.rgba[4 * (static_cast<size_t>(top + y) * static_cast<size_t>(page.width) + static_cast<size_t>(left))];
    for (int x = 0; x < from.width; ++x, source += 4, target += 4) {
      const int alpha = source[3];
      for (int c = 0; c < 3; ++c)
        target[c] = static_cast<uint8_t>((source[c] * alpha + target[c] * (255 - alpha) + 127) / 255);
    }
  }
}

/// As large as it was asked for, but no wider than its place.
double fitting(const std::string& text, double size, double room) {
  const double width = text_width(text, size);
  return width > room ? size * room / width : size;
}

Picture blank(int width, int height, const Colour& colour) {
  Picture page{width, height, {}};
  const auto byte = [](float v) { return static_cast<uint8_t>(std::lround(255 * std::clamp(v, 0.f, 1.f))); };
  const uint8_t pixel[] = {byte(colour.r), byte(colour.g), byte(colour.b), 255};
  page.rgba.resize(4 * static_cast<size_t>(width) * static_cast<size_t>(height));
  for (size_t i = 0; i < page.rgba.size(); ++i) page.rgba[i] = pixel[i % 4];
  return page;
}

}  // namespace

Picture page_of(const std::vector<Tile>& tiles, const PageSettings& s) {
  if (tiles.empty()) fail("a page needs at least one picture");
  if (s.columns < 0 || s.gap < 0 || s.gap > max_picture_side)
    fail("a page's columns and gap must be 0 or more, came {} and {}", s.columns, s.gap);
  if (!(s.font_size >= 0 && s.font_size <= 1000))
    fail("a page's letters must be 0 to 1000 pixels, not {}", s.font_size);
  const auto count = static_cast<int>(tiles.size());
  const int columns = std::min(count, s.columns > 0 ? s.columns : static_cast<int>(std::ceil(std::sqrt(count))));
  const int rows = (count + columns - 1) / columns;
  int width = 1, height = 1;
  bool captions = false;
  for (const Tile& tile : tiles) {
    width = std::max(width, tile.picture.width), height = std::max(height, tile.picture.height);
    captions = captions || !tile.caption.empty();
  }
  const double font = s.font_size > 0 ? s.font_size : std::clamp(width / 18.0, 10.0, 40.0);
  const int foot = captions ? static_cast<int>(std::ceil(1.7 * font)) : 0;
  const int head = s.title.empty() ? 0 : static_cast<int>(std::ceil(2.4 * font));
  const auto side = [&](int places, int size) { return static_cast<long>(places) * (size + s.gap) + s.gap; };
  const long across = side(columns, width), down = side(rows, height + foot) + head;
  if (across > max_picture_side || down > max_picture_side)
    fail("a page of {} x {} pictures would have {} x {} pixels; at most {} are possible each way", columns, rows,
         across, down, max_picture_side);
  Picture page = blank(static_cast<int>(across), static_cast<int>(down), s.background);
  const Colour ink = ink_for(s.background);
  const auto write = [&](const std::string& text, double x, double y, double size, double room) {
    draw_text(page.rgba, page.width, page.height, text, x, y, fitting(text, size, room), ink, Label::Across::centre,
              Label::Along::middle);
  };
  if (head > 0) write(s.title, page.width / 2.0, s.gap + 0.5 * head, 1.3 * font, page.width - 2.0 * s.gap);
  for (int i = 0; i < count; ++i) {
    const Tile& tile = tiles[static_cast<size_t>(i)];
    const int left = s.gap + i % columns * (width + s.gap), top = head + s.gap + i / columns * (height + foot + s.gap);
    put(tile.picture, left + (width - tile.picture.width) / 2, top + (height - tile.picture.height) / 2, page);
    if (!tile.caption.empty()) write(tile.caption, left + width / 2.0, top + height + 0.5 * foot, font, width);
  }
  return page;
}

}  // namespace tunica
