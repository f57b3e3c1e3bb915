// Implements `probe`: plays the proofs of choices on a real controller, and reports its options.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/simulated_time.h"
#include "emulator/box/calibrate/evidence_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/on_box.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/command_line/yaml_files.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;
using Verdict = play::ScenarioResult::Verdict;

/// The case of a proof for one option of a choice, and its result on a real controller.
struct OptionCase {
  std::string option;
  std::shared_ptr<const play::Scenario> scenario;
  std::optional<Verdict> verdict{};  // nothing: the case was not played
  std::string why{};                 // the reason if the case failed, or could not distinguish the options
};

struct Probed {
  const ChoiceRow* choice = nullptr;
  std::vector<OptionCase> cases{};
  bool is_unsteady = false;  // a case ended differently the second time, so no option is excluded

  /// Returns the options whose cases passed. A case with a skipped step has not checked everything, so it
  /// supports no option.
  std::vector<std::string> agreeing() const {
    std::vector<std::string> options;
    for (const OptionCase& one : cases)
      if (is_unsteady || one.verdict == Verdict::passed) options.push_back(one.option);
    return options;
  }
  bool is_told() const {
    return std::ranges::all_of(cases, [](const OptionCase& one) {
      return one.verdict == Verdict::passed || one.verdict == Verdict::failed;
    });
  }
  const char* state() const {
    if (!is_told()) return "not_exercised";
    const std::size_t count = agreeing().size();
    return count == 1 ? "measured" : count == 0 ? "contradicted" : "undecided";
  }
  /// Proofs with many options are the most informative.
  std::size_t weight() const { return cases.size(); }
};

/// Returns the folder with the model's proofs, either in the source tree or installed.
std::string folder_of_proofs(const Model& model, const std::string& given) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  const std::vector<fs::path> places =
      given.empty() ? std::vector<fs::path>{program / "../share/understudy/docs/fidelity/proofs",
                                            program / "../../docs/fidelity/proofs"}
                    : std::vector<fs::path>{given};
  for (const fs::path& place : places) {
    const fs::path folder = place / std::string(model.name);
    if (fs::is_directory(folder, error)) return fs::canonical(folder, error).string();
  }
  throw UsageError("probe: the proofs of " + std::string(model.name) + " are not in " +
                   places.front().string() + "; expected --proofs with the folder docs/fidelity/proofs");
}

/// Returns true if the proof requires only a controller with factory settings at its usual station number.
bool is_of_bare_controller(const play::Scenario& scenario) {
  const world::Bench& bench = scenario.bench;
  if (bench.devices.size() != 1 || bench.lines.size() != 1) return false;
  const bool is_alone = bench.machines.empty() && bench.wires.empty() && bench.inputs.empty() &&
                        bench.faults.empty() && bench.lines.front().baud == 0;
  if (!is_alone) return false;
  const world::DeviceSetup& device = bench.devices.front();
  const DeviceSettings& settings = device.settings;
  const bool is_newest = settings.firmware == 0 || settings.firmware == device.model->firmwares.back();
  return is_newest && settings.address.value_or(1) == 1 && settings.dip.empty() && !settings.nv &&
         settings.program.empty() && settings.choices.size() == 1 && settings.modules <= 1;
}

/// Returns the scenario with the controller's own station number and firmware.
std::shared_ptr<const play::Scenario> adapted(std::shared_ptr<const play::Scenario> scenario,
                                              const ProbeArguments& arguments) {
  auto changed = std::make_shared<play::Scenario>(*scenario);
  world::DeviceSetup& device = changed->bench.devices.front();
  if (arguments.station) device.settings.address = arguments.station;
  const Firmware firmware = require_firmware(*device.model, arguments.firmware);
  if (firmware != 0) device.settings.firmware = firmware;
  return changed;
}

std::vector<Probed> proofs_of(ModelList models, const Model& model, const ProbeArguments& arguments) {
  const std::string folder = folder_of_proofs(model, arguments.proofs);
  play::CaseList case_list(models, {});
  std::map<std::string, Probed> by_choice;
  for (const std::string& path : files_below(folder, kYamlEndings)) {
    case_list.add(path, [](const play::Scenario&) {});
  }
  play::CaseReader reader(case_list);
  play::Selection all(case_list, "", {});
  while (const auto next = all.next()) {
    const std::shared_ptr<const play::Scenario> scenario = reader.read(*next);
    if (!is_of_bare_controller(*scenario)) continue;
    for (const ChoiceRow& row : model.choices) {
      const auto& chosen = scenario->bench.devices.front().settings.choices;
      const auto option = chosen.find(std::string(row.id));
      if (option == chosen.end() || !scenario->name.starts_with(std::string(row.id) + ":")) continue;
      Probed& probed = by_choice[std::string(row.id)];
      probed.choice = &row;
      probed.cases.push_back({.option = option->second, .scenario = adapted(scenario, arguments)});
    }
  }
  std::vector<Probed> proofs;
  for (auto& [id, probed] : by_choice)
    if (probed.cases.size() > 1) proofs.push_back(std::move(probed));
  std::ranges::stable_sort(proofs, std::ranges::greater{}, &Probed::weight);
  return proofs;
}

