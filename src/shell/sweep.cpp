// SPDX-License-Identifier: MIT
#include "shell/sweep.h"

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "base/cancel.h"
#include "base/error.h"
#include "base/files.h"
#include "shell/exit_codes.h"
#include "shell/options.h"
#include "shell/places.h"
#include "shell/sweep_refine.h"
#include "shell/terminal.h"

namespace tunica::shell {

namespace {

/// The first `count` of the samples by score, the best first; equal ones by number.
std::vector<int64_t> best_samples(const SweepWork& work, const SweepOptions& options, size_t count) {
  std::vector<std::pair<double, int64_t>> list;
  for (const auto& [number, row] : work.samples())
    if (const auto score = work.score(number, options.seeds))
      list.push_back({options.minimize ? *score : -*score, number});
  std::sort(list.begin(), list.end());
  std::vector<int64_t> best;
  for (size_t i = 0; i < std::min(count, list.size()); ++i) best.push_back(list[i].second);
  return best;
}

std::vector<Task> tasks_of(const std::vector<int64_t>& samples, const std::vector<uint64_t>& seeds, bool fresh) {
  std::vector<Task> tasks;
  for (const int64_t sample : samples)
    for (const uint64_t seed : seeds) tasks.push_back({sample, seed, fresh});
  return tasks;
}

bool run_samples(SweepWork& work, const SweepOptions& options, const SweepPlan& plan) {
  std::vector<int64_t> mine;
  for (size_t i = options.shard - 1; i < plan.samples.size(); i += options.shards)
    mine.push_back(static_cast<int64_t>(i) + 1);
  return work.run(tasks_of(mine, options.seeds, false));
}

/// The best are run on seeds that the search never saw. False when stopped.
bool run_winners(SweepWork& work, const SweepOptions& options) {
  return work.run(tasks_of(best_samples(work, options, options.winners), options.fresh, true));
}

/// If no sample at all has a score, the expression is the likely reason.
void warn_of_scores(const SweepWork& work, const SweepOptions& options) {
  std::string why;
  for (const auto& [number, row] : work.samples())
    if (work.score(number, options.seeds, &why)) return;
  if (!work.samples().empty()) say_warning(fmt::format("no sample has a score; of the last one: {}", why));
}

void say_how_it_went(const SweepWork& work, const SweepOptions& options) {
  if (options.quiet || work.made() == 0) return;
  say_note(fmt::format("{} runs in {:.1f} s{}; {} processes, busy {:.0f} %, {:.2f} cores used", work.made(),
                       work.wall_seconds(), work.failed() ? fmt::format(", {} failed", work.failed()) : "",
                       options.jobs, 100 * work.busy(), work.cpu_seconds() / work.wall_seconds()));
}

/// All that is to be run. False when stopped by a signal.
bool run_all(SweepWork& work, const SweepOptions& options, const SweepPlan& plan, sweep::Table& table) {
  const size_t samples = plan.samples.size() / options.shards + options.refine;
  work.expect(samples * options.seeds.size() + (options.score.empty() ? 0 : options.winners * options.fresh.size()));
  if (!run_samples(work, options, plan)) return false;
  if (options.refine > 0 && !refine(work, options, plan, table)) return false;
  return options.score.empty() || options.shards > 1 || run_winners(work, options);
}

int run_plan(SweepModel& model, SweepOptions& options) {
  const SweepPlan plan = make_plan(model, options);
  std::unique_ptr<Scorer> scorer;
  if (!options.score.empty()) scorer = std::make_unique<Scorer>(model.session(), options.score, plan.about);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of the file's size is to be an error like a full disk
  const auto table = open_table(options.out);
  try {
    settle_plan(*table, model, options, plan);
    if (options.retry) table->remove_failures();
    SweepWork work(model, plan, options, *table, scorer.get());
    const bool whole = run_all(work, options, plan, *table);
    table->commit();
    say_how_it_went(work, options);
    if (!whole) {
      say_note(fmt::format("stopped; all finished runs are in '{}'; the same command goes on", options.out));
      return model.session().code_of_stop();
    }
    if (scorer) warn_of_scores(work, options);
  } catch (const Error& error) {
    say_error(fmt::format("{}; runs that finished before are kept, and the same command goes on", error.what()));
    return file_error;
  }
  options.files = {options.out};
  return options.quiet ? ok : show_sweep(options);
}

int run_sweep(SweepOptions& options) {
  if (options.out.empty()) options.out = stem_of(options.script) + ".db";
  SweepModel model(options.script);
  try {
    return run_plan(model, options);
  } catch (const Cancelled& stopped) {
    say_note(stopped.what());
    return model.session().code_of_stop();
  }
}

}  // namespace

int sweep_command(int argc, char** argv) {
  auto options = read_sweep_options(argc, argv);
  if (!options) return ok;
  switch (options->command) {
    case SweepOptions::Command::show:
      return show_sweep(*options);
    case SweepOptions::Command::merge:
      return merge_sweeps(*options);
    case SweepOptions::Command::run:
      break;
  }
  return run_sweep(*options);
}

}  // namespace tunica::shell
