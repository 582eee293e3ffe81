// SPDX-License-Identifier: MIT
#include "shell/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "shell/sweep_options.h"

namespace tunica::shell {

namespace {

constexpr const char* about = "Models of growing plant tissue, written in Lua.";

constexpr const char* closing = R"(
Commands:
  tunica                       the prompt (in a terminal), or a script from standard input
  tunica MODEL.lua D=2 ...     run a model, parameters changed; also by the name of a shipped model
  tunica models                list the shipped models
  tunica resume DIR            continue an interrupted run (--until T: beyond its end)
  tunica rerun DIR             repeat a run in a new directory and compare the result
  tunica chart MODEL           the error of every method against its time, and which to take;
                               with --score: the step that a pattern needs, over many seeds
  tunica stability MODEL       the largest step of every method
  tunica sweep MODEL ...       many runs: samples, a score, a search (tunica sweep --help)
  tunica curve FILE            draw a curve (.func, .con) in the terminal, or a new one

Exit codes: 0 done, 1 error in the script, 2 command line, 3 numerical failure, 4 files cannot be written,
  75 stopped by SIGUSR1 with a checkpoint, 129 hung up, 130 interrupted, 143 terminated.
More: share/doc/runs.md.)";

void add_run_options(CLI::App& app, Options& options) {
  app.add_option("--out", options.out, "run directory (default runs/MODEL-N)")->type_name("DIR");
  app.add_option("--until", options.until, "model time at which the run ends")->type_name("T");
  app.add_flag_callback(
      "--frames", [&] { options.frames = true; }, "write the pictures of the model's views (default)");
  app.add_flag_callback(
      "--no-frames", [&] { options.frames = false; }, "write no pictures");
  app.add_flag("--movie", options.movie, "make movie.mp4 of the frames (with ffmpeg)");
  app.add_option("--checkpoint", options.checkpoint, "seconds between checkpoints (default 60)")->type_name("SECONDS");
  app.add_flag("--json", options.json, "results as one JSON object");
  app.add_flag("-q,--quiet", options.quiet, "no progress, no notes");
}

/// Whole numbers that a Lua number and JSON hold exactly.
uint64_t read_seed(const std::string& text) {
  uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size() || seed > (uint64_t{1} << 53))
    throw UsageError{fmt::format("--seed: expected a whole number from 0 to 2^53, got '{}'", text)};
  return seed;
}

void add_script_options(CLI::App& app, Options& options) {
  app.add_option_function<std::string>(
         "--seed", [&](const std::string& text) { options.seed = read_seed(text); },
         "seed of all random numbers (default 1)")
      ->type_name("N");
  app.add_option("-e", options.code, "run this Lua code (before the script)")
      ->type_name("CODE")
      ->expected(1)
      ->take_all();
  app.add_option("--color", options.colour, "colours: auto, always or never (NO_COLOR has the last word)")
      ->type_name("WHEN")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  app.add_flag_callback(
      "--private", [&] { options.history = false; }, "prompt: no history is read or kept");
  app.add_flag_callback(
      "--no-init", [&] { options.init = false; }, "prompt: without the user's init.lua");
  app.add_flag("-i", options.interactive, "prompt after the script; a model is kept in the variable `model`");
  app.add_flag_callback(
      "--version", [&] { options.command = Options::Command::version; }, "versions, also with --json");
  app.add_option("script", options.script, "script, name of a shipped model, or - for standard input")
      ->type_name("MODEL");
  app.add_option("arguments", options.arguments, "parameters of the model: key=value")->type_name("");
}

constexpr const char* chart_closing = R"(
A model whose course is chaotic (cells divide, a pattern decides) has an error of 1 by every method in the long run. What is left to
compare is the pattern: with --score each setting is run on many seeds, and its mean held against that of the finest steps.
  tunica chart phyllotaxis/transport_apex --score spiral --seeds 1..24 --until 25 --methods sts,euler,rkc2
