// SPDX-License-Identifier: MIT
#pragma once

namespace tunica::shell {

/// What the program returns; documented in share/doc/runs.md and in --help.
enum ExitCode : int {
  ok = 0,
  script_error = 1,           ///< also: a repeated run whose result differs
  usage_error = 2,            ///< command line, unknown model or parameter, a run directory that exists
  numerical_failure = 3,      ///< a value became NaN, a method broke down; the last good step is kept
  file_error = 4,             ///< the files of the run cannot be written
  stopped_by_scheduler = 75,  ///< SIGUSR1: checkpoint written, resume it
  hung_up = 129,
  interrupted = 130,
  terminated = 143,
};

}  // namespace tunica::shell
