// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>

#include "shell/session.h"
#include "shell/sweep_pool.h"
#include "sweep/range.h"

namespace tunica::shell {

/// What a sweep must know of a model.
struct Description {
  std::vector<sweep::Parameter> parameters;
  std::vector<std::string> reports;  ///< names
  std::string hash;                  ///< of the script with all files that took part
  std::string json;                  ///< all of this as it came
};

using Values = std::map<std::string, std::string>;  ///< parameters as text, by name

/// The model of a sweep. The library is loaded once; the script runs in children only.
class SweepModel {
 public:
  /// Errors: UsageError if there is no such script.
  explicit SweepModel(const std::string& given);

  Session& session() { return session_; }
  const Script& script() const { return script_; }
  /// Name by which `tunica` finds the model again.
  const std::string& given() const { return given_; }

  /// Loads the model in a child, within the limits of a run. Errors: UsageError with what the child said, or which
  /// limit it met; Cancelled by a signal.
  Description describe(const Values& values, std::optional<double> until, const RunLimits& limits);
  /// In a child: takes the model to its end and writes its result to the descriptor. `solution`: method, dt, tolerance;
  /// empty for the model's own. Returns an exit code.
  int run(const Values& values, const Values& solution, uint64_t seed, std::optional<double> until, int descriptor);

 private:
  bool load(const Values& values, uint64_t seed);
  int answer(const char* function, std::optional<double> until, const Values& solution, int descriptor);
  int answer_error(int descriptor);
  std::string files();

  std::string given_;
  Script script_;
  Session session_;
};

/// Reads the JSON that lua/tunica/sweep/run.lua makes of a model.
Description read_description(const std::string& json);

}  // namespace tunica::shell
