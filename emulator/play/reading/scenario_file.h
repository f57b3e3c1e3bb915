// Scenario files (YAML, docs/scenarios.md) into scenarios: one for each row of `cases` and each combination
// of what `vary` says, or one if there are neither.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

struct SharedReading;  // shared_reading.h

struct ReadingOptions {
  /// A scenario may be somebody else's, so what it saves must be below this folder, or below its own if it is
  /// empty.
  std::string save_below{};
  std::optional<std::uint64_t> seed{};  // instead of the scenarios' own
};

/// A scenario file whose cases are read one at a time: there may be more than fit into memory. Its devices
/// are of the shared models; paths in it are relative to its own folder.
class ScenarioFile {
 public:
  /// Reads it, but none of its cases. `shared` must outlive this. Throws FileError.
  ScenarioFile(const std::string& path, const ReadingOptions& options, SharedReading& shared);
  /// From a text; `path` stands for the file in messages and paths.
  ScenarioFile(const std::string& text, const std::string& path, const ReadingOptions& options,
               SharedReading& shared);
  ~ScenarioFile();
  ScenarioFile(const ScenarioFile&) = delete;
  ScenarioFile& operator=(const ScenarioFile&) = delete;

  /// How many cases there are; 1 without `cases` and `vary`.
  std::uint64_t size() const;
  bool is_varied() const;
  // Of one case, from 0: neither is checked further than it takes.
  Case case_of(std::uint64_t number) const;
  std::string name_of(std::uint64_t number) const;
  /// Reads a case and checks everything in it. Throws FileError.
  Scenario read(std::uint64_t number);
  /// Reads all cases, and gives them away one by one; of those that `vary` makes, typical ones: each listed
  /// value is in one of them, and of each range both ends and some between. Throws FileError with all that is
  /// wrong.
  void check(const std::function<void(Scenario)>& take);

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

/// What ScenarioFile::check() gives: all cases of a file, or typical ones. When this returns nothing has run,
/// but everything in them has been checked. Throws FileError.
std::vector<Scenario> load_scenarios(ModelList models, const std::string& path,
                                     const std::string& save_below = "");
/// Like the above, for one of several scenarios, which share what they read.
std::vector<Scenario> load_scenarios(const std::string& path, const std::string& save_below,
                                     SharedReading& shared);
/// Like the above, from a text.
std::vector<Scenario> parse_scenarios(ModelList models, const std::string& text, const std::string& path,
                                      const std::string& save_below = "");

/// What a file is meant to be, by its keys. Throws FileError if it cannot be read.
enum class FileKind : std::uint8_t {
  bench,
  scenario,
  steps,  // for other scenarios to include
  model,  // that benches name by its path (docs/import.md)
};
FileKind kind_of_file(const std::string& path);

}  // namespace understudy::emulator::play
