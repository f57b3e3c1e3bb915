#include "emulator/command_line/probe_proofs.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "base/simulated_time.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/on_box.h"
#include "emulator/command_line/yaml_files.h"
#include "emulator/device/model.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "pty/line.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;

/// The delays of adapters that a rehearsal tries. A case whose end depends on them tells nothing.
constexpr std::array<SimTime, 3> kDelaysOfAdapters{SimTime{0}, std::chrono::milliseconds(5),
                                                   std::chrono::milliseconds(16)};

/// Returns the folder of the model's proofs: in the source tree, or the installed one.
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

/// Returns what the proof needs beyond a controller with factory settings at its usual station number, or
/// nothing. A rig, or a person, can set inputs and load programs.
std::string need_of(const play::Scenario& scenario, int modules, const OnBox& stage) {
  const world::Bench& bench = scenario.bench;
  if (bench.devices.size() != 1) return "needs several controllers";
  const world::DeviceSetup& device = bench.devices.front();
  const DeviceSettings& settings = device.settings;
  if (bench.lines.size() != 1) return "needs several lines";
  if (!bench.machines.empty()) return "needs a machine";
  if (!bench.wires.empty()) return "needs wires";
  if (!bench.faults.empty()) return "begins with a fault";
  if (bench.lines.front().baud != 0) return "needs another speed of the line";
  if (bench.lines.front().echoes) return "needs a line that echoes";
  if (settings.firmware != 0 && settings.firmware != device.model->firmwares.back())
    return "is about an older firmware";
  if (settings.address.value_or(1) != 1) return "needs another station number";
  if (settings.nv) return "needs a memory with other contents";
  if (settings.choices.size() != 1) return "depends on options of other choices";
  if (settings.modules > modules) return "needs more modules";
  const bool has_surroundings = !settings.dip.empty() || !bench.inputs.empty() || !settings.program.empty();
  if (has_surroundings && !stage.has_helper()) return "needs a rig or a person";
  return "";
}

/// Returns the scenario with the controller's own station number, firmware and modules, on a real line.
std::shared_ptr<const play::Scenario> adapted(const play::Scenario& scenario,
                                              const ProbeArguments& arguments) {
  auto changed = std::make_shared<play::Scenario>(scenario);
  world::DeviceSetup& device = changed->bench.devices.front();
  if (arguments.station) device.settings.address = arguments.station;
  const Firmware firmware = require_firmware(*device.model, arguments.firmware);
  if (firmware != 0) device.settings.firmware = firmware;
  if (device.model->max_modules != 0) device.settings.modules = arguments.modules;
  for (world::LineSetup& line : changed->bench.lines) line.timing = pty::Timing::wire;
  return changed;
}

/// Returns how the case ends whatever the delay. If it does not end in one way, `why` becomes the reason.
std::optional<Ending> rehearsed_ending(play::Scenario scenario, OnBox& stage, std::string& why) {
  play::RunOptions options;
  options.make_executor = [&](const play::Scenario& one) { return stage.rehearse(one); };
  const SimTime gap = scenario.gap;
  std::optional<Ending> all;
  for (const SimTime delay : kDelaysOfAdapters) {
    scenario.gap = gap + delay;
    const CaseEnd end = end_of(play::run_scenario(scenario, options).front());
    if (!end.ending) {
      why = end.why;
      return std::nullopt;
    }
    if (!all) all = end.ending;
    if (all->failed_step != end.ending->failed_step) {
      why = end.why.empty() ? "it depends on the delay" : end.why;
      return std::nullopt;
    }
    if (all->came != end.ending->came) all->came.clear();
  }
  return all;
}

}  // namespace

bool are_alike(const Ending& a, const Ending& b) {
  // A rehearsal receives as many bytes of a reply as are expected, and a real line all of them.
  return a.failed_step == b.failed_step && (a.came.starts_with(b.came) || b.came.starts_with(a.came));
}

