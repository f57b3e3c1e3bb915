// Writes results as rows, for counting and plotting: as JSON lines (FILE.jsonl), or as a table in a database
// (FILE.sqlite). A run that was killed can continue where its file ends.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

/// The columns of a row, in this order. All of them are texts except `parameters`, `simulated_s`, `at_s` and
/// `seed`.
struct ResultRow {
  std::string file;
  std::string name;
  std::string branch;   // empty for the scenario itself
  std::string case_id;  // 16 digits
  std::vector<std::pair<std::string, std::string>> parameters;
  std::string verdict;  // passed, failed, not reached, unreadable
  std::optional<std::string> hash;
  std::string simulated_s;
  std::uint64_t seed = 0;
  // These are set only for a failure.
  std::optional<std::string> kind;
  std::optional<std::string> failure;
  std::optional<std::string> at_s;
  std::optional<std::string> step;       // "grid.yaml:17"
  std::optional<std::string> recording;  // the path
  std::string made_of;                   // a hash of the files and the program that produced it
};
/// `with_hash` is true if outcome_hash was requested.
ResultRow row_of(const ScenarioResult& result, std::uint64_t made_of, bool with_hash);
/// Returns a JSON object without a line ending. Parameters that are plain numbers are written as numbers.
std::string json_text(const ResultRow& row);
std::string json_text_of_parameters(const ResultRow& row);

/// Identifies the case of a row.
struct CaseKey {
  std::string file;
  std::uint64_t identity = 0;
  std::uint64_t made_of = 0;
};

/// has_failed() may be called on any thread, but only one call at a time.
class ResultsFile {
 public:
  virtual ~ResultsFile() = default;
  /// Returns true if it contains rows from an earlier run, which begin() would delete.
  virtual bool has_rows() = 0;
  /// Empties the file. This is not called if the run continues in the file.
  virtual void begin() = 0;
  /// Returns true if the case failed, false if it did not, and nothing if it has not run before.
  virtual std::optional<bool> has_failed(const CaseKey& key) = 0;
  /// Adds the rows of a case: either all of them or none.
  virtual void add(std::span<const ResultRow> rows) = 0;
  /// Ensures that everything is in the file.
  virtual void finish() = 0;
};

inline constexpr std::string_view kJsonLinesEnding = ".jsonl";
inline constexpr std::string_view kSqliteEnding = ".sqlite";

/// Opens or creates the file; its old content stays until begin(). With `continues`, the run continues in the
/// file, so its rows are read. All functions of the returned object throw GrowingFileError if a file cannot
/// be written, or was not written by this program.
std::unique_ptr<ResultsFile> open_json_lines(const std::string& path, bool continues);
std::unique_ptr<ResultsFile> open_sqlite(const std::string& path, bool continues);

}  // namespace understudy::emulator::play