Steps that are parameters can be listed: step=.1,.2,.4. More: share/doc/methods.md.)";

/// Of a chart of a score.
void add_score_options(CLI::App& app, Options& options) {
  const auto* group = "Chart of a pattern";
  app.add_option("--score", options.score,
                 "compare runs by this, not by their state: a Lua expression over the report (share/doc/sweeps.md)")
      ->type_name("EXPR")
      ->group(group);
  app.add_option_function<std::string>(
         "--seeds", [&](const std::string& text) { options.seeds = read_seeds("--seeds", text); },
         "of the runs of each setting (default 1..12)")
      ->type_name("A..B")
      ->group(group);
  app.add_option("--dt", options.steps, "steps to try (default: halved from coarse ones on)")
      ->type_name("A,B")
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows may be a parameter
      ->group(group);
  app.add_option("--tolerance", options.tolerances, "tolerances to try (default: decades from .1 on)")
      ->type_name("A,B")
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows may be a parameter
      ->group(group);
  app.add_option("--jobs,-j", options.jobs, "processes (default: cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 400))
      ->group(group);
  app.add_flag("--retry", options.retry, "run failed runs again")->group(group);
  app.footer(chart_closing);
}

/// What `tunica chart` and `tunica stability` have in common, and what only one of them has.
void add_study_options(CLI::App& app, Options& options) {
  const bool chart = options.command == Options::Command::chart;
  app.add_option(
         "--out", options.out,
         fmt::format("folder, continued if it is there (default runs/MODEL-{}-N)", chart ? "chart" : "stability"))
      ->type_name("DIR");
  app.add_option("--until", options.until, "model time at which runs end and are compared")->type_name("T");
  app.add_option("--methods", options.methods, "only these, separated by commas")
      ->type_name("A,B")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--quantity", options.quantity,
                 chart ? "column, or number that the model reports, whose error counts (default: every column of state)"
                       : "column whose maxima are the pattern (default: the first column of state)")
      ->type_name("NAME");
  app.add_option("--seconds", options.seconds, "most that one run may take")->type_name("S");
  if (chart) {
    app.add_option("--error", options.error,
                   "recommend a method for this error (default 1e-3; of a score: the difference that matters, .1)")
        ->type_name("E");
    app.add_option("--repeats", options.repeats, "of runs shorter than 0.2 s; the least time counts (default 3)")
        ->type_name("N");
  }
  if (chart) add_score_options(app, options);
  app.add_flag("-q,--quiet", options.quiet, "no progress, no notes");
  app.add_option_function<std::string>(
         "--seed", [&](const std::string& text) { options.seed = read_seed(text); },
         "seed of all random numbers (default 1)")
      ->type_name("N");
  app.add_option("script", options.script, "script, or name of a shipped model")->type_name("MODEL")->required();
  app.add_option("arguments", options.arguments, "parameters of the model: key=value")->type_name("");
}

/// "--otu" is unknown; did you mean '--out'?
std::string about_unknown(const CLI::App& app, const std::string& given) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    for (const auto& name : option->get_fnames()) names.push_back("--" + name);
  }
  std::string bare = given.substr(0, given.find('='));
  return fmt::format("unknown option '{}'{}; `{} --help` lists them", bare, did_you_mean(bare, names), app.get_name());
}