CaseEnd end_of(const play::ScenarioResult& result) {
  for (const play::StepResult& step : result.steps)
    if (!step.skipped.empty()) return {.ending = {}, .why = step.skipped};
  if (result.failure)
    return {.ending = Ending{.failed_step = result.steps.size(), .came = result.failure->came},
            .why = result.failure->what};
  if (result.verdict != play::ScenarioResult::Verdict::passed)
    return {.ending = {}, .why = "nothing is checked"};
  return {.ending = Ending()};
}

bool OptionCase::is_telling() const {
  for (const auto& [one, ending] : rehearsed)
    for (const auto& [other, its_ending] : rehearsed)
      if (ending && its_ending && !are_alike(*ending, *its_ending)) return true;
  return false;
}

void Proof::rehearse(OnBox& stage, const MeasuredOptions& measured) {
  for (OptionCase& one : cases) {
    for (const OptionCase& held : cases) {
      play::Scenario rehearsal = *one.scenario;
      auto& options = rehearsal.bench.devices.front().settings.choices;
      options.insert(measured.begin(), measured.end());
      options[std::string(choice->id)] = held.option;
      std::string why;
      one.rehearsed[held.option] = rehearsed_ending(std::move(rehearsal), stage, why);
      if (&one == &held && !one.ended) one.why = why;
    }
  }
  if (std::ranges::none_of(cases, &OptionCase::is_telling)) why_not = "cannot be told over a line";
}

std::vector<std::string> Proof::agreeing() const {
  std::vector<std::string> options;
  for (const OptionCase& held : cases) {
    const bool agrees = std::ranges::all_of(cases, [&](const OptionCase& one) {
      const auto known = one.rehearsed.find(held.option);
      const bool is_known = known != one.rehearsed.end() && known->second && one.ended;
      return is_unsteady || !is_known || are_alike(*known->second, *one.ended);
    });
    if (agrees) options.push_back(held.option);
  }
  return options;
}

bool Proof::is_played() const {
  return why_not.empty() &&
         std::ranges::any_of(cases, [](const OptionCase& one) { return one.ended.has_value(); });
}

std::string Proof::state() const {
  if (!why_not.empty()) return "not_exercised";
  const std::size_t count = agreeing().size();
  return count == 1 ? "measured" : count == 0 ? "contradicted" : "undecided";
}

std::vector<Proof> proofs_of(ModelList models, const Model& model, const ProbeArguments& arguments,
                             const OnBox& stage) {
  const std::string folder = folder_of_proofs(model, arguments.proofs);
  play::CaseList case_list(models, {});
  std::map<std::string, Proof> by_choice;
  for (const std::string& path : files_below(folder, kYamlEndings))
    case_list.add(path, [](const play::Scenario&) {});
  play::CaseReader reader(case_list);
  play::Selection all(case_list, "", {});
  while (const auto next = all.next()) {
    const std::shared_ptr<const play::Scenario> scenario = reader.read(*next);
    for (const ChoiceRow& row : model.choices) {
      if (scenario->choice != row.id || scenario->bench.devices.empty()) continue;
      const auto& chosen = scenario->bench.devices.front().settings.choices;
      const auto option = chosen.find(std::string(row.id));
      Proof& proof = by_choice[std::string(row.id)];
      proof.choice = &row;
      if (option == chosen.end()) {
        proof.why_not = "needs several controllers";
        continue;
      }
      const std::string need = need_of(*scenario, arguments.modules, stage);
      if (proof.why_not.empty()) proof.why_not = need;
      proof.cases.push_back(
          {.option = option->second, .scenario = need.empty() ? adapted(*scenario, arguments) : scenario});
    }
  }
  std::vector<Proof> proofs;
  for (auto& [id, proof] : by_choice) {
    if (proof.why_not.empty() && proof.cases.size() < 2) proof.why_not = "has a case for one option alone";
    proofs.push_back(std::move(proof));
  }
  std::ranges::stable_sort(proofs, std::ranges::greater{}, [](const Proof& one) { return one.cases.size(); });
  return proofs;
}

}  // namespace understudy::emulator::command_line
