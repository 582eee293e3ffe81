// SPDX-License-Identifier: MIT
// Pictures of apices and pages of pictures, from plain tables.
#include <cmath>

#include "lua/bind_tissue.h"
#include "lua/surroundings_table.h"
#include "lua/view_settings.h"
#include "view/apex_scene.h"
#include "view/page.h"
#include "view/png.h"
#include "view/render.h"

namespace tunica::lua {
namespace {

constexpr double degree = M_PI / 180;

/// Calls `read(stack index)` for every item of the list in a field; without the field it is not called.
template <class Read>
void each_item(const TableReader& reader, const char* key, Read&& read) {
  if (!reader.push(key)) return;
  lua_State* L = reader.state();
  check_table(L, -1, key);
  const int list = lua_gettop(L);
  for (size_t i = 1, size = lua_objlen(L, list); i <= size; ++i) {
    lua_rawgeti(L, list, static_cast<int>(i));
    read(lua_gettop(L));
    lua_settop(L, list);
  }
  lua_pop(L, 1);
}

std::vector<double> numbers(const TableReader& reader, const char* key) {
  std::vector<double> values;
  each_item(reader, key, [&](int at) { values.push_back(check_number(reader.state(), at, key)); });
  return values;
}

int whole(const TableReader& reader, const char* key, int low, int high, int otherwise) {
  const double value = reader.number(key, low, high, otherwise);
  if (value != std::floor(value)) fail("'{}' must be a whole number, came {}", key, value);
  return static_cast<int>(value);
}

std::vector<Bump> read_primordia(const TableReader& reader) {
  std::vector<Bump> primordia;
  lua_State* L = reader.state();
  each_item(reader, "primordia", [&](int at) {
    check_table(L, at, "a primordium");
    const TableReader each(L, at);
    Bump bump;
    const auto theta = each.number("theta"), arc = each.number("arc");
    if (!theta || !arc) fail("primordium {} has no '{}'", primordia.size() + 1, theta ? "arc" : "theta");
    bump.theta = *theta * degree, bump.arc = *arc;
    bump.age = each.number("age").value_or(0);
    bump.radius = each.number("radius"), bump.height = each.number("height");
    bump.value = each.number("value").value_or(0);
    if (each.number("number")) bump.number = whole(each, "number", -1e9, 1e9, 0);
    primordia.push_back(bump);
  });
  return primordia;
}

std::optional<FieldRing> read_ring(const TableReader& reader) {
  if (!reader.push("ring")) return std::nullopt;
  lua_State* L = reader.state();
  check_table(L, -1, "'ring'");
  const TableReader inside(L, lua_gettop(L));
  FieldRing ring;
  const auto arc = inside.number("arc");
  if (!arc) fail("the ring has no 'arc'");
  ring.arc = *arc;
  ring.values = numbers(inside, "values");
  ring.angles = numbers(inside, "angles");
  for (double& angle : ring.angles) angle *= degree;
  if (ring.angles.empty())
    for (size_t i = 0; i < ring.values.size(); ++i)
      ring.angles.push_back(2 * M_PI * static_cast<double>(i) / static_cast<double>(ring.values.size()));
  ring.threshold = inside.number("threshold");
  if (const auto chosen = inside.number("chosen")) ring.chosen = *chosen * degree;
  lua_pop(L, 1);
  return ring;
}

SurfaceField read_field(const TableReader& reader) {
  SurfaceField field;
  if (!reader.push("field")) return field;
  lua_State* L = reader.state();
  check_table(L, -1, "'field'");
  const TableReader inside(L, lua_gettop(L));
  field.angles = whole(inside, "angles", 0, 100000, 0);
  field.arcs = numbers(inside, "arcs");
  field.values = numbers(inside, "values");
  lua_pop(L, 1);
  return field;
}

ApexPicture read_apex(lua_State* L, int at) {
  check_table(L, at, "the data of an apex");
  const TableReader reader(L, at);
  ApexPicture apex;
  each_item(reader, "profile", [&](int item) {
    const Vec3 p = reader.vector_at(item, "a point of the profile");
    apex.profile.emplace_back(p.x(), p.y());
  });
  apex.primordia = read_primordia(reader);
  apex.ring = read_ring(reader);
  apex.field = read_field(reader);
  const auto pair = numbers(reader, "parastichies");
  if (!pair.empty()) {
    if (pair.size() != 2 || pair[0] != std::floor(pair[0]) || pair[1] != std::floor(pair[1]) ||
        std::max(pair[0], pair[1]) > 1e6)
      fail("'parastichies' must be two whole numbers, {{ m, n }}");
    apex.pair = {static_cast<int>(pair[0]), static_cast<int>(pair[1])};
  }
  apex.jugacy = whole(reader, "jugacy", 1, 1000, 1);
  return apex;
}

/// The place of a word in a list of words; errors name the nearest.
size_t choice(const TableReader& reader, const char* key, const std::vector<std::string>& words, size_t otherwise) {
  const auto given = reader.text(key);
  if (!given) return otherwise;
  for (size_t i = 0; i < words.size(); ++i)
    if (words[i] == *given) return i;
  fail("'{}' must be one of {}, not '{}'{}", key, fmt::join(words, ", "), *given, did_you_mean(*given, words));
}

ApexView read_view(lua_State* L, int at) {
  check_table(L, at, "the settings of a view");
  const TableReader reader(L, at);
  ApexView view;
  view.width = whole(reader, "width", 0, max_picture_side, 0);
  view.height = whole(reader, "height", 0, max_picture_side, 0);
  view.title = reader.text("title").value_or("");
  if (const auto colour = reader.text("background")) view.background = parse_colour(*colour);
  if (reader.boolean("transparent").value_or(false)) view.background = clear;
  view.from = static_cast<ApexView::From>(choice(reader, "from", {"top", "oblique", "side"}, 0));
  view.by = static_cast<ApexView::By>(choice(reader, "colour", {"plain", "age", "size", "value", "field"}, 1));
  view.map = static_cast<ApexView::Map>(choice(reader, "lattice", {"angles", "arc", "log"}, 0));
  view.turn = reader.number("turn", -1e6, 1e6, 0) * degree;
  view.zoom = reader.number("zoom", 1e-3, 1e6, 1);
  view.palette = read_palette(reader);
  view.min = reader.number("min"), view.max = reader.number("max");
  view.legend_title = reader.text("legend_title").value_or("");
  view.legend = reader.boolean("legend").value_or(true);
  if (const auto colour = reader.text("surface")) view.surface = parse_colour(*colour);
  if (const auto colour = reader.text("plain")) view.plain = parse_colour(*colour);
  view.parastichies = reader.boolean("parastichies").value_or(false);
  view.labels = reader.boolean("labels").value_or(false);
  view.arrows = reader.boolean("arrows").value_or(false);
  view.reach = reader.number("reach");
  return view;
}

int push_png(lua_State* L, const Picture& picture, const PngTexts& texts) {
  const std::string png = encode_png(picture, texts, &host(L).cancel);
  lua_pushlstring(L, png.data(), png.size());
  lua_pushinteger(L, picture.width);
  lua_pushinteger(L, picture.height);
  return 3;
}

/// draw_apex(data, settings [, texts]) -> bytes of a PNG, width, height, what is around its content. With `lattice`
/// among the settings ("angles", "arc" or "log") the apex is drawn unrolled. Angles are in degrees.
int draw_apex(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 3);
    const PngTexts texts = read_picture_texts(L, 3);
    const ApexPicture apex = read_apex(L, 1);
    ApexView view = read_view(L, 2);
    view.cancel = &host(L).cancel;
    const bool lattice = TableReader(L, 2).text("lattice").has_value();
    const Scene scene = lattice ? scene_of_lattice(apex, view) : scene_of_apex(apex, view);
    push_png(L, render(scene), texts);
    push_surroundings(L, surroundings_of(scene));
    return 4;
  });
}

