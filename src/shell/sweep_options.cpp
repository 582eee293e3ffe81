// SPDX-License-Identifier: MIT
#include "shell/sweep_options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <thread>

#include "base/error.h"
#include "shell/options.h"

namespace tunica::shell {

namespace {

constexpr const char* closing = R"text(
Parameters:
  D=3            fixed                    D=3,4,5        a list
  D=3..5         a range                  D=3..5:9       a range, nine values in a grid
  D=.01..10:log  equal ratios             n=3..9:whole   whole numbers
Scores are Lua expressions over names of the report and of parameters: "peaks - abs(spacing - 3)", also
  series.NAME.min, .max, .mean of a report with `every`. A sample's score is the mean over its seeds.
  The best are run anew on fresh seeds, and only that score is reported.
A sweep that was stopped goes on with the same command. Other commands:
  tunica sweep show FILE         best samples, counts, failures, plots
  tunica sweep merge OUT FILE..  one file of the parts of a sweep
More: share/doc/sweeps.md.)text";

constexpr size_t most_seeds = 100'000;

uint64_t read_whole(const char* option, const std::string& text) {
  uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > (uint64_t{1} << 53))
    throw UsageError{
        fmt::format("{}: expected whole numbers from 0 to 2^53 like 1..8 or 1,2,5, got '{}'", option, text)};
  return value;
}

void read_shard(SweepOptions& options, const std::string& text) {
  const size_t slash = text.find('/');
  const auto whole = [&](const std::string& part) {
    size_t value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size() ? value : 0;
  };
  if (slash != std::string::npos) {
    options.shard = whole(text.substr(0, slash));
    options.shards = whole(text.substr(slash + 1));
  }
  if (slash == std::string::npos || options.shard < 1 || options.shard > options.shards)
    throw UsageError{fmt::format("--shard: expected K/N with K from 1 to N, got '{}'", text)};
}

void add_samples(CLI::App& app, SweepOptions& options) {
  using sweep::Sampling;
  const auto sampling = [&options](Sampling kind, size_t count) {
    if (options.sampling != Sampling::none) throw UsageError{"only one of --grid, --random and --sobol can be given"};
    options.sampling = kind;
    options.count = count;
  };
  app.add_flag_callback(
      "--grid", [=] { sampling(Sampling::grid, 0); }, "all combinations of lists and steps");
  app.add_option_function<size_t>(
         "--random", [=](size_t n) { sampling(Sampling::random, n); }, "N random samples")
      ->type_name("N");
  app.add_option_function<size_t>(
         "--sobol", [=](size_t n) { sampling(Sampling::sobol, n); },
         "N samples that fill the ranges evenly (powers of two are best)")
      ->type_name("N");
  app.add_option("--sampling-seed", options.sampling_seed, "of samples and optimizer (default 1)")->type_name("N");
  app.add_option_function<std::string>(
         "--seeds", [&](const std::string& text) { options.seeds = read_seeds("--seeds", text); },
         "of the runs of each sample (default 1)")
      ->type_name("A..B");
  app.add_option("--until", options.until, "model time at which runs end")->type_name("T");
}

