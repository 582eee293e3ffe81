// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <set>

#include "shell/sweep_plan.h"
#include "shell/sweep_pool.h"
#include "shell/sweep_score.h"

namespace tunica::shell {

/// One run that is to be made.
struct Task {
  int64_t sample;
  uint64_t seed;
  bool fresh;
};

/// What is known of a run.
struct Known {
  std::string status;
  Score score;
};

/// Makes runs by a pool of local processes and keeps their rows. Another engine would start `tunica sweep ... --shard
/// k/n` elsewhere, each with its own file, and merge the files.
class SweepWork {
 public:
  /// Reads what the file holds already. `scorer` may be null.
  SweepWork(SweepModel& model, const SweepPlan& plan, const SweepOptions& options, sweep::Table& table, Scorer* scorer);

  /// Makes those of the runs that the file does not hold. False when a signal stopped it; what was done is kept then.
  /// Errors: the file cannot be written (what was written before is kept).
  bool run(const std::vector<Task>& tasks);

  /// Adds a sample that an optimizer asks for, and returns its number; that of an equal one if there is one.
  int64_t add_sample(const std::string& origin, const sweep::Sample& sample);

  /// Mean score over seeds; nothing if a run failed or has no score. `why`, if given, is then told.
  std::optional<double> score(int64_t sample, const std::vector<uint64_t>& seeds, std::string* why = nullptr) const;

  /// Score of one run; null if it was not made.
  const Score* score_of(int64_t sample, uint64_t seed) const {
    const auto found = known_.find({sample, seed});
    return found == known_.end() ? nullptr : &found->second.score;
  }

  const std::map<int64_t, sweep::SampleRow>& samples() const { return samples_; }
  /// For the line of progress: runs that are to come in all, and words at its end.
  void expect(size_t runs) { expected_ = runs; }
  void remark(const std::string& text) { remark_ = text; }

  size_t made() const { return made_; }
  size_t failed() const { return failed_; }  ///< of those made now
  /// Share of the processes' time, from the first run to the last, in which a run was going on.
  double busy() const { return wall_ > 0 ? in_runs_ / (wall_ * options_.jobs) : 0; }
  double cpu_seconds() const { return cpu_; }
  double wall_seconds() const { return wall_; }

 private:
  using Key = std::pair<int64_t, uint64_t>;
  void note(const sweep::RunRow& row);
  void keep(const Task& task, const Outcome& outcome);
  void show_progress(bool last);

  SweepModel& model_;
  const SweepPlan& plan_;
  const SweepOptions& options_;
  sweep::Table& table_;
  Scorer* scorer_;
  std::map<Key, Known> known_;
  std::set<std::string> files_;  ///< that runs have told, seen to fit
  std::map<int64_t, sweep::SampleRow> samples_;
  std::map<sweep::Sample, int64_t> numbers_;
  size_t made_ = 0, failed_ = 0, expected_ = 0, passed_over_ = 0;
  std::string remark_;
  double wall_ = 0, in_runs_ = 0, cpu_ = 0;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now(), shown_ = begun_;
};

}  // namespace tunica::shell
