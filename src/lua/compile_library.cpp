// SPDX-License-Identifier: MIT
// A tool of the build. compile_library FOLDER FILE: compiles every FOLDER/**/*.lua, the Lua half of the library, to
// bytecode with lines and names, and writes all of it to FILE for compiled_library.cpp to read: the version of LuaJIT,
// where the code begins, for each part its name, the hash of its text and its place in the code; then the code.
#include <cstdio>
#include <filesystem>
#include <lua.hpp>

#include "base/bytes.h"
#include "base/files.h"
#include "lua/compiled_library.h"

namespace {

using namespace tunica;

int append(lua_State*, const void* bytes, size_t size, void* code) {
  static_cast<std::string*>(code)->append(static_cast<const char*>(bytes), size);
  return 0;
}

std::string version_of_luajit(lua_State* L) {
  luaL_openlibs(L);
  lua_getglobal(L, "jit");
  lua_getfield(L, -1, "version");
  std::string version = lua_tostring(L, -1);
  lua_pop(L, 2);
  return version;
}

void compile(lua_State* L, const std::string& part, const std::string& text, std::string& code) {
  if (luaL_loadbuffer(L, text.data(), text.size(), lua::chunk_name(part).c_str()) != 0) fail("{}", lua_tostring(L, -1));
  if (lua_dump(L, append, &code) != 0) fail("tunica/{}.lua cannot be written as bytecode", part);
  lua_pop(L, 1);
}

std::string compile_all(lua_State* L, const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::path> files;  // by name: the order of a folder is not the same everywhere
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".lua")
      files[std::filesystem::relative(entry.path(), folder).replace_extension().generic_string()] = entry.path();
  const std::string version = version_of_luajit(L);
  ByteWriter index;
  std::string code;
  index.put(static_cast<uint32_t>(files.size()));
  for (const auto& [part, path] : files) {
    const std::string text = read_file(path.string());
    const auto start = static_cast<uint64_t>(code.size());
    compile(L, part, text, code);
    index.text(part);
    index.text(hash(text));
    index.put(start);
    index.put(static_cast<uint64_t>(code.size()) - start);
  }
  ByteWriter head;
  head.text(version);
  head.put(static_cast<uint64_t>(head.bytes().size() + sizeof(uint64_t) + index.bytes().size()));
  return head.bytes() + index.bytes() + code;
}

}  // namespace

int main(int argc, char** argv) {
  lua_State* L = argc == 3 ? luaL_newstate() : nullptr;
  if (!L) return std::fprintf(stderr, "usage: compile_library FOLDER FILE\n"), 2;
  int code = 0;
  try {
    write_atomic(argv[2], compile_all(L, std::filesystem::path(argv[1]) / "tunica"));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    code = 1;
  }
  lua_close(L);
  return code;
}
