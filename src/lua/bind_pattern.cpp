// SPDX-License-Identifier: MIT
// Phyllotactic patterns: reading a list of primordia, and the numbers of parastichy pairs. Angles are degrees in Lua.
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "field/pattern.h"
#include "lua/bind_tissue.h"

namespace tunica::lua {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int most_items = 10'000'000;

void set(lua_State* L, const char* key, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, key);
}

void set(lua_State* L, const char* key, const std::string& text) {
  lua_pushlstring(L, text.data(), text.size());
  lua_setfield(L, -2, key);
}

void set_flag(lua_State* L, const char* key, bool value) {
  lua_pushboolean(L, value);
  lua_setfield(L, -2, key);
}

template <class List, class Push>
void set_list(lua_State* L, const char* key, const List& list, Push&& push) {
  lua_createtable(L, static_cast<int>(list.size()), 0);
  int i = 0;
  for (const auto& item : list) {
    push(item);
    lua_rawseti(L, -2, ++i);
  }
  lua_setfield(L, -2, key);
}

void set_angles(lua_State* L, const char* key, const std::vector<double>& angles) {
  set_list(L, key, angles, [&](double a) { lua_pushnumber(L, a / degree); });
}

void push_pair(lua_State* L, ParastichyPair pair) {
  lua_createtable(L, 2, 0);
  lua_pushinteger(L, pair.m);
  lua_rawseti(L, -2, 1);
  lua_pushinteger(L, pair.n);
  lua_rawseti(L, -2, 2);
}

void set_pair(lua_State* L, const char* key, ParastichyPair pair) {
  if (pair.n == 0) return;
  push_pair(L, pair);
  lua_setfield(L, -2, key);
}

void set_figures(lua_State* L, const char* key, const Figures& figures) {
  if (figures.count == 0) return;
  lua_createtable(L, 0, 4);
  set(L, "mean", figures.mean);
  set(L, "sd", figures.sd);
  set(L, "median", figures.median);
  set(L, "count", figures.count);
  lua_setfield(L, -2, key);
}

/// The number under a key of the table on top of the stack, or `otherwise` if there is none.
double number_of(lua_State* L, const char* key, int item, double otherwise = PatternItem::unknown) {
  lua_getfield(L, -1, key);
  double value = otherwise;
  if (!lua_isnil(L, -1)) value = check_number(L, -1, fmt::format("'{}' of primordium {}", key, item).c_str());
  lua_pop(L, 1);
  return value;
}

PatternItem item_at_top(lua_State* L, int number) {
  PatternItem item;
  if (lua_type(L, -1) == LUA_TNUMBER) {
    item.angle = check_number(L, -1, fmt::format("primordium {}", number).c_str()) * degree;
    return item;
  }
  if (lua_type(L, -1) != LUA_TTABLE)
    fail(
        "primordium {} must be an angle in degrees or a table {{ angle =, time =, radius = | x =, y =, z = }}, came {}",
        number, describe(L, -1));
  const double x = number_of(L, "x", number), z = number_of(L, "z", number), y = number_of(L, "y", number, 0);
  const double angle = number_of(L, "angle", number), radius = number_of(L, "radius", number);
  item.time = number_of(L, "time", number);
  const bool placed = std::isfinite(x) && std::isfinite(z);
  if (std::isnan(angle) && !placed) fail("primordium {} has no 'angle', and no 'x' and 'z' either", number);
  if (radius < 0) fail("'radius' of primordium {} must be 0 or more, came {:.10g}", number, radius);
  item.angle = std::isnan(angle) ? std::atan2(z, x) : std::remainder(angle, 360) * degree;
  if (placed)
    item.place = {x, y, z};
  else if (std::isfinite(radius))
    item.place = {radius * std::cos(item.angle), y, radius * std::sin(item.angle)};
  return item;
}

