#include "emulator/play/reading/scenario_warnings.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/program_warnings.h"

namespace understudy::emulator::play {

namespace {

void add_warnings(const Steps& steps, const world::Bench& bench, std::vector<FileError::Diagnostic>& all) {
  for (const Step& step : steps) {
    if (const auto* const fork = std::get_if<ForkStep>(&step.what)) {
      for (const ForkStep::Branch& branch : fork->branches) add_warnings(branch.steps, bench, all);
    }
    const auto* const program = std::get_if<ProgramStep>(&step.what);
    if (program == nullptr || program->refused || !program->asks) continue;
    const world::DeviceSetup& device = bench.devices[program->device];
    if (program->file != step.file) {
      for (auto& odd : world::program_warnings(device, program->text, program->file)) {
        all.push_back(std::move(odd));
      }
      continue;
    }
    // The program is written in the step.
    for (const ProgramMistake& odd : program_warnings(*device.model, program->text, device.settings)) {
      const std::string place = step.file + ":" + std::to_string(step.line) + ": ";
      all.push_back({.place = {.file = step.file, .line = step.line},
                     .text = one_line(place + "program: " + in_text(odd))});
    }
  }
}

}  // namespace

std::vector<FileError::Diagnostic> warnings_of(const Scenario& scenario) {
  std::vector<FileError::Diagnostic> all = world::program_warnings(scenario.bench);
  add_warnings(scenario.steps, scenario.bench, all);
  return all;
}

}  // namespace understudy::emulator::play
