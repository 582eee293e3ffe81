// SPDX-License-Identifier: MIT
#include "shell/batch.h"

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "shell/exit_codes.h"
#include "shell/terminal.h"
#include "shell/version.h"

namespace tunica::shell {

namespace {

namespace fs = std::filesystem;

void set_text(lua_State* L, const char* name, const std::string& value) {
  lua_pushlstring(L, value.data(), value.size());
  lua_setfield(L, -2, name);
}
void set_flag(lua_State* L, const char* name, bool value) {
  lua_pushboolean(L, value);
  lua_setfield(L, -2, name);
}
void set_list(lua_State* L, const char* name, const std::vector<std::string>& list) {
  lua_createtable(L, static_cast<int>(list.size()), 0);
  for (size_t i = 0; i < list.size(); ++i) {
    lua_pushlstring(L, list[i].data(), list[i].size());
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
  lua_setfield(L, -2, name);
}
void set_number(lua_State* L, const char* name, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, name);
}

/// The options as the table that run.begin takes.
void push_options(lua_State* L, const Options& options, const Script& script, const std::string& name) {
  lua_newtable(L);
  if (!options.out.empty()) set_text(L, "out", options.out);
  if (options.until) set_number(L, "until_time", *options.until);
  if (options.frames) set_flag(L, "frames", *options.frames);
  set_flag(L, "movie", options.movie);
  set_flag(L, "json", options.json);
  set_flag(L, "quiet", options.quiet);
  set_flag(L, "terminal", error_is_terminal());
  set_number(L, "checkpoint", options.checkpoint);
  set_text(L, "name", name);
  set_text(L, "script", script.path);
  set_text(L, "versions", versions_as_json());
  if (options.command == Options::Command::resume) set_text(L, "resume", options.directory);
  if (options.command == Options::Command::rerun) set_text(L, "rerun", options.directory);
  if (!options.quantity.empty()) set_text(L, "quantity", options.quantity);
  set_list(L, "methods", options.methods);
  set_number(L, "error", options.error.value_or(1e-3));
  set_number(L, "repeats", options.repeats);
  if (options.seconds) set_number(L, "seconds", *options.seconds);
  set_list(L, "arguments", options.arguments);
  // Code that is the script itself is kept as the script.
  set_list(L, "code", script.path == code_path ? std::vector<std::string>{} : options.code);
}

/// The module of lua/tunica that has begin, loop and close of what is asked for.
const char* driver_of(const Options& options) {
  if (options.command == Options::Command::chart) return "tunica.chart";
  if (options.command == Options::Command::stability) return "tunica.stability";
  return "tunica.run";
}

/// Pushes a function of a driver.
bool push_driver(Session& session, const char* driver, const char* name) {
  lua_State* L = session.lua();
  lua_getglobal(L, "require");
  lua_pushstring(L, driver);
  if (!session.call(1, 1)) return false;
  lua_getfield(L, -1, name);
  lua_remove(L, -2);
  return true;
}

}  // namespace

Record read_record(const std::string& directory) {
  if (!fs::is_directory(directory)) fail("'{}' is not a folder; expected a run directory", directory);
  const std::string path = directory + "/run.json";
  if (!fs::exists(path)) fail("'{}' is not a run directory: it has no run.json", directory);
  try {
    const auto json = nlohmann::json::parse(read_file(path));
    Record record;
    const std::string copy = json.at("script").at("copy");
    const std::string original = json.at("script").at("path");
    record.script.path = directory + "/" + copy;
    record.script.name = "@" + record.script.path;
    record.script.text = read_file(record.script.path);
    // Modules and curves come from their copies; modules not yet required then, from where the script stood.
    record.script.folders = directory + "/script;" + fs::path(original).parent_path().string();
    for (const auto& file : json.at("script").value("files", nlohmann::json::array()))
      if (file.contains("asked"))
        record.script.copies[file.at("asked")] = directory + "/" + file.at("copy").get<std::string>();
    record.name = json.at("name");
    record.seed = json.at("seed");
    record.code = json.at("code").get<std::vector<std::string>>();
    record.arguments = json.at("arguments").get<std::vector<std::string>>();
    return record;
  } catch (const nlohmann::json::exception& error) {
    fail("'{}' is damaged: {}", path, error.what());
  }
}

bool is_model(Session& session) {
  lua_State* L = session.lua();
  if (!lua_istable(L, -1) && !lua_isuserdata(L, -1)) return false;
  lua_pushvalue(L, -1);
  if (!push_driver(session, "tunica.run", "is_model")) return false;
  lua_insert(L, -2);
  if (!session.call(1, 1)) return false;
  const bool yes = lua_toboolean(L, -1);
  lua_pop(L, 1);
  return yes;
}

int run_batch(Session& session, const Options& options, const Script& script, const std::string& name) {
  lua_State* L = session.lua();
  Interrupts& interrupts = session.interrupts();
  std::signal(SIGPIPE, SIG_IGN);  // a run goes on when nobody reads what it prints
  const int model = lua_gettop(L);
  const char* driver = driver_of(options);
  if (!push_driver(session, driver, "begin")) return session.exit_code();
  lua_pushvalue(L, model);
  push_options(L, options, script, name);
  if (!session.call(2, 2)) return session.exit_code();
  // begin(model, options) -> the run, or nil and an exit code after it has said why.
  if (lua_isnil(L, -2)) return static_cast<int>(lua_tointeger(L, -1));
  lua_pop(L, 1);
  const int run = lua_gettop(L);

  if (!push_driver(session, driver, "loop")) return session.exit_code();
  lua_pushvalue(L, run);
  const auto error = lua::call_protected(L, 1, 1);
  const int stop = interrupts.signal();
  const int code = stop || error ? session.code_of_stop() : 0;
  interrupts.calm(false);  // the loop has unwound; what follows must not be stopped, except by a second signal

  if (!push_driver(session, driver, "close")) return session.exit_code();
  lua_pushvalue(L, run);
  if (error && !stop)
    lua_pushlstring(L, error->data(), error->size());
  else
    lua_pushnil(L);
  lua_pushinteger(L, code);
  if (!session.call(3, 1)) return session.exit_code();
  return static_cast<int>(lua_tointeger(L, -1));
}

}  // namespace tunica::shell
