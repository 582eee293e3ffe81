// SPDX-License-Identifier: MIT
#include "sweep/table.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
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
  bool good() const { return good_; }
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

/// What there is in place of a file that could be opened; SQLite would say too little of it, or wait for ever (a pipe).
void check_path(const std::string& path, bool must_exist) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    if (must_exist) fail("there is no file '{}'", path);
    return;
  }
  if (std::filesystem::is_directory(status)) fail("'{}' is a directory; expected the file of a sweep", path);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail("'{}' is no ordinary file; expected the file of a sweep", path);
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail("'{}' cannot be read: {}", path, std::strerror(errno));
  close(file);
}

std::string not_a_database(const std::string& path) {
  return fmt::format("'{}' is not the file of a sweep: expected an SQLite database, and it is something else", path);
}

// Each finds the first row that is not as this class writes it. `case` stops at the first thing that is wrong, since
// what follows is an error for SQLite then.
constexpr const char* bad_sample = R"(SELECT sample FROM samples WHERE CASE WHEN NOT json_valid(parameters) THEN 1
  WHEN json_type(parameters) != 'array' THEN 1
  ELSE json_array_length(parameters) != (SELECT json_array_length(parameters) FROM samples ORDER BY sample LIMIT 1)
    OR EXISTS (SELECT 1 FROM json_each(parameters) WHERE type != 'text') END ORDER BY sample LIMIT 1)";
constexpr const char* bad_run = R"(SELECT sample, seed FROM runs WHERE CASE WHEN status != 'done' THEN 0
  WHEN NOT json_valid(result) THEN 1 ELSE json_type(result) != 'object' END ORDER BY sample, seed LIMIT 1)";
constexpr const char* lost_run = R"(SELECT sample, seed FROM runs WHERE sample NOT IN (SELECT sample FROM samples)
  ORDER BY sample, seed LIMIT 1)";

}  // namespace

Table::Table(const std::string& path, Mode mode) : path_(path) {
  check_path(path, mode == Mode::read);
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
      // SQLite takes a file of one byte for an empty one, and would write over it.
      std::error_code error;
      if (const auto size = std::filesystem::file_size(path, error); !error && size > 0 && size < 512)
        fail("{}", not_a_database(path));
      if (mode == Mode::read) fail("'{}' is empty; expected the file of a sweep", path);
      begin();
      execute(layout);
      set_note("format", format);
      return;
    }
    check();
  } catch (...) {
    sqlite3_close(db_);
    throw;
  }
}

void Table::check() const {
  Statement whole(db_, "PRAGMA quick_check(1)");
  if (whole.step() != SQLITE_ROW) refuse();
  // Several lines, the last of which says where.
  if (const std::string found = whole.text(0); found != "ok")
    damaged(fmt::format("cut off, or overwritten in part ({})", found.substr(found.rfind('\n') + 1)));
  if (!Statement(db_, "SELECT name, value FROM notes").good() ||
      !Statement(db_, "SELECT sample, origin, parameters FROM samples").good() ||
      !Statement(db_, "SELECT sample, seed, fresh, status, result, message, log, seconds, megabytes FROM runs").good())
    fail("'{}' is a database of something else; expected the file of a sweep, with its tables notes, samples and runs",
         path_);
  if (note("format") != format)
    fail("'{}' has the format {}; this version reads {}", path_, note("format").value_or("?"), format);
  const auto first = [&](const char* query, const char* what) {
    Statement found(db_, query);
    const int state = found.step();
    if (state == SQLITE_ROW)
      damaged(fmt::format(fmt::runtime(what), found.integer(0), static_cast<uint64_t>(found.integer(1))));
    if (state != SQLITE_DONE) refuse();
  };
  first(bad_sample, "the parameters of sample {} are no list of texts as long as that of the others");
  first(bad_run, "the result of sample {}, seed {} is none");
  first(lost_run, "it has runs of sample {}, and no such sample");
}

void Table::damaged(const std::string& why) const {
  fail("'{}' is damaged: {}. It was left as it is; a copy of it may be whole, and .recover of sqlite3 may save rows",
       path_, why);
}

Table::~Table() {
  if (open_) sqlite3_exec(db_, "COMMIT", nullptr, nullptr, nullptr);
  sqlite3_close(db_);
}

void Table::refuse() const {
  const int code = db_ ? sqlite3_errcode(db_) : SQLITE_NOMEM;
  const std::string reason = db_ ? sqlite3_errmsg(db_) : "out of memory";
  if (code == SQLITE_NOTADB) fail("{}", not_a_database(path_));
  if (code == SQLITE_CORRUPT) damaged("cut off, or overwritten in part");
  if (code == SQLITE_CANTOPEN && sqlite3_system_errno(db_) != 0)
    fail("'{}' cannot be opened: {}", path_, std::strerror(sqlite3_system_errno(db_)));
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