/// The numbers under `left` and `right`, as places in a list that begins with number `first`.
void add_neighbours(lua_State* L, PatternItem& item, int number, int first) {
  if (lua_type(L, -1) != LUA_TTABLE) return;
  const double left = number_of(L, "left", number), right = number_of(L, "right", number);
  if (std::isnan(left) && std::isnan(right)) return;
  const auto place = [&](double n) { return n >= first && n < number ? static_cast<Index>(n) - first : none; };
  item.neighbours = {place(left), place(right)};
}

std::vector<PatternItem> items_at(lua_State* L, int at, int first, int last) {
  std::vector<PatternItem> items;
  for (int i = first; i <= last; ++i) {
    lua_rawgeti(L, at, i);
    items.push_back(item_at_top(L, i));
    add_neighbours(L, items.back(), i, first);
    lua_pop(L, 1);
  }
  return items;
}

void push_pattern(lua_State* L, const Pattern& p, int first) {
  lua_createtable(L, 0, 32);
  set(L, "name", p.name);
  set(L, "description", describe(p));
  set(L, "primordia", p.primordia);
  set_flag(L, "orderly", p.kind != PatternKind::none && p.kind != PatternKind::too_few);
  set_flag(L, "enough", p.kind != PatternKind::too_few);
  set_list(L, "evidence", p.evidence, [&](const std::string& text) { lua_pushlstring(L, text.data(), text.size()); });
  set(L, "jugacy", p.jugacy);
  set(L, "whorls", p.whorls);
  set(L, "missing", p.missing);
  set(L, "intra", p.intra / degree);
  set(L, "spread", p.spread);
  set_list(L, "whorl", p.whorl, [&](int w) { lua_pushinteger(L, w + 1); });
  set_angles(L, "raw", p.raw);
  set(L, "raw_mean", p.raw_mean / degree);
  set(L, "raw_sd", p.raw_sd / degree);
  set_list(L, "order", p.sequence, [&](Index i) { lua_pushinteger(L, i + first); });
  set(L, "swaps", p.swaps);
  set_angles(L, "divergences", p.divergences);
  set(L, "mean", p.mean / degree);
  set(L, "sd", p.sd / degree);
  set(L, "folded_mean", p.folded_mean / degree);
  set(L, "folded_sd", p.folded_sd / degree);
  set(L, "hand", p.hand);
  set(L, "reversals", p.reversals);
  set_pair(L, "pair", p.contact);
  if (p.contact.n > 0) set(L, "pair_share", p.contact_share);
  set_pair(L, "named_by", p.named_by);
  if (p.named_by.n > 0) set_angles(L, "interval", {p.interval.low, p.interval.high});
  set_list(L, "visible", p.visible, [&](ParastichyPair pair) { push_pair(L, pair); });
  if (p.limit > 0) set(L, "limit", p.limit / degree);
  set_figures(L, "plastochron", p.plastochron);
  set_figures(L, "ratio", p.plastochron_ratio);
}

int field_integer(lua_State* L, int at, const char* key, int least, int most, int otherwise) {
  lua_getfield(L, at, key);
  int value = otherwise;
  if (!lua_isnil(L, -1)) value = static_cast<int>(check_integer(L, -1, fmt::format("'{}'", key).c_str(), least, most));
  lua_pop(L, 1);
  return value;
}

ExpectedPattern expected_at_top(lua_State* L) {
  check_table(L, -1, "'expected'");
  const int at = lua_gettop(L);
  ExpectedPattern e;
  lua_getfield(L, at, "angle");
  e.angle = check_number(L, -1, "'angle' of 'expected'") * degree;
  lua_pop(L, 1);
  e.jugacy = field_integer(L, at, "jugacy", 1, 100, 1);
  lua_getfield(L, at, "pair");
  if (!lua_isnil(L, -1)) {
    check_table(L, -1, "'pair' of 'expected'");
    for (int* number : {&e.pair.m, &e.pair.n}) {
      lua_rawgeti(L, -1, number == &e.pair.m ? 1 : 2);
      *number = static_cast<int>(check_integer(L, -1, "a number of 'pair'", 1, 1000000));
      lua_pop(L, 1);
    }
  }
  lua_pop(L, 1);
  return e;
}

