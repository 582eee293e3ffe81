// SPDX-License-Identifier: MIT
#include "shell/score_chart.h"

#include <algorithm>
#include <csignal>
#include <thread>

#include "base/cancel.h"
#include "base/error.h"
#include "shell/exit_codes.h"
#include "shell/places.h"
#include "shell/sweep_work.h"
#include "shell/terminal.h"
#include "shell/version.h"

namespace tunica::shell {

namespace {

constexpr const char* parts_of_solution[] = {"method", "dt", "tolerance"};

/// The sweep that the chart's runs are of.
SweepOptions sweep_of(const Options& options) {
  SweepOptions sweep;
  sweep.script = options.script;
  sweep.arguments = options.arguments;
  sweep.until = options.until;
  sweep.sampling = sweep::Sampling::grid;  // of the parameters that are listed
  sweep.seeds = options.seeds;
  sweep.jobs = options.jobs > 0 ? options.jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  sweep.quiet = options.quiet;
  return sweep;
}

/// Ranges that hold how a sample is solved; which values they take the chart decides on its way.
void add_solution(SweepPlan& plan) {
  for (const char* part : parts_of_solution) {
    sweep::Range range;
    range.name = std::string(solution_prefix) + part;
    range.kind = sweep::Range::Kind::list;
    range.values = {"of", "the chart"};
    plan.ranges.push_back(range);
  }
}

void set_text(lua_State* L, const char* name, const std::string& text) {
  lua_pushlstring(L, text.data(), text.size());
  lua_setfield(L, -2, name);
}

void set_number(lua_State* L, const char* name, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, name);
}

/// A table of a list; `push` puts a value on the stack.
template <class List, class Push>
void push_list(lua_State* L, const List& list, Push push) {
  lua_createtable(L, static_cast<int>(list.size()), 0);
  int place = 0;
  for (const auto& item : list) {
    push(item);
    lua_rawseti(L, -2, ++place);
  }
}

std::string text_in(lua_State* L, const char* name) {
  lua_getfield(L, -1, name);
  const char* text = lua_tostring(L, -1);
  const std::string copy = text ? text : "";
  lua_pop(L, 1);
  return copy;
}

/// The Lua half: says what is to be run next, is told what came of it, and draws the conclusion.
class Driver {
 public:
  explicit Driver(Session& session) : session_(session) {}
  ~Driver() { luaL_unref(session_.lua(), LUA_REGISTRYINDEX, chart_); }
  Driver(const Driver&) = delete;

  /// What is to be run next.
  struct Batch {
    std::vector<sweep::Sample> samples;
    std::string label;   ///< for people
    size_t seeds = 0;    ///< so many of them, from the first on
    double seconds = 0;  ///< that a run may take
  };

  bool begin(const Options& options, const SweepOptions& sweep, const SweepPlan& plan);
  std::string folder();
  /// False after an error, which has been said. Nothing in `batch` when all is done.
  bool next(const SweepPlan& plan, std::optional<Batch>& batch);
  void tell(const SweepWork& work, const sweep::Table& table, const std::vector<int64_t>& samples);
  int close(bool stopped);

 private:
  bool push(const char* function);
  void push_run(const SweepWork& work, const sweep::RunRow& run);

