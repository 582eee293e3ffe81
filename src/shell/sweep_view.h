// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <nlohmann/json.hpp>

#include "shell/sweep_score.h"
#include "sweep/table.h"

namespace tunica::shell {

/// A number with what it is not known better than.
struct Mean {
  double value = 0;
  double error = 0;  ///< standard error of the mean; 0 for a single value
  size_t count = 0;
};

/// The file of a sweep, read to be shown.
class SweepView {
 public:
  /// Errors: no such file, not a sweep.
  explicit SweepView(const std::string& path);

  struct Varied {
    std::string name, range;
    bool varies;
  };
  std::string model;               ///< as it was given
  std::vector<Varied> parameters;  ///< those that the command line named
  Description about;
  nlohmann::json identity, settings;
  std::vector<sweep::SampleRow> samples;
  std::vector<sweep::RunRow> runs;  ///< by sample and seed
  std::map<std::pair<int64_t, uint64_t>, Score> scores;

  bool has_score() const { return !settings.at("score").get<std::string>().empty(); }
  bool minimizes() const { return settings.at("minimize"); }
  Values values(const sweep::SampleRow& sample) const;
  /// All parameters as the run had them; if it failed, those of its sample.
  Values parameters_of(const sweep::SampleRow& sample, const sweep::RunRow& run) const;
  /// Mean score of a sample over seeds of the search, or over fresh ones; nothing unless all of these are there.
  std::optional<Mean> score(int64_t sample, bool fresh) const;
  /// Samples by that score, the best first.
  std::vector<std::pair<int64_t, Mean>> ranking(bool fresh) const;
  /// Runs that the search wants and the file lacks.
  size_t missing() const;
  /// `tunica MODEL D=3 ... --seed 1`.
  std::string command(const sweep::SampleRow& sample, uint64_t seed) const;

 private:
  std::vector<uint64_t> seeds(bool fresh) const { return settings.at(fresh ? "fresh" : "seeds"); }
  std::unique_ptr<Session> session_;
};

/// The numbers and texts of a run by dotted name: "report.peaks", "time".
std::vector<std::pair<std::string, nlohmann::json>> flatten(const std::string& result);

/// A text without quotes, a number in its shortest form.
std::string as_text(const nlohmann::json& value);

}  // namespace tunica::shell
