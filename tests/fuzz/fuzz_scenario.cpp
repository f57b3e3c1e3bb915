// Any text as a scenario file is refused with an error, or it is a list of scenarios with names and steps.
// (They are checked, not run: the fuzz targets of lines cover what runs do.)
#include <cstdint>
#include <string>

#include "emulator/models/models.h"
#include "emulator/play/reading/scenario_file.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;

constexpr std::size_t kLongest = 4096;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  try {
    const auto scenarios = emulator::play::parse_scenarios(emulator::models::all_models(),
                                                           std::string(fuzzing::text_of(data, size)),
                                                           "/nonexistent/scenario.yaml");
    require(!scenarios.empty(), "a file that is accepted has a scenario");
    for (const emulator::play::Scenario& scenario : scenarios) {
      require(!scenario.name.empty(), "a scenario has a name");
    }
  } catch (const FileError& error) {
    require(error.what()[0] != '\0', "an error says something");
  }
  return 0;
}