/// What belongs to a chart of a score, and what to one of errors.
void check_score(const Options& options) {
  if (!options.score) {
    const char* given = !options.seeds.empty()        ? "--seeds"
                        : !options.steps.empty()      ? "--dt"
                        : !options.tolerances.empty() ? "--tolerance"
                        : options.jobs                ? "--jobs"
                        : options.retry               ? "--retry"
                                                      : nullptr;
    if (given)
      throw UsageError{fmt::format("{} is for a chart of a pattern: say by which --score it is compared", given)};
    return;
  }
  if (options.score->find_first_not_of(" \t\n") == std::string::npos)
    throw UsageError{"--score: expected an expression over the model's report, got nothing"};
  if (options.seed) throw UsageError{"--seed: a chart of a score is of many seeds: --seeds 1..12"};
  if (!options.quantity.empty())
    throw UsageError{"--quantity is for errors of the state; with --score it says nothing"};
  if (options.seeds.size() == 1)
    throw UsageError{"--seeds: a mean with its error needs at least 2 seeds, and some 12 to say much (1..12)"};
  for (const double dt : options.steps)
    if (!(dt > 0 && std::isfinite(dt))) throw UsageError{fmt::format("--dt: expected steps above 0, got {}", dt)};
  for (const double t : options.tolerances)
    if (!(t > 0 && t <= 1))
      throw UsageError{fmt::format("--tolerance: expected numbers above 0, at most 1, got {}", t)};
}

void check(const Options& options) {
  if (options.until && !(std::isfinite(*options.until) && *options.until >= 0))
    throw UsageError{fmt::format("--until: expected a time from 0 on, got {}", *options.until)};
  if (!(options.checkpoint > 0)) throw UsageError{"--checkpoint: expected a number of seconds above 0"};
  if (options.error && !(*options.error > 0 && (options.score ? std::isfinite(*options.error) : *options.error < 1)))
    throw UsageError{options.score ? "--error: expected a difference of scores above 0"
                                   : "--error: expected a number between 0 and 1"};
  check_score(options);
  if (options.repeats < 1 || options.repeats > 1000) throw UsageError{"--repeats: expected a number from 1 to 1000"};
  if (options.seconds && !(*options.seconds > 0)) throw UsageError{"--seconds: expected a number of seconds above 0"};
  if (options.movie && options.frames == false) throw UsageError{"--movie needs frames; leave out --no-frames"};
}

}  // namespace

bool parse_arguments(CLI::App& app, int argc, char** argv) {
  app.allow_extras();
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return false;
  } catch (const CLI::ParseError& error) {
    throw UsageError{error.what()};
  }
  for (const auto& extra : app.remaining()) {
    if (extra.size() > 1 && extra[0] == '-') throw UsageError{about_unknown(app, extra)};
    throw UsageError{fmt::format("unexpected argument '{}'", extra)};
  }
  return true;
}

std::optional<Options> read_options(int argc, char** argv) {
  Options options;
  CLI::App app(about, "tunica");
  app.get_formatter()->column_width(34);
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "models") {
    options.command = Options::Command::models;
    app.add_flag("--json", options.json, "as one JSON object");
    return parse_arguments(app, argc - 1, argv + 1) ? std::optional(options) : std::nullopt;
  }
  if (first == "chart" || first == "stability") {
    options.command = first == "chart" ? Options::Command::chart : Options::Command::stability;
    add_study_options(app, options);
    if (!parse_arguments(app, argc - 1, argv + 1)) return std::nullopt;
    check(options);
    if (options.seeds.empty())
      for (uint64_t seed = 1; seed <= 12; ++seed) options.seeds.push_back(seed);
    return options;
  }
  if (first == "curve") {
    options.command = Options::Command::curve;
    app.add_option("file", options.script, "file of a curve (.func, .con), new or not; or name of a shipped one")
        ->type_name("FILE")
        ->required();
    return parse_arguments(app, argc - 1, argv + 1) ? std::optional(options) : std::nullopt;
  }
  add_run_options(app, options);
  if (first == "resume" || first == "rerun") {
    options.command = first == "resume" ? Options::Command::resume : Options::Command::rerun;
    app.add_option("directory", options.directory, "run directory")->type_name("DIR")->required();
    if (!parse_arguments(app, argc - 1, argv + 1)) return std::nullopt;
  } else {
    add_script_options(app, options);
    app.footer(closing);
    if (!parse_arguments(app, argc, argv)) return std::nullopt;
  }
  check(options);
  return options;
}

}  // namespace tunica::shell
