// SPDX-License-Identifier: MIT
#include "view/text.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "base/error.h"

namespace tunica {
namespace {

/// DejaVu Sans, asked for by its file and not by a font service: the same letters on every machine that has it.
constexpr const char* font_files[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",    // Debian, Ubuntu
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",  // Fedora
    "/usr/share/fonts/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",  // Arch
};

class Font {
 public:
  Font() {
    if (FT_Init_FreeType(&library_) != 0) fail("cannot draw text: FreeType does not start");
    const char* chosen = std::getenv("TUNICA_FONT");
    if (chosen && *chosen) {
      if (FT_New_Face(library_, chosen, 0, &face_) != 0) face_ = nullptr;
    } else {
      for (const char* file : font_files)
        if (!face_ && FT_New_Face(library_, file, 0, &face_) != 0) face_ = nullptr;
    }
    if (face_) return;
    FT_Done_FreeType(library_);
    if (chosen && *chosen) fail("cannot draw text: the font that TUNICA_FONT names, '{}', cannot be read", chosen);
    fail("cannot draw text: the font DejaVu Sans is not installed (Debian: apt-get install fonts-dejavu-core)");
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }

  void set_size(double pixels) {
    FT_Set_Char_Size(face_, 0, static_cast<FT_F26Dot6>(std::lround(pixels * 64)), 72, 72);
  }
  FT_Face face() const { return face_; }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

Font& font() {
  thread_local std::unique_ptr<Font> own;
  if (!own) own = std::make_unique<Font>();
  return *own;
}

/// Takes one character off the front; U+FFFD for what is not UTF-8.
char32_t next_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const int length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (length == 0 || text.size() < static_cast<size_t>(length)) {
    text.remove_prefix(1);
    return 0xfffd;
  }
  char32_t code = length == 1 ? first : first & (0x7f >> length);
  for (int i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[static_cast<size_t>(i)]);
    if (byte >> 6 != 2) {
      text.remove_prefix(1);
      return 0xfffd;
    }
    code = (code << 6) | (byte & 0x3f);
  }
  text.remove_prefix(static_cast<size_t>(length));
  return code;
}

/// Calls `visit(pen)` for each letter with its outline loaded and the pen's place; returns the whole width.
template <class Visit>
double each_letter(std::string_view text, double size, Visit&& visit) {
  Font& f = font();
  f.set_size(size);
  double pen = 0;
  FT_UInt previous = 0;
  while (!text.empty()) {
    const FT_UInt glyph = FT_Get_Char_Index(f.face(), next_character(text));
    if (previous && glyph) {
      FT_Vector kerning{0, 0};
      FT_Get_Kerning(f.face(), previous, glyph, FT_KERNING_UNFITTED, &kerning);
      pen += static_cast<double>(kerning.x) / 64;
    }
    previous = glyph;
    // Light hinting aligns letters to pixel rows, where it sharpens, and leaves their spacing alone.
    if (FT_Load_Glyph(f.face(), glyph, FT_LOAD_TARGET_LIGHT | FT_LOAD_NO_BITMAP) != 0) continue;
    visit(pen);
    pen += static_cast<double>(f.face()->glyph->linearHoriAdvance) / 65536;
  }
  return pen;
}

void blend(uint8_t* pixel, const Colour& colour, double coverage) {
  const double alpha = colour.a * coverage;
  const double channel[] = {colour.r * alpha, colour.g * alpha, colour.b * alpha, alpha};
  for (int c = 0; c < 4; ++c)
    pixel[c] = static_cast<uint8_t>(std::clamp(std::lround(255 * channel[c] + pixel[c] * (1 - alpha)), 0l, 255l));
}

}  // namespace

double text_width(std::string_view text, double size) {
  return each_letter(text, size, [](double) {});
}

void draw_text(std::vector<uint8_t>& pixels, int width, int height, std::string_view text, double x, double y,
               double size, const Colour& colour, Label::Across across, Label::Along along) {
  if (text.empty()) return;
  if (across != Label::Across::left) x -= text_width(text, size) * (across == Label::Across::centre ? 0.5 : 1);
  // Placed by the height of a capital and not by each text's own extent, so that a row of labels stands on one line.
  const double capital = 0.73 * size;
  const double below = along == Label::Along::top ? capital : along == Label::Along::middle ? capital / 2 : 0;
  const auto baseline = static_cast<int>(std::lround(y + below));
  each_letter(text, size, [&](double pen) {
    const FT_GlyphSlot slot = font().face()->glyph;
    const double at = std::floor(4 * (x + pen) + 0.5) / 4, whole = std::floor(at);
    FT_Outline_Translate(&slot->outline, static_cast<FT_Pos>(64 * (at - whole)), 0);
    if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL) != 0) return;
    const int left = static_cast<int>(whole) + slot->bitmap_left, top = baseline - slot->bitmap_top;
    for (int row = 0; row < static_cast<int>(slot->bitmap.rows); ++row) {
      for (int column = 0; column < static_cast<int>(slot->bitmap.width); ++column) {
        const int px = left + column, py = top + row;
        const uint8_t coverage = slot->bitmap.buffer[row * slot->bitmap.pitch + column];
        if (coverage == 0 || px < 0 || py < 0 || px >= width || py >= height) continue;
        blend(&pixels[4 * (static_cast<size_t>(py) * static_cast<size_t>(width) + static_cast<size_t>(px))], colour,
              coverage / 255.0);
      }
    }
  });
}

}  // namespace tunica
