// SPDX-License-Identifier: MIT
#include "lua/view_settings.h"

#include <cmath>

#include "lua/bind_tissue.h"
#include "lua/table_reader.h"

namespace tunica::lua {
namespace {

/// Calls the function at the top of the stack for every element; `take(index)` reads the `results` it returned from the
/// top. Pops the function.
template <class Take>
void for_each_element(lua_State* L, Tissue& tissue, Kind kind, int results, Take&& take) {
  const Entering entering(L);
  const Locked lock(tissue);
  const int function = lua_gettop(L);
  for (Index i = 0; i < tissue.count(kind); ++i) {
    lua_pushvalue(L, function);
    push_element(L, 1, kind, i);
    call(L, 1, results);
    take(i);
    lua_settop(L, function);
  }
  lua_pop(L, 1);
}

/// A column's name, or a function of the elements (nil: no value).
Field read_field(const TableReader& reader, Tissue& tissue, Kind kind, const char* key, const char* title) {
  Field field;
  field.title = reader.text(title).value_or("");
  if (!reader.push(key)) return field;
  lua_State* L = reader.state();
  if (!lua_isfunction(L, -1)) {
    field.column = check_string(L, -1, key);
    if (field.column.empty()) fail("'{}' must be the name of a column, came empty text", key);
    lua_pop(L, 1);
    return field;
  }
  field.values.reserve(static_cast<size_t>(tissue.count(kind)));
  for_each_element(L, tissue, kind, 1, [&](Index) {
    if (!lua_isnil(L, -1) && lua_type(L, -1) != LUA_TNUMBER)
      fail("the function of '{}' must return a number or nil, returned {}", key, describe(L, -1));
    field.values.push_back(lua_isnil(L, -1) ? std::nan("") : lua_tonumber(L, -1));
  });
  return field;
}

/// `marked`: a function of the cells, or a list of cells.
void read_marked(const TableReader& reader, Tissue& tissue, ViewSettings& s) {
  if (!reader.push("marked")) return;
  lua_State* L = reader.state();
  s.marked.assign(static_cast<size_t>(tissue.cells()), 0);
  if (lua_isfunction(L, -1)) {
    for_each_element(L, tissue, Kind::cell, 1,
                     [&](Index i) { s.marked[static_cast<size_t>(i)] = static_cast<char>(lua_toboolean(L, -1)); });
    return;
  }
  check_table(L, -1, "'markers'");
  for (size_t i = 1, size = lua_objlen(L, -1); i <= size; ++i) {
    lua_rawgeti(L, -1, static_cast<int>(i));
    s.marked[static_cast<size_t>(check_element(L, lua_gettop(L), Kind::cell, tissue))] = 1;
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
}

Marker::Shape read_shape(const TableReader& reader) {
  const std::vector<std::string> names = {"disc", "ring", "square", "triangle", "cross", "plus"};
  const std::string name = reader.text("marker_shape").value_or("ring");
  for (size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<Marker::Shape>(i);
  fail("there is no marker '{}': expected one of {}{}", name, fmt::join(names, ", "), did_you_mean(name, names));
}

/// `labels`: "id", the name of a column, or a function of the cells that returns text, a number or nil.
void read_labels(const TableReader& reader, Tissue& tissue, ViewSettings& s) {
  if (!reader.push("labels")) return;
  lua_State* L = reader.state();
  if (lua_isfunction(L, -1)) {
    for_each_element(L, tissue, Kind::cell, 1, [&](Index) {
      const int type = lua_type(L, -1);
      if (type != LUA_TSTRING && type != LUA_TNUMBER && type != LUA_TNIL)
        fail("the function of 'labels' must return text, a number or nil, returned {}", describe(L, -1));
      s.labels.push_back(type == LUA_TNUMBER ? fmt::format("{:.4g}", lua_tonumber(L, -1))
                         : type == LUA_TNIL  ? ""
                                             : check_string(L, -1, "'labels'"));
    });
    return;
  }
  const std::string what = check_string(L, -1, "'labels'");
  lua_pop(L, 1);
  const Column* column = what == "id" ? nullptr : &tissue.column(Kind::cell, what);
  for (Index c = 0; c < tissue.cells(); ++c)
    s.labels.push_back(column ? fmt::format("{:.3g}", column->values[static_cast<size_t>(c)])
                              : std::to_string(tissue.id(Kind::cell, c)));
}

void read_places(const TableReader& reader, Tissue& tissue, ViewSettings& s) {
  if (!reader.push("place")) return;
  lua_State* L = reader.state();
  check_function(L, -1, "'place'");
  s.place.reserve(static_cast<size_t>(tissue.cells()));
  for_each_element(L, tissue, Kind::cell, 3, [&](Index) {
    constexpr const char* what = "a coordinate that the function of 'place' returns";
    const double x = check_number(L, -3, what), y = check_number(L, -2, what);
    s.place.emplace_back(x, y, lua_isnil(L, -1) ? 0 : check_number(L, -1, what));
  });
}

void read_camera(const TableReader& settings, ViewSettings& s) {
  if (!settings.push("camera")) return;
  lua_State* L = settings.state();
  check_table(L, -1, "'camera'");
  {
    const TableReader reader(L, lua_gettop(L));
    Camera camera;
    camera.direction = reader.vector("direction").value_or(camera.direction);
    camera.up = reader.vector("up").value_or(camera.up);
    camera.perspective = reader.boolean("perspective").value_or(false);
    camera.zoom = reader.number("zoom", 1e-3, 1e6, 1);
    camera.centre = reader.vector("centre");
    camera.extent = reader.number("extent");
    s.camera = camera;
  }
  lua_pop(L, 1);
}

void read_sides(const TableReader& reader, Tissue& tissue, ViewSettings& s) {
  s.sides = read_field(reader, tissue, Kind::side, "sides", "sides_title");
  s.sides_max = reader.number("sides_max");
  if (s.sides_max && !(*s.sides_max > 0)) fail("the value of the widest band must be positive, came {}", *s.sides_max);
  if (const auto colour = reader.text("sides_colour")) s.sides_colour = parse_colour(*colour);
  s.sides_width = reader.number("sides_width", 0, 1, s.sides_width);
  const std::string style = reader.text("sides_style").value_or("width");
  if (style != "width" && style != "intensity")
    fail("the style of sides is 'width' or 'intensity', not '{}'{}", style,
         did_you_mean(style, {"width", "intensity"}));
  s.sides_by_width = style == "width";
}

}  // namespace

std::optional<Palette> read_palette(const TableReader& reader) {
  if (!reader.push("palette")) return std::nullopt;
  lua_State* L = reader.state();
  if (!lua_istable(L, -1)) {
    const std::string name = check_string(L, -1, "'palette'");
    lua_pop(L, 1);
    return palette(name);
  }
  std::vector<Colour> colours;
  for (int i = 1; i <= static_cast<int>(std::min<size_t>(lua_objlen(L, -1), 1000)); ++i) {
    lua_rawgeti(L, -1, i);
    colours.push_back(parse_colour(check_string(L, -1, "a colour of 'palette'")));
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  return palette_through(colours);
}

PngTexts read_picture_texts(lua_State* L, int at) {
  PngTexts texts;
  if (lua_isnoneornil(L, at)) return texts;
  check_table(L, at, "the texts of a PNG");
  for (int i = 1, size = static_cast<int>(lua_objlen(L, at)); i <= size; ++i) {
    lua_rawgeti(L, at, i);
    check_table(L, -1, "a text of a PNG");
    lua_rawgeti(L, -1, 1);
    lua_rawgeti(L, -2, 2);
    texts.emplace_back(check_string(L, -2, "a keyword"), check_string(L, -1, "a text"));
    lua_pop(L, 3);
  }
  return texts;
}

ViewSettings read_view_settings(lua_State* L, Tissue& tissue, int table) {
  check_table(L, table, "the settings of a view");
  const TableReader reader(L, table);
  ViewSettings s;
  s.width = static_cast<int>(reader.number("width", 0, max_picture_side, 0));
  s.height = static_cast<int>(reader.number("height", 0, max_picture_side, 0));
  s.title = reader.text("title").value_or("");
  if (const auto colour = reader.text("background")) s.background = parse_colour(*colour);
  if (reader.boolean("transparent").value_or(false)) s.background = clear;
  s.colour = read_field(reader, tissue, Kind::cell, "colour", "colour_title");
  s.min = reader.number("min");
  s.max = reader.number("max");
  s.palette = read_palette(reader).value_or(palette("viridis"));
  if (const auto colour = reader.text("missing")) s.palette.missing = parse_colour(*colour);
  s.missing_title = reader.text("missing_title").value_or(s.missing_title);
  if (const auto colour = reader.text("plain")) s.plain = parse_colour(*colour);
  read_sides(reader, tissue, s);
  if (const auto colour = reader.text("outline")) s.outline = parse_colour(*colour);
  if (reader.number("outline_width")) s.outline_width = reader.number("outline_width", 0, 100, 0);
  s.legend = reader.boolean("legend").value_or(true);
  read_marked(reader, tissue, s);
  s.marker = read_shape(reader);
  if (const auto colour = reader.text("marker_colour")) s.marker_colour = parse_colour(*colour);
  s.marker_size = reader.number("marker_size", 0, 1000, 0);
  read_labels(reader, tissue, s);
  s.bars = reader.boolean("bars");
  read_places(reader, tissue, s);
  s.wireframe = reader.boolean("wireframe").value_or(false);
  read_camera(reader, s);
  s.light = reader.boolean("light");
  return s;
}

}  // namespace tunica::lua
