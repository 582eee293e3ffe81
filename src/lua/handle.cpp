// SPDX-License-Identifier: MIT
#include "lua/handle.h"

#include "lua/boxes.h"

namespace tunica::lua {
namespace {

void push_metatable(lua_State* L, int type) {
  lua_pushlightuserdata(L, const_cast<void*>(host(L).metatables[type]));
  lua_rawget(L, LUA_REGISTRYINDEX);
}

/// A tissue's memory is unknown to Lua's collector, so garbage tissues would pile up; collect them every so often.
void collect_garbage_tissues(lua_State* L) {
  if (++host(L).tissues_made % 64 == 0) lua_gc(L, LUA_GCCOLLECT, 0);
}

}  // namespace

int type_of(lua_State* L, int at) {
  if (lua_type(L, at) != LUA_TUSERDATA || !lua_getmetatable(L, at)) return -1;
  const void* metatable = lua_topointer(L, -1);
  lua_pop(L, 1);
  const Host& h = host(L);
  for (int type = 0; type <= tissue_type; ++type)
    if (h.metatables[type] == metatable) return type;
  return -1;
}

Handle* handle_at(lua_State* L, int at) {
  const int type = type_of(L, at);
  return type >= 0 && type < tissue_type ? static_cast<Handle*>(lua_touserdata(L, at)) : nullptr;
}

Tissue& open_tissue(const TissueBox& box) {
  if (!box.tissue) fail("the tissue is closed");
  return *box.tissue;
}

Index resolve(Handle& handle, const Tissue& tissue) {
  const bool still_there =
      handle.hint >= 0 && handle.hint < tissue.count(handle.kind) && tissue.id(handle.kind, handle.hint) == handle.id;
  if (!still_there) handle.hint = tissue.find(handle.kind, handle.id);
  return handle.hint;
}

Index resolve_or_fail(Handle& handle, const Tissue& tissue) {
  const Index index = resolve(handle, tissue);
  if (index == none) fail("{} {} {}", name_of(handle.kind), handle.id, tissue.fate(handle.kind, handle.id));
  return index;
}

void push_tissue(lua_State* L, std::shared_ptr<Tissue> tissue) {
  lua_pushlightuserdata(L, const_cast<char*>(&boxes_key));
  lua_rawget(L, LUA_REGISTRYINDEX);
  lua_pushlightuserdata(L, tissue.get());
  lua_rawget(L, -2);
  if (!lua_isnil(L, -1)) {
    lua_remove(L, -2);
    return;
  }
  lua_pop(L, 1);
  collect_garbage_tissues(L);
  auto* box = new (lua_newuserdata(L, sizeof(TissueBox))) TissueBox{std::move(tissue)};
  push_metatable(L, tissue_type);
  lua_setmetatable(L, -2);
  lua_newtable(L);  // the environment, shared with the handles: holds the tissue, the user's data, the columns' rules
  lua_pushvalue(L, -2);
  lua_rawseti(L, -2, 1);
  for (const char* part : {"data", "rules"}) {
    lua_newtable(L);
    lua_setfield(L, -2, part);
  }
  lua_setfenv(L, -2);
  lua_pushlightuserdata(L, box->tissue.get());
  lua_pushvalue(L, -2);
  lua_rawset(L, -4);
  lua_remove(L, -2);
}

bool push_rules(lua_State* L, const Tissue* tissue) {
  lua_pushlightuserdata(L, const_cast<char*>(&boxes_key));
  lua_rawget(L, LUA_REGISTRYINDEX);
  lua_pushlightuserdata(L, const_cast<Tissue*>(tissue));
  lua_rawget(L, -2);
  lua_remove(L, -2);
  if (lua_isnil(L, -1)) {
    lua_pop(L, 1);
    return false;
  }
  lua_getfenv(L, -1);
  lua_getfield(L, -1, "rules");
  lua_replace(L, -3);
  lua_pop(L, 1);
  return true;
}

namespace {

/// The tissue's box of a tissue or of a handle into it; makes the stack index absolute.
TissueBox* box_of(lua_State* L, int& owner) {
  if (owner < 0 && owner > LUA_REGISTRYINDEX) owner += lua_gettop(L) + 1;
  const int type = type_of(L, owner);
  if (type < 0) fail("expected a tissue or one of its elements, came {}", describe(L, owner));
  return type == tissue_type ? static_cast<TissueBox*>(lua_touserdata(L, owner))
                             : static_cast<Handle*>(lua_touserdata(L, owner))->box;
}

void push_handle(lua_State* L, int owner, const Handle& handle) {
  new (lua_newuserdata(L, sizeof(Handle))) Handle(handle);
  push_metatable(L, static_cast<int>(handle.kind));
  lua_setmetatable(L, -2);
  lua_getfenv(L, owner);
  lua_setfenv(L, -2);
}

}  // namespace

void push_element(lua_State* L, int owner, Kind kind, Index index) {
  if (index == none) {
    lua_pushnil(L);
    return;
  }
  TissueBox* box = box_of(L, owner);
  push_handle(L, owner, {box, open_tissue(*box).id(kind, index), index, kind});
}

void push_identity(lua_State* L, int owner, Kind kind, Id id) {
  TissueBox* box = box_of(L, owner);
  push_handle(L, owner, {box, id, open_tissue(*box).find(kind, id), kind});
}

bool is_tissue(lua_State* L, int at) { return type_of(L, at) == tissue_type; }

std::shared_ptr<Tissue> check_tissue(lua_State* L, int at) {
  tissue_at(L, at);
  return static_cast<TissueBox*>(lua_touserdata(L, at))->tissue;
}

Tissue& tissue_at(lua_State* L, int at) {
  if (type_of(L, at) != tissue_type) fail("expected a tissue, came {}", describe(L, at));
  return open_tissue(*static_cast<TissueBox*>(lua_touserdata(L, at)));
}

void require_changeable(const Tissue& tissue) {
  if (tissue.locked())
    fail("the structure of the tissue cannot change while a rule, or a function given to an operation, runs on it");
}

Element check_element(lua_State* L, int at) {
  Handle* handle = handle_at(L, at);
  if (!handle) fail("expected an element of a tissue, came {}", describe(L, at));
  Tissue& tissue = open_tissue(*handle->box);
  return {tissue, handle->kind, resolve_or_fail(*handle, tissue)};
}

Element check_element(lua_State* L, int at, Kind kind) {
  const Handle* handle = handle_at(L, at);
  if (!handle || handle->kind != kind) fail("expected {}, came {}", article(name_of(kind)), describe(L, at));
  return check_element(L, at);
}

Index check_element(lua_State* L, int at, Kind kind, const Tissue& tissue) {
  const Element element = check_element(L, at, kind);
  if (&element.tissue != &tissue) fail("{} belongs to another tissue", describe(L, at));
  return element.index;
}

bool peek_handle(lua_State* L, int at, Kind& kind, Id& id, Tissue*& tissue) {
  const Handle* handle = handle_at(L, at);
  if (!handle) return false;
  kind = handle->kind;
  id = handle->id;
  tissue = &open_tissue(*handle->box);
  return true;
}

}  // namespace tunica::lua
