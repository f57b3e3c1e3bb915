// Results as rows, for those who count and plot them: a line of JSON each (FILE.jsonl), or a table in a
// database (FILE.sqlite). A run that was killed can go on where its file ends.
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

/// The columns of a row, in this order. Texts but for `parameters`, `simulated_s`, `at_s` and `seed`.
struct ResultRow {
  std::string file;
  std::string name;
  std::string branch;   // empty: the scenario itself
  std::string case_id;  // 16 digits
  std::vector<std::pair<std::string, std::string>> parameters;
  std::string verdict;  // passed, failed, not reached, unreadable
  std::optional<std::string> hash;
  std::string simulated_s;
  std::uint64_t seed = 0;
  // Of a failure:
  std::optional<std::string> kind;
  std::optional<std::string> failure;
  std::optional<std::string> at_s;
  std::optional<std::string> step;       // "grid.yaml:17"
  std::optional<std::string> recording;  // its path
  std::string made_of;                   // a hash of the files and the program that made it
};
/// `with_hash`: outcome_hash was asked for.
ResultRow row_of(const ScenarioResult& result, std::uint64_t made_of, bool with_hash);
/// A JSON object, without an end of line. Parameters that are plain numbers are numbers.
std::string json_text(const ResultRow& row);
std::string json_text_of_parameters(const ResultRow& row);

/// Which case a row is about.
struct CaseKey {
  std::string file;
  std::uint64_t identity = 0;
  std::uint64_t made_of = 0;
};

/// Of its functions has_failed() may be called on any thread, one call at a time.
class ResultsFile {
 public:
  virtual ~ResultsFile() = default;
  /// Whether it has rows of an earlier run, which begin() would throw away.
  virtual bool has_rows() = 0;
  /// Empties the file; not to be called if the run goes on in it.
  virtual void begin() = 0;
  /// Whether that case has been played before, and failed.
  virtual std::optional<bool> has_failed(const CaseKey& key) = 0;
  /// Adds the rows of one case: all or none of them.
  virtual void add(std::span<const ResultRow> rows) = 0;
  /// Everything is in the file from then on.
  virtual void finish() = 0;
};

inline constexpr std::string_view kJsonLinesEnding = ".jsonl";
inline constexpr std::string_view kSqliteEnding = ".sqlite";

/// Opens the file, or makes it; what is there stays until begin(). With `goes_on`, its rows are read. All of
/// it throws GrowingFileError for what cannot be written, or has not been written by this.
std::unique_ptr<ResultsFile> open_json_lines(const std::string& path, bool goes_on);
std::unique_ptr<ResultsFile> open_sqlite(const std::string& path, bool goes_on);

}  // namespace understudy::emulator::play
