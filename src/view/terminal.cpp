// SPDX-License-Identifier: MIT
#include "view/terminal.h"

#include <chafa.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "base/error.h"
#include "view/png.h"
#include "view/terminal_parts.h"

namespace tunica {

const char* const terminal_variables[11] = {
    "TUNICA_IMAGES",   "TERM",     "TERM_PROGRAM", "LC_TERMINAL", "COLORTERM", "TMUX",
    "KITTY_WINDOW_ID", "NO_COLOR", "LC_ALL",       "LC_CTYPE",    "LANG"};

namespace {

constexpr std::pair<std::string_view, ImageProtocol> protocols[] = {{"none", ImageProtocol::off},
                                                                    {"kitty", ImageProtocol::kitty},
                                                                    {"iterm", ImageProtocol::iterm},
                                                                    {"sixel", ImageProtocol::sixel},
                                                                    {"blocks", ImageProtocol::blocks}};

std::string value_of(const Terminal& terminal, const char* name) {
  const auto found = terminal.environment.find(name);
  return found == terminal.environment.end() ? std::string() : found->second;
}

bool starts(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }
bool contains(std::string_view text, std::string_view what) { return text.find(what) != std::string_view::npos; }

/// Whether "\033[?62;4;22c" lists 4: sixel graphics.
bool reply_has_sixel(std::string_view reply) {
  const size_t start = reply.rfind("\033[?"), end = reply.find('c', start == std::string_view::npos ? 0 : start);
  if (start == std::string_view::npos || end == std::string_view::npos) return false;
  const std::string list = ";" + std::string(reply.substr(start + 3, end - start - 3)) + ";";
  return list.find(";4;", list.find(';', 1)) != std::string::npos;
}

ImageProtocol by_name(const Terminal& terminal) {
  const std::string term = value_of(terminal, "TERM"), program = value_of(terminal, "TERM_PROGRAM");
  if (term == "xterm-kitty" || term == "xterm-ghostty" || program == "ghostty" ||
      !value_of(terminal, "KITTY_WINDOW_ID").empty())
    return ImageProtocol::kitty;
  if (program == "iTerm.app" || value_of(terminal, "LC_TERMINAL") == "iTerm2") return ImageProtocol::iterm;
  if (program == "WezTerm" || starts(term, "foot") || starts(term, "mlterm") || starts(term, "contour"))
    return ImageProtocol::sixel;
  return ImageProtocol::blocks;
}

/// Colours of blocks; not by chafa's own table, which is wrong for some plain terminals.
ChafaCanvasMode colours_of(const Terminal& terminal) {
  const std::string term = value_of(terminal, "TERM"), colours = value_of(terminal, "COLORTERM");
  const bool multiplexed = starts(term, "screen") || starts(term, "tmux");
  if (!multiplexed && (colours == "truecolor" || colours == "24bit")) return CHAFA_CANVAS_MODE_TRUECOLOR;
  if (contains(term, "direct") || contains(term, "kitty") || contains(term, "ghostty") || starts(term, "foot") ||
      starts(term, "alacritty"))
    return CHAFA_CANVAS_MODE_TRUECOLOR;
  if (multiplexed || contains(term, "256")) return CHAFA_CANVAS_MODE_INDEXED_256;
  return term == "linux" ? CHAFA_CANVAS_MODE_INDEXED_16_8 : CHAFA_CANVAS_MODE_INDEXED_16;
}

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = (group << 8) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (size_t k = 0; k < 4; ++k) text += k <= count ? digits[(group >> (18 - 6 * k)) & 63] : '=';
  }
  return text;
}

/// The PNG itself, in pieces of at most 4096 characters; q=2: no answers, which would look like typed keys.
std::string kitty(const Picture& picture, const Cells& cells) {
  const std::string data = base64(encode_png(picture));
  std::string out;
  constexpr size_t piece = 4096;
  for (size_t i = 0; i < data.size(); i += piece) {
    const int more = i + piece < data.size();
    out += i == 0 ? fmt::format("\033_Ga=T,f=100,q=2,c={},r={},m={};", cells.columns, cells.rows, more)
                  : fmt::format("\033_Gm={};", more);
    out += data.substr(i, piece);
    out += "\033\\";
  }
  return out + "\n";
}

