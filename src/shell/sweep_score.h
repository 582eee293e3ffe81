// SPDX-License-Identifier: MIT
#pragma once

#include "shell/sweep_model.h"

namespace tunica::shell {

/// The score of one run, or why it has none.
struct Score {
  std::optional<double> value;
  std::string why;
};

/// Evaluates an expression over results of runs (lua/tunica/sweep/score.lua).
class Scorer {
 public:
  /// Errors: UsageError for syntax, and names that neither report nor parameters have.
  Scorer(Session& session, const std::string& expression, const Description& about);
  ~Scorer();
  Scorer(const Scorer&) = delete;

  /// `result`: JSON of a run; `values`: parameters that differ from the model's own.
  Score operator()(const std::string& result, const Values& values);

 private:
  Session& session_;
  int compiled_;  ///< reference in Lua's registry
};

}  // namespace tunica::shell
