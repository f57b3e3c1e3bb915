// Any text as a program of the test controller is refused with a place for each error, by the check and by a
// device, which is then unchanged; or the device lists its program, and that listing is accepted and listed
// the same again. A program as numbers gives the same program from these numbers.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "emulator/device/program_cells.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using namespace understudy::emulator;
using fuzzing::require;

DeviceSettings settings() {
  DeviceSettings made;
  made.name = "it";
  made.firmware = 100;
  return made;
}

/// The same device repeatedly, restored to its initial state.
workbench::Workbench& fresh_device() {
  static const std::unique_ptr<Device> device = make_device(workbench::model(), settings());
  static const workbench::WorkbenchState fresh = static_cast<workbench::Workbench&>(*device).state;
  auto& its = static_cast<workbench::Workbench&>(*device);
  its.state = fresh;
  return its;
}

void check_places(const std::vector<ProgramMistake>& mistakes, std::string_view text) {
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  std::pair<int, int> last{0, 0};
  for (const ProgramMistake& mistake : mistakes) {
    require(mistake.line >= 1 && mistake.line <= lines + 1 && mistake.column >= 0, "a mistake has a place");
    require(!mistake.what.empty() && mistake.what.find('\n') == std::string::npos, "and says a line");
    require(last <= std::pair(mistake.line, mistake.column), "mistakes come in the order of the text");
    last = {mistake.line, mistake.column};
  }
}

void check_numbers(const std::string& listed) {
  const ProgramCells& cells = *workbench::language().cells();
  try {
    const std::string numbers = to_text(cells.assemble(listed, settings()));
    if (numbers.empty()) return;
    const std::string text = cells.disassemble(read_cells(numbers, cells.cell_form()), settings());
    require(to_text(cells.assemble(text, settings())) == numbers, "a program is the same from its numbers");
  } catch (const ProgramError& error) {
    require(listed.find("FILE ") != std::string::npos, "all but files has numbers");
    check_places({}, error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzzing::text_of(data, size);
  const std::vector<ProgramMistake> mistakes = workbench::language().check(text, settings());
  check_places(mistakes, text);
  workbench::Workbench& device = fresh_device();
  const TextBlocks before = device.state.kept.blocks;
  try {
    device.load_program(text);
  } catch (const ProgramError& error) {
    require(error.mistakes == mistakes, "a device refuses what the check refuses");
    require(device.state.kept.blocks == before, "and keeps what it had");
    return 0;
  }
  require(mistakes.empty(), "a device takes what the check takes");
  const std::string listed = device.program_text();
  const TextBlocks kept = device.state.kept.blocks;
  workbench::Workbench& other = fresh_device();
  other.load_program(listed);
  require(other.state.kept.blocks.all() == kept.all(), "what is listed is the same program");
  require(other.program_text() == listed, "and is listed the same");
  check_numbers(listed);
  return 0;
}
