// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "shell/exit_codes.h"
#include "shell/options.h"
#include "shell/sweep.h"
#include "shell/sweep_notes.h"
#include "shell/sweep_plan.h"
#include "shell/terminal.h"
#include "sweep/table.h"

namespace tunica::shell {

namespace {

/// Takes over what a part has and the whole lacks. Returns how many runs.
size_t take_over(sweep::Table& whole, const sweep::Table& part) {
  std::map<int64_t, sweep::SampleRow> samples;
  for (auto& row : whole.samples()) samples.emplace(row.sample, row);
  for (const auto& row : part.samples()) {
    const auto found = samples.find(row.sample);
    if (found == samples.end())
      whole.add_sample(row);
    else if (found->second.parameters != row.parameters)
      throw UsageError{fmt::format("'{}' holds other values for sample {}", part.path(), row.sample)};
  }
  std::map<std::pair<int64_t, uint64_t>, sweep::RunRow> runs;
  for (auto& row : whole.runs()) runs.emplace(std::pair(row.sample, row.seed), row);
  size_t taken = 0;
  for (const auto& row : part.runs()) {
    const auto found = runs.find({row.sample, row.seed});
    if (found == runs.end() || (found->second.status != "done" && row.status == "done")) {
      whole.add_run(row);
      ++taken;
    } else if (row.status == "done" && found->second.result != row.result) {
      throw UsageError{fmt::format("'{}' has another result for sample {}, seed {}: the machines differ, or one erred",
                                   part.path(), row.sample, row.seed)};
    }
  }
  return taken;
}

/// Takes over one part: what it is of, if the whole does not know yet, and its rows. Returns how many runs.
size_t merge_part(sweep::Table& whole, const std::string& path) {
  const sweep::Table part(path, sweep::Table::Mode::read);
  check_notes(part);
  const auto here = whole.note("identity"), there = part.note("identity");
  if (!there) throw UsageError{fmt::format("'{}' was stopped before its first run", part.path())};
  if (here)
    if (const std::string what = difference(*here, *there); !what.empty())
      throw UsageError{fmt::format("'{}' is of another sweep than '{}': {}", part.path(), whole.path(), what)};
  for (const char* name : {"identity", "model", "script", "build", "about", "settings"})
    if (const auto text = part.note(name); text && !here) whole.set_note(name, *text);
  auto settings = nlohmann::json::parse(*whole.note("settings"));
  settings["shard"] = settings["shards"] = 1;
  whole.set_note("settings", settings.dump());
  if (const auto files = part.note("files")) settle_files(whole, *files);
  return take_over(whole, part);
}

/// All parts or none: what was there before a part that does not fit stays as it was.
std::vector<size_t> merge_all(const std::string& out, const std::vector<std::string>& parts) {
  sweep::Table whole(out, sweep::Table::Mode::write);
  check_notes(whole);
  try {
    std::vector<size_t> taken;
    for (const auto& part : parts) taken.push_back(merge_part(whole, part));
    whole.commit();
    return taken;
  } catch (...) {
    whole.take_back();
    throw;
  }
}

}  // namespace

int merge_sweeps(const SweepOptions& options) try {
  if (options.files.size() < 2)
    throw UsageError{"merge: expected a new file and the parts: tunica sweep merge all.db part*.db"};
  const std::string& out = options.files[0];
  if (!lock_file(out + ".lock")) throw UsageError{fmt::format("'{}' is in use: another sweep writes to it", out)};
  for (size_t i = 1; i < options.files.size(); ++i)
    if (!std::filesystem::exists(options.files[i]))
      throw UsageError{fmt::format("there is no file '{}'", options.files[i])};
  const std::vector<std::string> parts(options.files.begin() + 1, options.files.end());
  std::error_code error;
  const bool is_new = !std::filesystem::exists(out, error);
  try {
    const auto taken = merge_all(out, parts);
    for (size_t i = 0; i < parts.size(); ++i) fmt::print("{}: {} runs\n", parts[i], taken[i]);
  } catch (...) {
    if (is_new) std::filesystem::remove(out, error);
    throw;
  }
  return ok;
} catch (const Error& error) {
  say_error(error.what());
  return file_error;
}

}  // namespace tunica::shell
