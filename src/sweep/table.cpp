// SPDX-License-Identifier: MIT
#include "sweep/table.h"

#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace tunica::sweep {

namespace {

constexpr const char* format = "1";

// Parameters and results are JSON, which SQLite reads too: select json_extract(result, '$.report.peaks') from runs.
constexpr const char* layout = R"(
CREATE TABLE notes(name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE samples(sample INTEGER PRIMARY KEY, origin TEXT NOT NULL, parameters TEXT NOT NULL);
CREATE TABLE runs(sample INTEGER NOT NULL, seed INTEGER NOT NULL, fresh INTEGER NOT NULL, status TEXT NOT NULL,
  result TEXT, message TEXT, log TEXT, seconds REAL, megabytes REAL, PRIMARY KEY(sample, seed)) WITHOUT ROWID;
)";

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// A prepared statement.
class Statement {
 public:
  Statement(sqlite3* db, const char* text) {
    good_ = sqlite3_prepare_v2(db, text, -1, &statement_, nullptr) == SQLITE_OK;
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;

  Statement& bind(const std::string& text) {
    sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    return *this;
  }
  Statement& bind(int64_t value) {
    sqlite3_bind_int64(statement_, ++bound_, value);
    return *this;
  }
  Statement& bind(double value) {
    sqlite3_bind_double(statement_, ++bound_, value);
    return *this;
  }
  /// SQLITE_ROW, SQLITE_DONE, or an error.
  int step() { return good_ ? sqlite3_step(statement_) : SQLITE_ERROR; }
  int64_t integer(int i) { return sqlite3_column_int64(statement_, i); }
  double number(int i) { return sqlite3_column_double(statement_, i); }
  std::string text(int i) {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, i));
    return text ? std::string(text, sqlite3_column_bytes(statement_, i)) : "";
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
  bool good_ = false;
  int bound_ = 0;
};

}  // namespace

Table::Table(const std::string& path, Mode mode) : path_(path) {
  std::error_code error;
  if (mode == Mode::read && !std::filesystem::is_regular_file(path, error)) fail("there is no file '{}'", path);
  try {
    // A reader may write too, if the file lets it: after kill -9 what was half written is first to be taken back.
    const int flags = SQLITE_OPEN_READWRITE | (mode == Mode::write ? SQLITE_OPEN_CREATE : 0);
    if (sqlite3_open_v2(path.c_str(), &db_, flags, nullptr) != SQLITE_OK) refuse();
    sqlite3_busy_timeout(db_, 20000);
    // A journal beside the file and not a log (WAL), since the latter does not work on network file systems.
    if (mode == Mode::write) execute("PRAGMA journal_mode=DELETE; PRAGMA synchronous=NORMAL;");
    Statement tables(db_, "SELECT count(*) FROM sqlite_master");
    if (tables.step() != SQLITE_ROW) refuse();
    if (tables.integer(0) == 0) {
      if (mode == Mode::read) fail("'{}' is empty", path);
      begin();
      execute(layout);
      set_note("format", format);
      return;
    }
    Statement ours(db_, "SELECT count(*) FROM sqlite_master WHERE name IN ('notes', 'samples', 'runs')");
    if (ours.step() != SQLITE_ROW || ours.integer(0) != 3) fail("'{}' is a database of something else", path);
    if (note("format") != format)
      fail("'{}' has the format {}; this version reads {}", path, note("format").value_or("?"), format);
  } catch (...) {
    sqlite3_close(db_);
    throw;
  }
}

Table::~Table() {
  if (open_) sqlite3_exec(db_, "COMMIT", nullptr, nullptr, nullptr);
  sqlite3_close(db_);
}

void Table::refuse() const {
  const int code = db_ ? sqlite3_errcode(db_) : SQLITE_NOMEM;
  const std::string reason = db_ ? sqlite3_errmsg(db_) : "out of memory";
  if (code == SQLITE_NOTADB) fail("'{}' is not the file of a sweep: {}", path_, reason);
  fail("'{}': {}", path_, reason);
}

