// Writes results to a table in an SQLite database. Only this file uses SQLite.
#include <sqlite3.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/content_kind.h"
#include "base/files/growing_file.h"
#include "base/files/output_file.h"
#include "emulator/play/results/results_file.h"
#include "emulator/play/scenario/case.h"

namespace understudy::emulator::play {

namespace {

constexpr int kApplicationId = 0x55535459;  // "USTY" in the header of the file
// A run that is killed loses at most the results of the last interval. Readers see results with at most this
// delay.
constexpr std::chrono::milliseconds kCommitEvery{250};

constexpr std::string_view kTables = R"(
CREATE TABLE IF NOT EXISTS results(
  file TEXT NOT NULL, name TEXT NOT NULL, branch TEXT NOT NULL, case_id TEXT NOT NULL, parameters TEXT NOT NULL,
  verdict TEXT NOT NULL, hash TEXT, simulated_s REAL NOT NULL, seed INTEGER NOT NULL,
  kind TEXT, failure TEXT, at_s REAL, step TEXT, recording TEXT, made_of TEXT NOT NULL);
CREATE UNIQUE INDEX IF NOT EXISTS of_case ON results(file, case_id, branch);
CREATE TABLE IF NOT EXISTS parameter_names(name TEXT PRIMARY KEY);
)";
constexpr std::string_view kInsert =
    "INSERT OR REPLACE INTO results VALUES(?1,?2,?3,?4,?5,?6,?7,?8,?9,?10,?11,?12,?13,?14,?15)";
constexpr std::string_view kFind =
    "SELECT max(verdict = 'failed'), max(branch = '' AND verdict <> 'unreadable') FROM results "
    "WHERE file = ?1 AND case_id = ?2 AND made_of = ?3";

/// Quotes a text for SQL.
std::string sql_quoted(const std::string& text, char mark) {
  std::string made(1, mark);
  for (const char c : text) made += c == mark ? std::string(2, c) : std::string(1, c);
  return made + mark;
}

class SqliteResults final : public ResultsFile {
 public:
  SqliteResults(const std::string& path, bool continues) : path_(path) {
    try {
      lock_.emplace(path, ContentKind::database);
    } catch (const OutputError& error) {
      refuse(error.what());
    }
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(lock_->target().c_str(), &opened, SQLITE_OPEN_READWRITE, nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) refuse_last();
    sqlite3_busy_timeout(opened, kPatience_ms);
    require_own();
    if (!continues) return;
    make_tables();
    const Statement names = prepare("SELECT name FROM parameter_names");
    while (step(names)) names_.insert(text_of(names, 0));
  }

  ~SqliteResults() override {
    try {
      commit();
    } catch (const GrowingFileError&) {
      // The run is ending for a different reason, which is reported.
    }
  }
  SqliteResults(const SqliteResults&) = delete;
  SqliteResults& operator=(const SqliteResults&) = delete;

  bool has_rows() override {
    const Statement table = prepare("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'results'");
    return step(table) && step(prepare("SELECT 1 FROM results LIMIT 1"));
  }

  void begin() override {
    run("DROP VIEW IF EXISTS cases; DROP TABLE IF EXISTS results; DROP TABLE IF EXISTS parameter_names");
    make_tables();
  }

  std::optional<bool> has_failed(const CaseKey& key) override {
    const std::lock_guard lock(mutex_);
    if (!find_) find_ = prepare(kFind);
    sqlite3_reset(find_.get());
    bind(find_, 1, key.file);
    bind(find_, 2, identity_text(key.identity));
    bind(find_, 3, identity_text(key.made_of));
    if (!step(find_) || sqlite3_column_int(find_.get(), 1) == 0) return std::nullopt;
    return sqlite3_column_int(find_.get(), 0) != 0;
  }

  void add(std::span<const ResultRow> rows) override {
    const std::lock_guard lock(mutex_);
    if (!is_open_) {
      run("BEGIN IMMEDIATE");
      is_open_ = true;
      begun_ = std::chrono::steady_clock::now();
    }
    for (const ResultRow& row : rows) insert(row);
    if (std::chrono::steady_clock::now() - begun_ > kCommitEvery) commit();
  }

  void finish() override { commit(); }

 private:
  static constexpr int kPatience_ms = 10'000;  // how long to wait for a reader

  struct Closing {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Closing>;

  [[noreturn]] void refuse(const std::string& why) const {
    throw GrowingFileError("--results: " + path_ + " cannot be written: " + why);
  }
  [[noreturn]] void refuse_last() const { refuse(sqlite3_errmsg(database_.get())); }

