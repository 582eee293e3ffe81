// SPDX-License-Identifier: MIT
#include "lua/compiled_library.h"

#include "base/bytes.h"
#include "lua/state.h"

// Weak: programs that link no library_bytecode.cpp (most tests) take every part from its text.
extern "C" {
__attribute__((weak)) extern const char tunica_library_begin[];
__attribute__((weak)) extern const char tunica_library_end[];
}

namespace tunica::lua {

namespace {

CompiledLibrary read_library(std::string_view bytes) {
  CompiledLibrary library;
  ByteReader index(bytes);
  library.luajit = index.text();
  const auto code = index.get<uint64_t>();
  for (auto count = index.get<uint32_t>(); count > 0; --count) {
    CompiledPart& part = library.parts[index.text()];
    part.source = index.text();
    const auto start = index.get<uint64_t>(), size = index.get<uint64_t>();
    part.bytecode = bytes.substr(code + start, size);
  }
  return library;
}

bool same_luajit(lua_State* L, const std::string& version) {
  lua_getfield(L, LUA_REGISTRYINDEX, "tunica.luajit");
  const bool same = lua_isstring(L, -1) && version == lua_tostring(L, -1);
  lua_pop(L, 1);
  return same;
}

}  // namespace

const CompiledLibrary& compiled_library() {
  static const CompiledLibrary library =
      tunica_library_begin ? read_library({tunica_library_begin, tunica_library_end}) : CompiledLibrary{};
  return library;
}

bool load_part(lua_State* L, const std::string& part, std::string_view text) {
  const CompiledLibrary& library = compiled_library();
  const auto found = library.parts.find(part);
  if (found != library.parts.end() && found->second.source == hash(text) && same_luajit(L, library.luajit)) {
    const std::string_view code = found->second.bytecode;
    if (luaL_loadbufferx(L, code.data(), code.size(), chunk_name(part).c_str(), "b") == 0) return true;
    lua_pop(L, 1);  // LuaJIT refuses a format other than its own
  }
  load_text(L, text, chunk_name(part));
  return false;
}

}  // namespace tunica::lua
