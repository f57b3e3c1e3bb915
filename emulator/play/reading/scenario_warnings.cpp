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
    const world::InlineText* const inside = program->inside ? &*program->inside : nullptr;
    for (auto& odd : world::program_warnings(device, program->text, program->file, inside))
      all.push_back(std::move(odd));
  }
}

}  // namespace

std::vector<FileError::Diagnostic> warnings_of(const Scenario& scenario) {
  std::vector<FileError::Diagnostic> all = world::program_warnings(scenario.bench);
  add_warnings(scenario.steps, scenario.bench, all);
  return all;
}

}  // namespace understudy::emulator::play
