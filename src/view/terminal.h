// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "view/picture.h"

namespace tunica {

struct Surroundings;

/// Ways to show a picture within text: kitty's graphics protocol, iTerm2's inline files, sixels, coloured half blocks.
enum class ImageProtocol { off, kitty, iterm, sixel, blocks };
const char* name_of(ImageProtocol protocol);

/// What is known of a terminal.
struct Terminal {
  bool is_tty = false;
  std::map<std::string, std::string> environment;  ///< variables as in terminal_variables
  std::string reply;                               ///< what came back for image_query(), or ""
};

/// The environment variables that tell what a terminal can do.
extern const char* const terminal_variables[11];
/// Those of this process.
std::map<std::string, std::string> terminal_environment();

/// To be written to a terminal whose answer decides what it can show: asks for kitty's protocol, then for the primary
/// device attributes, which every terminal answers (last: "\033[?...c" ends the reply).
std::string image_query();

/// What comes from a terminal that was asked: its answers, and the keys typed before and in between.
struct Reply {
  std::string answers, typed;
  bool complete = false;  ///< the primary device attributes have come
};
Reply split_reply(std::string_view bytes);

/// How to show pictures: TUNICA_IMAGES (kitty, iterm, sixel, blocks, none) decides if it is set; none if this is not a
/// terminal, or one without cursor and colour (TERM dumb, vt100), or NO_COLOR; else by the reply and what is known of
/// terminals by name. Within tmux and screen, which do not pass graphics on, blocks.
/// Errors: TUNICA_IMAGES is something else (names the nearest).
ImageProtocol choose_protocol(const Terminal& terminal);

/// The characters that show a picture at most `columns` by `rows` cells large, ending in a newline; "" for none.
/// The kernel prints nothing: the caller writes them. Errors: columns or rows not within 1 to 10,000.
std::string terminal_picture(const Picture& picture, ImageProtocol protocol, const Terminal& terminal, int columns,
                             int rows);
/// The same; but blocks show the content alone, larger, and what is around it is text above and beside it.
std::string terminal_picture(const Picture& picture, const Surroundings& around, ImageProtocol protocol,
                             const Terminal& terminal, int columns, int rows);

}  // namespace tunica
