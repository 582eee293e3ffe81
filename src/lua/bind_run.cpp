// SPDX-License-Identifier: MIT
// What the Lua half needs of the world for runs: files written as one act, JSON, hashes, clocks, checkpoints.
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "base/bytes.h"
#include "base/container.h"
#include "base/files.h"
#include "lua/guard.h"
#include "lua/json.h"
#include "lua/state.h"

namespace tunica::lua {

namespace {

std::string text_at(lua_State* L, int index) {
  size_t size = 0;
  if (lua_type(L, index) != LUA_TSTRING) fail("argument {}: expected text, got {}", index, luaL_typename(L, index));
  const char* text = lua_tolstring(L, index, &size);
  return {text, size};
}

std::string path_at(lua_State* L, int index) {
  std::string path = text_at(L, index);
  if (path.empty()) fail("argument {}: expected a path, got empty text", index);
  if (path.find('\0') != std::string::npos) fail("argument {}: a path cannot hold a zero byte", index);
  return path;
}

void push_text(lua_State* L, std::string_view text) { lua_pushlstring(L, text.data(), text.size()); }

// === Files

int write_file(lua_State* L) {
  return guard(L, [&] {
    write_atomic(path_at(L, 1), text_at(L, 2));
    return 0;
  });
}

int read_whole_file(lua_State* L) {
  return guard(L, [&] {
    push_text(L, read_file(path_at(L, 1)));
    return 1;
  });
}

int make_folder(lua_State* L) {
  return guard(L, [&] {
    make_folders(path_at(L, 1));
    return 0;
  });
}

int list(lua_State* L) {
  return guard(L, [&] {
    const auto names = list_folder(path_at(L, 1));
    lua_createtable(L, static_cast<int>(names.size()), 0);
    for (size_t i = 0; i < names.size(); ++i) {
      push_text(L, names[i]);
      lua_rawseti(L, -2, static_cast<int>(i) + 1);
    }
    return 1;
  });
}

/// core.rename(from, to): of a folder onto an existing one only if that is empty.
int rename_path(lua_State* L) {
  return guard(L, [&] {
    rename_synced(path_at(L, 1), path_at(L, 2));
    return 0;
  });
}

/// core.lock_file(path): whether this process has the lock of the file now, and until it ends.
int lock(lua_State* L) {
  return guard(L, [&] {
    lua_pushboolean(L, lock_file(path_at(L, 1)));
    return 1;
  });
}

/// core.remove_all(path): a file, or a folder with all in it.
int remove_all(lua_State* L) {
  return guard(L, [&] {
    std::error_code error;
    std::filesystem::remove_all(path_at(L, 1), error);
    return 0;
  });
}

/// core.kind_of(path): "file", "folder", "other" or nil if there is none.
int kind_of_path(lua_State* L) {
  return guard(L, [&] {
    struct stat about {};
    if (::stat(path_at(L, 1).c_str(), &about) != 0) return 0;
    lua_pushstring(L, S_ISDIR(about.st_mode) ? "folder" : S_ISREG(about.st_mode) ? "file" : "other");
    return 1;
  });
}

int absolute_path(lua_State* L) {
  return guard(L, [&] {
    push_text(L, std::filesystem::weakly_canonical(path_at(L, 1)).string());
    return 1;
  });
}

/// core.shared_folder(name): where "scripts", "doc" or "stubs" are, installed or among the sources.
int shared_folder(lua_State* L) {
  return guard(L, [&] {
    lua_getfield(L, LUA_REGISTRYINDEX, "tunica.lua folder");
    const auto beside = std::filesystem::path(text_at(L, lua_gettop(L))).parent_path();
    std::error_code error;
    const auto in_sources = beside / "share" / text_at(L, 1);
    push_text(L, (std::filesystem::is_directory(in_sources, error) ? in_sources : beside / text_at(L, 1)).string());
    return 1;
  });
}

// === JSON, hashes, numbers as text

/// core.encode(value [, indented])
int encode(lua_State* L) {
  return guard(L, [&] {
    luaL_checkany(L, 1);
    push_text(L, to_json(L, 1, lua_toboolean(L, 2)));
    return 1;
  });
}

/// core.as_list(table): the same table; when empty, JSON shows it as a list.
int as_list(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  lua_settop(L, 1);
  lua_createtable(L, 0, 1);
  lua_pushboolean(L, 1);
  lua_setfield(L, -2, "__list");
  lua_setmetatable(L, 1);
  return 1;
}

int decode(lua_State* L) {
  return guard(L, [&] {
    push_json(L, text_at(L, 1));
    return 1;
  });
}

int hash_text(lua_State* L) {
  return guard(L, [&] {
    push_text(L, hash(text_at(L, 1)));
    return 1;
  });
}

/// core.shortest(x): the fewest digits that read back as the same number.
int shortest(lua_State* L) {
  return guard(L, [&] {
    push_text(L, fmt::format("{}", luaL_checknumber(L, 1)));
    return 1;
  });
}

// === Checkpoints

/// core.pack { name = bytes, ... }: one checked byte string.
int pack(lua_State* L) {
  return guard(L, [&] {
    luaL_checktype(L, 1, LUA_TTABLE);
    std::map<std::string, std::string_view> sections;  // the table holds the texts meanwhile
    for (lua_pushnil(L); lua_next(L, 1); lua_pop(L, 1)) {
      if (lua_type(L, -2) != LUA_TSTRING) fail("pack: expected text keys, got {}", luaL_typename(L, -2));
      if (lua_type(L, -1) != LUA_TSTRING) fail("pack: expected texts, got {}", luaL_typename(L, -1));
      size_t size = 0;
      const char* bytes = lua_tolstring(L, -1, &size);
      sections[lua_tostring(L, -2)] = {bytes, size};
    }
    push_text(L, pack_sections(sections));
    return 1;
  });
}

int unpack(lua_State* L) {
  return guard(L, [&] {
    const auto sections = unpack_sections(text_at(L, 1));
    lua_createtable(L, 0, static_cast<int>(sections.size()));
    for (const auto& [name, bytes] : sections) {
      push_text(L, bytes);
      lua_setfield(L, -2, name.c_str());
    }
    return 1;
  });
}

/// core.random_state() and core.random_state(text): where math.random stands.
int random_state(lua_State* L) {
  return guard(L, [&] {
    RandomStream& stream = host(L).random;
    if (!lua_isnoneornil(L, 1)) {
      const std::string bytes = text_at(L, 1);
      ByteReader reader(bytes);
      stream.seed = reader.get<uint64_t>();
      stream.drawn = reader.get<uint64_t>();
      stream.seeded = reader.get<uint8_t>() != 0;
      return 0;
    }
    ByteWriter writer;
    writer.put(stream.seed);
    writer.put(stream.drawn);
    writer.put(static_cast<uint8_t>(stream.seeded));
    push_text(L, writer.bytes());
    return 1;
  });
}

int seed(lua_State* L) {
  lua_pushnumber(L, static_cast<double>(host(L).seed));
  return 1;
}

// === What the program knows

/// core.now(): seconds of a steady clock, for rates and intervals; never for results.
int now(lua_State* L) {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  lua_pushnumber(L, std::chrono::duration<double>(since).count());
  return 1;
}

/// core.date(): the time of day in UTC, ISO 8601.
int date(lua_State* L) {
  return guard(L, [&] {
    const std::time_t seconds = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    char text[32];
    lua_pushlstring(L, text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts));
    return 1;
  });
}

/// core.cancelled(): whether the run has been asked to stop.
int cancelled(lua_State* L) {
  lua_pushboolean(L, host(L).cancel.requested());
  return 1;
}

int process_id(lua_State* L) {
  lua_pushinteger(L, getpid());
  return 1;
}

/// core.blame_command_line(): the error that follows is about the command line, not about the script.
int blame_command_line(lua_State* L) {
  lua_pushboolean(L, 1);
  lua_setfield(L, LUA_REGISTRYINDEX, "tunica.usage");
  return 0;
}

int registry_table(lua_State* L, const char* name) {
  luaL_findtable(L, LUA_REGISTRYINDEX, name, 0);
  return 1;
}

/// core.overrides(): the key=value arguments of the command line, as text by name.
int overrides(lua_State* L) { return registry_table(L, "tunica.overrides"); }

/// core.sources(): list of {path=, text=} of the script and the modules of its own that it loaded, in order.
int sources(lua_State* L) { return registry_table(L, "tunica.sources"); }

/// core.did_you_mean(name, list): "; did you mean 'x'?" or "".
int suggestion(lua_State* L) {
  return guard(L, [&] {
    luaL_checktype(L, 2, LUA_TTABLE);
    std::vector<std::string> names;
    for (int i = 1, size = static_cast<int>(lua_objlen(L, 2)); i <= size; ++i) {
      lua_rawgeti(L, 2, i);
      names.push_back(text_at(L, lua_gettop(L)));
      lua_pop(L, 1);
    }
    push_text(L, did_you_mean(text_at(L, 1), names));
    return 1;
  });
}

/// core.where(): "file:line: " of the user's code that called, for error messages of the library.
int where(lua_State* L) {
  push_where(L);
  return 1;
}

/// core.note_errors(function(message) that returns the message, or nil): told where an error is first raised.
int note_errors_of(lua_State* L) {
  lua_settop(L, 1);
  note_errors(L);
  return 0;
}

}  // namespace

void register_run(lua_State* L) {
  const luaL_Reg functions[] = {{"write_atomic", write_file},
                                {"read_file", read_whole_file},
                                {"mkdir", make_folder},
                                {"list", list},
                                {"rename", rename_path},
                                {"lock_file", lock},
                                {"remove_all", remove_all},
                                {"kind_of", kind_of_path},
                                {"absolute_path", absolute_path},
                                {"shared_folder", shared_folder},
                                {"encode", encode},
                                {"decode", decode},
                                {"as_list", as_list},
                                {"hash", hash_text},
                                {"shortest", shortest},
                                {"pack", pack},
                                {"unpack", unpack},
                                {"random_state", random_state},
                                {"seed", seed},
                                {"now", now},
                                {"date", date},
                                {"cancelled", cancelled},
                                {"overrides", overrides},
                                {"sources", sources},
                                {"process_id", process_id},
                                {"blame_command_line", blame_command_line},
                                {"did_you_mean", suggestion},
                                {"where", where},
                                {"note_errors", note_errors_of},
                                {nullptr, nullptr}};
  for (const luaL_Reg* f = functions; f->name; ++f) {
    lua_pushcfunction(L, f->func);
    lua_setfield(L, -2, f->name);
  }
}

}  // namespace tunica::lua
