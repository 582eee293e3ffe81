// SPDX-License-Identifier: MIT
// Models of phyllotaxis: start, course, and what there is to see. Angles are in radians here.
#include "lua/bind_phyllotaxis.h"
#include "lua/guard.h"

namespace tunica::lua {

namespace {

// === Start and course

/// inhibition_primordium(engine, angle, age); inhibition_random(engine)
int primordium(lua_State* L) {
  return guard(L, [&] {
    engine_at(L, 1).add_primordium(check_number(L, 2, "the angle"), check_number(L, 3, "the age"));
    return 0;
  });
}

int random_one(lua_State* L) {
  return guard(L, [&] {
    engine_at(L, 1).add_random();
    return 0;
  });
}

/// inhibition_lattice(engine, whorls, angle, jugacy, plastochron | nil) -> plastochron
int lattice(lua_State* L) {
  return guard(L, [&] {
    Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    std::optional<double> spacing;
    if (!lua_isnoneornil(L, 5)) spacing = check_number(L, 5, "the spacing");
    lua_pushnumber(L, engine.add_lattice(static_cast<int>(check_integer(L, 2, "count", 1, 100000)),
                                         check_number(L, 3, "the angle"),
                                         static_cast<int>(check_integer(L, 4, "jugacy", 1, 1000)), spacing));
    return 1;
  });
}

/// inhibition_advance(engine, to) -> "reached" | "inserted" | "clear" | "interrupted"
int advance_to(lua_State* L) {
  return guard(L, [&] {
    Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    static constexpr const char* names[] = {"reached", "inserted", "clear", "interrupted"};
    lua_pushstring(L, names[static_cast<int>(engine.advance(check_number(L, 2, "a time")))]);
    return 1;
  });
}

/// inhibition_known(engine) -> until when nothing happens; nothing when interrupted
int known(lua_State* L) {
  return guard(L, [&] {
    Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    try {
      lua_pushnumber(L, engine.known_until());
    } catch (const Cancelled&) {
      return 0;
    }
    return 1;
  });
}

/// inhibition_show(engine, t): another time within the present search interval.
int show(lua_State* L) {
  return guard(L, [&] {
    engine_at(L, 1).show(check_number(L, 2, "a time"));
    return 0;
  });
}

// === Looking at it

/// inhibition_state(engine) -> table
int state(lua_State* L) {
  return guard(L, [&] {
    const Inhibition& engine = engine_at(L, 1);
    lua_createtable(L, 0, 10);
    const auto number = [&](const char* key, double value) {
      lua_pushnumber(L, value);
      lua_setfield(L, -2, key);
    };
    number("time", engine.time());
    number("searched_from", engine.searched_from());
    number("count", static_cast<double>(engine.primordia().size()));
    number("left_out", static_cast<double>(engine.first_active()));
    number("steps", static_cast<double>(engine.steps()));
    number("plastochron", engine.plastochron());
    number("last_birth", engine.last_birth());
    number("time_scale", engine.time_scale());
    number("evaluations", static_cast<double>(engine.evaluations()));
    number("pairs", static_cast<double>(engine.pairs()));
    lua_pushboolean(L, engine.overflowed());
    lua_setfield(L, -2, "overflowed");
    return 1;
  });
}

/// inhibition_neighbours(engine, n) -> numbers of the older primordia that were nearest to the n-th when it arose, on
/// either side; nil where there is none
int neighbours(lua_State* L) {
  return guard(L, [&] {
    const Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    const auto n = check_integer(L, 2, "a number", 1, static_cast<int64_t>(engine.primordia().size()));
    const auto [one, other] = engine.neighbours(static_cast<size_t>(n - 1));
    for (const Index found : {one, other}) found == none ? lua_pushnil(L) : lua_pushinteger(L, found + 1);
    return 2;
  });
}

/// inhibition_primordia(engine, first) -> list of { angle, birth, initial, x, y } from the first-th on
int primordia(lua_State* L) {
  return guard(L, [&] {
    const Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    const auto first = static_cast<size_t>(check_integer(L, 2, "first", 1, int64_t{1} << 50));
    lua_newtable(L);
    int count = 0;
    for (size_t i = first - 1; i < engine.primordia().size(); ++i) {
      const Primordium& p = engine.primordia()[i];
      const Vec2 at = engine.place(p);
      lua_createtable(L, 0, 8);
      for (const auto& [key, value] : {std::pair{"angle", p.angle}, {"birth", p.birth}, {"x", at.x()}, {"y", at.y()}}) {
        lua_pushnumber(L, value);
        lua_setfield(L, -2, key);
      }
      lua_pushboolean(L, p.initial);
      lua_setfield(L, -2, "initial");
      lua_rawseti(L, -2, ++count);
    }
    return 1;
  });
}

/// inhibition_value(engine, k, angle, x, y) -> the field there, now
int value(lua_State* L) {
  return guard(L, [&] {
    Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    const size_t k = field_at(L, 2, engine);
    lua_pushnumber(
        L, engine.value(k, check_number(L, 3, "the angle"), {check_number(L, 4, "x"), check_number(L, 5, "y")}));
    return 1;
  });
}

/// inhibition_ring(engine, k) -> values of the field on the samples, and their angles
int ring(lua_State* L) {
  return guard(L, [&] {
    Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    const size_t k = field_at(L, 2, engine);
    for (const std::vector<double>& list : {engine.ring_values(k), engine.angles()}) {
      lua_createtable(L, static_cast<int>(list.size()), 0);
      for (size_t i = 0; i < list.size(); ++i) {
        lua_pushnumber(L, list[i]);
        lua_rawseti(L, -2, static_cast<int>(i) + 1);
      }
    }
    return 2;
  });
}

/// inhibition_minimum(engine) -> angle, value, whether it is a candidate
int minimum(lua_State* L) {
  return guard(L, [&] {
    Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    const Inhibition::Minimum m = engine.minimum();
    lua_pushnumber(L, m.angle);
    lua_pushnumber(L, m.value);
    lua_pushboolean(L, m.candidate);
    return 3;
  });
}

int save(lua_State* L) {
  return guard(L, [&] {
    ByteWriter out;
    engine_at(L, 1).save(out);
    lua_pushlstring(L, out.bytes().data(), out.bytes().size());
    return 1;
  });
}

int load(lua_State* L) {
  return guard(L, [&] {
    const std::string bytes = check_string(L, 2, "a saved state");
    ByteReader in(bytes);
    engine_at(L, 1).load(in);
    return 0;
  });
}

}  // namespace

void register_phyllotaxis_course(lua_State* L) {
  const luaL_Reg functions[] = {{"inhibition_primordium", primordium},
                                {"inhibition_random", random_one},
                                {"inhibition_lattice", lattice},
                                {"inhibition_advance", advance_to},
                                {"inhibition_known", known},
                                {"inhibition_show", show},
                                {"inhibition_state", state},
                                {"inhibition_primordia", primordia},
                                {"inhibition_neighbours", neighbours},
                                {"inhibition_value", value},
                                {"inhibition_ring", ring},
                                {"inhibition_minimum", minimum},
                                {"inhibition_save", save},
                                {"inhibition_load", load},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