void play_case(OptionCase& one, OnBox& stage) {
  play::RunOptions options;
  options.make_executor = [&](const play::Scenario& scenario) { return stage.make(scenario); };
  const std::vector<play::ScenarioResult> results = play::run_scenario(*one.scenario, options);
  const play::ScenarioResult& result = results.front();
  one.verdict = result.verdict;
  if (result.failure) one.why = result.failure->what;
  for (const play::StepResult& step : result.steps) {
    if (step.skipped.empty() || result.failure) continue;
    one.verdict = Verdict::not_tellable;
    one.why = step.skipped;
    break;
  }
}

/// Returns true if the cases distinguish the options over a line: each case passes with its own option, and
/// fails with every other option. Cases that depend on exact moments of simulated time do not, nor do cases
/// that depend on moments that an adapter would delay.
bool are_telling(const Probed& probed, OnBox& stage) {
  constexpr SimTime kDelayOfAdapter = std::chrono::milliseconds(16);
  play::RunOptions options;
  options.make_executor = [&](const play::Scenario& scenario) { return stage.rehearse(scenario); };
  for (const SimTime gap : {SimTime{0}, kDelayOfAdapter}) {
    for (const OptionCase& asked : probed.cases) {
      for (const OptionCase& held : probed.cases) {
        play::Scenario rehearsal = *asked.scenario;
        rehearsal.gap += gap;
        rehearsal.bench.devices.front().settings.choices[std::string(probed.choice->id)] = held.option;
        const play::ScenarioResult result = play::run_scenario(rehearsal, options).front();
        const bool is_whole = std::ranges::all_of(
            result.steps, [](const play::StepResult& step) { return step.skipped.empty(); });
        const Verdict wanted = &asked == &held ? Verdict::passed : Verdict::failed;
        if (!is_whole || result.verdict != wanted) return false;
      }
    }
  }
  return true;
}

/// Plays each case, and then each again, because a late reply or the effect of an earlier case can change a
/// verdict. If the result of a case is unknown, the choice's other cases would not decide either.
void play_all(Probed& probed, OnBox& stage, int times) {
  if (!are_telling(probed, stage)) return;
  for (int time = 0; time < times; ++time) {
    for (OptionCase& one : probed.cases) {
      const std::optional<Verdict> before = one.verdict;
      play_case(one, stage);
      if (one.verdict != Verdict::passed && one.verdict != Verdict::failed) return;
      if (before && one.verdict != before) probed.is_unsteady = true;
    }
  }
}

box::EvidenceFile evidence_of(const Model& model, const ProbeArguments& arguments,
                              const std::vector<Probed>& proofs) {
  const std::string device = "box";
  box::EvidenceFile evidence{.box = arguments.box, .port = arguments.port};
  const Firmware firmware = require_firmware(model, arguments.firmware);
  evidence.devices = {
      {device, std::string(model.name), version_text(firmware != 0 ? firmware : model.firmwares.back())}};
  for (const Probed& probed : proofs) {
    box::EvidenceRow row{.device = device,
                         .choice = std::string(probed.choice->id),
                         .state = probed.state(),
                         .options = probed.is_told() ? probed.agreeing() : std::vector<std::string>(),
                         .expected = std::string(options_of(*probed.choice).front()),
                         .proof = probed.cases.front().scenario->file};
    for (const OptionCase& one : probed.cases)
      if (!one.why.empty()) row.seen[one.option] = one.why;
    evidence.rows.push_back(std::move(row));
  }
  return evidence;
}

}  // namespace

int probe_box(ModelList models, const ProbeArguments& arguments) {
  const Model& model = require_model(models, arguments.model);
  require_firmware(model, arguments.firmware);
  FileClaims claims;
  ResultFile output("--output", require_output(claims, "--output", arguments.output), ContentKind::evidence);
  std::vector<Probed> proofs = proofs_of(models, model, arguments);
  OnArguments on = arguments.on;
  on.on = {"*=" + arguments.port};
  OnBox stage(on, true);
  bool is_aborted = false;
  try {
    for (Probed& probed : proofs) {
      if (on.plan) std::printf("%s\n", std::string(probed.choice->id).c_str());
      play_all(probed, stage, on.plan ? 1 : 2);
    }
  } catch (const play::ExecutionAborted&) {
    is_aborted = true;
  }
  if (on.plan) return kExitWell;
  const box::EvidenceFile evidence = evidence_of(model, arguments, proofs);
  std::fputs(box::evidence_table(evidence, "the model's default is different").c_str(), stdout);
  if (output.is_wanted()) {
    output.replace(box::evidence_text(evidence));
    std::printf("wrote %s\n", arguments.output.c_str());
  }
  return is_aborted ? kExitFailed : kExitWell;
}

}  // namespace understudy::emulator::command_line
