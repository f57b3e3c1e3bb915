// The cases of a run: scenario files with all their cases. Files are read and checked before anything runs.
// Cases are kept only if there are few; otherwise, each case is read again when it is run.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "emulator/play/performing/suite.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

/// A part of a test suite: shard number 1 contains the first case and every `of`th case after it.
struct Shard {
  std::uint64_t number = 1;
  std::uint64_t of = 1;
};
/// Parses "2/4". Returns nothing for any other text.
std::optional<Shard> parse_shard(std::string_view text);

/// Returns true if the pattern (`*`, `?`, `[abc]`) matches the name of the case, or if it is the identity of
/// the case.
bool matches(const std::string& pattern, const std::string& name, std::uint64_t identity);

class CaseList {
 public:
  CaseList(ModelList models, ReadingOptions options);

  /// Adds a file, and passes the cases that are checked in advance to `look`. Throws FileError.
  void add(const std::string& path, const std::function<void(const Scenario&)>& look);

  std::size_t files() const { return files_.size(); }
  const std::string& path(std::size_t file) const { return files_[file].path; }
  bool is_varied(std::size_t file) const { return files_[file].is_varied; }
  std::uint64_t cases_of(std::size_t file) const { return files_[file].size; }
  std::uint64_t cases() const;
  /// Returns a hash of all sources from which a file is read.
  std::uint64_t made_of(std::size_t file) const { return files_[file].made_of; }

 private:
  friend class CaseReader;
  struct File {
    std::string path;
    std::uint64_t size = 0;
    bool is_varied = false;
    std::uint64_t made_of = 0;
    std::vector<std::shared_ptr<const Scenario>> held;  // all cases of the file, or none
  };
  std::uint64_t hash_of_file(const std::string& path);
  void claim_saved(const Scenario& scenario) const;

  ReadingOptions options_;
  SharedReading shared_;
  std::vector<File> files_;
  std::size_t held_ = 0;                         // the number of kept cases in all files
  std::map<std::string, std::uint64_t> hashes_;  // of files, by path
  // The files that unlisted cases save: a hash of the path, and a hash of the case.
  mutable std::mutex saved_mutex_;
  mutable std::unordered_map<std::uint64_t, std::uint64_t> saved_;
};

/// Reads the cases in a case list. Each thread has its own reader.
class CaseReader {
 public:
  explicit CaseReader(const CaseList& case_list);
  /// Throws FileError if the case is wrong and was not checked in advance, or if a file has changed.
  std::shared_ptr<const Scenario> read(const CaseId& which_case);
  // Returns the name without reading the whole case.
  std::string name_of(const CaseId& which_case);
  Case case_of(const CaseId& which_case);

 private:
  ScenarioFile& open(std::size_t file);
  const CaseList& case_list_;
  SharedReading shared_;
  std::size_t file_ = SIZE_MAX;  // the open file
  std::unique_ptr<ScenarioFile> open_;
};

/// The cases in a case list that match a pattern, or one shard of these cases, in order.
class Selection {
 public:
  /// An empty pattern matches all.
  Selection(const CaseList& case_list, std::string pattern, Shard shard);
  std::optional<CaseId> next();
  /// Returns how many cases next() will return in total. With a pattern, they are counted one by one.
  static std::uint64_t count(const CaseList& case_list, const std::string& pattern, Shard shard);

 private:
  const CaseList& case_list_;
  std::string pattern_;
  Shard shard_;
  CaseReader reader_;
  CaseId at_;
  std::uint64_t selected_ = 0;  // number of matches so far
};

}  // namespace understudy::emulator::play
