// Scenario files (YAML, docs/scenarios.md) into scenarios: one of each row of `cases`, one without.
#pragma once

#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/play/script/scenario.h"

namespace understudy::emulator::play {

struct SharedReading;  // shared_reading.h

/// Its devices are of one of the models. What the path of a scenario is relative to is its own folder.
/// Nothing of it has run when it returns, but all of it is checked. What it saves must be below `save_below`,
/// or below its own folder if that is empty: it may be somebody else's. Throws FileError.
std::vector<Scenario> load_scenarios(ModelList models, const std::string& path,
                                     const std::string& save_below = "");
/// The same for one of several, which share what they read.
std::vector<Scenario> load_scenarios(const std::string& path, const std::string& save_below,
                                     SharedReading& shared);
/// The same from a text; `path` stands for the file in messages and paths.
std::vector<Scenario> parse_scenarios(ModelList models, const std::string& text, const std::string& path,
                                      const std::string& save_below = "");

/// What a file is meant to be, by its keys. Throws FileError if it cannot be read.
enum class FileKind : std::uint8_t {
  bench,
  scenario,
  steps,  // for other scenarios to include
};
FileKind kind_of_file(const std::string& path);

}  // namespace understudy::emulator::play
