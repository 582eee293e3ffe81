// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lua/guard.h"
#include "lua/state.h"
#include "shell/options.h"
#include "shell/signals.h"

namespace tunica::shell {

/// A script as text with where it came from.
struct Script {
  std::string path;  ///< as given or found; "-" for standard input, "" for code of the command line
  std::string name;  ///< of the chunk, for Lua: "@path" or "=(...)"
  std::string text;
  std::string folders;                             ///< where its `require` looks, separated by semicolons
  std::map<std::string, std::string> copies = {};  ///< of files it reads, by the names it asks for them
};

inline constexpr const char* code_path = "(command line)";

/// One Lua state with what runs in it.
class Session {
 public:
  explicit Session(uint64_t seed);
  lua_State* lua() const { return state_.get(); }
  Interrupts& interrupts() { return interrupts_; }
  lua::TerminalTalk& terminal() { return terminal_; }

  /// key=value arguments, for tunica.params.
  void set_parameters(const std::map<std::string, std::string>& parameters);
  /// The table `arg`: [0] the script, [1].. its arguments.
  void set_arguments(const std::string& script, const std::vector<std::string>& arguments);

  /// Runs a chunk; its first result stays on the Lua stack if `keep`. Returns false after an error, which is printed;
  /// `exit_code` then says what to return.
  bool run(const Script& script, bool keep);

  /// Calls the function below its arguments; prints the error. For what follows the script.
  bool call(int arguments, int results);

  int exit_code() const { return exit_code_; }
  const std::string& error() const { return error_; }

  /// The exit code for a stop by the signal that came, or for an error in the script.
  int code_of_stop() const;

 private:
  lua::TerminalTalk terminal_;
  lua::State state_;
  Interrupts interrupts_;
  int exit_code_ = 0;
  std::string error_;
};

/// "D=2" -> {"D", "2"}; empty if some argument is not of this form.
std::optional<std::map<std::string, std::string>> read_parameters(const std::vector<std::string>& arguments,
                                                                  std::string* wrong);

}  // namespace tunica::shell
