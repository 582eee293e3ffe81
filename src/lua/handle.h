// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <memory>
#include <string>

#include "tissue/tissue.h"

namespace tunica::lua {

/// A tissue and its elements as Lua values. A handle keeps the identity of its element, not its index, so it stays
/// right while the tissue changes; and it keeps its tissue alive. Every function here throws Error (never a Lua error)
/// on wrong input, so call it inside guard().

/// Creates the metatables; adds `methods` and `properties` (a table per kind, filled by the registry) to the module on
/// top of the stack.
void register_handles(lua_State* L);

/// Pushes the tissue as a Lua value; the same tissue is the same value each time.
void push_tissue(lua_State* L, std::shared_ptr<Tissue> tissue);
/// Pushes a handle to an element, or nil if `index` is none. `owner` is the stack index of the tissue or of any handle
/// into it.
void push_element(lua_State* L, int owner, Kind kind, Index index);
/// Pushes a handle to the element of an identity, which may be gone.
void push_identity(lua_State* L, int owner, Kind kind, Id id);

/// The tissue at a stack index. Errors: something else.
std::shared_ptr<Tissue> check_tissue(lua_State* L, int at);
/// The same without sharing ownership: for the length of a C function that has the value on its stack.
Tissue& tissue_at(lua_State* L, int at);
/// Errors: rules or an operation are running on the tissue, so its structure cannot change now.
void require_changeable(const Tissue& tissue);

/// Pushes the table of the functions that divide this tissue's columns, by "kind.column"; false, and nothing pushed, if
/// Lua does not know the tissue.
bool push_rules(lua_State* L, const Tissue* tissue);

struct Element {
  Tissue& tissue;
  Kind kind;
  Index index;
};
/// The element that a handle names. Errors: not a handle, of another kind, gone ("cell 17 has divided into 23 and 24").
Element check_element(lua_State* L, int at, Kind kind);
/// The same for a handle of any kind.
Element check_element(lua_State* L, int at);
/// The same, and it must belong to `tissue`.
Index check_element(lua_State* L, int at, Kind kind, const Tissue& tissue);

/// What a handle names, alive or not; false if the value is no handle.
bool peek_handle(lua_State* L, int at, Kind& kind, Id& id, Tissue*& tissue);

/// True for a tissue userdata.
bool is_tissue(lua_State* L, int at);

/// Errors: rules cannot set this of an element of this kind (a property, an operation, what follows from the geometry).
void require_settable(lua_State* L, const Tissue& tissue, Kind kind, const std::string& name);

/// Arguments of C functions; each throws Error naming what was expected and what came.
double check_number(lua_State* L, int at, const char* what);
/// Whole number within the limits.
int64_t check_integer(lua_State* L, int at, const char* what, int64_t low, int64_t high);
std::string check_string(lua_State* L, int at, const char* what);
void check_function(lua_State* L, int at, const char* what);
void check_table(lua_State* L, int at, const char* what);
Kind check_kind(lua_State* L, int at);

/// A value in words for an error message: "nil", "the number -1", "the text 'abc'", "a table", "cell 17".
std::string describe(lua_State* L, int at);

}  // namespace tunica::lua