void add_search(CLI::App& app, SweepOptions& options) {
  app.add_option("--score", options.score, "what is sought: a Lua expression over the report")->type_name("EXPR");
  app.add_flag("--minimize,!--maximize", options.minimize, "the least score is the best (default: the greatest)");
  app.add_option("--refine", options.refine, "so many evaluations of an optimizer, from the best sample or the model")
      ->type_name("N");
  app.add_option("--method", options.method, "its method (default cmaes)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"cmaes"}));
  app.add_option("--step", options.step, "its first step as a share of each range (default 0.2)")->type_name("S");
  app.add_option("--population", options.population, "evaluations of one generation (default by parameters)")
      ->type_name("N");
  app.add_option("--winners", options.winners, "samples that are run on fresh seeds (default 5)")->type_name("N");
  app.add_option_function<std::string>(
         "--fresh-seeds", [&](const std::string& text) { options.fresh = read_seeds("--fresh-seeds", text); },
         "for winners (default: as many as --seeds, from 1000001)")
      ->type_name("A..B");
}

void add_engine(CLI::App& app, SweepOptions& options) {
  app.add_option("--out", options.out, "the SQLite file (default MODEL.db); goes on if it is there")->type_name("FILE");
  app.add_option("--jobs,-j", options.jobs, "processes (default: cores)")->type_name("N")->check(CLI::Range(1, 400));
  app.add_option("--time-limit", options.time_limit, "seconds that a run may take (default 3600)")->type_name("S");
  app.add_option("--memory", options.memory, "megabytes that a run may use (default: 0.8 of the machine / jobs)")
      ->type_name("MB");
  app.add_option_function<std::string>(
         "--shard", [&](const std::string& text) { read_shard(options, text); }, "only part K of N of the samples")
      ->type_name("K/N");
  app.add_flag("--retry", options.retry, "run failed runs again");
  app.add_flag("-q,--quiet", options.quiet, "no progress, no notes");
  app.add_option("script", options.script, "script, or name of a shipped model")->type_name("MODEL")->required();
  app.add_option("arguments", options.arguments, "parameters: name=value, name=low..high")->type_name("");
  app.footer(closing);
}

void add_show(CLI::App& app, SweepOptions& options) {
  app.add_option("files", options.files, "file of a sweep")->type_name("FILE")->required()->expected(1);
  app.add_option("--best", options.best, "how many are shown (default 10)")->type_name("N");
  app.add_flag("--failures", options.failures, "runs that failed, and why");
  app.add_flag("--csv", options.csv, "every run as a row of text separated by commas");
  app.add_option("--plot", options.plot, "one value against another")->type_name("X Y")->expected(2);
  app.add_option("--png", options.png, "draw the plot into this file, .png or .svg")->type_name("FILE");
  app.add_option("--sample", options.row, "everything about one sample")->type_name("N");
}

void check(const SweepOptions& o) {
  if (!(o.time_limit > 0)) throw UsageError{"--time-limit: expected a number of seconds above 0"};
  if (!(o.memory >= 0)) throw UsageError{"--memory: expected a number of megabytes"};
  if (!(o.step > 0 && o.step <= 1)) throw UsageError{"--step: expected a share of the ranges, above 0 and at most 1"};
  if (o.until && !(*o.until >= 0)) throw UsageError{"--until: expected a time from 0 on"};
  if (o.refine > 0 && o.score.empty()) throw UsageError{"--refine needs --score: what is sought?"};
  if (o.refine > 0 && o.shards > 1)
    throw UsageError{"--refine looks at all samples; run the shards first, merge them, then refine the merged file"};
  if (o.population > 0 && o.population < 5) throw UsageError{"--population: expected at least 5"};
  for (const uint64_t seed : o.fresh)
    if (std::binary_search(o.seeds.begin(), o.seeds.end(), seed))
      throw UsageError{
          fmt::format("--fresh-seeds: {} is among --seeds; fresh seeds are those the search never saw", seed)};
}

/// What was not said.
void complete(SweepOptions& o) {
  if (o.jobs == 0) o.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (!o.fresh.empty()) return;
  for (uint64_t seed = 1'000'001; o.fresh.size() < o.seeds.size(); ++seed)
    if (!std::binary_search(o.seeds.begin(), o.seeds.end(), seed)) o.fresh.push_back(seed);
}

}  // namespace

std::vector<uint64_t> read_seeds(const char* option, const std::string& text) {
  std::vector<uint64_t> seeds;
  size_t from = 0;
  while (from <= text.size()) {
    const size_t comma = std::min(text.find(',', from), text.size());
    const std::string part = text.substr(from, comma - from);
    const size_t dots = part.find("..");
    const uint64_t low = read_whole(option, part.substr(0, dots));
    const uint64_t high = dots == std::string::npos ? low : read_whole(option, part.substr(dots + 2));
    if (low > high) throw UsageError{fmt::format("{}: {}..{} is reversed; write {}..{}", option, low, high, high, low)};
    if (high - low >= most_seeds || seeds.size() > most_seeds)
      throw UsageError{fmt::format("{}: at most {} seeds", option, most_seeds)};
    for (uint64_t seed = low; seed <= high; ++seed) seeds.push_back(seed);
    from = comma + 1;
  }
  std::sort(seeds.begin(), seeds.end());
  if (std::adjacent_find(seeds.begin(), seeds.end()) != seeds.end())
    throw UsageError{fmt::format("{}: a seed is given twice in '{}'", option, text)};
  return seeds;
}

std::optional<SweepOptions> read_sweep_options(int argc, char** argv) {
  SweepOptions options;
  const std::string first = argc > 1 ? argv[1] : "";
  CLI::App app("Many runs of a model: grids, samples, a search for the best.",
               first == "show" || first == "merge" ? "tunica sweep " + first : "tunica sweep");
  app.get_formatter()->column_width(34);
  if (first == "show") {
    options.command = SweepOptions::Command::show;
    add_show(app, options);
    return parse_arguments(app, argc - 1, argv + 1) ? std::optional(options) : std::nullopt;
  }
  if (first == "merge") {
    options.command = SweepOptions::Command::merge;
    app.add_option("files", options.files, "the new file, then the parts")->type_name("OUT PART...")->required();
    return parse_arguments(app, argc - 1, argv + 1) ? std::optional(options) : std::nullopt;
  }
  add_samples(app, options);
  add_search(app, options);
  add_engine(app, options);
  if (!parse_arguments(app, argc, argv)) return std::nullopt;
  check(options);
  complete(options);
  return options;
}

double megabytes_for_a_run(const SweepOptions& options) {
  if (options.memory > 0) return options.memory;
  const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return 0.8 * bytes / 1048576 / options.jobs;
}

}  // namespace tunica::shell
