// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct sqlite3;

namespace tunica::sweep {

/// One run: a sample with a seed.
struct RunRow {
  int64_t sample = 0;
  uint64_t seed = 0;
  bool fresh = false;   ///< for a seed that the search does not see
  std::string status;   ///< done, failed, numerical, crashed, killed, time, memory
  std::string result;   ///< JSON: time, steps, hash, report, series; "" unless done
  std::string message;  ///< why it failed
  std::string log;      ///< last lines of standard error
  double seconds = 0;   ///< of wall clock; takes part in no comparison
  double megabytes = 0;
};

struct SampleRow {
  int64_t sample = 0;
  std::string origin;                   ///< grid, random, sobol, start, cmaes ...
  std::vector<std::string> parameters;  ///< as text, in the order of the sweep's ranges
};

/// The SQLite file of a sweep. Rows lie in the order of (sample, seed), whatever the order in which they came. Writes
/// are collected and become lasting together by `commit`, which costs some milliseconds. Errors: the system's or
/// SQLite's reason, with the path.
class Table {
 public:
  enum class Mode { read, write };
  /// Opens a file; `write` makes it if it is missing. It is looked through first, so that damage is found before
  /// anything is done on its account. Errors: missing, unreadable, not a sweep, of a later format, damaged.
  Table(const std::string& path, Mode mode);
  ~Table();
  Table(const Table&) = delete;

  std::optional<std::string> note(const std::string& name) const;  ///< what stands under a name
  void set_note(const std::string& name, const std::string& text);

  void add_sample(const SampleRow& row);
  void add_run(const RunRow& row);
  void remove_failures();
  void commit();
  void take_back();  ///< all writes since the last commit
  /// Seconds since the first write that is not yet lasting; 0 if there is none.
  double pending() const;

  std::vector<SampleRow> samples() const;
  std::vector<RunRow> runs() const;
  size_t count_runs() const;
  const std::string& path() const { return path_; }
  /// Error: what a reader found wrong with the contents.
  [[noreturn]] void damaged(const std::string& why) const;

 private:
  void begin();
  void check() const;
  void execute(const char* text) const;
  [[noreturn]] void refuse() const;

  std::string path_;
  sqlite3* db_ = nullptr;
  bool open_ = false;  ///< a transaction
  double begun_ = 0;
};

}  // namespace tunica::sweep
