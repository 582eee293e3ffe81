// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace tunica::lua {

/// A Lua state as models see it: interpreter only (no JIT), text chunks only, `pairs` in order, math.random from a
/// counter, undefined variables are errors, `require` finds the library and the script's own folder, nothing that can
/// crash the program (ffi, loadlib, most of debug) within reach. Closing it frees everything.
class State {
 public:
  /// `library`: folder that holds tunica/init.lua. Errors: out of memory.
  explicit State(const std::string& library);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  lua_State* get() const { return state_; }

 private:
  lua_State* state_;
};

/// Compiles source text and pushes the function. `name`: "@path" for a file, "=name" else. Errors: syntax (file:line
/// in the message), bytecode.
void load_text(lua_State* L, std::string_view text, const std::string& name);

/// Calls the function below its `arguments` on the stack. Returns nothing, or the error as text followed by the lines
/// of the user's own code that led there (frames of the library left out); then no results are left.
std::optional<std::string> call_protected(lua_State* L, int arguments, int results);

/// Where `require` looks for a script's own modules: folders, first match wins.
void set_search_folders(lua_State* L, const std::string& folders_separated_by_semicolons);

/// Notes a source file that took part in the run (a script, a module it required), for the run directory.
/// core.sources() lists them.
void note_source(lua_State* L, const std::string& path, std::string_view text);

/// Notes a data file that a script read, under the name by which it asked for it. `beside`: this is a path from the
/// folder of the script or module that asked.
void note_file(lua_State* L, const std::string& path, const std::string& asked, bool beside, std::string_view text);

/// From now on a file asked for by this name is the one at `path`: a copy that a run directory holds.
void set_copy(lua_State* L, const std::string& asked, const std::string& path);
/// Where the copy of a file is, or "" if there is none.
std::string copy_of(lua_State* L, const std::string& asked);

// --- Parts of the state, each filled by its own file.

/// Replaces pairs, math.random and math.randomseed by reproducible ones; makes undefined variables an error.
void open_reproducible(lua_State* L);

/// Replaces load, loadstring, loadfile, dofile and the loaders of `require`.
void open_loaders(lua_State* L, const std::string& library);

}  // namespace tunica::lua
