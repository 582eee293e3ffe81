// SPDX-License-Identifier: MIT
#include "lua/surroundings_table.h"

#include <algorithm>

#include "lua/table_reader.h"

namespace tunica::lua {
namespace {

constexpr size_t most_colours = 64;  // of a bar; a terminal shows no more

void set_number(lua_State* L, const char* name, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, name);
}
void set_text(lua_State* L, const char* name, const std::string& text) {
  lua_pushlstring(L, text.data(), text.size());
  lua_setfield(L, -2, name);
}

void push_colour(lua_State* L, const Colour& c) {
  const auto byte = [](float part) { return std::lround(255 * std::clamp(part, 0.f, 1.f)); };
  lua_pushstring(L, fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b)).c_str());
}

void push_bar(lua_State* L, const ColourBar& bar) {
  lua_newtable(L);
  set_number(L, "min", bar.min);
  set_number(L, "max", bar.max);
  set_text(L, "title", bar.title);
  lua_newtable(L);
  const size_t count = std::min(bar.colours.size(), most_colours);
  for (size_t i = 0; i < count; ++i) {
    push_colour(L, bar.colours[count > 1 ? i * (bar.colours.size() - 1) / (count - 1) : 0]);
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
  lua_setfield(L, -2, "colours");
}

/// Calls `read(reader)` for each table in the list under a name.
template <class Read>
void each_table(const TableReader& reader, const char* name, Read&& read) {
  if (!reader.push(name)) return;
  lua_State* L = reader.state();
  check_table(L, -1, name);
  const int list = lua_gettop(L);
  for (int i = 1, size = static_cast<int>(lua_objlen(L, list)); i <= size; ++i) {
    lua_rawgeti(L, list, i);
    check_table(L, -1, name);
    read(TableReader(L, list + 1));
    lua_settop(L, list);
  }
  lua_pop(L, 1);
}

std::vector<Colour> read_colours(const TableReader& reader) {
  std::vector<Colour> colours;
  if (!reader.push("colours")) return colours;
  lua_State* L = reader.state();
  check_table(L, -1, "colours");
  for (int i = 1, size = static_cast<int>(lua_objlen(L, -1)); i <= size; ++i) {
    lua_rawgeti(L, -1, i);
    colours.push_back(parse_colour(check_string(L, -1, "a colour")));
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  return colours;
}

}  // namespace

void push_surroundings(lua_State* L, const Surroundings& around) {
  lua_newtable(L);
  set_text(L, "title", around.title);
  set_number(L, "x", around.content.x);
  set_number(L, "y", around.content.y);
  set_number(L, "width", around.content.width);
  set_number(L, "height", around.content.height);
  lua_newtable(L);
  for (size_t i = 0; i < around.bars.size(); ++i) {
    push_bar(L, around.bars[i]);
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
  lua_setfield(L, -2, "bars");
  lua_newtable(L);
  for (size_t i = 0; i < around.keys.size(); ++i) {
    lua_newtable(L);
    set_text(L, "text", around.keys[i].text);
    push_colour(L, around.keys[i].colour);
    lua_setfield(L, -2, "colour");
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
  lua_setfield(L, -2, "keys");
}

Surroundings read_surroundings(lua_State* L, int at) {
  Surroundings around;
  if (lua_isnoneornil(L, at)) return around;
  check_table(L, at, "what is around a picture");
  const TableReader reader(L, at);
  constexpr double most = 1e6;
  around.title = reader.text("title").value_or("");
  around.content = {reader.number("x", -most, most, 0), reader.number("y", -most, most, 0),
                    reader.number("width", 0, most, most), reader.number("height", 0, most, most)};
  each_table(reader, "bars", [&](const TableReader& bar) {
    around.bars.push_back({read_colours(bar), bar.number("min").value_or(0), bar.number("max").value_or(1),
                           bar.text("title").value_or("")});
  });
  each_table(reader, "keys", [&](const TableReader& key) {
    around.keys.push_back({parse_colour(key.text("colour").value_or("white")), key.text("text").value_or("")});
  });
  return around;
}

}  // namespace tunica::lua
