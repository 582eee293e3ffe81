// SPDX-License-Identifier: MIT
#include "shell/sweep_plan.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/bytes.h"
#include "base/error.h"
#include "base/files.h"
#include "shell/places.h"
#include "shell/sweep_notes.h"
#include "shell/terminal.h"
#include "shell/version.h"

namespace tunica::shell {

namespace {

using nlohmann::json;
using sweep::Sampling;

/// What two sweeps must have in common for their rows to be of one table.
json identity_of(const SweepOptions& options, const SweepPlan& plan) {
  json ranges = json::array();
  for (const auto& range : plan.ranges) ranges.push_back({range.name, range.text()});
  return {{"script", plan.about.hash},
          {"program", versions_as_text()},
          {"parameters", ranges},
          {"sampling", name_of(options.sampling)},
          {"sampling seed", options.sampling_seed},
          {"until", options.until ? json(*options.until) : json("the model's own")}};
}

/// Of the last command; `show` reads them.
json settings_of(const SweepOptions& options) {
  return {{"seeds", options.seeds},       {"fresh", options.fresh},     {"score", options.score},
          {"minimize", options.minimize}, {"winners", options.winners}, {"shard", options.shard},
          {"shards", options.shards}};
}

std::string name_and_text(const json& range) {
  return fmt::format("{}={}", range.at(0).get<std::string>(), range.at(1).get<std::string>());
}

std::string all_ranges(const json& ranges) {
  std::vector<std::string> parts;
  for (const auto& range : ranges) parts.push_back(name_and_text(range));
  return fmt::format("{}", fmt::join(parts, " "));
}

/// A fingerprint of the program and of the Lua half of its library. Versions say less: they rarely change.
std::string build_of_program() {
  std::string all = hash(read_file("/proc/self/exe"));
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(library_folder()))
    if (entry.path().extension() == ".lua") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) all += hash(read_file(path));
  return hash(all);
}

std::string as_text(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// The samples of the plan, those that the file has already compared.
void settle_samples(sweep::Table& table, const SweepOptions& options, const SweepPlan& plan) {
  const auto there = table.samples();
  size_t known = 0;
  while (known < there.size() && there[known].origin == name_of(options.sampling)) ++known;
  for (size_t i = 0; i < std::min(known, plan.samples.size()); ++i)
    if (there[i].parameters != plan.samples[i])
      throw UsageError{fmt::format("'{}' holds other values for sample {}", table.path(), i + 1)};
  if (plan.samples.size() > known && there.size() > known)
    throw UsageError{fmt::format("'{}' was refined from {} samples; more cannot be added to it; choose another --out",
                                 table.path(), known)};
  for (size_t i = known; i < plan.samples.size(); ++i)
    table.add_sample({static_cast<int64_t>(i) + 1, name_of(options.sampling), plan.samples[i]});
}

/// Arguments that can be nothing but fixed values.
Values plainly_fixed(const std::vector<std::string>& arguments) {
  Values values;
  for (const auto& argument : arguments) {
    const size_t equals = argument.find('=');
    if (equals == std::string::npos || equals == 0) continue;
    const std::string text = argument.substr(equals + 1);
    if (text.find_first_of(",'") == std::string::npos && text.find("..") == std::string::npos)
      values[argument.substr(0, equals)] = text;
  }
  return values;
}

/// Files that only some samples read are not in the model's own hash. Those that are missing here are left to the runs.
void check_files(const sweep::Table& table) {
  const auto there = table.note("files");
  if (!there) return;
  const json files = json::parse(*there);
  for (const auto& [path, noted] : files.items())
    if (std::filesystem::is_regular_file(path) && hash(read_file(path)) != noted)
      throw UsageError{
          fmt::format("'{}' holds another sweep: '{}', which some of its runs read, has changed since; "
                      "choose another --out",
                      table.path(), path)};
}

/// Winners are run on seeds that no search of the file saw, not only the one that is asked for now.
void check_fresh_seeds(const sweep::Table& table, const SweepOptions& options) {
  if (options.score.empty()) return;
  for (const auto& run : table.runs())
    if (!run.fresh && std::find(options.fresh.begin(), options.fresh.end(), run.seed) != options.fresh.end())
      throw UsageError{
          fmt::format("--fresh-seeds: {} is a seed of a search in '{}'; fresh seeds are those the search "
                      "never saw",
                      run.seed, table.path())};
}

}  // namespace

Values SweepPlan::values(const sweep::Sample& sample) const {
  Values values;
  for (size_t i = 0; i < ranges.size(); ++i)
    if (!ranges[i].name.starts_with(solution_prefix)) values[ranges[i].name] = sample[i];
  return values;
}

Values SweepPlan::solution(const sweep::Sample& sample) const {
  Values values;
  for (size_t i = 0; i < ranges.size(); ++i)
    if (ranges[i].name.starts_with(solution_prefix) && !sample[i].empty())
      values[ranges[i].name.substr(solution_prefix.size())] = sample[i];
  return values;
}

