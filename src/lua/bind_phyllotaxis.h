// SPDX-License-Identifier: MIT
#pragma once

#include "field/inhibition.h"
#include "lua/bind_model.h"

namespace tunica::lua {

/// A model's inhibition as Lua holds it.
struct Phyllotaxis {
  std::unique_ptr<Inhibition> engine;
};

template <>
struct TypeName<Phyllotaxis> {
  static constexpr const char* value = "tunica.inhibition";
};

inline Inhibition& engine_at(lua_State* L, int at) { return *object_at<Phyllotaxis>(L, at).engine; }

/// The number of a field from 1, as an index from 0. Errors: there are fewer.
size_t field_at(lua_State* L, int at, const Inhibition& engine);

/// Adds the functions that start a model, take it on and look at it (bind_phyllotaxis_course.cpp).
void register_phyllotaxis_course(lua_State* L);

}  // namespace tunica::lua
