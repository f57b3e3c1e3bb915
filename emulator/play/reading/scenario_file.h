// Scenario files (YAML, docs/scenarios.md) into scenarios: one for each row of `cases`, or one if there are
// none.
#pragma once

#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

struct SharedReading;  // shared_reading.h

/// Its devices are of one of the models. Paths in a scenario are relative to its own folder. When this
/// returns nothing has run, but everything has been checked. The scenario may be somebody else's, so what it
/// saves must be below `save_below`, or below its own folder if that is empty. Throws FileError.
std::vector<Scenario> load_scenarios(ModelList models, const std::string& path,
                                     const std::string& save_below = "");
/// Like the above, for one of several scenarios, which share what they read.
std::vector<Scenario> load_scenarios(const std::string& path, const std::string& save_below,
                                     SharedReading& shared);
/// Like the above, from a text; `path` stands for the file in messages and paths.
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
