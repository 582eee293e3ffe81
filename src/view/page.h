// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "view/colour.h"
#include "view/picture.h"

namespace tunica {

/// A picture on a page, with words below it.
struct Tile {
  Picture picture;
  std::string caption;
};

struct PageSettings {
  int columns = 0;       ///< 0: as square as it gets
  int gap = 12;          ///< pixels between pictures and around them
  double font_size = 0;  ///< of captions, in pixels; 0: by the pictures' size
  std::string title;
  Colour background = white;
};

/// Many pictures in one, row by row, each in the middle of a place as large as the largest; transparent ones let the
/// page's ground through. Errors: no pictures; settings that are no sizes; a page larger than a picture can be.
Picture page_of(const std::vector<Tile>& tiles, const PageSettings& settings);

}  // namespace tunica
