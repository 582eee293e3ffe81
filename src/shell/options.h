// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tunica::shell {

/// What the command line asks for.
struct Options {
  enum class Command { script, models, resume, rerun, chart, stability, curve, version };
  Command command = Command::script;
  std::string script;                  ///< path, name of a shipped model, "-" (standard input), or ""
  std::vector<std::string> arguments;  ///< after the script: key=value for a model, anything for a plain script
  std::vector<std::string> code;       ///< -e
  std::string directory;               ///< of resume and rerun
  std::string out;                     ///< run directory; "" = the next free one under runs/
  std::optional<double> until;
  std::optional<uint64_t> seed;
  std::optional<bool> frames;
  bool movie = false, json = false, interactive = false, quiet = false;
  bool history = true, init = true;  ///< of the prompt
  std::string colour = "auto";       ///< auto, always or never
  std::string quantity;              ///< chart, stability: what errors and patterns are of; "" = the default
  std::vector<std::string> methods;  ///< chart, stability: those to try; none = all
  std::optional<double> error;       ///< chart: for which a method is recommended (1e-3; .1 of a score)
  int repeats = 3;                   ///< chart: of runs shorter than 0.2 s
  std::optional<double> seconds;     ///< chart, stability: most that one run may take
  std::optional<std::string> score;  ///< chart: what runs on many seeds are compared by; none = errors of the state
  std::vector<uint64_t> seeds;       ///< chart of a score
  std::vector<double> steps, tolerances;  ///< chart of a score: those to try; none = the chart's own
  int jobs = 0;                           ///< chart of a score: processes; 0 = as many as cores
  bool retry = false;                     ///< chart of a score: failed runs are made again
  double checkpoint = 60;                 ///< seconds of wall clock between checkpoints
};

/// Thrown for what is wrong with the command line: exit code 2.
struct UsageError {
  std::string message;
};

/// Reads the command line. Returns nothing if it was --help, which has then been printed. Errors: UsageError.
std::optional<Options> read_options(int argc, char** argv);

/// Parses what an application declares; what it does not know is an error that names the nearest option. False if help
/// was asked for, which has then been printed. Errors: UsageError.
bool parse_arguments(CLI::App& app, int argc, char** argv);

}  // namespace tunica::shell
