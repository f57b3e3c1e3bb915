// Reads scenario files (YAML, docs/scenarios.md): one scenario for each row of `cases` combined with all
// values of `vary`. Without these keys, a file contains a single scenario.
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
  /// The files that a scenario saves must be below this folder, or, if it is empty, below the scenario's own
  /// folder, because the author of a scenario may be unknown.
  std::string save_below{};
  std::optional<std::uint64_t> seed{};  // replaces the seeds in the scenarios
  /// The words of the command that runs with each case. They may contain ${...}. Empty: no command.
  std::vector<std::string> command{};
};

/// A scenario file whose cases are read one at a time, because there may be more cases than fit in memory.
/// Its devices must have one of the shared models. Paths in the file are relative to its own folder.
class ScenarioFile {
 public:
  /// Reads the file, but none of its cases. `shared` must outlive this object. Throws FileError.
  ScenarioFile(const std::string& path, const ReadingOptions& options, SharedReading& shared);
  /// Reads a text. In messages and for relative paths, `path` is used as the file's path.
  ScenarioFile(const std::string& text, const std::string& path, const ReadingOptions& options,
               SharedReading& shared);
  ~ScenarioFile();
  ScenarioFile(const ScenarioFile&) = delete;
  ScenarioFile& operator=(const ScenarioFile&) = delete;

  /// Returns the number of cases, which is 1 without `cases` and `vary`.
  std::uint64_t size() const;
  bool is_varied() const;
  // These two functions read one case, counted from 0, and check only what they need.
  Case case_of(std::uint64_t number) const;
  std::string name_of(std::uint64_t number) const;
  /// Reads a case and checks everything in it. Throws FileError.
  Scenario read(std::uint64_t number);
  /// Reads all cases and passes them to `take` one by one. For `vary`, it reads only typical cases, which
  /// together contain each listed value, and both ends and some intermediate values of each range. Throws
  /// FileError with all mistakes.
  void check(const std::function<void(Scenario)>& take);

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

/// Returns the scenarios of ScenarioFile::check(): all cases of a file, or typical cases. Nothing has been
/// run, but everything in the scenarios has been checked. Throws FileError.
std::vector<Scenario> load_scenarios(ModelList models, const std::string& path,
                                     const std::string& save_below = "");
/// The same, for one of several scenarios that use the same files.
std::vector<Scenario> load_scenarios(const std::string& path, const std::string& save_below,
                                     SharedReading& shared);
/// The same, for a text.
std::vector<Scenario> parse_scenarios(ModelList models, const std::string& text, const std::string& path,
                                      const std::string& save_below = "");

/// The kind of a file.
enum class FileKind : std::uint8_t {
  bench,
  scenario,
  steps,  // to be included by other scenarios
  model,  // for benches, which refer to it by its path (docs/import.md)
};
/// Determines the kind of a file from its keys. Throws FileError if the file cannot be read.
FileKind kind_of_file(const std::string& path);

}  // namespace understudy::emulator::play
