#include "emulator/world/bench_file/program_warnings.h"

#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

std::vector<FileError::Diagnostic> program_warnings(const DeviceSetup& device, const std::string& text,
                                                    const std::string& file, const InlineText* inside) {
  std::vector<FileError::Diagnostic> all;
  if (text.empty()) return all;
  for (const ProgramMistake& odd : emulator::program_warnings(*device.model, text, device.settings)) {
    if (inside != nullptr) {
      all.push_back(diagnostic_in(*inside, odd));
      continue;
    }
    all.push_back({.place = {.file = file, .line = odd.line, .column = odd.column},
                   .text = one_line(in_file(odd, file))});
  }
  return all;
}

std::vector<FileError::Diagnostic> program_warnings(const Bench& bench) {
  std::vector<FileError::Diagnostic> all;
  for (const DeviceSetup& device : bench.devices) {
    const auto warnings = program_warnings(device, device.settings.program, device.settings.program_name,
                                           device.program_inside ? &*device.program_inside : nullptr);
    all.insert(all.end(), warnings.begin(), warnings.end());
  }
  return all;
}

}  // namespace understudy::emulator::world
