// SPDX-License-Identifier: MIT
// How tissues and elements behave in Lua: fields, comparison, text, and clear errors for what they are not.
#include <cmath>

#include "lua/boxes.h"
#include "lua/symbol.h"

namespace tunica::lua {
namespace {

/// The names of methods and properties (upvalues 1 and 2 of __index).
std::vector<std::string> member_names(lua_State* L) {
  std::vector<std::string> names;
  for (int upvalue = 1; upvalue <= 2; ++upvalue) {
    lua_pushnil(L);
    while (lua_next(L, lua_upvalueindex(upvalue))) {
      if (lua_type(L, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -2));
      lua_pop(L, 1);
    }
  }
  return names;
}

std::string key_at(lua_State* L, int at, const char* noun) {
  if (lua_type(L, at) != LUA_TSTRING) fail("a {} has named fields; {} is not a name", noun, describe(L, at));
  return lua_tostring(L, at);
}

/// Looks the key (stack 2) up among methods, then properties (called with the value at 1). True if a result is pushed.
bool push_member(lua_State* L) {
  lua_pushvalue(L, 2);
  lua_rawget(L, lua_upvalueindex(1));
  if (!lua_isnil(L, -1)) return true;
  lua_pop(L, 1);
  lua_pushvalue(L, 2);
  lua_rawget(L, lua_upvalueindex(2));
  if (lua_isnil(L, -1)) {
    lua_pop(L, 1);
    return false;
  }
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  return true;
}

int element_index(lua_State* L) {
  return guard(L, [&] {
    Handle* handle = handle_at(L, 1);
    if (!handle) fail("a field was asked of {}", describe(L, 1));
    if (active_tracer(L)) fail("a rule that reads one particular {} cannot be traced", name_of(handle->kind));
    if (lua_type(L, 2) == LUA_TSTRING && push_member(L)) return 1;
    const std::string key = key_at(L, 2, name_of(handle->kind));
    const Tissue& tissue = open_tissue(*handle->box);
    const Index index = resolve_or_fail(*handle, tissue);
    const Column* column = tissue.find_column(handle->kind, key);
    if (!column) {
      std::vector<std::string> names = member_names(L);
      for (const auto& each : tissue.columns(handle->kind)) names.push_back(each->name);
      fail("a {} has no field '{:.60}'{}", name_of(handle->kind), key, did_you_mean(key, names));
    }
    lua_pushnumber(L, column->values[static_cast<size_t>(index)]);
    return 1;
  });
}

std::string not_its_own(const std::string& key, const char* noun) {
  return fmt::format(
      "a rule cannot set '{:.60}' of a {}: a derive rule sets columns of the element it is given, a rate rule those of "
      "d",
      key, noun);
}

int element_newindex(lua_State* L) {
  return guard(L, [&] {
    Handle* handle = handle_at(L, 1);
    if (!handle) fail("a field was set on {}", describe(L, 1));
    const char* noun = name_of(handle->kind);
    const std::string key = key_at(L, 2, noun);
    if (Tracer* tracer = active_tracer(L)) tracer->forbid(L, not_its_own(key, noun));
    if (host(L).rules > 0) fail("{}", not_its_own(key, noun));
    Tissue& tissue = open_tissue(*handle->box);
    const Index index = resolve_or_fail(*handle, tissue);
    Column* column = tissue.find_column(handle->kind, key);
    if (!column) {
      std::vector<std::string> writable;
      for (const auto& each : tissue.columns(handle->kind))
        if (!each->geometric) writable.push_back(each->name);
      fail("a {} has no column '{:.60}'{}; declare it first: tissue:{} {{ {:.60} = 0 }}", noun, key,
           did_you_mean(key, writable), noun, key);
    }
    if (column->geometric) fail("'{}' of a {} follows from its geometry and cannot be set", key, noun);
    if (lua_type(L, 3) != LUA_TNUMBER) fail("'{}' of a {} must be a number, came {}", key, noun, describe(L, 3));
    const double value = lua_tonumber(L, 3);
    if (!std::isfinite(value))
      fail("'{}' of {} {} must be a finite number, came {}", key, noun, handle->id, describe(L, 3));
    column->values[static_cast<size_t>(index)] = value;
    return 0;
  });
}

int element_equal(lua_State* L) {
  return guard(L, [&] {
    const Handle *a = handle_at(L, 1), *b = handle_at(L, 2);
    lua_pushboolean(L, a && b && a->box == b->box && a->kind == b->kind && a->id == b->id);
    return 1;
  });
}

std::string text_of(Handle& handle) {
  const Tissue& tissue = open_tissue(*handle.box);
  std::string text = fmt::format("{} {}", name_of(handle.kind), handle.id);
  const Index index = resolve(handle, tissue);
  if (index == none) return fmt::format("{} ({})", text, tissue.fate(handle.kind, handle.id));
  const char* separator = ": ";
  const auto add = [&](const std::string& part) {
    text += separator + part;
    separator = ", ";
  };
  if (handle.kind == Kind::cell) add(fmt::format("{} sides", tissue.side_count(index)));
  if (handle.kind == Kind::side) add(fmt::format("of cell {}", tissue.id(Kind::cell, tissue.cell_of(index))));
  if (handle.kind == Kind::junction) {
    const Vec3& p = tissue.position(index);
    add(fmt::format("at {:.4g}, {:.4g}, {:.4g}", p.x(), p.y(), p.z()));
  }
  for (const auto& column : tissue.columns(handle.kind))
    add(fmt::format("{} {:.4g}", column->name, column->values[static_cast<size_t>(index)]));
  return text;
}

int element_tostring(lua_State* L) {
  return guard(L, [&] {
    Handle* handle = handle_at(L, 1);
    if (!handle) fail("expected a handle, came {}", describe(L, 1));
    lua_pushstring(L, text_of(*handle).c_str());
    return 1;
  });
}

int no_arithmetic(lua_State* L) {
  return guard(L, [&]() -> int {
    const int at = type_of(L, 1) >= 0 ? 1 : 2;
    const int type = type_of(L, at);
    fail("{} is not a number: calculate with one of its fields, such as {}", describe(L, at),
         type == 0             ? "c.area"
         : type == 1           ? "w.length"
         : type == tissue_type ? "tissue:count()"
                               : "its columns");
  });
}

int concatenate(lua_State* L) {
  return guard(L, [&] {
    std::string text;
    for (int at = 1; at <= 2; ++at) {
      Handle* handle = handle_at(L, at);
      if (handle)
        text += text_of(*handle);
      else if (lua_isstring(L, at))
        text += lua_tostring(L, at);
      else
        text += describe(L, at);
    }
    lua_pushlstring(L, text.data(), text.size());
    return 1;
  });
}

int tissue_index(lua_State* L) {
  return guard(L, [&]() -> int {
    tissue_at(L, 1);
    if (lua_type(L, 2) == LUA_TSTRING && push_member(L)) return 1;
    const std::string key = key_at(L, 2, "tissue");
    fail("a tissue has no field '{:.60}'{}", key, did_you_mean(key, member_names(L)));
  });
}

int tissue_newindex(lua_State* L) {
  return guard(L, [&]() -> int {
    const std::string key = key_at(L, 2, "tissue");
    fail(
        "'{:.60}' cannot be set on a tissue; values of your own go into tissue.data, state of the cells into columns: "
        "tissue:cell {{ {:.60} = 0 }}",
        key, key);
  });
}

int tissue_length(lua_State* L) {
  return guard(L, [&] {
    lua_pushnumber(L, tissue_at(L, 1).cells());
    return 1;
  });
}

int tissue_tostring(lua_State* L) {
  return guard(L, [&] {
    const Tissue& t = tissue_at(L, 1);
    lua_pushstring(L, fmt::format("tissue: {} cells, {} walls{}", t.cells(), t.walls(),
                                  t.has_geometry() ? fmt::format(", {} junctions", t.junctions()) : ", no geometry")
                          .c_str());
    return 1;
  });
}

int tissue_collect(lua_State* L) {
  if (type_of(L, 1) == tissue_type) static_cast<TissueBox*>(lua_touserdata(L, 1))->tissue.reset();
  return 0;
}

void set(lua_State* L, const char* name, lua_CFunction function) {
  lua_pushcfunction(L, function);
  lua_setfield(L, -2, name);
}

/// Stack: methods, properties of the type. Leaves the stack as it was.
void make_metatable(lua_State* L, int type) {
  const int methods = lua_gettop(L) - 1, properties = methods + 1;
  const bool whole = type == tissue_type;
  lua_newtable(L);
  host(L).metatables[type] = lua_topointer(L, -1);
  lua_pushvalue(L, methods);
  lua_pushvalue(L, properties);
  lua_pushcclosure(L, whole ? tissue_index : element_index, 2);
  lua_setfield(L, -2, "__index");
  set(L, "__newindex", whole ? tissue_newindex : element_newindex);
  set(L, "__tostring", whole ? tissue_tostring : element_tostring);
  for (const char* event : {"__add", "__sub", "__mul", "__div", "__mod", "__pow", "__unm", "__lt", "__le", "__call"})
    set(L, event, no_arithmetic);
  set(L, "__concat", whole ? no_arithmetic : concatenate);
  set(L, "__len", whole ? tissue_length : no_arithmetic);
  if (whole)
    set(L, "__gc", tissue_collect);
  else
    set(L, "__eq", element_equal);
  lua_pushstring(L, article(type_names[type]).c_str());
  lua_setfield(L, -2, "__metatable");
  lua_pushlightuserdata(L, const_cast<void*>(host(L).metatables[type]));  // keeps it for the life of the state
  lua_insert(L, -2);
  lua_rawset(L, LUA_REGISTRYINDEX);
}

}  // namespace

void require_settable(lua_State* L, const Tissue& tissue, Kind kind, const std::string& name) {
  const int top = lua_gettop(L);
  lua_pushlightuserdata(L, const_cast<void*>(host(L).metatables[static_cast<int>(kind)]));
  lua_rawget(L, LUA_REGISTRYINDEX);
  lua_getfield(L, -1, "__index");
  bool taken = false;
  for (int upvalue = 1; upvalue <= 2; ++upvalue) {
    lua_getupvalue(L, top + 2, upvalue);
    lua_getfield(L, -1, name.c_str());
    taken = taken || !lua_isnil(L, -1);
  }
  lua_settop(L, top);
  if (taken)
    fail("a rule cannot set '{}': it means something else for a {} already; choose another name", name, name_of(kind));
  const Column* column = tissue.find_column(kind, name);
  if (column && column->geometric)
    fail("a rule cannot set '{}': it follows from the geometry of the {}", name, name_of(kind));
}

void register_handles(lua_State* L) {
  const int module = lua_gettop(L);
  lua_newtable(L);
  lua_newtable(L);
  for (int type = 0; type <= tissue_type; ++type) {
    for (int table = module + 1; table <= module + 2; ++table) {
      lua_newtable(L);
      lua_pushvalue(L, -1);
      lua_setfield(L, table, type_names[type]);
    }
    make_metatable(L, type);
    lua_pop(L, 2);
  }
  lua_setfield(L, module, "properties");
  lua_setfield(L, module, "methods");
  lua_pushlightuserdata(L, const_cast<char*>(&boxes_key));
  lua_newtable(L);
  lua_newtable(L);
  lua_pushliteral(L, "v");
  lua_setfield(L, -2, "__mode");
  lua_setmetatable(L, -2);
  lua_rawset(L, LUA_REGISTRYINDEX);
}

}  // namespace tunica::lua
