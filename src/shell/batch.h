// SPDX-License-Identifier: MIT
#pragma once

#include "shell/session.h"

namespace tunica::shell {

/// What a run directory says of the run that made it.
struct Record {
  Script script;
  std::string name;
  std::vector<std::string> arguments;
  std::vector<std::string> code;  ///< of -e, run before the script
  uint64_t seed = 1;
};

/// Reads run.json and the script's copy. Errors: not a run directory, damaged.
Record read_record(const std::string& directory);

/// Whether the value on top of the Lua stack is a model.
bool is_model(Session& session);

/// Runs the model on top of the Lua stack to its end into a run directory (lua/tunica/run.lua does it), or continues or
/// repeats the run in `options.directory`; or makes its chart (lua/tunica/chart.lua) or tries its stability
/// (stability.lua). Returns the exit code.
int run_batch(Session& session, const Options& options, const Script& script, const std::string& name);

}  // namespace tunica::shell