void Table::execute(const char* text) const {
  if (sqlite3_exec(db_, text, nullptr, nullptr, nullptr) != SQLITE_OK) refuse();
}

void Table::begin() {
  if (open_) return;
  execute("BEGIN IMMEDIATE");
  open_ = true;
  begun_ = now();
}

void Table::commit() {
  if (!open_) return;
  // A commit that fails leaves the transaction open or rolls it back; either way what was lasting before stays.
  if (sqlite3_exec(db_, "COMMIT", nullptr, nullptr, nullptr) != SQLITE_OK) {
    const std::string reason = sqlite3_errmsg(db_);
    sqlite3_exec(db_, "ROLLBACK", nullptr, nullptr, nullptr);
    open_ = false;
    fail("'{}': {}", path_, reason);
  }
  open_ = false;
}

void Table::take_back() {
  if (open_) sqlite3_exec(db_, "ROLLBACK", nullptr, nullptr, nullptr);
  open_ = false;
}

double Table::pending() const { return open_ ? now() - begun_ : 0; }

std::optional<std::string> Table::note(const std::string& name) const {
  Statement query(db_, "SELECT value FROM notes WHERE name = ?");
  const int state = query.bind(name).step();
  if (state == SQLITE_ROW) return query.text(0);
  if (state != SQLITE_DONE) refuse();
  return std::nullopt;
}

void Table::set_note(const std::string& name, const std::string& text) {
  begin();
  Statement insert(db_, "INSERT OR REPLACE INTO notes VALUES(?, ?)");
  if (insert.bind(name).bind(text).step() != SQLITE_DONE) refuse();
}

void Table::add_sample(const SampleRow& row) {
  begin();
  Statement insert(db_, "INSERT INTO samples VALUES(?, ?, ?)");
  insert.bind(row.sample).bind(row.origin).bind(nlohmann::json(row.parameters).dump());
  if (insert.step() != SQLITE_DONE) refuse();
}

void Table::add_run(const RunRow& row) {
  begin();
  Statement insert(db_, "INSERT OR REPLACE INTO runs VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(row.sample).bind(static_cast<int64_t>(row.seed)).bind(int64_t{row.fresh}).bind(row.status);
  insert.bind(row.result).bind(row.message).bind(row.log).bind(row.seconds).bind(row.megabytes);
  if (insert.step() != SQLITE_DONE) refuse();
}

void Table::remove_failures() {
  begin();
  execute("DELETE FROM runs WHERE status != 'done'");
}

std::vector<SampleRow> Table::samples() const {
  std::vector<SampleRow> rows;
  Statement query(db_, "SELECT sample, origin, parameters FROM samples ORDER BY sample");
  int state = 0;
  while ((state = query.step()) == SQLITE_ROW)
    rows.push_back({query.integer(0), query.text(1), nlohmann::json::parse(query.text(2))});
  if (state != SQLITE_DONE) refuse();
  return rows;
}

std::vector<RunRow> Table::runs() const {
  std::vector<RunRow> rows;
  Statement query(db_,
                  "SELECT sample, seed, fresh, status, result, message, log, seconds, megabytes FROM runs "
                  "ORDER BY sample, seed");
  int state = 0;
  while ((state = query.step()) == SQLITE_ROW)
    rows.push_back({query.integer(0), static_cast<uint64_t>(query.integer(1)), query.integer(2) != 0, query.text(3),
                    query.text(4), query.text(5), query.text(6), query.number(7), query.number(8)});
  if (state != SQLITE_DONE) refuse();
  return rows;
}

size_t Table::count_runs() const {
  Statement query(db_, "SELECT count(*) FROM runs");
  return query.step() == SQLITE_ROW ? static_cast<size_t>(query.integer(0)) : 0;
}

}  // namespace tunica::sweep
