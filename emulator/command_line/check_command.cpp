#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/program_texts.h"
#include "emulator/command_line/text_argument.h"
#include "emulator/command_line/yaml_files.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
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
std::string checked(ModelList models, const std::string& file, const std::string& save_below) {
  switch (play::kind_of_file(file)) {
    case play::FileKind::bench: {
      world::Bench bench = world::load_bench(models, file);
      serve::read_memories(bench, "");
      return "a bench with " + counted(bench.lines.size(), "line") + " and " +
             counted(bench.devices.size(), "device");
    }
    case play::FileKind::scenario: {
      const auto scenarios = play::load_scenarios(models, file, save_below);
      std::size_t steps = 0;
      for (const play::Scenario& scenario : scenarios) steps += count_steps(scenario.steps);
      return (scenarios.size() == 1 ? "a scenario" : std::to_string(scenarios.size()) + " scenarios") +
             " with " + counted(steps, "step");
    }
    case play::FileKind::steps: return "steps to include; they are checked with the scenarios that do";
  }
  return "";
}

int check_programs(ModelList models, const CheckArguments& arguments) {
  const Model& model = demand_model(models, arguments.programs.model);
  const ProgramLanguage& language = demand_language(model);
  const DeviceSettings settings = program_settings(model, arguments.programs);
  const std::string_view endings[] = {language.file_ending()};
  int code = kExitWell;
  for (const std::string& file : with_folders_opened(arguments.files, endings)) {
    const auto text = read_text_argument(file);
    const auto mistakes =
        text ? check_program(model, *text, settings)
             : std::vector<ProgramMistake>{{.line = 0, .column = 0, .what = text.why + "; expected a file"}};
    print_mistakes(mistakes, file);
    if (!mistakes.empty()) {
      code = kExitBadInput;
      continue;
    }
    const auto lines = static_cast<std::size_t>(std::count(text->begin(), text->end(), '\n'));
    const bool has_rest = !text->empty() && text->back() != '\n';
    std::printf("%s: %s with %s\n", file.c_str(), std::string(language.name()).c_str(),
                counted(lines + (has_rest ? 1 : 0), "line").c_str());
  }
  return code;
}

}  // namespace

int check_files(ModelList models, const CheckArguments& arguments) {
  if (!arguments.programs.model.empty()) return check_programs(models, arguments);
  if (!arguments.programs.firmware.empty() || !arguments.programs.choices.empty())
    throw UsageError("check: --firmware and --choice belong to --model; a bench says them itself");
  int code = kExitWell;
  for (const std::string& file : with_folders_opened(arguments.files, kYamlEndings)) {
    try {
      std::printf("%s: %s\n", file.c_str(), checked(models, file, arguments.save_below).c_str());
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
