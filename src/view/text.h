// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "view/scene.h"

namespace tunica {

/// Width of a line of text in pixels (UTF-8; broken bytes show as a replacement mark).
/// Errors: no font (the message names the package).
double text_width(std::string_view text, double size);

/// Draws a line of text into premultiplied pixels. (x, y) is the point the text is placed by, in pixels; `size` is the
/// font's (about 1.4 times the height of a capital). Letters are placed to a quarter of a pixel, smoothed in grey.
void draw_text(std::vector<uint8_t>& pixels, int width, int height, std::string_view text, double x, double y,
               double size, const Colour& colour, Label::Across across, Label::Along along);

}  // namespace tunica
