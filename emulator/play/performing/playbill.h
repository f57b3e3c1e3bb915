// What is played: scenario files with all their cases, and which of them, in order. Files are read and
// checked before anything is played; but cases are held only if there are few, and read again when their turn
// comes.
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

/// Which part of a suite: the first, and each `of`th after it, for number 1.
struct Shard {
  std::uint64_t number = 1;
  std::uint64_t of = 1;
};
/// Reads "2/4"; nothing if the text is something else.
std::optional<Shard> parse_shard(std::string_view text);

/// Whether a case is meant: the pattern (`*`, `?`, `[abc]`) matches its name, or is its identity.
bool is_meant(const std::string& pattern, const std::string& name, std::uint64_t identity);

class Playbill {
 public:
  Playbill(ModelList models, ReadingOptions options);

  /// Adds a file, and lets `look` see the cases that are checked beforehand. Throws FileError.
  void add(const std::string& path, const std::function<void(const Scenario&)>& look);

  std::size_t files() const { return files_.size(); }
  const std::string& path(std::size_t file) const { return files_[file].path; }
  bool is_varied(std::size_t file) const { return files_[file].is_varied; }
  std::uint64_t cases_of(std::size_t file) const { return files_[file].size; }
  std::uint64_t cases() const;
  /// A hash of all that a file is read from.
  std::uint64_t made_of(std::size_t file) const { return files_[file].made_of; }

 private:
  friend class CaseReader;
  struct File {
    std::string path;
    std::uint64_t size = 0;
    bool is_varied = false;
    std::uint64_t made_of = 0;
    std::vector<std::shared_ptr<const Scenario>> held;  // all its cases, or none
  };
  std::uint64_t hash_of_file(const std::string& path);
  void claim_saved(const Scenario& scenario) const;

  ReadingOptions options_;
  SharedReading shared_;
  std::vector<File> files_;
  std::size_t held_ = 0;                         // cases, of all files
  std::map<std::string, std::uint64_t> hashes_;  // of files, by path
  // What cases that nobody has listed save: hashes of paths, and of the case.
  mutable std::mutex saved_mutex_;
  mutable std::unordered_map<std::uint64_t, std::uint64_t> saved_;
};

/// Reads the cases of a playbill. Each thread has its own.
class CaseReader {
 public:
  explicit CaseReader(const Playbill& bill);
  /// Throws FileError for a case that was not among those that were checked, or a file that has changed.
  std::shared_ptr<const Scenario> read(const Ticket& ticket);
  // Without reading all of it.
  std::string name_of(const Ticket& ticket);
  Case case_of(const Ticket& ticket);

 private:
  ScenarioFile& open(std::size_t file);
  const Playbill& bill_;
  SharedReading shared_;
  std::size_t file_ = SIZE_MAX;  // that is open
  std::unique_ptr<ScenarioFile> open_;
};

/// Those cases of a playbill that are meant, and of these one shard, in order.
class Selection {
 public:
  /// An empty pattern means all.
  Selection(const Playbill& bill, std::string pattern, Shard shard);
  std::optional<Ticket> next();
  /// How many next() gives in all. With a pattern they are counted one by one.
  static std::uint64_t count(const Playbill& bill, const std::string& pattern, Shard shard);

 private:
  const Playbill& bill_;
  std::string pattern_;
  Shard shard_;
  CaseReader reader_;
  Ticket at_;
  std::uint64_t meant_ = 0;  // so far
};

}  // namespace understudy::emulator::play
