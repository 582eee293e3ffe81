// SPDX-License-Identifier: MIT
#include "shell/program.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "shell/batch.h"
#include "shell/exit_codes.h"
#include "shell/options.h"
#include "shell/places.h"
#include "shell/prompt.h"
#include "shell/score_chart.h"
#include "shell/screen.h"
#include "shell/sweep.h"
#include "shell/terminal.h"
#include "shell/version.h"

namespace tunica::shell {

namespace {

Script read_script(const std::string& given) {
  if (given == "-") return {"-", "=(standard input)", std::string(std::istreambuf_iterator<char>(std::cin), {}), "."};
  try {
    const std::string path = find_script(given);
    return {path, "@" + path, read_file(path, size_t{64} << 20), std::filesystem::path(path).parent_path().string()};
  } catch (const Error& error) {
    throw UsageError{error.what()};
  }
}

int list_models(bool json) {
  const auto models = shipped_models();
  if (json) {
    auto list = nlohmann::json::array();
    for (const auto& model : models) list.push_back({{"name", model.name}, {"about", model.about}});
    fmt::print("{}\n", list.dump(2));
    return ok;
  }
  size_t width = 0;
  for (const auto& model : models) width = std::max(width, model.name.size());
  for (const auto& model : models) fmt::print("{:<{}}  {}\n", model.name, width, model.about);
  return ok;
}

int show_version(bool json) {
  if (json)
    fmt::print("{}\n", nlohmann::json::parse(versions_as_json()).dump(2));
  else
    fmt::print("{}\n", versions_as_text());
  return ok;
}

/// What a failure before any run looks like to a program that reads --json.
int failed(const Options& options, const Session& session) {
  if (options.json)
    fmt::print("{}\n", nlohmann::json{{"status", "failed"}, {"message", session.error()}}.dump(
                           2, ' ', false, nlohmann::json::error_handler_t::replace));
  return session.exit_code();
}

/// Options that only a run has, given with a script that returned no model.
void warn_of_unused(const Options& options) {
  const bool unused = !options.out.empty() || options.until || options.movie || options.frames || options.json;
  if (unused && !options.quiet) say_warning("the script returned no model: options of a run have no effect");
}

int start_prompt(Session& session, const Options& options, bool banner, bool failed = false) {
  return run_prompt(session, {.banner = banner && !options.quiet,
                              .keeps_history = options.history,
                              .runs_init = options.init,
                              .failed = failed});
}

/// With -i the prompt comes also after a script that failed or was interrupted: there one can look why.
int after_failure(Session& session, const Options& options, const Script& script) {
  const int signal = session.interrupts().signal();
  if (!options.interactive || session.exit_code() == usage_error || (signal && signal != SIGINT))
    return failed(options, session);
  session.interrupts().calm(true);
  if (!script.path.empty() && script.path != "-" && script.path != code_path)
    say_note(
        fmt::format("the prompt has what was defined before; when the script is mended: load \"{}\"", script.path));
  return start_prompt(session, options, false, true);
}

int run_model(Session& session, Options& options, const Script& script, const std::string& name) {
  if (options.interactive) {
    lua_setfield(session.lua(), LUA_REGISTRYINDEX, "tunica.model");
    lua_pushstring(session.lua(), name.c_str());
    lua_setfield(session.lua(), LUA_REGISTRYINDEX, "tunica.model_name");
    return start_prompt(session, options, false);
  }
  return run_batch(session, options, script, name);
}

int run_script(Options& options) {
  // A run directory that exists is better refused before an hour of setting up.
  std::error_code none;
  if (std::filesystem::exists(options.out, none) && !std::filesystem::is_empty(options.out, none))
    throw UsageError{fmt::format("'{}' exists and is not empty; choose another --out{}", options.out,
                                 std::filesystem::exists(options.out + "/run.json", none)
                                     ? ", or continue it: tunica resume " + options.out
                                     : "")};
  Session session(options.seed.value_or(1));
  std::string wrong;
  const auto parameters = read_parameters(options.arguments, &wrong);
  if (parameters) session.set_parameters(*parameters);
  session.set_arguments(options.script, options.arguments);
  Script script;
  for (const auto& code : options.code) {
    script = {code_path, std::string("=") + code_path, code, "."};
    if (!session.run(script, true)) return after_failure(session, options, script);
  }
  const bool prompt = options.script.empty() && options.code.empty() && isatty(STDIN_FILENO);
  if (prompt) return start_prompt(session, options, true);
  if (!options.script.empty() || options.code.empty()) {
    if (options.script.empty()) options.script.assign(1, '-');  // GCC 12 warns of an assignment without reason
    script = read_script(options.script);
    if (!session.run(script, true)) return after_failure(session, options, script);
  }
  if (!is_model(session)) {
    if (session.exit_code()) return failed(options, session);
    if (options.interactive) return start_prompt(session, options, false);
    warn_of_unused(options);
    return ok;
  }
  if (!parameters) throw UsageError{fmt::format("expected name=value to change a parameter, got '{}'", wrong)};
  return run_model(session, options, script, stem_of(options.script.empty() ? "command" : options.script));
}

/// tunica chart, tunica stability: the model is loaded as for a run.
int run_study(const Options& options) {
  Session session(options.seed.value_or(1));
  std::string wrong;
  const auto parameters = read_parameters(options.arguments, &wrong);
  if (!parameters) throw UsageError{fmt::format("expected name=value to change a parameter, got '{}'", wrong)};
  session.set_parameters(*parameters);
  session.set_arguments(options.script, options.arguments);
  const Script script = read_script(options.script);
  if (!session.run(script, true)) return session.exit_code();
  if (!is_model(session)) {
    if (session.exit_code()) return session.exit_code();
    throw UsageError{fmt::format("'{}' returned no model", options.script)};
  }
  return run_batch(session, options, script, stem_of(options.script));
}

/// tunica curve: the editor alone.
int edit_curve(const Options& options) {
  Session session(1);
  tell_screen(session);
  lua_State* L = session.lua();
  lua_getglobal(L, "require");
  lua_pushliteral(L, "tunica.prompt.edit_curve");
  if (!session.call(1, 1)) return session.exit_code();
  lua_getfield(L, -1, "edit_file");
  lua_pushlstring(L, options.script.data(), options.script.size());
  session.call(1, 0);
  return session.interrupts().signal() ? session.code_of_stop() : session.exit_code();
}

int run_recorded(Options& options) {
  Record record;
  try {
    record = read_record(options.directory);
  } catch (const Error& error) {
    throw UsageError{error.what()};
  }
  Session session(record.seed);
  std::string wrong;
  session.set_parameters(read_parameters(record.arguments, &wrong).value_or(std::map<std::string, std::string>{}));
  session.set_arguments(record.script.path, record.arguments);
  options.arguments = record.arguments;
  options.code = record.code;
  for (const auto& code : record.code)
    if (!session.run({code_path, std::string("=") + code_path, code, "."}, false)) return failed(options, session);
  if (!session.run(record.script, true)) return failed(options, session);
  if (!is_model(session)) throw UsageError{fmt::format("'{}' returned no model", record.script.path)};
  return run_batch(session, options, record.script, record.name);
}

int run_command(Options& options) {
  switch (options.command) {
    case Options::Command::models:
      return list_models(options.json);
    case Options::Command::version:
      return show_version(options.json);
    case Options::Command::resume:
    case Options::Command::rerun:
      return run_recorded(options);
    case Options::Command::chart:
      return options.score ? chart_of_score(options) : run_study(options);
    case Options::Command::stability:
      return run_study(options);
    case Options::Command::curve:
      return edit_curve(options);
    case Options::Command::script:
      break;
  }
  return run_script(options);
}

/// What was printed must have arrived: `tunica model > /full/disk` is an error, a reader that went away is not.
int flush_output(int code) {
  errno = 0;
  if ((std::fflush(stdout) == 0 && !std::ferror(stdout)) || errno == EPIPE) return code;
  say_error(fmt::format("cannot write to standard output: {}", std::strerror(errno ? errno : EIO)));
  return code == ok ? file_error : code;
}

}  // namespace

int run_program(int argc, char** argv) {
  try {
    if (argc > 1 && std::strcmp(argv[1], "sweep") == 0) return flush_output(sweep_command(argc - 1, argv + 1));
    auto options = read_options(argc, argv);
    if (options && options->colour != "auto")
      choose_colour(options->colour == "always" ? Colour::always : Colour::never);
    return flush_output(options ? run_command(*options) : ok);
  } catch (const UsageError& error) {
    say_error(error.message);
    return flush_output(usage_error);
  } catch (const std::exception& error) {
    say_error(error.what());
    return flush_output(script_error);
  }
}

}  // namespace tunica::shell