std::string iterm(const Picture& picture, const Cells& cells) {
  const std::string png = encode_png(picture);
  return fmt::format("\033]1337;File=inline=1;size={};width={};preserveAspectRatio=1:{}\a\n", png.size(), cells.columns,
                     base64(png));
}

struct Unref {
  void operator()(ChafaCanvasConfig* p) const { chafa_canvas_config_unref(p); }
  void operator()(ChafaCanvas* p) const { chafa_canvas_unref(p); }
  void operator()(ChafaSymbolMap* p) const { chafa_symbol_map_unref(p); }
  void operator()(ChafaTermInfo* p) const { chafa_term_info_unref(p); }
  void operator()(GString* p) const { g_string_free(p, TRUE); }
};
template <class T>
using Held = std::unique_ptr<T, Unref>;

/// Control sequences as a capable terminal takes them; which terminal this is was decided by choose_protocol.
Held<ChafaTermInfo> sequences(ImageProtocol protocol) {
  std::string term = protocol == ImageProtocol::sixel ? "TERM=mlterm" : "TERM=xterm-256color";
  std::string colour = "COLORTERM=truecolor";
  gchar* environment[] = {term.data(), colour.data(), nullptr};
  return Held<ChafaTermInfo>(chafa_term_db_detect(chafa_term_db_get_default(), environment));
}

std::string by_chafa(const Picture& picture, ImageProtocol protocol, const Terminal& terminal, const Cells& cells) {
  const Held<ChafaCanvasConfig> config(chafa_canvas_config_new());
  const Held<ChafaSymbolMap> symbols(chafa_symbol_map_new());
  const bool plain = !speaks_utf8(terminal), console = value_of(terminal, "TERM") == "linux";
  chafa_symbol_map_add_by_tags(symbols.get(), CHAFA_SYMBOL_TAG_SPACE);
  if (plain) {
    chafa_symbol_map_add_by_tags(symbols.get(), CHAFA_SYMBOL_TAG_ASCII);
  } else {
    chafa_symbol_map_add_by_tags(symbols.get(), CHAFA_SYMBOL_TAG_SOLID);
    chafa_symbol_map_add_by_tags(symbols.get(), console ? CHAFA_SYMBOL_TAG_VHALF : CHAFA_SYMBOL_TAG_BLOCK);
  }
  chafa_canvas_config_set_geometry(config.get(), cells.columns, cells.rows);
  chafa_canvas_config_set_cell_geometry(config.get(), 10, 20);
  chafa_canvas_config_set_symbol_map(config.get(), symbols.get());
  const bool sixel = protocol == ImageProtocol::sixel;
  chafa_canvas_config_set_pixel_mode(config.get(), sixel ? CHAFA_PIXEL_MODE_SIXELS : CHAFA_PIXEL_MODE_SYMBOLS);
  chafa_canvas_config_set_canvas_mode(config.get(), sixel ? CHAFA_CANVAS_MODE_TRUECOLOR : colours_of(terminal));
  const Held<ChafaCanvas> canvas(chafa_canvas_new(config.get()));
  chafa_canvas_draw_all_pixels(canvas.get(), CHAFA_PIXEL_RGBA8_UNASSOCIATED, picture.rgba.data(), picture.width,
                               picture.height, picture.width * 4);
  const Held<ChafaTermInfo> info = sequences(protocol);
  const Held<GString> text(chafa_canvas_print(canvas.get(), info.get()));
  return std::string(text->str, text->len) + "\n";
}

}  // namespace

bool speaks_utf8(const Terminal& terminal) {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    std::string value = value_of(terminal, name);
    if (value.empty()) continue;
    std::transform(value.begin(), value.end(), value.begin(), [](unsigned char c) { return std::tolower(c); });
    return contains(value, "utf-8") || contains(value, "utf8");
  }
  return false;
}