void set_judgement(lua_State* L, const std::vector<PatternItem>& items, const Pattern& found,
                   const ExpectedPattern& expected) {
  const Judgement verdict =
      judge(found.jugacy == expected.jugacy ? found : read_pattern(items, {expected.jugacy}), expected);
  lua_createtable(L, 0, 4);
  set_flag(L, "lenient", verdict.lenient);
  set_flag(L, "strict", verdict.strict);
  set_flag(L, "hold", verdict.hold);
  set(L, "why", verdict.why);
  lua_setfield(L, -2, "judgement");
}

/// read_pattern(list, { jugacy =, first =, last =, expected = { angle =, jugacy =, pair = { m, n } } }) -> table
int read(lua_State* L) {
  return guard(L, [&] {
    check_table(L, 1, "the list of primordia");
    check_table(L, 2, "the options");
    if (lua_objlen(L, 1) > most_items) fail("at most {} primordia are read, came {}", most_items, lua_objlen(L, 1));
    const int count = static_cast<int>(lua_objlen(L, 1));
    const int first = field_integer(L, 2, "first", 1, most_items, 1);
    const int last = std::min(count, field_integer(L, 2, "last", 0, most_items, count));
    const std::vector<PatternItem> items = items_at(L, 1, first, last);
    const Pattern pattern = read_pattern(items, {field_integer(L, 2, "jugacy", 1, 100, 0)});
    push_pattern(L, pattern, first);
    lua_getfield(L, 2, "expected");
    const bool wanted = !lua_isnil(L, -1);
    const ExpectedPattern expected = wanted ? expected_at_top(L) : ExpectedPattern();
    lua_pop(L, 1);
    if (wanted) set_judgement(L, items, pattern, expected);
    return 1;
  });
}

int pair_member(lua_State* L, int at) {
  return static_cast<int>(check_integer(L, at, "a number of the pair", 1, 1000000));
}
int jugacy_at(lua_State* L, int at) {
  return lua_isnoneornil(L, at) ? 0 : static_cast<int>(check_integer(L, at, "'jugacy'", 1, 1000000));
}

/// sequence(m, n, jugacy | nil, count) -> { terms ..., name =, limit =, jugacy = }
int sequence(lua_State* L) {
  return guard(L, [&] {
    const Sequence s = sequence_of(pair_member(L, 1), pair_member(L, 2), jugacy_at(L, 3));
    const std::vector<int> terms = s.terms(static_cast<int>(check_integer(L, 4, "'count'", 1, 50)));
    lua_createtable(L, static_cast<int>(terms.size()), 3);
    for (size_t i = 0; i < terms.size(); ++i) {
      lua_pushinteger(L, terms[i]);
      lua_rawseti(L, -2, static_cast<int>(i) + 1);
    }
    set(L, "name", s.name);
    set(L, "limit", s.limit / degree);
    set(L, "jugacy", s.jugacy);
    return 1;
  });
}

/// interval(m, n, angle | nil, jugacy | nil) -> low, high; nil if the pair is not visible and opposed at this angle
int interval(lua_State* L) {
  return guard(L, [&] {
    const int m = pair_member(L, 1), n = pair_member(L, 2), jugacy = jugacy_at(L, 4);
    const Sequence s = sequence_of(m, n, jugacy);
    const double angle = lua_isnoneornil(L, 3) ? s.limit : check_number(L, 3, "'angle'") * degree;
    const AllowableInterval found = allowable_interval(m, n, angle, jugacy);
    if (!found.opposed) return 0;
    lua_pushnumber(L, found.low / degree);
    lua_pushnumber(L, found.high / degree);
    return 2;
  });
}

}  // namespace

void register_pattern(lua_State* L) {
  const luaL_Reg functions[] = {
      {"read_pattern", read}, {"parastichy_sequence", sequence}, {"allowable_interval", interval}, {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
