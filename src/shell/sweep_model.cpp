// SPDX-License-Identifier: MIT
#include "shell/sweep_model.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/cancel.h"
#include "base/error.h"
#include "base/files.h"
#include "lua/guard.h"
#include "shell/exit_codes.h"
#include "shell/places.h"
#include "shell/terminal.h"

namespace tunica::shell {

namespace {

Script read_script(const std::string& given) {
  try {
    const std::string path = find_script(given);
    return {path, "@" + path, read_file(path, size_t{64} << 20), std::filesystem::path(path).parent_path().string()};
  } catch (const Error& error) {
    throw UsageError{error.what()};
  }
}

bool write_all(int descriptor, const std::string& text) {
  const char* bytes = text.data();
  size_t size = text.size();
  while (size > 0) {
    const ssize_t count = write(descriptor, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<size_t>(count);
  }
  return true;
}

bool require(Session& session, const char* module) {
  lua_getglobal(session.lua(), "require");
  lua_pushstring(session.lua(), module);
  return session.call(1, 1);
}

std::optional<double> number_in(const nlohmann::json& json, const char* name) {
  return json.contains(name) ? std::optional(json.at(name).get<double>()) : std::nullopt;
}

}  // namespace

Description read_description(const std::string& text) {
  using Type = sweep::Parameter::Type;
  Description about;
  const auto json = nlohmann::json::parse(text);
  for (const auto& p : json.at("parameters")) {
    const std::string type = p.at("type");
    about.parameters.push_back({.name = p.at("name"),
                                .type = type == "number"    ? Type::number
                                        : type == "boolean" ? Type::boolean
                                                            : Type::text,
                                .value = p.at("value"),
                                .min = number_in(p, "min"),
                                .max = number_in(p, "max")});
  }
  about.reports = json.at("reports").get<std::vector<std::string>>();
  about.hash = json.at("script");
  about.json = text;
  return about;
}

SweepModel::SweepModel(const std::string& given) : given_(given), script_(read_script(given)), session_(1) {
  // What every run needs is loaded before the first fork, so that a run costs no more than itself. The library takes
  // the globals that it finds for Lua's own: `arg` is one of them, as in a run by itself.
  session_.set_arguments(given_, {});
  for (const char* module : {"tunica", "tunica.sweep.run", "tunica.sweep.score"}) {
    if (!require(session_, module)) fail("the library cannot be loaded: {}", session_.error());
    lua_pop(session_.lua(), 1);
  }
}

bool SweepModel::load(const Values& values, uint64_t seed) {
  lua::host(session_.lua()).seed = seed;
  session_.set_parameters(values);
  std::vector<std::string> arguments;
  for (const auto& [name, value] : values) arguments.push_back(name + "=" + value);
  session_.set_arguments(given_, arguments);
  return session_.run(script_, true);
}

/// The files that the script has read, as JSON; "" if they cannot be told.
std::string SweepModel::files() {
  lua_State* L = session_.lua();
  lua_getglobal(L, "require");
  lua_pushstring(L, "tunica.sweep.run");
  if (lua::call_protected(L, 1, 1)) return "";
  lua_getfield(L, -1, "files");
  if (lua::call_protected(L, 0, 1)) return "";
  const std::string text = lua_tostring(L, -1);
  lua_pop(L, 2);
  return text;
}

/// The error that ended the script, in one line, for the parent.
int SweepModel::answer_error(int descriptor) {
  const std::string& error = session_.error();
  const std::string line = error.substr(0, error.find('\n'));
  const bool memory = line == "not enough memory" || line.ends_with(": out of memory");
  write_all(descriptor, answer_of(memory ? "memory" : "failed", line, "", memory ? "" : files()));
  return session_.exit_code();
}

int SweepModel::answer(const char* function, std::optional<double> until, const Values& solution, int descriptor) {
  lua_State* L = session_.lua();
  if (!require(session_, "tunica.sweep.run")) return answer_error(descriptor);
  lua_getfield(L, -1, function);
  lua_remove(L, -2);
  lua_insert(L, -2);  // below what the script returned
  until ? lua_pushnumber(L, *until) : lua_pushnil(L);
  solution.empty() ? lua_pushnil(L) : lua_newtable(L);
  for (const auto& [name, text] : solution) {
    lua_pushlstring(L, text.data(), text.size());
    lua_setfield(L, -2, name.c_str());
  }
  if (!session_.call(3, 2)) return answer_error(descriptor);
  size_t size = 0;
  if (const char* text = lua_tolstring(L, -2, &size))
    return write_all(descriptor, answer_of("done", "", std::string(text, size), files())) ? ok : file_error;
  const char* why = lua_tostring(L, -1);
  say_error(why);
  const std::string message(why);
  write_all(descriptor, answer_of("numerical", message.substr(0, message.find('\n')), "", files()));
  return numerical_failure;
}

Description SweepModel::describe(const Values& values, std::optional<double> until, const RunLimits& limits) {
  Pool pool(1, limits, [&](size_t, int descriptor) {
    return load(values, 1) ? answer("describe", until, {}, descriptor) : answer_error(descriptor);
  });
  pool.start(0);
  for (;;) {
    if (session_.interrupts().signal()) throw Cancelled();
    const auto outcome = pool.wait(1);
    if (!outcome) continue;
    if (outcome->status == "done") return read_description(outcome->result);
    const bool limited = outcome->status == "memory" || outcome->status == "time";
    throw UsageError{fmt::format("'{}': {}{}", given_, outcome->message,
                                 limited ? ", while the script was loaded to learn its parameters" : "")};
  }
}

int SweepModel::run(const Values& values, const Values& solution, uint64_t seed, std::optional<double> until,
                    int descriptor) {
  return load(values, seed) ? answer("run", until, solution, descriptor) : answer_error(descriptor);
}

}  // namespace tunica::shell
