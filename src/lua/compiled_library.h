// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <map>
#include <string>
#include <string_view>

namespace tunica::lua {

/// The name under which a part of the library ("prompt/errors") is compiled. Messages, and what tells the library's
/// functions from a script's, go by it.
inline std::string chunk_name(const std::string& part) { return "=tunica/" + part + ".lua"; }

/// A part of the library as LuaJIT's bytecode, with its lines and names.
struct CompiledPart {
  std::string source;         ///< hash of the text that it was compiled from
  std::string_view bytecode;  ///< of the program itself
};

/// Parts by name, as `compile_library` wrote them for the LuaJIT that calls itself `luajit`.
struct CompiledLibrary {
  std::string luajit;
  std::map<std::string, CompiledPart> parts;
};

/// What the build linked into this program (src/lua/library_bytecode.cpp), read once. Without parts where it did not.
const CompiledLibrary& compiled_library();

/// Pushes the function of a part of the library: from the program's bytecode if that was compiled from just this text,
/// by the LuaJIT that now runs; else from the text. The function is the same. Returns whether it came from bytecode.
/// Errors: as load_text.
bool load_part(lua_State* L, const std::string& part, std::string_view text);

}  // namespace tunica::lua
