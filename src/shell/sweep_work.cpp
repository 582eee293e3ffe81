// SPDX-License-Identifier: MIT
#include "shell/sweep_work.h"

#include "base/error.h"
#include "shell/terminal.h"

namespace tunica::shell {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double longest_uncommitted = 0.5;  // seconds of finished runs that a power cut or kill -9 may cost

double since(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

std::string clock(double seconds) {
  const auto s = static_cast<int64_t>(seconds + 0.5);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

SweepWork::SweepWork(SweepModel& model, const SweepPlan& plan, const SweepOptions& options, sweep::Table& table,
                     Scorer* scorer)
    : model_(model), plan_(plan), options_(options), table_(table), scorer_(scorer) {
  for (auto& row : table.samples()) {
    numbers_.emplace(row.parameters, row.sample);
    samples_.emplace(row.sample, std::move(row));
  }
  for (const auto& row : table.runs()) note(row);
}

void SweepWork::note(const sweep::RunRow& row) {
  Known known{row.status, {}};
  if (row.status != "done")
    known.score.why = row.status + ": " + row.message;
  else if (scorer_)
    known.score = (*scorer_)(row.result, plan_.values(samples_.at(row.sample).parameters));
  known_.insert_or_assign(Key{row.sample, row.seed}, known);
}

int64_t SweepWork::add_sample(const std::string& origin, const sweep::Sample& sample) {
  if (const auto found = numbers_.find(sample); found != numbers_.end()) return found->second;
  const int64_t number = samples_.empty() ? 1 : samples_.rbegin()->first + 1;
  const sweep::SampleRow row{number, origin, sample};
  table_.add_sample(row);
  samples_.emplace(number, row);
  numbers_.emplace(sample, number);
  return number;
}

std::optional<double> SweepWork::score(int64_t sample, const std::vector<uint64_t>& seeds, std::string* why) const {
  double sum = 0;
  for (const uint64_t seed : seeds) {
    const auto found = known_.find({sample, seed});
    if (found == known_.end() || !found->second.score.value) {
      if (why) *why = found == known_.end() ? "not run" : found->second.score.why;
      return std::nullopt;
    }
    sum += *found->second.score.value;
  }
  return sum / static_cast<double>(seeds.size());
}

void SweepWork::keep(const Task& task, const Outcome& outcome) {
  const sweep::RunRow row{.sample = task.sample,
                          .seed = task.seed,
                          .fresh = task.fresh,
                          .status = outcome.status,
                          .result = outcome.result,
                          .message = outcome.message,
                          .log = outcome.log,
                          .seconds = outcome.seconds,
                          .megabytes = outcome.megabytes};
  if (files_.insert(outcome.files).second) settle_files(table_, outcome.files);
  table_.add_run(row);
  note(row);
  ++made_;
  if (outcome.status != "done") ++failed_;
  in_runs_ += outcome.seconds;
  cpu_ += outcome.cpu_seconds;
}

void SweepWork::show_progress(bool last) {
  if (options_.quiet) return;
  const bool terminal = error_is_terminal();
  if (last) {
    if (terminal) fmt::print(stderr, "\r\033[K");
    return;
  }
  if (since(shown_) < (terminal ? 0.25 : 30)) return;
  shown_ = Clock::now();
  const size_t done = made_ + passed_over_, all = std::max(done, expected_);
  const double left = since(begun_) / static_cast<double>(made_) * static_cast<double>(all - done);
  fmt::print(stderr, "{}{} of {} runs{}, {} to go{}{}", terminal ? "\r\033[K" : "", done, all,
             failed_ ? fmt::format(" ({} failed)", failed_) : "", clock(left), remark_.empty() ? "" : ", " + remark_,
             terminal ? "" : "\n");
  std::fflush(stderr);
}

bool SweepWork::run(const std::vector<Task>& all) {
  std::vector<Task> tasks;
  for (const auto& task : all)
    if (!known_.contains({task.sample, task.seed})) tasks.push_back(task);
  passed_over_ += all.size() - tasks.size();
  if (tasks.empty()) return true;
  Pool pool(options_.jobs, {options_.time_limit, megabytes_for_a_run(options_)}, [&](size_t i, int descriptor) {
    const auto& sample = samples_.at(tasks[i].sample).parameters;
    return model_.run(plan_.values(sample), plan_.solution(sample), tasks[i].seed, options_.until, descriptor);
  });
  const auto begun = Clock::now();
  size_t next = 0;
  const auto stopped = [&] { return model_.session().interrupts().signal() != 0; };
  while ((next < tasks.size() || !pool.empty()) && !stopped()) {
    while (next < tasks.size() && !pool.full() && !stopped()) pool.start(next++);
    const double pending = table_.pending();
    const auto outcome = pool.wait(pending > 0 ? std::max(0.0, longest_uncommitted - pending) : 60);
    // The place of the run that has ended is filled before its row is written.
    if (outcome && next < tasks.size() && !stopped()) pool.start(next++);
    if (outcome) {
      keep(tasks[outcome->job], *outcome);
      show_progress(false);
    }
    if (table_.pending() >= longest_uncommitted) table_.commit();
  }
  pool.stop();
  show_progress(true);
  wall_ += since(begun);
  return !stopped();
}

}  // namespace tunica::shell