/// page(list of { bytes of a PNG, caption or nil }, settings [, texts]) -> bytes of a PNG, width, height
int page(lua_State* L) {
  return guard(L, [&] {
    lua_settop(L, 3);
    const PngTexts texts = read_picture_texts(L, 3);
    check_table(L, 1, "the pictures of a page");
    std::vector<Tile> tiles;
    for (size_t i = 1, size = lua_objlen(L, 1); i <= size; ++i) {
      lua_rawgeti(L, 1, static_cast<int>(i));
      check_table(L, -1, "a picture of a page");
      lua_rawgeti(L, -1, 1);
      lua_rawgeti(L, -2, 2);
      tiles.push_back({decode_png(check_string(L, -2, "a picture of a page")),
                       lua_isnil(L, -1) ? "" : check_string(L, -1, "a caption")});
      lua_settop(L, 3);
    }
    check_table(L, 2, "the settings of a page");
    const TableReader reader(L, 2);
    PageSettings settings;
    settings.columns = whole(reader, "columns", 0, 10000, 0);
    settings.gap = whole(reader, "gap", 0, max_picture_side, settings.gap);
    settings.font_size = reader.number("font_size", 0, 1000, 0);
    settings.title = reader.text("title").value_or("");
    if (const auto colour = reader.text("background")) settings.background = parse_colour(*colour);
    return push_png(L, page_of(tiles, settings), texts);
  });
}

}  // namespace

void register_apex_view(lua_State* L) {
  const luaL_Reg functions[] = {{"draw_apex", draw_apex}, {"page", page}, {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
