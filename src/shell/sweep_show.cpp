// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "shell/exit_codes.h"
#include "shell/options.h"
#include "shell/sweep.h"
#include "shell/sweep_view.h"

namespace tunica::shell {

namespace {

using Line = std::vector<std::string>;

/// Columns set to the right, below each other.
void print_columns(const std::vector<Line>& lines) {
  std::vector<size_t> widths;
  for (const auto& line : lines)
    for (size_t i = 0; i < line.size(); ++i) {
      if (i == widths.size()) widths.push_back(0);
      widths[i] = std::max(widths[i], line[i].size());
    }
  for (const auto& line : lines) {
    for (size_t i = 0; i < line.size(); ++i) fmt::print("{}{:>{}}", i ? "  " : "", line[i], widths[i]);
    fmt::print("\n");
  }
}

std::string brief(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end && *end == 0 && !text.empty() ? fmt::format("{:.5g}", value) : text;
}

void print_counts(const SweepView& view) {
  std::map<std::string, size_t> by_status;
  size_t fresh = 0;
  for (const auto& run : view.runs) {
    ++by_status[run.status];
    fresh += run.fresh;
  }
  std::string failures;
  for (const auto& [status, count] : by_status)
    if (status != "done") failures += fmt::format(", {} {}", count, status);
  fmt::print("{}: {} samples, {} runs done{}{}{}\n", view.model, view.samples.size(), by_status["done"],
             fresh ? fmt::format(" ({} of winners on fresh seeds)", fresh) : "", failures,
             view.missing() ? fmt::format(", {} left", view.missing()) : "");
  std::vector<std::string> ranges;
  for (const auto& p : view.parameters) ranges.push_back(p.name + "=" + p.range);
  fmt::print("  {}\n", fmt::join(ranges, " "));
}

/// One line of the table of best samples, before its score.
Line line_of(const SweepView& view, const sweep::SampleRow& sample) {
  Line line{std::to_string(sample.sample)};
  for (size_t i = 0; i < view.parameters.size(); ++i)
    if (view.parameters[i].varies) line.push_back(brief(sample.parameters[i]));
  return line;
}

Line head_of(const SweepView& view) {
  Line head{"sample"};
  for (const auto& p : view.parameters)
    if (p.varies) head.push_back(p.name);
  return head;
}

const sweep::SampleRow& row_of(const SweepView& view, int64_t number) {
  for (const auto& sample : view.samples)
    if (sample.sample == number) return sample;
  fail("there is no sample {}; the file has {}", number, view.samples.size());
}

/// Winners that have no score on fresh seeds.
size_t failed_winners(const SweepView& view) {
  std::set<int64_t> winners;
  for (const auto& run : view.runs)
    if (run.fresh && !view.score(run.sample, true)) winners.insert(run.sample);
  return winners.size();
}

void print_best(const SweepView& view, size_t count) {
  auto list = view.ranking(true);
  const bool fresh = !list.empty();
  if (!fresh) list = view.ranking(false);
  fmt::print("\nscore: {} ({})\n", view.settings.at("score").get<std::string>(),
             view.minimizes() ? "least is best" : "greatest is best");
  if (list.empty()) {
    std::string why;
    for (const auto& [key, score] : view.scores)
      if (!score.value) why = ": " + score.why;
    return fmt::print("no sample has a score yet{}\n", why);
  }
  if (!fresh)
    fmt::print(
        "These are scores on the seeds of the search; the best of many are flattered. Winners are not run yet.\n");
  std::vector<Line> lines{head_of(view)};
  lines[0].push_back(fresh ? "score on fresh seeds" : "score of the search");
  lines[0].push_back("std error");
  for (size_t i = 0; i < std::min(count, list.size()); ++i) {
    lines.push_back(line_of(view, row_of(view, list[i].first)));
    lines.back().push_back(fmt::format("{:.6g}", list[i].second.value));
    lines.back().push_back(list[i].second.count > 1 ? fmt::format("{:.2g}", list[i].second.error) : "-");
  }
  print_columns(lines);
  const auto& seeds = view.settings.at(fresh ? "fresh" : "seeds");
  const size_t lost = fresh ? failed_winners(view) : 0;
  if (lost > 0) fmt::print("{} more failed, or had no score, on a fresh seed\n", lost);
  fmt::print("\nthe best again: {}\n", view.command(row_of(view, list[0].first), seeds.at(0)));
}

/// Means over seeds of the numbers that a model reports, by name.
std::map<std::string, double> means_of(const SweepView& view, int64_t sample) {
  std::map<std::string, std::pair<double, double>> sums;
  for (const auto& run : view.runs)
    if (run.sample == sample)
      for (const auto& [name, value] : flatten(run.result))
        if (value.is_number() && name.starts_with("report.")) {
          auto& [sum, count] = sums[name.substr(7)];
          sum += value.get<double>();
          count += 1;
        }
  std::map<std::string, double> means;
  for (const auto& [name, entry] : sums) means[name] = entry.first / entry.second;
  return means;
}

/// Without a score: the first samples.
void print_samples(const SweepView& view, size_t count) {
  constexpr size_t most_names = 8;
  std::vector<std::map<std::string, double>> rows;
  std::set<std::string> names;
  for (size_t i = 0; i < std::min(count, view.samples.size()); ++i) {
    rows.push_back(means_of(view, view.samples[i].sample));
    for (const auto& [name, mean] : rows.back())
      if (names.size() < most_names) names.insert(name);
  }
  std::vector<Line> lines{head_of(view)};
  lines[0].insert(lines[0].end(), names.begin(), names.end());
  for (size_t i = 0; i < rows.size(); ++i) {
    lines.push_back(line_of(view, view.samples[i]));
    for (const auto& name : names)
      lines.back().push_back(rows[i].contains(name) ? fmt::format("{:.5g}", rows[i].at(name)) : "-");
  }
  fmt::print("\nmeans over seeds; no score was asked for\n");
  print_columns(lines);
  if (count < view.samples.size()) fmt::print("... {} more (--best N, --csv)\n", view.samples.size() - count);
}

void print_failures(const SweepView& view) {
  size_t count = 0;
  for (const auto& run : view.runs) {
    if (run.status == "done") continue;
    ++count;
    fmt::print("sample {} seed {}: {}: {}\n  {}\n", run.sample, run.seed, run.status, run.message,
               view.command(row_of(view, run.sample), run.seed));
  }
  if (count == 0) fmt::print("no run failed\n");
}

void print_sample(const SweepView& view, int64_t number) {
  const auto& sample = row_of(view, number);
  fmt::print("sample {} ({})\n", number, sample.origin);
  for (const auto& [name, value] : view.values(sample)) fmt::print("  {} = {}\n", name, value);
  for (const auto& run : view.runs) {
    if (run.sample != number) continue;
    fmt::print("\nseed {}{}: {} in {:.3g} s, {:.0f} MB\n", run.seed, run.fresh ? " (fresh)" : "", run.status,
               run.seconds, run.megabytes);
    for (const auto& [name, value] : flatten(run.result)) fmt::print("  {} = {}\n", name, as_text(value));
    if (const auto score = view.scores.find({number, run.seed}); score != view.scores.end())
      fmt::print("  score = {}\n", score->second.value ? sweep::shortest(*score->second.value) : score->second.why);
    if (!run.message.empty()) fmt::print("  {}\n", run.message);
    if (!run.log.empty()) fmt::print("{}\n", run.log);
    fmt::print("  {}\n", view.command(sample, run.seed));
  }
}

// --- Every run as a row --------------------------------------------------------------------------------------------

using Fields = std::map<std::string, std::string>;

constexpr std::string_view of_report = "report.", of_parameter = "parameter.", of_parameters = "parameters.";

/// Names that several of reports, parameters and a run's own values have; these are told apart by what they are of.
class Names {
 public:
  explicit Names(const SweepView& view) {
    for (const char* name : {"sample", "seed", "fresh", "status", "score"}) own_.insert(name);
    for (const auto& p : view.about.parameters) parameters_.insert(p.name);
    for (const auto& run : view.runs)
      for (const auto& [name, value] : flatten(run.result)) {
        if (name.starts_with(of_report))
          reports_.insert(name.substr(of_report.size()));
        else if (!name.starts_with(of_parameters))
          own_.insert(name);
      }
  }
  std::string report(const std::string& name) const {
    return taken(name) || parameters_.contains(name) ? std::string(of_report) + name : name;
  }
  std::string parameter(const std::string& name) const {
    return taken(name) || reports_.contains(name) ? std::string(of_parameter) + name : name;
  }

