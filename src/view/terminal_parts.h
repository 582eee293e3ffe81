// SPDX-License-Identifier: MIT
#pragma once

#include "view/terminal.h"

namespace tunica {

struct Cells {
  int columns, rows;
};

/// The largest size with the picture's proportions; a cell is taken to be twice as high as wide.
Cells fit(const Picture& picture, int columns, int rows);

/// Coloured blocks: as many lines as rows, each as wide as the columns and with its colours ended.
std::string in_blocks(const Picture& picture, const Terminal& terminal, const Cells& cells);

/// Whether letters beyond ASCII can be written.
bool speaks_utf8(const Terminal& terminal);

}  // namespace tunica