Cells fit(const Picture& picture, int columns, int rows) {
  const double ratio = static_cast<double>(picture.height) / picture.width / 2;
  const double wide = std::min<double>(columns, rows / ratio);
  return {std::max(1, static_cast<int>(std::lround(wide))), std::max(1, static_cast<int>(std::lround(wide * ratio)))};
}

std::string in_blocks(const Picture& picture, const Terminal& terminal, const Cells& cells) {
  return by_chafa(picture, ImageProtocol::blocks, terminal, cells);
}

const char* name_of(ImageProtocol protocol) {
  for (const auto& [name, value] : protocols)
    if (value == protocol) return name.data();
  return "none";
}

std::map<std::string, std::string> terminal_environment() {
  std::map<std::string, std::string> environment;
  for (const char* name : terminal_variables)
    if (const char* value = std::getenv(name)) environment[name] = value;
  return environment;
}

std::string image_query() { return "\033_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\033\\\033[c"; }

Reply split_reply(std::string_view bytes) {
  constexpr std::pair<std::string_view, std::string_view> answers[] = {{"\033_G", "\033\\"}, {"\033[?", "c"}};
  Reply reply;
  while (!bytes.empty()) {
    size_t length = 0;
    for (const auto& [start, end] : answers) {
      if (!starts(bytes, start)) continue;
      const size_t last = bytes.find(end, start.size());
      length = last == std::string_view::npos ? bytes.size() : last + end.size();
      reply.complete = reply.complete || (end == "c" && last != std::string_view::npos);
    }
    (length ? reply.answers : reply.typed) += bytes.substr(0, std::max<size_t>(1, length));
    bytes.remove_prefix(std::max<size_t>(1, length));
  }
  return reply;
}

ImageProtocol choose_protocol(const Terminal& terminal) {
  const std::string wanted = value_of(terminal, "TUNICA_IMAGES"), term = value_of(terminal, "TERM");
  if (!wanted.empty()) {
    std::vector<std::string> known;
    for (const auto& [name, protocol] : protocols) {
      if (name == wanted) return protocol;
      known.emplace_back(name);
    }
    fail("TUNICA_IMAGES is '{}': expected one of {}{}", wanted, fmt::join(known, ", "), did_you_mean(wanted, known));
  }
  if (!terminal.is_tty || term.empty() || term == "dumb" || starts(term, "vt")) return ImageProtocol::off;
  const bool multiplexed = !value_of(terminal, "TMUX").empty() || starts(term, "screen") || starts(term, "tmux");
  ImageProtocol chosen = ImageProtocol::blocks;
  if (!multiplexed && contains(terminal.reply, "_Gi=31;OK"))
    chosen = ImageProtocol::kitty;
  else if (!multiplexed && by_name(terminal) != ImageProtocol::blocks)
    chosen = by_name(terminal);
  else if (reply_has_sixel(terminal.reply))
    chosen = ImageProtocol::sixel;
  if (chosen == ImageProtocol::blocks && !value_of(terminal, "NO_COLOR").empty()) return ImageProtocol::off;
  return chosen;
}

std::string terminal_picture(const Picture& picture, ImageProtocol protocol, const Terminal& terminal, int columns,
                             int rows) {
  if (columns < 1 || rows < 1 || columns > 10000 || rows > 10000)
    fail("a picture in a terminal is 1 to 10,000 columns and rows large, not {} x {}", columns, rows);
  const Cells cells = fit(picture, columns, rows);
  switch (protocol) {
    case ImageProtocol::off:
      return "";
    case ImageProtocol::kitty:
      return kitty(picture, cells);
    case ImageProtocol::iterm:
      return iterm(picture, cells);
    case ImageProtocol::sixel:
    case ImageProtocol::blocks:
      return by_chafa(picture, protocol, terminal, cells);
  }
  return "";
}

}  // namespace tunica
