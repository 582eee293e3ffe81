// SPDX-License-Identifier: MIT
#include "shell/session.h"

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "base/error.h"
#include "lua/guard.h"
#include "shell/exit_codes.h"
#include "shell/places.h"
#include "shell/terminal.h"

namespace tunica::shell {

Session::Session(uint64_t seed) : state_(library_folder()), interrupts_(state_.get()) {
  lua::host(lua()).seed = seed;
  lua::host(lua()).terminal = &terminal_;
}

void Session::set_parameters(const std::map<std::string, std::string>& parameters) {
  luaL_findtable(lua(), LUA_REGISTRYINDEX, "tunica.overrides", 0);
  for (const auto& [name, value] : parameters) {
    lua_pushlstring(lua(), value.data(), value.size());
    lua_setfield(lua(), -2, name.c_str());
  }
  lua_pop(lua(), 1);
}

void Session::set_arguments(const std::string& script, const std::vector<std::string>& arguments) {
  lua_newtable(lua());
  lua_pushstring(lua(), script.c_str());
  lua_rawseti(lua(), -2, 0);
  for (size_t i = 0; i < arguments.size(); ++i) {
    lua_pushlstring(lua(), arguments[i].data(), arguments[i].size());
    lua_rawseti(lua(), -2, static_cast<int>(i) + 1);
  }
  lua_setglobal(lua(), "arg");
}

bool Session::run(const Script& script, bool keep) {
  try {
    if (!script.folders.empty()) lua::set_search_folders(lua(), script.folders);
    for (const auto& [asked, path] : script.copies) lua::set_copy(lua(), asked, path);
    lua::note_source(lua(), script.path, script.text);
    lua::load_text(lua(), script.text, script.name);
  } catch (const Error& error) {
    error_ = error.what();
    exit_code_ = script_error;
    say_error(error_);
    return false;
  }
  return call(0, keep ? 1 : 0);
}

bool Session::call(int arguments, int results) {
  auto error = lua::call_protected(lua(), arguments, results);
  if (!error) return true;
  exit_code_ = code_of_stop();
  lua_getfield(lua(), LUA_REGISTRYINDEX, "tunica.usage");
  if (exit_code_ == script_error && lua_toboolean(lua(), -1)) exit_code_ = usage_error;
  lua_pop(lua(), 1);
  if (exit_code_ == usage_error) error->erase(std::min(error->find('\n'), error->size()));
  if (interrupts_.signal()) {
    error_ = "interrupted";
    say_note(error_);
  } else {
    error_ = *error;
    say_error(error_);
  }
  return false;
}

int Session::code_of_stop() const {
  switch (interrupts_.signal()) {
    case 0:
      return script_error;
    case SIGUSR1:
      return stopped_by_scheduler;
    default:
      return 128 + interrupts_.signal();
  }
}

std::optional<std::map<std::string, std::string>> read_parameters(const std::vector<std::string>& arguments,
                                                                  std::string* wrong) {
  std::map<std::string, std::string> parameters;
  for (const auto& argument : arguments) {
    const size_t equals = argument.find('=');
    if (equals == std::string::npos || equals == 0) {
      *wrong = argument;
      return std::nullopt;
    }
    parameters[argument.substr(0, equals)] = argument.substr(equals + 1);
  }
  return parameters;
}

}  // namespace tunica::shell
