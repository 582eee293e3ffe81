// SPDX-License-Identifier: MIT
#include "view/terminal.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "view/png.h"
#include "view/surroundings.h"

namespace tunica {
namespace {

using Environment = std::map<std::string, std::string>;

Picture gradient(int width, int height) {
  Picture p{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int v : {x * 255 / width, y * 255 / height, 90, 255}) p.rgba.push_back(static_cast<uint8_t>(v));
  return p;
}

TEST(Terminal, TellsAnswersFromKeys) {
  const Reply reply = split_reply("ru\033[A\033_Gi=31;OK\033\\n(5)\n\033[?62;4c\xc3\xa9");
  EXPECT_EQ(reply.answers, "\033_Gi=31;OK\033\\\033[?62;4c");
  EXPECT_EQ(reply.typed, "ru\033[An(5)\n\xc3\xa9");
  EXPECT_TRUE(reply.complete);
  EXPECT_FALSE(split_reply("c\033[?62").complete);
  EXPECT_EQ(split_reply("c\033[?62").typed, "c");
}

TEST(Terminal, ChoosesTheProtocol) {
  struct Case {
    Environment environment;
    const char* reply;
    ImageProtocol expected;
  };
  const std::string kitty = "\033_Gi=31;OK\033\\\033[?62;c", sixel = "\033[?62;4;22c", plain = "\033[?62;22c";
  const Case cases[] = {
      {{{"TERM", "xterm-256color"}}, "", ImageProtocol::blocks},
      {{{"TERM", "xterm-256color"}}, kitty.c_str(), ImageProtocol::kitty},
      {{{"TERM", "xterm-256color"}}, sixel.c_str(), ImageProtocol::sixel},
      {{{"TERM", "xterm-256color"}}, plain.c_str(), ImageProtocol::blocks},
      {{{"TERM", "xterm"}}, "\033[?4c", ImageProtocol::blocks},  // a device class, not the graphics attribute
      {{{"TERM", "xterm-kitty"}}, "", ImageProtocol::kitty},
      {{{"TERM", "xterm-256color"}, {"TERM_PROGRAM", "iTerm.app"}}, "", ImageProtocol::iterm},
      {{{"TERM", "xterm-256color"}, {"LC_TERMINAL", "iTerm2"}}, "", ImageProtocol::iterm},
      {{{"TERM", "xterm-256color"}, {"TERM_PROGRAM", "WezTerm"}}, "", ImageProtocol::sixel},
      {{{"TERM", "foot"}}, "", ImageProtocol::sixel},
      {{{"TERM", "tmux-256color"}, {"KITTY_WINDOW_ID", "1"}}, "", ImageProtocol::blocks},
      {{{"TERM", "screen"}}, "", ImageProtocol::blocks},
      {{{"TERM", "tmux-256color"}}, sixel.c_str(), ImageProtocol::sixel},
      {{{"TERM", "linux"}}, "", ImageProtocol::blocks},
      {{{"TERM", "dumb"}}, kitty.c_str(), ImageProtocol::off},
      {{{"TERM", "vt100"}}, "", ImageProtocol::off},
      {{}, "", ImageProtocol::off},
      {{{"TERM", "xterm-256color"}, {"NO_COLOR", "1"}}, "", ImageProtocol::off},
      {{{"TERM", "xterm-kitty"}, {"NO_COLOR", "1"}}, "", ImageProtocol::kitty},
      {{{"TERM", "dumb"}, {"TUNICA_IMAGES", "sixel"}}, "", ImageProtocol::sixel},
      {{{"TERM", "xterm-kitty"}, {"TUNICA_IMAGES", "none"}}, "", ImageProtocol::off},
  };
  for (const Case& c : cases) {
    const Terminal terminal{true, c.environment, c.reply};
    EXPECT_EQ(choose_protocol(terminal), c.expected)
        << (c.environment.count("TERM") ? c.environment.at("TERM") : "") << ": " << name_of(choose_protocol(terminal));
  }
}

TEST(Terminal, ShowsNothingWhereThereIsNoTerminal) {
  EXPECT_EQ(choose_protocol({false, {{"TERM", "xterm-kitty"}}, ""}), ImageProtocol::off);
  EXPECT_EQ(terminal_picture(gradient(20, 20), ImageProtocol::off, {}, 80, 24), "");
}

TEST(Terminal, RefusesAnUnknownOverride) {
  EXPECT_THROW(choose_protocol({true, {{"TUNICA_IMAGES", "kity"}}, ""}), Error);
  EXPECT_THROW(terminal_picture(gradient(20, 20), ImageProtocol::kitty, {}, 0, 24), Error);
}

/// What base64 stands for; unknown characters are left out.
std::string decoded(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (digits.find(c) == std::string::npos) continue;
    bits = (bits << 6) | static_cast<uint32_t>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>((bits >> (count -= 8)) & 255);
  }
  return bytes;
}

TEST(Terminal, KittyGetsThePngInPieces) {
  Picture p = gradient(300, 200);
  for (size_t i = 0; i < p.rgba.size(); i += 4) p.rgba[i] = static_cast<uint8_t>(i * 2654435761u >> 13);
  const std::string text = terminal_picture(p, ImageProtocol::kitty, {}, 80, 24);
  EXPECT_EQ(text.rfind("\033_Ga=T,f=100,q=2,c=72,r=24,m=1;", 0), 0u) << text.substr(0, 40);
  std::string data;
  size_t at = 0, pieces = 0;
  while ((at = text.find("\033_G", at)) != std::string::npos) {
    const size_t start = text.find(';', at) + 1, end = text.find("\033\\", start);
    EXPECT_LE(end - start, 4096u);
    const bool more = text.substr(at, start - at).find("m=1") != std::string::npos;
    EXPECT_EQ(more, text.find("\033_G", end) != std::string::npos);
    data += text.substr(start, end - start);
    at = end;
    ++pieces;
  }
  EXPECT_GT(pieces, 1u);
  EXPECT_EQ(decoded(data), encode_png(p));
}

TEST(Terminal, ItermGetsThePng) {
  const Picture p = gradient(30, 20);
  const std::string text = terminal_picture(p, ImageProtocol::iterm, {}, 80, 24), png = encode_png(p);
  EXPECT_EQ(text.rfind("\033]1337;File=inline=1;size=" + std::to_string(png.size()) + ";", 0), 0u);
  const size_t start = text.find(':') + 1;
  EXPECT_EQ(decoded(text.substr(start, text.find('\a') - start)), png);
}

TEST(Terminal, SixelsAndBlocksAreWhatTheySay) {
  const Picture p = gradient(100, 100);
  const std::string sixels = terminal_picture(p, ImageProtocol::sixel, {}, 20, 20);
  EXPECT_EQ(sixels.find("\033P"), sixels.find_first_of("\033"));
  EXPECT_NE(sixels.find("\033\\"), std::string::npos);

  const Terminal rich{true, {{"TERM", "xterm-256color"}, {"COLORTERM", "truecolor"}, {"LANG", "en_GB.UTF-8"}}, ""};
  const std::string blocks = terminal_picture(p, ImageProtocol::blocks, rich, 20, 20);
  EXPECT_EQ(std::count(blocks.begin(), blocks.end(), '\n'), 10);
  EXPECT_NE(blocks.find("38;2;"), std::string::npos);

  const Terminal some{true, {{"TERM", "screen-256color"}, {"COLORTERM", "truecolor"}, {"LANG", "C"}}, ""};
  const std::string poor = terminal_picture(p, ImageProtocol::blocks, some, 20, 20);
  EXPECT_EQ(poor.find("38;2;"), std::string::npos);
  for (const char c : poor) EXPECT_LT(static_cast<unsigned char>(c), 128);
}

/// Without control sequences.
std::string plain(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\033')
      while (i + 1 < text.size() && !std::isalpha(static_cast<unsigned char>(text[i]))) ++i;
    else
      out += text[i];
  return out;
}

TEST(Terminal, BlocksHaveTheirLegendAsText) {
  const Terminal rich{true, {{"TERM", "xterm-256color"}, {"COLORTERM", "truecolor"}, {"LANG", "en_GB.UTF-8"}}, ""};
  const Picture p = gradient(100, 100);
  const Surroundings around{
      {10, 20, 60, 60}, "t = 8", {{{{0, 0, 0, 1}, {0, 1, 0, 1}}, -4, 4, "auxin"}}, {{{1, 0, 0, 1}, "pin (full: 4.2)"}}};
  const std::string all = terminal_picture(p, around, ImageProtocol::blocks, rich, 80, 30), text = plain(all);
  EXPECT_EQ(text.find("  "), 0u);
  EXPECT_LT(text.find("t = 8"), text.find('\n'));
  for (const char* word : {"auxin", " 4", " 2", " 0", "\u22122", "pin (full: 4.2)"})
    EXPECT_NE(text.find(word), std::string::npos) << word << text;
  EXPECT_LT(text.find(" 4"), text.find("\u22122"));
  // The bar runs from green above to black, then comes the key's red; in its row the colours end before the text.
  const size_t green = all.find("8;2;0;255;0"), red = all.find("8;2;255;0;0");
  EXPECT_LT(green, red);
  EXPECT_NE(red, std::string::npos);
  EXPECT_EQ(all.substr(all.find(" pin (full") - 4, 4), "\033[0m");
  // What was written as text is not drawn: the content alone fills the height left by the title.
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 30);
  for (size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
    const auto line = text.substr(at, end - at);
    EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; }), 80);
  }
  // Narrow: below. Elsewhere the picture is what it is.
  const std::string narrow = plain(terminal_picture(p, around, ImageProtocol::blocks, rich, 24, 30));
  EXPECT_NE(narrow.find("\nauxin\n"), std::string::npos) << narrow;
  EXPECT_EQ(terminal_picture(p, around, ImageProtocol::sixel, rich, 40, 20),
            terminal_picture(p, ImageProtocol::sixel, rich, 40, 20));
  const Terminal poor{true, {{"TERM", "screen-256color"}, {"LANG", "C"}}, ""};
  for (const char c : terminal_picture(p, around, ImageProtocol::blocks, poor, 80, 30))
    EXPECT_LT(static_cast<unsigned char>(c), 128);
  EXPECT_NE(plain(terminal_picture(p, around, ImageProtocol::blocks, poor, 80, 30)).find("-2"), std::string::npos);
}

TEST(Terminal, LegendsOfAnySizeEnd) {
  const Terminal rich{true, {{"TERM", "xterm-256color"}, {"LANG", "C.UTF-8"}}, ""};
  const Picture p = gradient(33, 50);
  Surroundings around{{-5, -5, 1e6, 1e6}, std::string(300, 'x') + "\n\033[2J", {}, {}};
  for (int i = 0; i < 3; ++i) around.bars.push_back({{{0, 0, 0, 1}}, i * 1.0, i * 1.0, "\u00e4\u00f6"});
  around.bars.push_back({{}, NAN, 1, ""});
  for (int i = 0; i < 20; ++i) around.keys.push_back({{1, 0, 0, 1}, std::string(100, 'y')});
  for (const int columns : {1, 2, 5, 20, 80, 300})
    for (const int rows : {1, 2, 5, 40}) {
      const std::string text = terminal_picture(p, around, ImageProtocol::blocks, rich, columns, rows);
      EXPECT_FALSE(text.empty());
      EXPECT_EQ(text.find("\033[2J"), std::string::npos);
    }
}

}  // namespace
}  // namespace tunica
