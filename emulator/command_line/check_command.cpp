#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/findings.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/program_texts.h"
#include "emulator/command_line/text_argument.h"
#include "emulator/command_line/yaml_files.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/more_mistakes.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/reading/scenario_warnings.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/bench_file/program_warnings.h"

namespace understudy::emulator::command_line {

namespace {

/// Returns a count such as "1 line" or "2 lines".
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

std::string_view kind_name(play::FileKind kind) {
  switch (kind) {
    case play::FileKind::bench: return "bench";
    case play::FileKind::scenario: return "scenario";
    case play::FileKind::steps: return "steps";
    case play::FileKind::model: return "model";
  }
  return "file";
}

/// Collects warnings. A warning that several cases of a file share is listed only once.
class Warnings {
 public:
  void add(const std::vector<FileError::Diagnostic>& odd, const std::string& file) {
    for (const FileError::Diagnostic& each : odd) {
      if (!reported_.insert(each.text).second) continue;
      findings_.push_back(finding_of(each, file));
      findings_.back().is_warning = true;
    }
  }
  std::vector<Finding> take() { return std::move(findings_); }

 private:
  std::set<std::string> reported_;
  std::vector<Finding> findings_;
};

/// Describes a valid file, or throws an error.
std::string described(ModelList models, const std::string& file, play::FileKind kind,
                      const std::string& save_below, Warnings& warnings) {
  switch (kind) {
    case play::FileKind::bench: {
      world::Bench bench = world::load_bench(models, file);
      warnings.add(world::program_warnings(bench), file);
      serve::read_memories(bench, "");
      return "a bench with " + counted(bench.lines.size(), "line") + " and " +
             counted(bench.devices.size(), "device");
    }
    case play::FileKind::scenario: {
      play::SharedReading shared{.models = models, .benches = {}, .included = {}};
      play::ScenarioFile scenarios(file, {.save_below = save_below, .seed = {}}, shared);
      std::size_t steps = 0;
      std::size_t checked = 0;
      scenarios.check([&](const play::Scenario& scenario) {
        steps += count_steps(scenario.steps);
        warnings.add(play::warnings_of(scenario), file);
        ++checked;
      });
      const std::string count = std::to_string(scenarios.size());
      return (scenarios.size() == 1 ? "a scenario"
              : checked < scenarios.size()
                  ? count + " scenarios (" + std::to_string(checked) + " of them checked)"
                  : count + " scenarios") +
             " with " + counted(steps, "step");
    }
    case play::FileKind::model: {
      std::vector<FileClaim> files;
      const Model& model = described_model(models, file, files);
      warnings.add(models.files->remarks_on(model), file);
      return "a model with " + counted(register_rows(model).size(), "register") + " and " +
             (model.axes.size() == 1 ? "1 axis" : std::to_string(model.axes.size()) + " axes");
    }
    case play::FileKind::steps:
      return "steps to include; they are checked with the scenarios that include them";
  }
  return "";
}

CheckedFile checked_file(ModelList models, const std::string& file, const std::string& save_below) {
  CheckedFile checked{.file = file, .kind = "file"};
  try {
    const play::FileKind kind = play::kind_of_file(file);
    checked.kind = kind_name(kind);
    Warnings warnings;
    checked.is = described(models, file, kind, save_below, warnings);
    checked.findings = warnings.take();
  } catch (const FileError& error) {
    for (const FileError::Diagnostic& diagnostic : error.diagnostics()) {
      checked.findings.push_back(finding_of(diagnostic, file));
    }
  } catch (const NvError& error) {
    checked.findings.push_back(finding_of({.place = {}, .text = one_line(error.what())}, file));
  }
  return checked;
}

CheckedFile checked_program(const Model& model, const std::string& file, const DeviceSettings& settings) {
  CheckedFile checked{.file = file, .kind = "program"};
  const auto text = read_text_argument(file);
  const auto mistakes = [&]() -> std::vector<ProgramMistake> {
    if (!text) return {{.line = 0, .column = 0, .what = text.why + "; expected a file"}};
    const std::string why = is_another_kind(*text, ContentKind::program);
    if (!why.empty()) return {{.line = 1, .column = 1, .what = why}};
    return with_word_of_more(check_program(model, *text, settings));
  }();
  for (const ProgramMistake& mistake : mistakes) {
    checked.findings.push_back({.place = {file, mistake.line, mistake.column}, .text = mistake.what});
  }
  if (!mistakes.empty()) return checked;
  for (const ProgramMistake& odd : program_warnings(model, *text, settings)) {
    checked.findings.push_back({.place = {file, odd.line, odd.column}, .text = odd.what, .is_warning = true});
  }
  const auto lines = static_cast<std::size_t>(std::count(text->begin(), text->end(), '\n'));
  const bool has_rest = !text->empty() && text->back() != '\n';
  checked.is = std::string(model.language->name()) + " with " + counted(lines + (has_rest ? 1 : 0), "line");
  return checked;
}

/// Checks the files one after another. In text format, prints the findings of each file immediately.
int check_all(const CheckArguments& arguments, std::span<const std::string_view> endings,
              const std::function<CheckedFile(const std::string&)>& check) {
  const auto format = finding_format_called(arguments.format);
  if (!format)
    throw UsageError("--format: " + quoted(arguments.format) +
                     " is not a format; expected text, json, sarif or github");
  std::vector<CheckedFile> all;
  int code = kExitWell;
  for (const std::string& file : with_folders_opened(arguments.files, endings)) {
    CheckedFile checked = check(file);
    if (checked.is_wrong()) code = kExitBadInput;
    if (*format == FindingFormat::text) {
      print_as_text(checked);
    } else {
      all.push_back(std::move(checked));
    }
  }
  std::fputs(findings_as(*format, all).c_str(), stdout);
  return code;
}

}  // namespace

int check_files(ModelList models, const CheckArguments& arguments) {
  if (!arguments.programs.model.empty()) {
    const Model& model = require_model(models, arguments.programs.model);
    const std::string_view endings[] = {require_language(model).file_ending()};
    const DeviceSettings settings = program_settings(model, arguments.programs);
    return check_all(arguments, endings,
                     [&](const std::string& file) { return checked_program(model, file, settings); });
  }
  if (!arguments.programs.firmware.empty() || !arguments.programs.choices.empty())
    throw UsageError("check: --firmware and --choice need --model; a bench has its own");
  return check_all(arguments, kYamlEndings,
                   [&](const std::string& file) { return checked_file(models, file, arguments.save_below); });
}

}  // namespace understudy::emulator::command_line