  void run(const std::string& sql) {
    if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) refuse_last();
  }
  Statement prepare(std::string_view sql) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr) !=
        SQLITE_OK) {
      refuse_last();
    }
    return Statement(statement);
  }
  /// Runs a statement. Returns true if there is a row.
  bool step(const Statement& statement) {
    const int code = sqlite3_step(statement.get());
    if (code != SQLITE_ROW && code != SQLITE_DONE) refuse_last();
    return code == SQLITE_ROW;
  }
  static std::string text_of(const Statement& statement, int column) {
    const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement.get(), column));
    return text == nullptr ? "" : text;
  }
  static void bind(const Statement& statement, int place, const std::string& text) {
    sqlite3_bind_text(statement.get(), place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  static void bind(const Statement& statement, int place, const std::optional<std::string>& text) {
    if (text) {
      bind(statement, place, *text);
    } else {
      sqlite3_bind_null(statement.get(), place);
    }
  }

  /// Refuses a file that is neither empty nor one of our databases.
  void require_own() {
    const Statement id = prepare("PRAGMA application_id");
    const bool is_ours = step(id) && sqlite3_column_int(id.get(), 0) == kApplicationId;
    const Statement tables = prepare("SELECT count(*) FROM sqlite_master");
    if (is_ours || (step(tables) && sqlite3_column_int(tables.get(), 0) == 0)) return;
    refuse("it is another program's database; expected one that `--results` created, or a free path");
  }

  void make_tables() {
    run("PRAGMA application_id = " + std::to_string(kApplicationId) +
        "; PRAGMA synchronous = NORMAL; BEGIN;" + std::string(kTables) + "COMMIT");
    names_.clear();
    show_parameters();
  }

  /// Creates the view `cases`: the table with an additional column for each parameter.
  void show_parameters() {
    static const std::set<std::string> taken = {"file",    "name", "branch",      "case_id",   "parameters",
                                                "verdict", "hash", "seed",        "kind",      "failure",
                                                "at_s",    "step", "simulated_s", "recording", "made_of"};
    std::string columns;
    for (const std::string& name : names_) {
      columns += ", json_extract(parameters, " + sql_quoted("$.\"" + name + "\"", '\'') + ") AS " +
                 sql_quoted((taken.contains(name) ? "parameter_" : "") + name, '"');
    }
    run("DROP VIEW IF EXISTS cases; CREATE VIEW cases AS SELECT *" + columns + " FROM results");
  }

  void insert(const ResultRow& row) {
    const std::size_t known = names_.size();
    for (const auto& [name, value] : row.parameters) {
      if (names_.insert(name).second)
        run("INSERT OR IGNORE INTO parameter_names VALUES(" + sql_quoted(name, '\'') + ")");
    }
    if (names_.size() != known) show_parameters();
    if (!insert_) insert_ = prepare(kInsert);
    sqlite3_reset(insert_.get());
    bind(insert_, 1, row.file);
    bind(insert_, 2, row.name);
    bind(insert_, 3, row.branch);
    bind(insert_, 4, row.case_id);
    bind(insert_, 5, json_text_of_parameters(row));
    bind(insert_, 6, row.verdict);
    bind(insert_, 7, row.hash);
    bind(insert_, 8, row.simulated_s);  // digits, which the type of the column converts to a number
    sqlite3_bind_int64(insert_.get(), 9, static_cast<std::int64_t>(row.seed));
    bind(insert_, 10, row.kind);
    bind(insert_, 11, row.failure);
    bind(insert_, 12, row.at_s);
    bind(insert_, 13, row.step);
    bind(insert_, 14, row.recording);
    bind(insert_, 15, row.made_of);
    step(insert_);
  }

  void commit() {
    if (!is_open_) return;
    is_open_ = false;
    if (insert_) sqlite3_reset(insert_.get());
    if (find_) sqlite3_reset(find_.get());
    run("COMMIT");
  }

  std::string path_;
  std::mutex mutex_;
  // Declared before the database, because closing this file first would release the database's own locks.
  std::optional<OutputFile> lock_;
  std::unique_ptr<sqlite3, Closing> database_;
  Statement insert_;
  Statement find_;
  std::set<std::string> names_;  // the names of parameters
  bool is_open_ = false;         // true during a transaction
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace

std::unique_ptr<ResultsFile> open_sqlite(const std::string& path, bool continues) {
  return std::make_unique<SqliteResults>(path, continues);
}

}  // namespace understudy::emulator::play
