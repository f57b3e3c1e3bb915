#include <cstdio>
#include <string>
#include <variant>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/yaml_files.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/models/models.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::command_line {

namespace {

/// "1 line", "2 lines"
std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::size_t count_steps(const play::Steps& steps) {
  std::size_t count = steps.size();
  for (const play::Step& step : steps) {
    const auto* const fork = std::get_if<play::ForkStep>(&step.what);
    if (fork == nullptr) continue;
    for (const play::ForkStep::Branch& branch : fork->branches) count += count_steps(branch.steps);
  }
  return count;
}

/// What the file is, if nothing is wrong with it.
std::string checked(const std::string& file, const std::string& save_below) {
  switch (play::kind_of_file(file)) {
    case play::FileKind::bench: {
      world::Bench bench = world::load_bench(models::all_models(), file);
      serve::read_memories(bench, "");
      return "a bench with " + counted(bench.lines.size(), "line") + " and " +
             counted(bench.devices.size(), "device");
    }
    case play::FileKind::scenario: {
      const auto scenarios = play::load_scenarios(models::all_models(), file, save_below);
      std::size_t steps = 0;
      for (const play::Scenario& scenario : scenarios) steps += count_steps(scenario.steps);
      return (scenarios.size() == 1 ? "a scenario" : std::to_string(scenarios.size()) + " scenarios") +
             " with " + counted(steps, "step");
    }
    case play::FileKind::steps: return "steps to include; they are checked with the scenarios that do";
  }
  return "";
}

}  // namespace

int check_files(const std::vector<std::string>& files, const std::string& save_below) {
  int code = kExitWell;
  for (const std::string& file : with_folders_opened(files)) {
    try {
      std::printf("%s: %s\n", file.c_str(), checked(file, save_below).c_str());
    } catch (const FileError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      code = kExitBadInput;
    } catch (const NvError& error) {
      std::fprintf(stderr, "%s\n", one_line(error.what()).c_str());
      code = kExitBadInput;
    }
  }
  return code;
}

}  // namespace understudy::emulator::command_line
