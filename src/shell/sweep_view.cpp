// SPDX-License-Identifier: MIT
#include "shell/sweep_view.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "shell/options.h"
#include "shell/sweep_notes.h"

namespace tunica::shell {

namespace {

using nlohmann::json;

void flatten_into(const std::string& name, const json& value, std::vector<std::pair<std::string, json>>& out) {
  if (!value.is_structured()) return out.push_back({name, value});
  for (const auto& [key, item] : value.items()) {
    const std::string inner = value.is_array() ? std::to_string(std::stoul(key) + 1) : key;
    flatten_into(name.empty() ? inner : name + "." + inner, item, out);
  }
}

/// As a shell takes it.
std::string quoted(const std::string& text) {
  const bool plain =
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%") ==
      std::string::npos;
  if (plain && !text.empty()) return text;
  std::string out(1, '\'');
  for (const char c : text)
    if (c == '\'')
      out.append("'\\''");
    else
      out.push_back(c);
  out.push_back('\'');
  return out;
}

}  // namespace

std::vector<std::pair<std::string, json>> flatten(const std::string& result) {
  std::vector<std::pair<std::string, json>> out;
  if (!result.empty()) flatten_into("", json::parse(result), out);
  return out;
}

std::string as_text(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number() ? sweep::shortest(value.get<double>()) : value.dump();
}

SweepView::SweepView(const std::string& path) {
  const sweep::Table table(path, sweep::Table::Mode::read);
  check_notes(table);
  const auto note = [&](const char* name) {
    const auto text = table.note(name);
    if (!text) fail("'{}' is of a sweep that was stopped before its first run", path);
    return *text;
  };
  model = note("model");
  about = read_description(note("about"));
  identity = json::parse(note("identity"));
  settings = json::parse(note("settings"));
  for (const auto& range : identity.at("parameters")) {
    const std::string name = range.at(0), text = range.at(1);
    const bool varies = text.find("..") != std::string::npos || text.find(',') != std::string::npos;
    parameters.push_back({name, text, varies});
  }
  samples = table.samples();
  runs = table.runs();
  if (!has_score()) return;
  session_ = std::make_unique<Session>(1);
  std::unique_ptr<Scorer> scorer;
  try {
    scorer = std::make_unique<Scorer>(*session_, settings.at("score"), about);
  } catch (const UsageError& error) {
    table.damaged(fmt::format("the score that it notes cannot be read ({})", error.message));
  }
  std::map<int64_t, Values> values_of;
  for (const auto& sample : samples) values_of[sample.sample] = values(sample);
  for (const auto& run : runs)
    if (run.status == "done") scores[{run.sample, run.seed}] = (*scorer)(run.result, values_of[run.sample]);
}

Values SweepView::values(const sweep::SampleRow& sample) const {
  Values list;
  for (size_t i = 0; i < parameters.size() && i < sample.parameters.size(); ++i)
    list[parameters[i].name] = sample.parameters[i];
  return list;
}

Values SweepView::parameters_of(const sweep::SampleRow& sample, const sweep::RunRow& run) const {
  Values list = values(sample);
  for (const auto& [name, value] : flatten(run.result))
    if (name.starts_with("parameters.")) list[name.substr(11)] = as_text(value);
  return list;
}

std::optional<Mean> SweepView::score(int64_t sample, bool fresh) const {
  Mean mean;
  double sum = 0, squares = 0;
  for (const uint64_t seed : seeds(fresh)) {
    const auto found = scores.find({sample, seed});
    if (found == scores.end() || !found->second.value) return std::nullopt;
    sum += *found->second.value;
    ++mean.count;
  }
  mean.value = sum / static_cast<double>(mean.count);
  for (const uint64_t seed : seeds(fresh)) squares += std::pow(*scores.at({sample, seed}).value - mean.value, 2);
  if (mean.count > 1)
    mean.error = std::sqrt(squares / static_cast<double>(mean.count - 1) / static_cast<double>(mean.count));
  return mean;
}

std::vector<std::pair<int64_t, Mean>> SweepView::ranking(bool fresh) const {
  std::vector<std::pair<int64_t, Mean>> list;
  for (const auto& sample : samples)
    if (const auto mean = score(sample.sample, fresh)) list.push_back({sample.sample, *mean});
  std::stable_sort(list.begin(), list.end(), [&](const auto& a, const auto& b) {
    return minimizes() ? a.second.value < b.second.value : a.second.value > b.second.value;
  });
  return list;
}

size_t SweepView::missing() const {
  const int64_t shard = settings.at("shard"), shards = settings.at("shards");
  const auto mine = [&](int64_t sample) { return (sample - shard) % shards == 0; };
  const auto wanted = seeds(false);
  size_t missing = 0;
  for (const auto& sample : samples)
    if (mine(sample.sample)) missing += wanted.size();
  for (const auto& run : runs)
    if (mine(run.sample)) missing -= std::binary_search(wanted.begin(), wanted.end(), run.seed);
  return missing;
}

std::string SweepView::command(const sweep::SampleRow& sample, uint64_t seed) const {
  std::string text = "tunica " + quoted(model);
  for (size_t i = 0; i < parameters.size(); ++i)
    text += fmt::format(" {}", quoted(fmt::format("{}={}", parameters[i].name, sample.parameters[i])));
  if (identity.at("until").is_number()) text += fmt::format(" --until {}", identity.at("until").get<double>());
  return text + fmt::format(" --seed {}", seed);
}

}  // namespace tunica::shell
