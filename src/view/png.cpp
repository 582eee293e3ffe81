// SPDX-License-Identifier: MIT
#include "view/png.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "base/error.h"
#include "view/scene.h"

namespace tunica {
namespace {

struct Sink {
  std::string bytes;
  char message[160] = "";
};

void on_error(png_structp png, png_const_charp message) {
  auto* sink = static_cast<Sink*>(png_get_error_ptr(png));
  std::strncpy(sink->message, message, sizeof sink->message - 1);
  std::longjmp(png_jmpbuf(png), 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep data, size_t size) {
  static_cast<Sink*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), size);
}

void on_flush(png_structp) {}

/// libpng reports errors by longjmp: this frame holds nothing that would need a destructor.
bool write(Sink* sink, const Picture& picture, bool opaque, png_text* texts, int count, png_bytep* rows,
           const CancelFlag* cancel) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, sink, on_error, on_warning);
  if (!png) return false;
  png_infop info = png_create_info_struct(png);
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, sink, on_write, on_flush);
  // Level 3 without row filters is fast and small for flat colours.
  png_set_compression_level(png, 3);
  png_set_filter(png, 0, PNG_FILTER_NONE | PNG_FILTER_UP);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), 8,
               opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (count > 0) png_set_text(png, info, texts, count);
  png_write_info(png, info);
  if (opaque) png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (int y = 0; y < picture.height; ++y) {
    if (cancel && cancel->requested()) png_error(png, "interrupted");
    png_write_row(png, rows[y]);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

uint32_t big_endian(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = at; i < at + 4; ++i) value = (value << 8) | static_cast<unsigned char>(bytes[i]);
  return value;
}

constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);

}  // namespace

std::string encode_png(const Picture& picture, const PngTexts& texts, const CancelFlag* cancel) {
  const size_t row = static_cast<size_t>(std::max(picture.width, 0)) * 4;
  if (picture.width < 1 || picture.height < 1 || picture.width > max_picture_side ||
      picture.height > max_picture_side || picture.rgba.size() != row * static_cast<size_t>(picture.height))
    fail("cannot write a picture of {} x {} pixels with {} bytes as PNG", picture.width, picture.height,
         picture.rgba.size());
  bool opaque = true;
  for (size_t i = 3; i < picture.rgba.size() && opaque; i += 4) opaque = picture.rgba[i] == 255;
  std::vector<png_bytep> rows;
  for (int y = 0; y < picture.height; ++y)
    rows.push_back(const_cast<png_bytep>(picture.rgba.data() + static_cast<size_t>(y) * row));
  std::vector<png_text> entries;
  for (const auto& [keyword, text] : texts) {
    const bool latin = std::all_of(keyword.begin(), keyword.end(), [](unsigned char c) { return c >= 32 && c < 127; });
    if (keyword.empty() || keyword.size() > 79 || !latin || keyword.front() == ' ' || keyword.back() == ' ')
      fail("'{}' cannot be a keyword in a PNG file: 1 to 79 plain characters", keyword);
    png_text entry{};
    const bool plain = std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128; });
    entry.compression = plain ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    entry.key = const_cast<char*>(keyword.c_str());
    entry.text = const_cast<char*>(text.c_str());
    (plain ? entry.text_length : entry.itxt_length) = text.size();
    entries.push_back(entry);
  }
  Sink sink;
  if (!write(&sink, picture, opaque, entries.data(), static_cast<int>(entries.size()), rows.data(), cancel)) {
    poll(cancel);
    fail("cannot write a PNG: {}", sink.message);
  }
  return std::move(sink.bytes);
}

Picture decode_png(std::string_view bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()))
    fail("not a readable PNG: {}", image.message);
  if (image.width > static_cast<unsigned>(max_picture_side) || image.height > static_cast<unsigned>(max_picture_side)) {
    png_image_free(&image);
    fail("a PNG of {} x {} pixels is too large: at most {} a side", image.width, image.height, max_picture_side);
  }
  image.format = PNG_FORMAT_RGBA;
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.rgba.resize(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr)) {
    png_image_free(&image);
    fail("not a readable PNG: {}", image.message);
  }
  return picture;
}

PngTexts png_texts(std::string_view bytes) {
  if (bytes.substr(0, 8) != signature) fail("not a PNG file");
  PngTexts texts;
  for (size_t at = 8; at + 12 <= bytes.size();) {
    const size_t length = big_endian(bytes, at);
    const std::string_view type = bytes.substr(at + 4, 4);
    if (length > bytes.size() - at - 12) fail("the PNG file is cut or damaged");
    const std::string_view data = bytes.substr(at + 8, length);
    if (const size_t end = data.find('\0'); (type == "tEXt" || type == "iTXt") && end != std::string_view::npos) {
      std::string_view text = data.substr(end + 1);
      if (type == "iTXt") {
        // Two bytes of compression, then language and translated keyword, each ended by a zero.
        if (text.size() < 2 || text[0] != 0) text = {};
        text = text.substr(std::min<size_t>(2, text.size()));
        for (int i = 0; i < 2; ++i)
          text = text.find('\0') == std::string_view::npos ? std::string_view() : text.substr(text.find('\0') + 1);
      }
      texts.emplace_back(data.substr(0, end), text);
    }
    if (type == "IEND") break;
    at += 12 + length;
  }
  return texts;
}

}  // namespace tunica
