// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep/samples.h"

namespace tunica::shell {

/// What `tunica sweep` is asked for.
struct SweepOptions {
  enum class Command { run, show, merge };
  Command command = Command::run;
  std::string script;                  ///< path, or name of a shipped model
  std::vector<std::string> arguments;  ///< name=value, name=low..high, name=a,b,c
  std::string out;                     ///< the SQLite file; "" = MODEL.db
  std::optional<double> until;

  sweep::Sampling sampling = sweep::Sampling::none;
  size_t count = 0;            ///< of random and Sobol samples
  uint64_t sampling_seed = 1;  ///< of samples and of the optimizer, not of the runs
  std::vector<uint64_t> seeds = {1};
  std::vector<uint64_t> fresh;  ///< for winners; {} = as many as `seeds`, from 1,000,001 on

  std::string score;  ///< a Lua expression; "" = none
  bool minimize = false;
  size_t winners = 5;
  size_t refine = 0;  ///< evaluations of the optimizer
  std::string method = "cmaes";
  double step = 0.2;      ///< first step of the optimizer as a share of each range
  size_t population = 0;  ///< of the optimizer; 0 = by the number of parameters

  int jobs = 0;  ///< processes; 0 = as many as cores
  double time_limit = 3600;
  double memory = 0;  ///< megabytes for each run; 0 = its share of four fifths of the machine's
  size_t shard = 1, shards = 1;
  bool retry = false, quiet = false;

  std::vector<std::string> files;  ///< of show and merge
  size_t best = 10;
  bool failures = false, csv = false;
  std::vector<std::string> plot;  ///< names of x and y
  std::string png;                ///< where the plot goes; "" = the terminal
  std::optional<int64_t> row;     ///< show: all of one sample
};

/// "1..8", "1,2,5", "7"; in ascending order. Errors: UsageError that names the option.
std::vector<uint64_t> read_seeds(const char* option, const std::string& text);

/// Reads the command line behind `tunica sweep`. Returns nothing if it was --help, which has then been printed. Errors:
/// UsageError.
std::optional<SweepOptions> read_sweep_options(int argc, char** argv);

/// The limit of a run's memory: --memory, or its share of four fifths of the machine's.
double megabytes_for_a_run(const SweepOptions& options);

}  // namespace tunica::shell
