// SPDX-License-Identifier: MIT
#pragma once

#include "shell/sweep_model.h"
#include "shell/sweep_options.h"
#include "sweep/samples.h"
#include "sweep/table.h"

namespace tunica::shell {

/// What a sweep is to do.
struct SweepPlan {
  Description about;
  std::vector<sweep::Range> ranges;    ///< of the parameters named on the command line, in that order
  std::vector<sweep::Sample> samples;  ///< of grid, random or Sobol sampling; their numbers begin with 1

  /// A sample's parameters by name.
  Values values(const sweep::Sample& sample) const;
};

/// Reads ranges against the model and makes the samples. Errors: UsageError.
SweepPlan make_plan(SweepModel& model, const SweepOptions& options);

/// Writes the plan into the file, or checks that what the file holds is of the same: script, version, ranges, sampling,
/// end time. Samples may become more. Errors: UsageError that says what differs.
void settle_plan(sweep::Table& table, const SweepModel& model, const SweepOptions& options, const SweepPlan& plan);

/// Notes files that a run has read, JSON of path -> hash. Errors: UsageError if one was another when it was noted.
void settle_files(sweep::Table& table, const std::string& files);

/// What differs between two identities in words; "" if nothing does.
std::string difference(const std::string& there, const std::string& here);

}  // namespace tunica::shell