 private:
  bool taken(const std::string& name) const {
    return own_.contains(name) || name.starts_with(of_report) || name.starts_with(of_parameter);
  }
  std::set<std::string> own_, reports_, parameters_;
};

/// All values of a run by name; reports and parameters by their own names where these are no others'.
Fields fields_of(const SweepView& view, const Names& names, const sweep::SampleRow& sample, const sweep::RunRow& run) {
  Fields fields;
  for (const auto& [name, value] : flatten(run.result)) {
    if (name.starts_with(of_parameters)) continue;
    fields[name.starts_with(of_report) ? names.report(name.substr(of_report.size())) : name] = as_text(value);
  }
  for (const auto& [name, value] : view.parameters_of(sample, run)) fields[names.parameter(name)] = value;
  fields["sample"] = std::to_string(run.sample);
  fields["seed"] = std::to_string(run.seed);
  fields["fresh"] = std::to_string(int{run.fresh});
  fields["status"] = run.status;
  const auto score = view.scores.find({run.sample, run.seed});
  if (score != view.scores.end() && score->second.value) fields["score"] = sweep::shortest(*score->second.value);
  return fields;
}

std::vector<Fields> all_fields(const SweepView& view) {
  const Names names(view);
  std::map<int64_t, const sweep::SampleRow*> samples;
  for (const auto& sample : view.samples) samples[sample.sample] = &sample;
  std::vector<Fields> rows;
  for (const auto& run : view.runs) rows.push_back(fields_of(view, names, *samples.at(run.sample), run));
  return rows;
}

Line names_of(const SweepView& view, const std::vector<Fields>& rows) {
  const Names own(view);
  Line names{"sample", "seed", "fresh", "status"};
  for (const auto& p : view.parameters) names.push_back(own.parameter(p.name));
  if (view.has_score()) names.push_back("score");
  std::set<std::string> more;
  for (const auto& row : rows)
    for (const auto& [name, value] : row) more.insert(name);
  for (const auto& name : more)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of("\",\r\n") == std::string::npos) return text;
  std::string out(1, '"');
  for (const char c : text) {
    if (c == '"') out.push_back(c);
    out.push_back(c);
  }
  out.push_back('"');
  return out;
}

void print_csv(const SweepView& view) {
  const auto rows = all_fields(view);
  const Line names = names_of(view, rows);
  Line heads;
  for (const auto& name : names) heads.push_back(csv_field(name));
  fmt::print("{}\n", fmt::join(heads, ","));
  for (const auto& row : rows) {
    Line line;
    for (const auto& name : names) line.push_back(row.contains(name) ? csv_field(row.at(name)) : "");
    fmt::print("{}\n", fmt::join(line, ","));
  }
}

// --- Plots ---------------------------------------------------------------------------------------------------------

void push_list(lua_State* L, const char* name, const std::vector<double>& list) {
  lua_createtable(L, static_cast<int>(list.size()), 0);
  for (size_t i = 0; i < list.size(); ++i) {
    lua_pushnumber(L, list[i]);
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
  lua_setfield(L, -2, name);
}

void set_text(lua_State* L, const char* name, const std::string& text) {
  lua_pushlstring(L, text.data(), text.size());
  lua_setfield(L, -2, name);
}

/// Runs of the search only: those of winners would show them too often.
int print_plot(const SweepView& view, const SweepOptions& options) {
  const auto rows = all_fields(view);
  const Line names = names_of(view, rows);
  for (const auto& name : options.plot)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError{fmt::format("--plot: there is no '{}'{}; there are: {}", name, did_you_mean(name, names),
                                   fmt::join(names, ", "))};
  std::vector<double> x, y;
  for (const auto& row : rows) {
    if (row.at("fresh") != "0" || !row.contains(options.plot[0]) || !row.contains(options.plot[1])) continue;
    char *x_end = nullptr, *y_end = nullptr;
    const double a = std::strtod(row.at(options.plot[0]).c_str(), &x_end);
    const double b = std::strtod(row.at(options.plot[1]).c_str(), &y_end);
    if (*x_end || *y_end || !std::isfinite(a) || !std::isfinite(b)) continue;
    x.push_back(a);
    y.push_back(b);
  }
  if (x.empty()) throw UsageError{fmt::format("--plot: no run has numbers for {}", fmt::join(options.plot, " and "))};
  Session session(1);
  lua_State* L = session.lua();
  lua_getglobal(L, "require");
  lua_pushstring(L, "tunica.sweep.plot");
  if (!session.call(1, 1)) return session.exit_code();
  lua_newtable(L);
  if (!options.png.empty()) set_text(L, "file", options.png);
  push_list(L, "x", x);
  push_list(L, "y", y);
  set_text(L, "xlabel", options.plot[0]);
  set_text(L, "ylabel", options.plot[1]);
  set_text(L, "title", fmt::format("{}, {} runs", view.model, x.size()));
  if (!session.call(1, 1)) return session.exit_code();
  fmt::print("{}\n", lua_tostring(L, -1));
  return ok;
}

}  // namespace

int show_sweep(const SweepOptions& options) try {
  const SweepView view(options.files[0]);
  if (options.csv) return print_csv(view), ok;
  if (options.failures) return print_failures(view), ok;
  if (options.row) return print_sample(view, *options.row), ok;
  if (!options.plot.empty()) return print_plot(view, options);
  print_counts(view);
  view.has_score() ? print_best(view, options.best) : print_samples(view, options.best);
  return ok;
} catch (const Error& error) {
  throw UsageError{error.what()};
}

}  // namespace tunica::shell