SweepPlan make_plan(SweepModel& model, const SweepOptions& options) {
  SweepPlan plan;
  // What the model is may depend on what is fixed; so it is loaded with that, as far as it can be told before its
  // parameters are known.
  const Values plain = plainly_fixed(options.arguments);
  const RunLimits limits{options.time_limit, megabytes_for_a_run(options)};
  plan.about = model.describe(plain, options.until, limits);
  Values fixed;
  bool varies = false;
  try {
    plan.ranges = sweep::read_ranges(plan.about.parameters, options.arguments);
    for (const auto& range : plan.ranges) {
      varies = varies || range.varies();
      if (!range.varies()) fixed[range.name] = range.values[0];
    }
    // A model as it is, on many seeds, is a grid of one.
    const bool seeds_only =
        !varies && options.sampling == Sampling::none && options.refine == 0 && options.seeds.size() > 1;
    plan.samples = sweep::make_samples(plan.ranges, seeds_only ? Sampling::grid : options.sampling, options.count,
                                       options.sampling_seed);
  } catch (const Error& error) {
    throw UsageError{error.what()};
  }
  if (options.refine > 0 && std::none_of(plan.ranges.begin(), plan.ranges.end(),
                                         [](const auto& range) { return range.kind == sweep::Range::Kind::interval; }))
    throw UsageError{"--refine moves within ranges (D=3..5), and there is none"};
  if (options.sampling == Sampling::none && options.refine == 0 && plan.samples.empty())
    throw UsageError{varies ? "how are the ranges to be sampled? Say --grid, --random N, --sobol N or --refine N"
                            : "nothing varies: give a parameter a range (D=3..5) or a list (D=3,4,5), and say --grid, "
                              "--random N, --sobol N or --refine N; or several --seeds"};
  if (fixed.size() > plain.size()) plan.about = model.describe(fixed, options.until, limits);
  return plan;
}

std::string difference(const std::string& there_text, const std::string& here_text) {
  const json there = json::parse(there_text), here = json::parse(here_text);
  if (there.at("script") != here.at("script")) return "the script (or a file that it reads) has changed since";
  if (there.at("parameters") != here.at("parameters"))
    return fmt::format("it varies {}, and not {}", all_ranges(there.at("parameters")),
                       all_ranges(here.at("parameters")));
  for (const char* name : {"program", "sampling", "sampling seed", "until"})
    if (there.at(name) != here.at(name))
      return fmt::format("{} is {} now, and was {} there", name, as_text(here.at(name)), as_text(there.at(name)));
  return "";
}

void settle_files(sweep::Table& table, const std::string& files) {
  if (files.empty()) return;
  const auto there = table.note("files");
  json noted = there ? json::parse(*there) : json::object();
  const size_t before = noted.size();
  const json read = json::parse(files);
  for (const auto& [path, hash] : read.items())
    if (noted.emplace(path, hash).first.value() != hash)
      throw UsageError{
          fmt::format("'{}' has changed since '{}' was begun: its runs do not fit together; choose another "
                      "--out",
                      path, table.path())};
  if (noted.size() > before) table.set_note("files", noted.dump());
}

std::unique_ptr<sweep::Table> open_table(const std::string& path) {
  try {
    // A process that was killed a moment ago may still be going.
    bool free = lock_file(path + ".lock");
    for (int i = 0; i < 20 && !free; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      free = lock_file(path + ".lock");
    }
    if (!free) throw UsageError{fmt::format("'{}' is in use: another sweep writes to it", path)};
    auto table = std::make_unique<sweep::Table>(path, sweep::Table::Mode::write);
    check_notes(*table);
    return table;
  } catch (const Error& error) {
    throw UsageError{error.what()};
  }
}

void settle_plan(sweep::Table& table, const SweepModel& model, const SweepOptions& options, const SweepPlan& plan) {
  const std::string identity = identity_of(options, plan).dump(), build = build_of_program();
  if (const auto there = table.note("identity")) {
    if (const std::string what = difference(*there, identity); !what.empty())
      throw UsageError{fmt::format("'{}' holds another sweep: {}; choose another --out", table.path(), what)};
  } else {
    table.set_note("identity", identity);
    table.set_note("model", model.given());
    table.set_note("script", model.script().text);
    table.set_note("build", build);
    table.set_note("about", plan.about.json);
  }
  check_files(table);
  check_fresh_seeds(table, options);
  if (table.note("build") != build && !options.quiet)
    say_warning(
        fmt::format("the program or its library has changed since '{}' was begun: results may differ", table.path()));
  settle_samples(table, options, plan);
  const std::string settings = settings_of(options).dump();
  if (table.note("settings") != settings) table.set_note("settings", settings);
  table.commit();
}

}  // namespace tunica::shell
