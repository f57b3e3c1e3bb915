// Implements `calibrate`: finds the options of choices with which a bench replies as in captures.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/calibrate/calibration.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/command_line/box_bench.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator::command_line {

namespace {

using RowState = box::RowFinding::State;
using Evidence = nlohmann::ordered_json;

constexpr std::array kRowStates = {std::pair{RowState::measured, "measured"},
                                   std::pair{RowState::undecided, "undecided"},
                                   std::pair{RowState::not_exercised, "not_exercised"}};

const char* name_of_state(RowState state) {
  for (const auto& [known, name] : kRowStates)
    if (known == state) return name;
  return "";
}

std::vector<std::string> options_left(const world::Bench& bench, const box::RowFinding& finding) {
  std::vector<std::string> names;
  for (const std::uint8_t option : finding.remaining)
    names.push_back(box::option_name(bench, finding.key, option));
  return names;
}

std::string choice_name(const world::Bench& bench, box::ChoiceKey key) {
  return choice_text(bench, key.device, box::choice_id(bench, key));
}

/// Returns "feeder.exceptions: no_answer, feeder.move_begins: one_tick_in".
std::string hypothesis_text(const world::Bench& bench, const box::Hypothesis& hypothesis) {
  std::string text;
  for (const auto& [key, option] : hypothesis)
    text +=
        (text.empty() ? "" : ", ") + choice_name(bench, key) + ": " + box::option_name(bench, key, option);
  return text.empty() ? "the bench's own options" : text;
}

Evidence evidence_of(const BoxBench& box, const CalibrateArguments& arguments,
                     const box::Calibration& found) {
  Evidence evidence{{"understudy", 1}, {"kind", "evidence"}, {"bench", arguments.compare.bench}};
  if (!arguments.box.empty()) evidence["box"] = arguments.box;
  evidence["devices"] = Evidence::array();
  for (const world::StationSetup& station : box.bench.lines[box.settings.line].stations) {
    const world::DeviceSetup& device = box.bench.devices[station.device];
    evidence["devices"].push_back(
        {{"name", device.settings.name},
         {"model", device.model->name},
         {"firmware", version_text(device.settings.firmware != 0 ? device.settings.firmware
                                                                 : device.model->firmwares.back())}});
  }
  evidence["captures"] = Evidence::array();
  for (const box::Capture& capture : box.captures)
    evidence["captures"].push_back({{"file", capture.path}, {"exchanges", capture.exchanges.size()}});
  evidence["explained"] = found.explains;
  evidence["drift_ppm"] = found.drift_ppm;
  if (found.contradictory)
    evidence["contradictory"] = {box.captures[found.contradictory->first].path,
                                 box.captures[found.contradictory->second].path};
  evidence["choices"] = Evidence::array();
  for (const box::RowFinding& finding : found.findings) {
    Evidence row{{"choice", choice_name(box.bench, finding.key)},
                 {"state", name_of_state(finding.state)},
                 {"options", options_left(box.bench, finding)},
                 {"bench", box::option_name(box.bench, finding.key, finding.before)}};
    if (finding.capture) {
      row["capture"] = box.captures[*finding.capture].path;
      row["place"] = finding.place;
    }
    evidence["choices"].push_back(row);
  }
  return evidence;
}

void print_unexplained_calibration(const BoxBench& box, const box::Calibration& found) {
  const box::Capture& capture = box.captures[found.capture];
  const box::Exchange& exchange = capture.exchanges[found.exchange];
  std::printf("no options explain %s:%zu, at %s\n", capture.path.c_str(), exchange.place,
              format_duration(exchange.at).c_str());
  std::printf("the furthest: %s\n", hypothesis_text(box.bench, found.explanations.front()).c_str());
  if (found.contradictory) {
    const auto [first, second] = *found.contradictory;
    std::printf(
        "%s and %s contradict each other: each is explained alone, but not both; were they made of the same "
        "controller, with the same settings?\n",
        box.captures[first].path.c_str(), box.captures[second].path.c_str());
    return;
  }
  std::printf("next: run understudy compare with these options to see the difference\n");
}

void print_calibration(const BoxBench& box, const box::Calibration& found) {
  std::array<std::size_t, kRowStates.size()> counts{};
  for (const box::RowFinding& finding : found.findings) {
    ++counts[static_cast<std::size_t>(finding.state)];
    if (finding.state == RowState::not_exercised) continue;
    std::string options;
    for (const std::string& option : options_left(box.bench, finding))
      options += (options.empty() ? "" : " or ") + option;
    const bool is_new = finding.state == RowState::measured && !finding.remaining.contains(finding.before);
    std::printf("  %-12s %s: %s%s\n", name_of_state(finding.state),
                choice_name(box.bench, finding.key).c_str(), options.c_str(),
                is_new ? "  (the bench has a different option)" : "");
  }
  std::string text;
  for (const auto& [state, name] : kRowStates)
    text += (text.empty() ? "" : ", ") + std::to_string(counts[static_cast<std::size_t>(state)]) + " " + name;
  std::ranges::replace(text, '_', ' ');
  std::printf("%s, after %zu hypotheses\n", text.c_str(), found.tried);
}

/// Prints what the devices of a bench need, as parts of a bench file.
void print_measured_choices(const BoxBench& box, const box::Calibration& found) {
  std::size_t device = box.bench.devices.size();
  for (const bool is_firmware : {true, false}) {
    for (const box::RowFinding& finding : found.findings) {
      if (finding.state != RowState::measured || finding.remaining.contains(finding.before)) continue;
      if ((finding.key.row == box::ChoiceKey::kFirmware) != is_firmware) continue;
      const std::string id = box::choice_id(box.bench, finding.key);
      const std::string option = box::option_name(box.bench, finding.key, *finding.remaining.begin());
      const std::string& name = box.bench.devices[finding.key.device].settings.name;
      if (is_firmware) {
        std::printf("firmware: %s  # of %s\n", option.c_str(), name.c_str());
        continue;
      }
      if (finding.key.device != device) std::printf("choices:  # of %s\n", name.c_str());
      device = finding.key.device;
      std::printf("  %s: %s\n", id.c_str(), option.c_str());
    }
  }
}

}  // namespace

int calibrate_bench(ModelList models, const CalibrateArguments& arguments) {
  FileClaims claims;
  claims.add({arguments.compare.bench, "the bench itself"});
  for (const std::string& path : arguments.compare.captures) claims.add({path, "an input capture"});
  ResultFile output("--output", require_output(claims, "--output", arguments.output), ContentKind::evidence);
  const BoxBench box = read_box_bench(models, "calibrate", arguments.compare);
  // Settings that the model refuses are reported before any other option is tried.
  box::compare(box.bench, box.captures.front(), box.settings, box::Extent::to_difference);
  const box::Calibration found =
      box::calibrate(box.bench, box.captures, {.compare = box.settings, .threads = 0}, {});
  if (output.is_wanted()) output.write(evidence_of(box, arguments, found).dump(1) + "\n");
  if (arguments.choices && found.explains) {
    print_measured_choices(box, found);
  } else {
    found.explains ? print_calibration(box, found) : print_unexplained_calibration(box, found);
  }
  return found.explains ? kExitWell : kExitFailed;
}

}  // namespace understudy::emulator::command_line
