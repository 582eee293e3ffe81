// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

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
  /// How a sample is solved: what stands in ranges named "solution.method", "solution.dt", "solution.tolerance", which
  /// are no parameters; of texts that are empty nothing. Only charts have them.
  Values solution(const sweep::Sample& sample) const;
};

/// What the names of such ranges begin with.
inline constexpr std::string_view solution_prefix = "solution.";

/// Reads ranges against the model and makes the samples. Errors: UsageError.
SweepPlan make_plan(SweepModel& model, const SweepOptions& options);

/// Writes the plan into the file, or checks that what the file holds is of the same: script, version, ranges, sampling,
/// end time. Samples may become more. Errors: UsageError that says what differs.
void settle_plan(sweep::Table& table, const SweepModel& model, const SweepOptions& options, const SweepPlan& plan);

/// Opens a file, which belongs to this process alone from now on. Errors: UsageError.
std::unique_ptr<sweep::Table> open_table(const std::string& path);

/// Notes files that a run has read, JSON of path -> hash. Errors: UsageError if one was another when it was noted.
void settle_files(sweep::Table& table, const std::string& files);

/// What differs between two identities in words; "" if nothing does.
std::string difference(const std::string& there, const std::string& here);

}  // namespace tunica::shell
