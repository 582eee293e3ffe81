// SPDX-License-Identifier: MIT
// Pictures of blocks, with the title above them and the legends beside them as text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "view/legend.h"
#include "view/surroundings.h"
#include "view/terminal_parts.h"

namespace tunica {
namespace {

constexpr int patch = 2;  // columns of a colour beside its text

/// The part of a picture within a rectangle, and of that the part that is not ground.
Picture content_of(const Picture& picture, const Rect& rect) {
  const int x0 = std::clamp(static_cast<int>(rect.x), 0, picture.width - 1);
  const int y0 = std::clamp(static_cast<int>(rect.y), 0, picture.height - 1);
  const int x1 = std::clamp(static_cast<int>(std::ceil(rect.x + rect.width)), x0 + 1, picture.width);
  const int y1 = std::clamp(static_cast<int>(std::ceil(rect.y + rect.height)), y0 + 1, picture.height);
  const auto ground = picture.at(x0, y0);
  int left = x1, right = x0, top = y1, bottom = y0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (picture.at(x, y) != ground) {
        left = std::min(left, x), right = std::max(right, x + 1);
        top = std::min(top, y), bottom = std::max(bottom, y + 1);
      }
  if (left >= right) left = x0, right = x1, top = y0, bottom = y1;
  Picture part{right - left, bottom - top, {}};
  for (int y = top; y < bottom; ++y) {
    const auto row = picture.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + left);
    part.rgba.insert(part.rgba.end(), row, row + 4 * (right - left));
  }
  return part;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    lines.push_back(text.substr(at, end - at));
  return lines;
}

/// Colours from top to bottom, two to a row of cells as half blocks show them.
std::vector<std::string> patches(const std::vector<Colour>& colours, const Terminal& terminal, int rows) {
  const int size = 8;  // pixels of half a cell each way
  Picture strip{2 * size * patch, 2 * size * rows, {}};
  for (int y = 0; y < strip.height; ++y) {
    const double t = (y / size + 0.5) / (2 * rows);
    const Colour& c = colours[static_cast<size_t>(t * static_cast<double>(colours.size()))];
    for (int x = 0; x < strip.width; ++x)
      for (const float part : {c.r, c.g, c.b, 1.f})
        strip.rgba.push_back(static_cast<uint8_t>(std::lround(255 * std::clamp(part, 0.f, 1.f))));
  }
  return lines_of(in_blocks(strip, terminal, {patch, rows}));
}

struct TextLine {
  std::string coloured, text;  ///< the former is as wide as a patch, or empty
};

/// Characters of UTF-8.
int width_of(const std::string& text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}
int width_of(const TextLine& line) { return (line.coloured.empty() ? 0 : patch + 1) + width_of(line.text); }

/// On one line, in what the terminal can write, and no longer than the terminal is wide.
std::string written(const std::string& text, const Terminal& terminal, int columns) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    size_t length = 1;
    while (i + length < text.size() && (text[i + length] & 0xc0) == 0x80) ++length;
    const std::string letter = text.substr(i, length);
    i += length;
    if (width_of(out) >= columns) break;
    if (letter == "\u2212" && !speaks_utf8(terminal))
      out += '-';
    else if (length > 1)
      out += speaks_utf8(terminal) ? letter : "?";
    else
      out += static_cast<unsigned char>(letter[0]) < 32 ? ' ' : letter[0];
  }
  return out;
}

void add_bar(const ColourBar& bar, const Terminal& terminal, int rows, int columns, std::vector<TextLine>& out) {
  if (!bar.title.empty()) out.push_back({"", written(bar.title, terminal, columns)});
  if (bar.colours.empty()) return;
  const auto strip = patches({bar.colours.rbegin(), bar.colours.rend()}, terminal, rows);
  const size_t first = out.size();
  for (const auto& line : strip) out.push_back({line, ""});
  for (const Tick& tick : ticks_between(bar.min, bar.max, std::clamp(rows / 2, 1, 5))) {
    const double down = (bar.max - tick.value) / (bar.max - bar.min) * rows;
    const auto row = static_cast<size_t>(std::clamp(static_cast<int>(down), 0, static_cast<int>(strip.size()) - 1));
    out[first + row].text = written(tick.text, terminal, columns);
  }
}

std::vector<TextLine> legend_of(const Surroundings& around, const Terminal& terminal, int columns, int rows) {
  std::vector<TextLine> lines;
  const int others = static_cast<int>(around.keys.size() + 3 * around.bars.size());  // keys, titles, gaps
  const int count = std::max<int>(1, static_cast<int>(around.bars.size()));
  const int high = std::clamp((rows - others) / count, 2, 16);
  for (const ColourBar& bar : around.bars) {
    if (!lines.empty()) lines.emplace_back();
    add_bar(bar, terminal, high, columns, lines);
  }
  if (!lines.empty() && !around.keys.empty()) lines.emplace_back();
  for (const Key& key : around.keys)
    lines.push_back({patches({key.colour}, terminal, 1).at(0), written(key.text, terminal, columns - patch - 1)});
  return lines;
}

void append(const TextLine& line, std::string& out) {
  out += line.coloured;
  if (!line.coloured.empty() && !line.text.empty()) out += ' ';
  out += line.text;
}

}  // namespace

std::string terminal_picture(const Picture& picture, const Surroundings& around, ImageProtocol protocol,
                             const Terminal& terminal, int columns, int rows) {
  if (protocol != ImageProtocol::blocks || around.empty())
    return terminal_picture(picture, protocol, terminal, columns, rows);
  const Picture content = content_of(picture, around.content);
  const int below_title = std::max(1, rows - (around.title.empty() ? 0 : 1));
  const std::vector<TextLine> legend = legend_of(around, terminal, columns, below_title);
  int wide = 0;
  for (const TextLine& line : legend) wide = std::max(wide, width_of(line));
  const int between = 2, left = columns - between - wide;
  const bool beside = left >= columns / 2;  // else below
  const Cells cells = fit(content, beside ? left : columns, below_title);
  std::string out;
  if (!around.title.empty()) {
    const std::string title = written(around.title, terminal, columns);
    out.append(std::max(0, (cells.columns - width_of(title)) / 2), ' ').append(title).append("\n");
  }
  const auto drawn = lines_of(in_blocks(content, terminal, cells));
  const size_t height = beside ? std::max(drawn.size(), legend.size()) : drawn.size();
  const size_t first = beside && drawn.size() > legend.size() ? (drawn.size() - legend.size()) / 2 : 0;
  for (size_t i = 0; i < height; ++i) {
    if (i < drawn.size()) out += drawn[i];
    if (beside && i >= first && i - first < legend.size()) {
      out.append(between + (i < drawn.size() ? 0 : cells.columns), ' ');
      append(legend[i - first], out);
    }
    out += '\n';
  }
  for (size_t i = 0; i < legend.size() && !beside; ++i) append(legend[i], out), out += '\n';
  return out;
}

}  // namespace tunica
