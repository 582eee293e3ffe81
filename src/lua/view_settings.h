// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <optional>

#include "lua/table_reader.h"
#include "view/png.h"
#include "view/tissue_scene.h"

namespace tunica::lua {

/// The settings of a view from the table at a stack index, as lua/tunica/view.lua prepares it from what a user wrote;
/// everything is checked again. Functions in it are called for every element of the tissue, which must be at index 1.
/// Errors: wrong types, unknown names (name the nearest), values out of range; what such a function raises.
ViewSettings read_view_settings(lua_State* L, Tissue& tissue, int table);

/// The field `palette`: a name or a list of colours. Errors: as palette() and palette_through().
std::optional<Palette> read_palette(const TableReader& reader);

/// The texts to be kept in a PNG file, from a list of { keyword, text } at a stack index (nil: none).
PngTexts read_picture_texts(lua_State* L, int at);

}  // namespace tunica::lua