  Session& session_;
  int chart_ = LUA_NOREF;
  std::vector<sweep::Sample> combinations_;  ///< of the parameters' values
};

bool Driver::push(const char* function) {
  lua_State* L = session_.lua();
  lua_getglobal(L, "require");
  lua_pushstring(L, "tunica.chart.score");
  if (!session_.call(1, 1)) return false;
  lua_getfield(L, -1, function);
  lua_remove(L, -2);
  if (chart_ != LUA_NOREF) lua_rawgeti(L, LUA_REGISTRYINDEX, chart_);
  return true;
}

bool Driver::begin(const Options& options, const SweepOptions& sweep, const SweepPlan& plan) {
  lua_State* L = session_.lua();
  combinations_ = plan.samples;
  if (!push("begin")) return false;
  const auto text = [&](const std::string& item) { lua_pushlstring(L, item.data(), item.size()); };
  const auto number = [&](auto item) { lua_pushnumber(L, static_cast<double>(item)); };
  lua_newtable(L);
  set_text(L, "about", plan.about.json);
  set_text(L, "name", stem_of(options.script));
  set_text(L, "score", *options.score);
  set_text(L, "versions", versions_as_json());
  if (!options.out.empty()) set_text(L, "out", options.out);
  if (options.until) set_number(L, "until_time", *options.until);
  set_number(L, "error", options.error.value_or(0.1));
  set_number(L, "seconds", options.seconds.value_or(0));
  lua_pushboolean(L, options.quiet);
  lua_setfield(L, -2, "quiet");
  lua_pushboolean(L, error_is_terminal());
  lua_setfield(L, -2, "terminal");
  push_list(L, options.methods, text);
  lua_setfield(L, -2, "methods");
  push_list(L, options.steps, number);
  lua_setfield(L, -2, "steps");
  push_list(L, options.tolerances, number);
  lua_setfield(L, -2, "tolerances");
  push_list(L, sweep.seeds, number);
  lua_setfield(L, -2, "seeds");
  push_list(L, options.arguments, text);
  lua_setfield(L, -2, "arguments");
  push_list(L, plan.ranges, [&](const auto& range) {
    lua_newtable(L);
    set_text(L, "name", range.name);
    lua_pushboolean(L, range.varies());
    lua_setfield(L, -2, "varies");
  });
  lua_setfield(L, -2, "parameters");
  push_list(L, combinations_, [&](const sweep::Sample& sample) { push_list(L, sample, text); });
  lua_setfield(L, -2, "combinations");
  if (!session_.call(1, 1)) return false;
  chart_ = luaL_ref(L, LUA_REGISTRYINDEX);
  return true;
}

std::string Driver::folder() {
  lua_State* L = session_.lua();
  lua_rawgeti(L, LUA_REGISTRYINDEX, chart_);
  const std::string path = text_in(L, "folder");
  lua_pop(L, 1);
  return path;
}

bool Driver::next(const SweepPlan& plan, std::optional<Batch>& batch) {
  lua_State* L = session_.lua();
  batch.reset();
  if (!push("next") || !session_.call(1, 1)) return false;
  if (lua_istable(L, -1)) {
    batch.emplace();
    batch->label = text_in(L, "label");
    batch->seeds = std::stoul(text_in(L, "seeds"));
    batch->seconds = std::stod(text_in(L, "seconds"));
    for (int i = 1; i <= static_cast<int>(lua_objlen(L, -1)); ++i) {
      lua_rawgeti(L, -1, i);
      sweep::Sample sample = combinations_.at(std::stoul(text_in(L, "combination")) - 1);
      for (const char* part : parts_of_solution) sample.push_back(text_in(L, part));
      if (sample.size() != plan.ranges.size()) fail("a sample of {} values, not {}", sample.size(), plan.ranges.size());
      batch->samples.push_back(sample);
      lua_pop(L, 1);
    }
  }
  lua_pop(L, 1);
  return true;
}

void Driver::push_run(const SweepWork& work, const sweep::RunRow& run) {
  lua_State* L = session_.lua();
  lua_newtable(L);
  set_number(L, "seed", static_cast<double>(run.seed));
  set_text(L, "status", run.status);
  set_text(L, "message", run.message);
  set_text(L, "result", run.result);
  set_number(L, "wall", run.seconds);
  if (const Score* score = work.score_of(run.sample, run.seed)) {
    if (score->value) set_number(L, "score", *score->value);
    set_text(L, "why", score->why);
  }
}

/// All runs that are there of some samples, in the order in which they were asked for.
void Driver::tell(const SweepWork& work, const sweep::Table& table, const std::vector<int64_t>& samples) {
  lua_State* L = session_.lua();
  const auto runs = table.runs();
  session_.interrupts().calm(false);  // a signal that has come is not to break off what follows
  if (!push("tell")) return;
  push_list(L, samples, [&](int64_t sample) {
    std::vector<const sweep::RunRow*> own;
    for (const auto& run : runs)
      if (run.sample == sample) own.push_back(&run);
    push_list(L, own, [&](const sweep::RunRow* run) { push_run(work, *run); });
  });
  session_.call(2, 0);
}

int Driver::close(bool stopped) {
  lua_State* L = session_.lua();
  session_.interrupts().calm(false);
  if (!push("close")) return session_.exit_code();
  lua_pushboolean(L, stopped);
  if (!session_.call(2, 1)) return session_.exit_code();
  const int code = static_cast<int>(lua_tointeger(L, -1));
  lua_pop(L, 1);
  return code;
}

/// Runs what the driver asks for until it asks no more. False when stopped by a signal or an error of the driver's.
bool run_batches(Driver& driver, SweepWork& work, sweep::Table& table, SweepOptions& options, const SweepPlan& plan) {
  size_t expected = 0;
  for (std::optional<Driver::Batch> batch;;) {
    if (!driver.next(plan, batch)) return false;
    if (!batch) return true;
    std::vector<int64_t> numbers;
    std::vector<Task> tasks;
    for (const auto& sample : batch->samples) {
      numbers.push_back(work.add_sample("chart", sample));
      for (size_t i = 0; i < std::min(batch->seeds, options.seeds.size()); ++i)
        tasks.push_back({numbers.back(), options.seeds[i], false});
    }
    options.time_limit = batch->seconds;
    expected += tasks.size();
    work.expect(expected);
    work.remark(batch->label);
    const bool whole = work.run(tasks);
    driver.tell(work, table, numbers);
    if (!whole) return false;
  }
}

int run_chart(SweepModel& model, const Options& given, SweepOptions& options) {
  Session& session = model.session();
  SweepPlan plan = make_plan(model, options);
  const Scorer checked(session, *given.score, plan.about);  // before anything is written
  Driver driver(session);
  if (!driver.begin(given, options, plan)) return session.exit_code();
  options.out = driver.folder() + "/runs.db";
  plan.samples.clear();
  add_solution(plan);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of the file's size is to be an error like a full disk
  const auto table = open_table(options.out);
  try {
    settle_plan(*table, model, options, plan);
    if (given.retry) table->remove_failures();
    Scorer scorer(session, *given.score, plan.about);
    SweepWork work(model, plan, options, *table, &scorer);
    const bool whole = run_batches(driver, work, *table, options, plan);
    table->commit();
    const int signal = session.interrupts().signal(), failed = session.exit_code();
    const int code = driver.close(signal != 0);
    if (signal) return session.code_of_stop();
    return whole ? code : std::max(failed, 1);
  } catch (const Error& error) {
    say_error(fmt::format("{}; runs that finished before are kept, and the same command goes on with --out {}",
                          error.what(), driver.folder()));
    return file_error;
  }
}

}  // namespace

int chart_of_score(const Options& given) {
  SweepOptions options = sweep_of(given);
  SweepModel model(given.script);
  try {
    return run_chart(model, given, options);
  } catch (const Cancelled& stopped) {
    say_note(stopped.what());
    return model.session().code_of_stop();
  }
}

}  // namespace tunica::shell
