// Implements `calibrate`: finds the options of choices with which a bench replies as in the captures.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/sha256.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/calibrate/calibration.h"
#include "emulator/box/calibrate/evidence_file.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/command_line/box_bench.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator::command_line {

namespace {

using RowState = box::RowFinding::State;

/// Returns the state's word from box::kEvidenceStates.
std::string name_of_state(RowState state) {
  switch (state) {
    case RowState::measured: return "measured";
    case RowState::undecided: return "undecided";
    case RowState::not_exercised: return "not_exercised";
  }
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

/// Returns a text such as "feeder.exceptions: no_answer, feeder.move_begins: one_tick_in".
std::string hypothesis_text(const world::Bench& bench, const box::Hypothesis& hypothesis) {
  std::string text;
  for (const auto& [key, option] : hypothesis)
    text +=
        (text.empty() ? "" : ", ") + choice_name(bench, key) + ": " + box::option_name(bench, key, option);
  return text.empty() ? "the bench's own options" : text;
}

box::EvidenceRow evidence_row(const BoxBench& box, const std::vector<box::Capture>& captures,
                              const box::RowFinding& finding) {
  const world::DeviceSetup& device = box.bench.devices[finding.key.device];
  box::EvidenceRow row{.device = device.settings.name,
                       .choice = box::choice_id(box.bench, finding.key),
                       .state = name_of_state(finding.state),
                       .options = options_left(box.bench, finding),
                       .expected = box::option_name(box.bench, finding.key, finding.before)};
  if (finding.capture) {
    row.capture = captures[*finding.capture].path;
    row.place = finding.place;
  }
  return row;
}

/// Returns the bench's version, such as "1.40", or the remaining versions if a capture contradicts it.
std::string firmware_text(const BoxBench& box, std::size_t number, const box::Calibration& found) {
  for (const box::RowFinding& finding : found.findings) {
    const bool is_it = finding.key.device == number && finding.key.row == box::ChoiceKey::kFirmware;
    if (!is_it || finding.remaining.empty() || finding.remaining.contains(finding.before)) continue;
    std::string text;
    for (const std::string& version : options_left(box.bench, finding))
      text += (text.empty() ? "" : " or ") + version;
    return text;
  }
  const world::DeviceSetup& device = box.bench.devices[number];
  return version_text(device.settings.firmware != 0 ? device.settings.firmware
                                                    : device.model->firmwares.back());
}

box::EvidenceFile evidence_of(const BoxBench& box, const std::vector<box::Capture>& captures,
                              const CalibrateArguments& arguments, const box::Calibration& found) {
  box::EvidenceFile evidence{.box = arguments.box,
                             .bench = arguments.compare.bench,
                             .is_explained = found.explains,
                             .is_interrupted = found.is_interrupted,
                             .drift_ppm = found.drift_ppm};
  for (const world::StationSetup& station : box.bench.lines[box.settings.line].stations) {
    const world::DeviceSetup& device = box.bench.devices[station.device];
    evidence.devices.push_back(
        {device.settings.name, std::string(device.model->name), firmware_text(box, station.device, found)});
  }
  for (const box::Capture& capture : captures)
    evidence.captures.push_back(
        {capture.path, capture.exchanges.size(), sha256_of_file(capture.path).value_or("")});
  if (found.contradictory)
    evidence.contradictory = {captures[found.contradictory->first].path,
                              captures[found.contradictory->second].path};
  for (const box::RowFinding& finding : found.findings)
    evidence.rows.push_back(evidence_row(box, captures, finding));
  return evidence;
}

void print_unexplained_calibration(const BoxBench& box, const std::vector<box::Capture>& captures,
                                   const box::Calibration& found) {
  const box::Capture& capture = captures[found.capture];
  const box::Exchange& exchange = capture.exchanges[found.exchange];
  std::printf("no options explain %s:%zu, at %s\n", capture.path.c_str(), exchange.place,
              format_duration(exchange.at).c_str());
  std::printf("the options that agree longest: %s\n",
              hypothesis_text(box.bench, found.explanations.front()).c_str());
  if (found.contradictory) {
    const auto [first, second] = *found.contradictory;
    std::printf(
        "%s and %s contradict each other: options explain each alone, but not both; were they captured from "
        "the same "
        "controller, with the same settings?\n",
        captures[first].path.c_str(), captures[second].path.c_str());
    return;
  }
  std::printf("next: run understudy compare with these options to see the difference\n");
}

/// Returns "812 of 4848 hypotheses, 530/s".
std::string tried_text(const box::CalibrateTally& tally, double seconds) {
  char text[80];
  std::snprintf(text, sizeof text, "%zu of %zu hypotheses, %.0f/s", tally.tried.load(), tally.planned.load(),
                seconds > 0 ? static_cast<double>(tally.tried) / seconds : 0.0);
  return text;
}

/// Returns the progress line, which should fit into 80 columns.
std::string progress_of(const box::CalibrateTally& tally, std::size_t captures, std::size_t exchanges,
                        double seconds) {
  using enum box::CalibrateTally::Phase;
  const std::string tried = tried_text(tally, seconds);
  switch (tally.phase) {
    case trying_each: return "trying each option: " + tried;
    case contradicting: return "searching for contradictions: " + tried;
    case explaining: break;
  }
  std::string text = tried + "; explained " + std::to_string(tally.explained) + " of " +
                     std::to_string(exchanges) + " replies";
  if (captures > 1)
    text += ", " + std::to_string(tally.captures) + " of " + std::to_string(captures) + " captures";
  return text;
}

/// Searches, and shows a progress line on a terminal. Ctrl-C ends the search.
box::Calibration calibrate_with_progress(const BoxBench& box, const std::vector<box::Capture>& captures) {
  std::size_t exchanges = 0;
  for (const box::Capture& capture : captures) exchanges += capture.exchanges.size();
  watch_for_interruption();
  box::CalibrateTally tally;
  const ProgressLine progress(
      [&](double seconds) { return progress_of(tally, captures.size(), exchanges, seconds); });
  return box::calibrate(box.bench, captures, {.compare = box.settings, .threads = 0},
                        {.is_over = is_interrupted, .tally = &tally});
}

/// Prints the results up to Ctrl-C.
void print_interruption(const BoxBench& box, const std::vector<box::Capture>& captures,
                        const box::Calibration& found, std::FILE* to) {
  std::fprintf(to, "interrupted after %zu hypotheses; ", found.tried);
  if (found.explains) {
    std::fprintf(to, "these options explain everything: %s\n",
                 hypothesis_text(box.bench, found.explanations.front()).c_str());
    std::fprintf(to, "the options of %zu choices were tried; the other choices were not\n",
                 found.findings.size());
    return;
  }
  const box::Capture& capture = captures[found.capture];
  const box::Exchange& exchange = capture.exchanges[found.exchange];
  std::fprintf(to, "no options were found that explain everything\n");
  std::fprintf(to, "the options that agree longest, up to %s:%zu, at %s: %s\n", capture.path.c_str(),
               exchange.place, format_duration(exchange.at).c_str(),
               hypothesis_text(box.bench, found.explanations.front()).c_str());
}

/// Prints the measured choices of a bench's devices, in the format of a bench file.
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
  const std::vector<box::Capture> captures = read_captures(models, box, arguments.compare.captures);
  // Settings that the model rejects are reported before any other option is tried.
  box::compare(box.bench, captures.front(), box.settings, box::Extent::to_difference);
  const box::Calibration found = calibrate_with_progress(box, captures);
  const box::EvidenceFile evidence = evidence_of(box, captures, arguments, found);
  // An interrupted search without results must not overwrite the results of an earlier search.
  const bool is_written = output.is_wanted() && (!found.is_interrupted || !found.findings.empty());
  if (is_written) output.replace(box::evidence_text(evidence));
  if (found.is_interrupted) {
    print_interruption(box, captures, found, arguments.choices ? stderr : stdout);
  } else if (!found.explains) {
    print_unexplained_calibration(box, captures, found);
  }
  if (found.explains && arguments.choices) {
    print_measured_choices(box, found);
  } else if (found.explains) {
    std::fputs(box::evidence_table(evidence, "the bench has a different option").c_str(), stdout);
    if (!found.is_interrupted) std::printf("%zu hypotheses were tried\n", found.tried);
  }
  if (is_written && !arguments.choices) std::printf("wrote %s\n", arguments.output.c_str());
  return found.explains && !found.is_interrupted ? kExitWell : kExitFailed;
}

}  // namespace understudy::emulator::command_line
