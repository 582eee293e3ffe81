// SPDX-License-Identifier: MIT
#include "shell/sweep_refine.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "shell/options.h"
#include "shell/terminal.h"
#include "sweep/search.h"

namespace tunica::shell {

namespace {

using nlohmann::json;
using sweep::Range;

/// Numbers of the ranges that a search moves in; lists and fixed values stay as they are at the start.
std::vector<size_t> dimensions_of(const SweepPlan& plan) {
  std::vector<size_t> list;
  for (size_t i = 0; i < plan.ranges.size(); ++i)
    if (plan.ranges[i].kind == Range::Kind::interval) list.push_back(i);
  return list;
}

/// The model's own value of a parameter that varies, or what the sweep allows that is nearest to it.
std::string own_value(const Range& range, const std::string& own) {
  if (range.kind == Range::Kind::interval) {
    const double value = std::strtod(own.c_str(), nullptr);
    return value >= range.low && value <= range.high ? own : range.at(range.place_of(value));
  }
  const auto found = std::find(range.values.begin(), range.values.end(), own);
  return found == range.values.end() ? range.values[0] : own;
}

sweep::Sample start_of(const SweepWork& work, const SweepOptions& options, const SweepPlan& plan) {
  const double sign = options.minimize ? 1 : -1;
  std::optional<double> least;
  sweep::Sample start;
  for (size_t i = 0; i < plan.samples.size(); ++i) {
    const auto score = work.score(static_cast<int64_t>(i) + 1, options.seeds);
    if (!score || (least && sign * *score >= *least)) continue;
    least = sign * *score;
    start = plan.samples[i];
  }
  if (!start.empty()) return start;
  for (const auto& range : plan.ranges)
    for (const auto& p : plan.about.parameters)
      if (p.name == range.name) start.push_back(own_value(range, p.value));
  return start;
}

/// A search goes on only as it began. Returns its start, which stays what it was even if samples that failed then have
/// better scores now.
sweep::Sample settle_search(sweep::Table& table, const SweepWork& work, const SweepOptions& options,
                            const SweepPlan& plan) {
  json here{{"method", options.method},
            {"step", options.step},
            {"population", options.population},
            {"score", options.score},
            {"direction", options.minimize ? "minimize" : "maximize"},
            {"seeds", options.seeds},
            {"samples before it", plan.samples.size()}};
  const auto text = table.note("search");
  if (!text) {
    here["start"] = start_of(work, options, plan);
    table.set_note("search", here.dump());
    return here["start"];
  }
  const json there = json::parse(*text);
  for (const auto& [name, value] : here.items())
    if (there.at(name) != value)
      throw UsageError{fmt::format("'{}' holds another search: {} is {} now, and was {} there; choose another --out",
                                   table.path(), name, value.dump(), there.at(name).dump())};
  return there.at("start");
}

/// One generation. Returns its values, the least the best; nothing when stopped.
std::optional<std::vector<double>> evaluate(SweepWork& work, const SweepOptions& options,
                                            const std::vector<sweep::Sample>& samples) {
  std::vector<int64_t> numbers;
  std::vector<Task> tasks;
  for (const auto& sample : samples) {
    numbers.push_back(work.add_sample(options.method, sample));
    if (std::count(numbers.begin(), numbers.end(), numbers.back()) > 1) continue;  // whole numbers may meet
    for (const uint64_t seed : options.seeds) tasks.push_back({numbers.back(), seed, false});
  }
  if (!work.run(tasks)) return std::nullopt;
  std::vector<double> values;
  for (const int64_t number : numbers) {
    const auto score = work.score(number, options.seeds);
    values.push_back(!score ? sweep::Search::worst : options.minimize ? *score : -*score);
  }
  return values;
}

}  // namespace

bool refine(SweepWork& work, const SweepOptions& options, const SweepPlan& plan, sweep::Table& table) {
  const auto dimensions = dimensions_of(plan);
  const sweep::Sample start = settle_search(table, work, options, plan);
  sweep::Search::Settings settings{
      .step = options.step, .population = options.population, .seed = options.sampling_seed};
  for (const size_t i : dimensions)
    settings.start.push_back(plan.ranges[i].place_of(std::strtod(start[i].c_str(), nullptr)));
  auto first = evaluate(work, options, {start});
  if (!first) return false;
  double best = (*first)[0];
  sweep::Search search(settings);
  for (size_t asked = 0; asked < options.refine;) {
    const auto points = search.ask();
    if (points.empty()) break;
    std::vector<sweep::Sample> samples(points.size(), start);
    for (size_t k = 0; k < points.size(); ++k)
      for (size_t i = 0; i < dimensions.size(); ++i)
        samples[k][dimensions[i]] = plan.ranges[dimensions[i]].at(points[k][i]);
    const auto values = evaluate(work, options, samples);
    if (!values) return false;
    search.tell(*values);
    asked += points.size();
    best = std::min(best, *std::min_element(values->begin(), values->end()));
    if (best < sweep::Search::worst) work.remark(fmt::format("best {:.6g}", options.minimize ? best : -best));
  }
  return true;
}

}  // namespace tunica::shell
